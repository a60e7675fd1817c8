"""Checks of what a conversion from OpenDRIVE may have lost: ways, traffic lights, right of way.

netconvert names the edges of road R `-R` along the road and `R` against it, each with a suffix
where it splits the road. It ignores <priority> (OpenDRIVE 1.4, section 5.4.1), and joins roads
by their <link> elements alone. If a road has a light, netconvert makes the whole junction that
the road leads to a signalled one, with a programme of its own, since the map has none.

`conversion_warnings` returns one sentence for each thing that it finds.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from sim.roads.network import Link, Network, angle_between
from sim.scene import Signal

DRIVING = "driving"  # the type of lanes for cars
NEAR = 10.0  # [m] greatest gap from the end of a road to the start of one that may continue it
MOST_TURN = math.radians(60.0)  # greatest angle between the two
FIRST, BETWEEN, LAST = 10, 5, 1  # edge priorities that a warning advises
LIGHT = "10000"  # prefix of the types of traffic lights
SHOWN = 6  # greatest number of edges listed in one warning


@dataclass(frozen=True, slots=True)
class _Turn:
    """A connection of a junction in the map."""

    junction: str
    incoming: str  # road
    connecting: str  # road
    outgoing: str  # road


@dataclass(frozen=True, slots=True)
class _Pair:
    """Two ways through a junction; by the map, `first` goes first."""

    first: Link
    second: Link


def conversion_warnings(
    root: ET.Element, network: Network, start: str, priority: Mapping[str, int]
) -> tuple[str, ...]:
    """Return sentences about what looks wrong in a network that was converted from a map.

    Args:
        root: the map.
        network: the network that the map was converted to.
        start: the edge where the ego starts.
        priority: the edge priorities that the conversion was given.
    """
    turns = tuple(_turns(root))
    return (
        *_lost_ways(turns, network),
        *_gaps(network),
        *_dead_ends(network),
        *_parts(network, start),
        *_contradictions(root, turns, network, priority),
        *_lost_lights(root, network),
    )


def _turns(root: ET.Element) -> Iterator[_Turn]:
    """Yield the connections over which cars can drive."""
    roads = {
        road.get("id", ""): road
        for road in root.iter("road")
        if any(lane.get("type") == DRIVING for lane in road.iter("lane"))
    }
    for junction in root.iter("junction"):
        for connection in junction.iter("connection"):
            through = connection.get("connectingRoad", "")
            end = "predecessor" if connection.get("contactPoint") == "end" else "successor"
            after = roads[through].find(f"link/{end}") if through in roads else None
            if after is not None and after.get("elementType") == "road":
                incoming = connection.get("incomingRoad", "")
                name, outgoing = junction.get("id", ""), after.get("elementId", "")
                yield _Turn(name, incoming, through, outgoing)


def _lost_ways(turns: tuple[_Turn, ...], network: Network) -> Iterator[str]:
    """Yield a warning for each connection of the map without a link, if both roads exist."""
    roads = {_road(lane.edge) for lane in network.lanes.values() if not lane.internal}
    links = _links_by_roads(network)
    for turn in turns:
        ends = (turn.incoming, turn.outgoing)
        if roads >= set(ends) and ends not in links:
            yield (
                f"junction {turn.junction!r}: the way from road {turn.incoming!r} to road"
                f" {turn.outgoing!r} was lost; correct the <laneLink> of connecting road"
                f" {turn.connecting!r} in the map"
            )


def _gaps(network: Network) -> Iterator[str]:
    """Yield a warning for each edge that ends although another seems to continue it close by."""
    lead_on, reached = _ends(network)
    edges = sorted({lane.edge for lane in network.lanes.values() if not lane.internal})
    starts = [edge for edge in edges if edge not in reached]
    for edge in edges:
        for other in starts if edge not in lead_on else ():
            away = _away(network, edge, other)
            if away is not None and _road(other) != _road(edge):
                yield (
                    f"edge {edge!r} ends {away:.1f} m from where {other!r} begins, and no way"
                    f" leads across; correct the <link> of roads {_road(edge)!r} and"
                    f" {_road(other)!r} in the map"
                )


def _away(network: Network, edge: str, other: str) -> float | None:
    """Return the gap [m] from the end of an edge to the start of another that may continue it.

    None if the gap is too wide, or the angle too great.
    """
    end = network.edge_lanes(edge)[0].centreline[-2:]
    begin = network.edge_lanes(other)[0].centreline[:2]
    headings = [math.atan2(b[1] - a[1], b[0] - a[0]) for a, b in (end, begin)]
    away = math.dist(end[1], begin[0])
    return away if away <= NEAR and abs(angle_between(*headings)) <= MOST_TURN else None


def _dead_ends(network: Network) -> Iterator[str]:
    """Yield a warning for each lane that ends although another lane of its edge leads on."""
    lead_on, _ = _ends(network)
    for lane in network.lanes.values():
        if not lane.internal and lane.edge in lead_on and not network.links_from(lane.id):
            yield (
                f"lane {lane.id!r} is a dead end: vehicles must leave it for another lane of edge"
                f" {lane.edge!r}; if they need not on the road, correct its <link> in the map"
            )


def _parts(network: Network, start: str) -> Iterator[str]:
    """Yield a warning for each group of edges that is not connected with the ego's roads."""
    joined: dict[str, set[str]] = {}
    for link in network.links:
        ends = _link_roads(network, link)
        joined.setdefault(ends[0], set()).add(ends[1])
        joined.setdefault(ends[1], set()).add(ends[0])
    edges: dict[str, list[str]] = {}
    for edge in sorted({lane.edge for lane in network.lanes.values() if not lane.internal}):
        edges.setdefault(_road(edge), []).append(edge)
    left = set(edges) - _reach(joined, _road(start))
    while left:
        part = _reach(joined, min(left))
        left -= part
        names = [repr(edge) for road in sorted(part) for edge in edges.get(road, ())]
        more = ", ..." if len(names) > SHOWN else ""
        yield (
            f"no way leads between the ego's roads and {', '.join(names[:SHOWN])}{more};"
            " correct the <link> of these roads in the map if one should"
        )


