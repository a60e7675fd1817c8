"""Rides in the midst of traffic: the choice of start and destination.

SUMO runs the configuration once without the ego. The ego gets the way of one of its vehicles, from
where that enters an edge to the end of another edge that it reaches about half a minute later. One
such way is drawn among those with the most vehicles near.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from random import Random

from benchmarks.foreign.sites import MAPS, Site, net_of
from benchmarks.foreign.traffic import made_up
from sim.engine import SimulationError
from sim.roads.netconvert import NetconvertError, opendrive_net
from sim.roads.netfile import NetworkError, read_network
from sim.roads.network import Network
from sim.setup.checks import edges_of
from sim.setup.place_text import place_of
from sim.setup.scenario import ScenarioError, load
from sim.setup.source import Added
from sim.setup.survey import Stay, Trail, survey

WATCHED = 240.0  # [s] for which a configuration is observed, from its begin
LASTING = (25.0, 100.0)  # [s] least and greatest duration of a way
ROOM = 15.0  # [m] least length of the edge to begin or to end on
CROWDED = 0.25  # share of the ways, with the most vehicles near, among which one is drawn
ENOUGH = 4  # least number of ways to draw from
TRIED = 5  # ways that are tried, as SUMO may have none for the ego


class NoRide(Exception):
    """A site offers no ride; the message says why."""


@dataclass(frozen=True, slots=True)
class Chosen:
    """A ride that was chosen."""

    place: str  # to load it from as a scenario
    refused: tuple[str, ...]  # reasons why configurations of the site were skipped


@dataclass(frozen=True, slots=True)
class Way:
    """A way that a ride can take."""

    begin: float  # [s] of SUMO's clock
    edges: tuple[str, ...]
    company: float  # average number of vehicles near the one that drove along it


def ride(site: Site, seed: int, folder: Path) -> Chosen:
    """Choose a ride.

    Args:
        site: the site.
        seed: of the traffic and of the choice.
        folder: folder for traffic that is made up.

    Raises:
        NoRide: the network cannot be read, or no car drives there.
        SimulationError: SUMO is not installed or runs in this process already.
    """
    reasons: list[str] = []
    for file in _configurations(site, seed, folder, reasons):
        try:
            network = _network(file)
            trails = survey(file, seed, WATCHED)
        except (SimulationError, NetworkError) as error:
            reasons.append(str(error))
            continue
        ways = [way for trail in trails for way in _along(trail, network)]
        for way in _drawn(ways, network, Random(f"{site.name}/{seed}")):
            place = place_of(file, Added(way.edges[0], way.edges[-1], way.begin))
            try:
                load(place, seed)
            except ScenarioError as error:
                reasons.append(str(error))
            else:
                return Chosen(place, tuple(reasons))
        reasons.append(f"{file.name}: nobody drives for {LASTING[0]:g} s where cars may")
    raise NoRide("; ".join(dict.fromkeys(reasons)))


def _configurations(site: Site, seed: int, folder: Path, reasons: list[str]) -> Iterator[Path]:
    """Yield the site's own configurations, then one with traffic that is made up."""
    yield from (Path(file) for file in site.configurations)
    net = Path(site.network)
    try:
        net = opendrive_net(net, {}) if net.suffix in MAPS else net
        yield made_up(net, seed, folder)
    except (NetconvertError, NetworkError) as error:
        reasons.append(str(error))


def _network(configuration: Path) -> Network:
    net = net_of(configuration)
    if isinstance(net, str):
        raise NetworkError(f"{configuration.name}: {net}")
    return read_network(net)


def _along(trail: Trail, network: Network) -> Iterator[Way]:
    """Yield the ways that begin where a vehicle enters an edge."""
    edges = edges_of(network)
    for first, start in enumerate(trail.stays[:-1]):
        if start.edge not in edges or _length(network, start.edge) < ROOM:
            continue
        row: list[Stay] = [start]
        for stay in trail.stays[first + 1 :]:
            if stay.edge not in edges or stay.edge in {x.edge for x in row}:
                break
            row.append(stay)
            lasted = stay.end - start.begin
            long = LASTING[0] <= lasted <= LASTING[1] and _length(network, stay.edge) >= ROOM
            if long:
                yield Way(start.begin, tuple(x.edge for x in row), _company(row))
                break


def _company(row: Sequence[Stay]) -> float:
    spent = sum(stay.end - stay.begin for stay in row)
    return sum(stay.company * (stay.end - stay.begin) for stay in row) / max(spent, 1.0)


def _length(network: Network, edge: str) -> float:
    return min(lane.length for lane in network.edge_lanes(edge))


def _drawn(ways: Sequence[Way], network: Network, draw: Random) -> list[Way]:
    """Draw some of the ways with the most vehicles near whose end a car can reach."""
    ranked = sorted(ways, key=lambda way: (-way.company, way.begin, way.edges))
    pool = ranked[: max(ENOUGH, round(CROWDED * len(ranked)))]
    draw.shuffle(pool)
    reached = (way for way in pool if way.edges[0] in network.distance_to(way.edges[-1]))
    return list(islice(reached, TRIED))
