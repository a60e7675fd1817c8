"""Checks of whether the route file of a scenario fits its network.

The only error is TableError, which names file, vehicle, problem and remedy.
"""

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from itertools import pairwise
from pathlib import Path

from sim.roads.network import Network
from sim.setup import routes
from sim.setup.routes import Departure
from sim.setup.tables import TableError

MANY = 12  # greatest number of names in a message if none is spelt alike
SUMOS_OWN = "DEFAULT_"  # prefix of the names of SUMO's predefined types


def check_routes(file: Path, root: ET.Element, network: Network, ego: str) -> None:
    """Check that every edge and type exists, and that the edges of each route are connected.

    Only the ego must keep to edges for cars.

    Raises:
        TableError: one of this is not so.
    """
    cars = edges_of(network)
    edges = cars | {lane.edge for lane in network.other_lanes.values() if not lane.internal}
    for edge, owner in routes.mentioned_edges(root).items():
        if edge not in edges:
            key, problem = f"route of {owner!r}", f"there is no edge {edge!r}"
            raise TableError(file, key, problem, near(edge, edges))
    known = routes.types(root)
    follow = _followers(network)
    for vehicle in routes.departures(root):
        kind = vehicle.kind
        if kind is not None and kind not in known and not kind.startswith(SUMOS_OWN):
            key = f"vehicle {vehicle.id!r}"
            raise TableError(file, key, f"there is no type {kind!r}", one_of(known))
        key = f"route of {vehicle.id!r}"
        barred = [edge for edge in vehicle.edges if edge not in cars]
        if vehicle.id == ego and barred:
            problem = f"edge {barred[0]!r} is not for cars"
            raise TableError(file, key, problem, near(barred[0], cars))
        for here, after in () if vehicle.trip else pairwise(vehicle.edges):
            if after not in follow.get(here, set()):
                problem = f"no way leads from {here!r} to {after!r}"
                raise TableError(file, key, problem, one_of(follow.get(here, set())))


def check_starts(
    file: Path, departures: Sequence[Departure], network: Network, ego: str, spawn: bool
) -> None:
    """Check that the ego starts at 0 s, and that every vehicle starts on its first edge.

    Args:
        file: the route file.
        departures: the vehicles in it.
        network: the roads.
        ego: the ego's id.
        spawn: whether starts at 0 s vary.

    Raises:
        TableError: one of this is not so.
    """
    for vehicle in departures:
        key = f"vehicle {vehicle.id!r}"
        if not vehicle.edges:
            raise TableError(file, key, "it has no route", 'give it <route edges="..."/>')
        if vehicle.id == ego and not vehicle.at_start:
            raise TableError(file, key, "the ego departs late", 'write depart="0"')
        _check_place(file, key, vehicle, network, spawn and vehicle.at_start)


def _check_place(file: Path, key: str, vehicle: Departure, network: Network, varies: bool) -> None:
    both = (*network.lanes.values(), *network.other_lanes.values())
    lanes = [lane for lane in both if lane.edge == vehicle.edges[0] and not lane.internal]
    length = min(lane.stated_length for lane in lanes)
    place = vehicle.position
    if varies and place is None:
        problem = "departPos is not a number, from which [spawn] could vary it"
    elif place is not None and not -length <= place <= length:
        problem = f"departPos {place:g} is beyond the end of {vehicle.edges[0]!r}"
    else:
        return
    remedy = f"write departPos as a number from 0 to {length:g} m"
    raise TableError(file, key, problem, remedy)


def edges_of(network: Network) -> set[str]:
    """Return the edges for cars, without those inside junctions."""
    return {lane.edge for lane in network.lanes.values() if not lane.internal}


def one_of(names: Iterable[str]) -> str:
    """Return a remedy that lists what can be chosen."""
    listed = ", ".join(sorted(names))
    return f"choose one of {listed}" if listed else "there is none to choose"


def near(name: str, names: Iterable[str]) -> str:
    """Return a remedy that lists the names spelt like a name, or else the first ones."""
    listed = sorted(names)
    alike = get_close_matches(name, listed, n=8, cutoff=0.4)
    if alike or len(listed) <= MANY:
        return one_of(alike or listed)
    return f"choose one of {', '.join(listed[:MANY])}, ..."


def _followers(network: Network) -> dict[str, set[str]]:
    """Return the edges that follow each edge, from any of its lanes."""
    found: dict[str, set[str]] = {}
    every = {**network.other_lanes, **network.lanes}
    for link in (*network.links, *network.other_links):
        start, end = every[link.from_lane].edge, every[link.to_lane].edge
        found.setdefault(start, set()).add(end)
    return found
