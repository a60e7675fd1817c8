"""Whether the route file of a scenario fits its network.

The one error is TableError, which names file, vehicle, problem and remedy.
"""

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from itertools import pairwise
from pathlib import Path

from sim import routes
from sim.network import Network
from sim.routes import Departure, Spawn
from sim.tables import TableError

MANY = 40  # names in a message
SUMOS_OWN = "DEFAULT_"  # how the names of the types begin that SUMO brings


def check_routes(file: Path, root: ET.Element, network: Network) -> None:
    """Every edge and type exists, and the edges of each route follow one another.

    Raises:
        TableError: something does not.
    """
    edges = edges_of(network)
    for edge, owner in routes.mentioned_edges(root).items():
        if edge not in edges:
            key, problem = f"route of {owner!r}", f"there is no edge {edge!r} for cars"
            raise TableError(file, key, problem, one_of(edges))
    known = routes.types(root)
    follow = _followers(network)
    for vehicle in routes.departures(root):
        kind = vehicle.kind
        if kind is not None and kind not in known and not kind.startswith(SUMOS_OWN):
            key = f"vehicle {vehicle.id!r}"
            raise TableError(file, key, f"there is no type {kind!r}", one_of(known))
        for here, after in () if vehicle.trip else pairwise(vehicle.edges):
            if after not in follow.get(here, set()):
                key, problem = (
                    f"route of {vehicle.id!r}",
                    f"no way leads from {here!r} to {after!r}",
                )
                raise TableError(file, key, problem, one_of(follow.get(here, set())))


def check_starts(
    file: Path, departures: Sequence[Departure], network: Network, ego: str, spawn: Spawn | None
) -> None:
    """The ego starts at 0 s, the others in order, and every start lies on its first edge.

    Raises:
        TableError: one does not.
    """
    latest = 0.0
    for vehicle in departures:
        key = f"vehicle {vehicle.id!r}"
        if not vehicle.edges:
            raise TableError(file, key, "it has no route", 'give it <route edges="..."/>')
        if vehicle.id == ego and not vehicle.at_start:
            raise TableError(file, key, "the ego departs late", 'write depart="0"')
        if vehicle.depart is not None:
            if vehicle.depart < latest:
                problem = f"it departs at {vehicle.depart:g} s, after one of {latest:g} s"
                raise TableError(file, key, problem, "put the vehicles in order of depart")
            latest = vehicle.depart
        _check_place(file, key, vehicle, network, spawn if vehicle.at_start else None)


def _check_place(
    file: Path, key: str, vehicle: Departure, network: Network, spawn: Spawn | None
) -> None:
    length = min(lane.length for lane in network.edge_lanes(vehicle.edges[0]))
    half = spawn.longitudinal / 2.0 if spawn else 0.0
    place = vehicle.position
    if spawn and (place is None or not half <= place <= length - half):
        problem = "departPos leaves no room for [spawn]"
    elif place is not None and not -length <= place <= length:
        problem = f"departPos {place:g} is beyond the end of {vehicle.edges[0]!r}"
    else:
        return
    remedy = f"write departPos as a number from {half:g} to {length - half:g} m"
    raise TableError(file, key, problem, remedy)


def edges_of(network: Network) -> set[str]:
    """The edges for cars, without those inside junctions."""
    return {lane.edge for lane in network.lanes.values() if not lane.internal}


def one_of(names: Iterable[str]) -> str:
    """A remedy: what there is to choose from."""
    listed = ", ".join(sorted(names))
    return f"choose one of {listed}" if listed else "there is none to choose"


def near(name: str, names: Iterable[str]) -> str:
    """A remedy: what there is to choose from that is spelt alike, or else what comes first."""
    listed = sorted(names)
    return one_of(get_close_matches(name, listed, n=8, cutoff=0.4) or listed[:MANY])


def _followers(network: Network) -> dict[str, set[str]]:
    """The edges that can be driven to from each edge, lane changes being free."""
    found: dict[str, set[str]] = {}
    for link in network.links:
        start, end = network.lanes[link.from_lane].edge, network.lanes[link.to_lane].edge
        found.setdefault(start, set()).add(end)
    return found
