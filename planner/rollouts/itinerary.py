"""The ego's way to its destination: distance, free driving time, and junctions."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from planner.record.places import RouteStep, Rule, Turn
from planner.record.trace import EgoGoal
from planner.roads.roundabouts import ring_exits
from planner.roads.routes import direction_of, rest_of, way_out
from planner.roads.trajectory import Roads
from planner.rollouts.waypoints import next_link, toll, way
from sim.roads.network import Direction, Link, Location, Network, angle_between, point_at

STEPS = 8  # maximum number of junctions ahead that are recorded
BEARING = 20.0  # [m] distance from a roundabout at which the bearing of a road is taken
STRAIGHT = math.radians(45.0)  # [rad] greatest turn that counts as straight on
BACK = 2.6  # [rad] least turn that counts as the way back
TURNS: dict[Direction, Turn] = {
    "left": "exit-left",
    "straight": "exit-straight",
    "right": "exit-right",
}


@dataclass(frozen=True, slots=True)
class Leg:
    """A link on the way."""

    link: Link
    distance: float  # [m] to its entry


@dataclass(frozen=True, slots=True)
class Itinerary:
    """The way from a place towards the destination."""

    legs: tuple[Leg, ...]
    distance: float | None  # [m] to the destination; None where no way leads there
    free_time: float | None  # [s] to the destination if nobody is in the way


@dataclass(frozen=True, slots=True)
class _Stretch:
    """A part of a lane that is driven along."""

    lane: str
    begin: float  # [m] offset
    end: float  # [m] offset


def itinerary(roads: Roads, here: Location, planned: tuple[str, ...], goal: EgoGoal) -> Itinerary:
    """Return the way to the destination.

    Args:
        roads: the road network.
        here: where the ego is.
        planned: connected lanes that it drives along first, beginning with its own; () if open.
        goal: the destination.
    """
    network = roads.network
    edges = _edges(roads, here, planned, goal)
    stretches = [
        _Stretch(here.lane, here.offset, max(network.lanes[here.lane].length, here.offset))
    ]
    stretches += [_whole(network, lane) for lane in rest_of(network, here.lane)]
    legs: list[Leg] = []
    for link in _links(network, stretches[-1].lane, edges):
        legs.append(Leg(link, _length(stretches)))
        stretches += [_whole(network, lane) for lane in link.via]
        edge = network.lanes[link.to_lane].edge
        stretches.append(_whole(network, network.edge_lanes(edge)[0].id))
    last = stretches[-1]
    there = network.lanes[last.lane].edge == goal.edge and len(legs) == len(edges) - 1
    if not there or last.begin > goal.position:
        return Itinerary(tuple(legs), None, None)
    stretches[-1] = _Stretch(last.lane, last.begin, goal.position)
    time = sum(
        (x.end - x.begin) / network.lanes[x.lane].length * toll(roads, x.lane).time
        for x in stretches
    )
    return Itinerary(tuple(legs), _length(stretches), time)


def _whole(network: Network, lane: str) -> _Stretch:
    return _Stretch(lane, 0.0, network.lanes[lane].length)


def _length(stretches: Sequence[_Stretch]) -> float:
    return sum(x.end - x.begin for x in stretches)


def _edges(
    roads: Roads, here: Location, planned: tuple[str, ...], goal: EgoGoal
) -> tuple[str, ...]:
    """Return the edges to drive along, from the ego's on; in a junction, from the next one on."""
    network = roads.network
    start = (here.lane, *rest_of(network, here.lane))
    own = network.lanes[start[-1]].edge
    if len(start) == 1 and own == goal.edge and here.offset > goal.position:
        link = next_link(roads, own, goal)
        return (own,) if link is None else (own, *way(roads, (link.to_lane,), goal))
    edges = way(roads, planned or start, goal)
    return edges if edges[:1] == (own,) else way(roads, start, goal) or (own,)


def _links(network: Network, lane: str, edges: Sequence[str]) -> Iterator[Link]:
    """Yield the link from each edge to the next, from the lane nearest to the one driven."""
    for before, after in pairwise(edges):
        index = network.lanes[lane].index
        found = [
            link
            for other in network.edge_lanes(before)
            for link in network.links_from(other.id)
            if network.lanes[link.to_lane].edge == after
        ]
        if not found:
            return
        link = min(found, key=lambda x: abs(network.lanes[x.from_lane].index - index))
        yield link
        lane = link.to_lane