def _contradictions(
    root: ET.Element, turns: tuple[_Turn, ...], network: Network, priority: Mapping[str, int]
) -> Iterator[str]:
    """Yield a warning for each junction whose right of way differs from the map's, with advice."""
    for junction in root.iter("junction"):
        pairs = list(_pairs(junction, turns, network))
        wrong = [pair for pair in pairs if not _holds(pair)]
        if not wrong:
            continue
        high = {network.lanes[pair.first.from_lane].edge for pair in pairs}
        low = {network.lanes[pair.second.from_lane].edge for pair in pairs}
        advice = {
            edge: BETWEEN if edge in high & low else FIRST if edge in high else LAST
            for edge in sorted(high | low)
        }
        lines = ", ".join(f'"{edge}" = {value}' for edge, value in advice.items())
        mend = f"write in scenario.toml under [priority]: {lines}"
        if all(priority.get(edge) == value for edge, value in advice.items()):
            mend = "[priority] does not solve it; correct the junction in the map"
        told = "; ".join(dict.fromkeys(_told(pair, network) for pair in wrong))
        yield f"junction {junction.get('id')!r}: {told}; {mend}"


def _pairs(junction: ET.Element, turns: tuple[_Turn, ...], network: Network) -> Iterator[_Pair]:
    """Yield pairs of ways that meet, from different lanes, and that a <priority> orders.

    Ways with traffic lights are left out: the lights decide there.
    """
    links = _links_by_roads(network)
    here = [turn for turn in turns if turn.junction == junction.get("id")]

    def named(road: str | None) -> list[Link]:
        chosen = [x for x in here if x.connecting == road] or [
            x for x in here if x.incoming == road
        ]
        return [link for x in chosen for link in links.get((x.incoming, x.outgoing), ())]

    for rule in junction.iter("priority"):
        for first in named(rule.get("high")):
            for second in named(rule.get("low")):
                meet = first.junction == second.junction and second.index in first.foes
                lit = isinstance(first.control, Signal)
                if meet and not lit and first.from_lane != second.from_lane:
                    yield _Pair(first, second)


def _lost_lights(root: ET.Element, network: Network) -> Iterator[str]:
    """Yield a warning for each traffic light beside a road that controls no way from there."""
    held = {
        network.lanes[link.from_lane].edge.split(".")[0]
        for link in network.links
        if isinstance(link.control, Signal)
    }
    for road in root.iter("road"):
        if road.get("junction", "-1") != "-1":
            continue
        name = road.get("id", "")
        ends = {"+": (f"-{name}",), "-": (name,)}
        for signal in road.iterfind("signals/signal"):
            edges = ends.get(signal.get("orientation", ""), (f"-{name}", name))
            if signal.get("type", "").startswith(LIGHT) and held.isdisjoint(edges):
                yield (
                    f"traffic light {signal.get('id')!r} of road {name!r} was lost: it holds"
                    " nobody; correct the place, orientation or type of this <signal> in the map"
                )


def _holds(pair: _Pair) -> bool:
    waits = pair.first.index in pair.second.yields_to
    return waits and pair.second.index not in pair.first.yields_to


def _told(pair: _Pair, network: Network) -> str:
    (a, b), (c, d) = (
        tuple(network.lanes[lane].edge for lane in (link.from_lane, link.to_lane))
        for link in (pair.first, pair.second)
    )
    return f"by the map {a!r} to {b!r} goes before {c!r} to {d!r}, here it does not"


def _road(edge: str) -> str:
    """Return the road of the map that an edge comes from."""
    return edge.removeprefix("-").split(".")[0]


def _link_roads(network: Network, link: Link) -> tuple[str, str]:
    ends = network.lanes[link.from_lane].edge, network.lanes[link.to_lane].edge
    return _road(ends[0]), _road(ends[1])


def _links_by_roads(network: Network) -> dict[tuple[str, str], list[Link]]:
    found: dict[tuple[str, str], list[Link]] = {}
    for link in network.links:
        found.setdefault(_link_roads(network, link), []).append(link)
    return found


def _ends(network: Network) -> tuple[set[str], set[str]]:
    """Return the edges at which links begin, and those at which links end."""
    lanes = network.lanes
    lead_on = {lanes[link.from_lane].edge for link in network.links}
    return lead_on, {lanes[link.to_lane].edge for link in network.links}


def _reach(joined: Mapping[str, set[str]], road: str) -> set[str]:
    """Return the roads connected with a road, including itself."""
    found, frontier = {road}, [road]
    while frontier:
        new = joined.get(frontier.pop(), set()) - found
        found |= new
        frontier += new
    return found