def is_junction(network: Network, link: Link) -> bool:
    """Check whether passengers would call it a junction: several ways on, or others come in."""
    start = network.lanes[link.from_lane].edge
    links = [x for lane in network.edge_lanes(start) for x in network.links_from(lane.id)]
    ways = {network.lanes[x.to_lane].edge for x in links if x.direction != "turnaround"}
    known = network.junction_links(link.junction)
    others = [known[index] for index in link.foes if known[index].direction != "turnaround"]
    return len(ways) > 1 or any(network.lanes[x.from_lane].edge != start for x in others)


def rings_of(network: Network, link: Link) -> tuple[frozenset[str] | None, frozenset[str] | None]:
    """Return the roundabouts that a link comes from and leads to."""
    start, end = network.lanes[link.from_lane].edge, network.lanes[link.to_lane].edge
    return network.roundabout(start), network.roundabout(end)


def steps(roads: Roads, legs: Sequence[Leg]) -> tuple[RouteStep, ...]:
    """Return the junctions on the way, a roundabout counting as one; the nearest STEPS of them."""
    network = roads.network
    found: list[RouteStep] = []
    entered: Leg | None = None
    for leg in legs:
        before, after = rings_of(network, leg.link)
        if before is None and after is None and is_junction(network, leg.link):
            found.append(_junction(roads, leg))
        if before is not None and before != after:
            within = (entered or legs[0]).link
            first = within.from_lane if entered is None else within.to_lane
            exits = ring_exits(network, network.lanes[first].edge, before)
            found.append(_roundabout(network, before, entered, leg, exits))
            entered = None
        if after is not None and before != after:
            entered = leg
    if entered is not None:  # the destination is on the ring
        ring, edge = rings_of(network, entered.link)[1], network.lanes[entered.link.to_lane].edge
        assert ring is not None
        found.append(_roundabout(network, ring, entered, None, ring_exits(network, edge, ring)))
    return tuple(found[:STEPS])


def _junction(roads: Roads, leg: Leg) -> RouteStep:
    network, link = roads.network, leg.link
    links = network.junction_links(link.junction).values()
    return RouteStep(
        distance=round(leg.distance, 1),
        kind="junction",
        turn=TURNS[direction_of(roads, link)],
        exit=None,
        exits=None,
        arms=len({network.lanes[x.to_lane].edge for x in links}),
        rule=_rule(network, link),
    )


def _roundabout(
    network: Network,
    ring: frozenset[str],
    entered: Leg | None,
    left: Leg | None,
    exits: tuple[str, ...],
) -> RouteStep:
    """Return the step for a roundabout, from its entry (or from within) to its exit, if any."""
    first = entered or left
    assert first is not None
    number = None if left is None else 1 + exits.index(network.lanes[left.link.to_lane].edge)
    return RouteStep(
        distance=round(first.distance, 1),
        kind="roundabout",
        turn=_turn(network, ring, entered, left),
        exit=number,
        exits=len(exits),
        arms=len(exits),
        rule=_rule(network, first.link),
    )


def _turn(network: Network, ring: frozenset[str], entered: Leg | None, left: Leg | None) -> Turn:
    """Return the direction of the road after a roundabout; from within, the side of its exits."""
    side = way_out(network, ring)
    if left is None:
        return "exit-straight"
    if entered is None:
        return TURNS[side]
    before = network.lanes[entered.link.from_lane]
    after = network.lanes[left.link.to_lane]
    _, towards = point_at(before.centreline, before.length - BEARING)
    _, away = point_at(after.centreline, BEARING)
    turned = angle_between(away, towards)
    if abs(turned) >= BACK:
        return "exit-left" if side == "right" else "exit-right"
    if abs(turned) <= STRAIGHT:
        return "exit-straight"
    return "exit-left" if turned > 0.0 else "exit-right"


def _rule(network: Network, link: Link) -> Rule:
    if link.junction in network.equal:
        return "equal"
    return "give-way" if link.yields_to else "priority"
