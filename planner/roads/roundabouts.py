"""Roundabouts: the exits that lie ahead of a vehicle before a ring, or in it.

An exit is where a ring can be left; exits are counted from the vehicle on. To `exit-right` is to
leave by the next one (where driving is on the left: `exit-left`), and to `continue-next-exit` is
to go on past it. Before the ring, both begin by entering it. So the n-th exit is reached by n
macro actions, from any place.
"""

from dataclasses import dataclass

from planner.roads.routes import Refusal, approach, rest_of, way_out
from planner.roads.trajectory import Roads
from sim.roads.network import Direction, Link, Location, Network


@dataclass(frozen=True, slots=True)
class RingExit:
    """An exit of a roundabout ahead."""

    lanes: tuple[str, ...]  # connected, from the vehicle's to the last one before the exit
    out: tuple[Link, ...]  # by which the ring is left here, from any of its lanes
    on: Link | None  # by which the last of the lanes leads on round the ring


@dataclass(frozen=True, slots=True)
class Roundabout:
    """A roundabout ahead, or around the vehicle."""

    side: Direction  # to which it is left
    entry: Link | None  # by which it is still to be entered
    entering: int  # lanes before the ring, among those of every exit
    exits: tuple[RingExit, ...]  # in driving order, once round at most


def roundabout_ahead(roads: Roads, here: Location, view: float) -> Roundabout | Refusal:
    """Return the roundabout in view that a vehicle is in, or that its road leads to.

    Args:
        roads: the road network.
        here: where the vehicle is.
        view: [m] how far ahead an entry is seen.
    """
    network, nothing = roads.network, Refusal("there is no roundabout ahead")
    if not network.roundabouts:
        return nothing
    lanes = [here.lane, *rest_of(network, here.lane)]
    ring = _ring(network, lanes[-1])
    entry = None
    if ring is None:
        ahead = approach(roads, here, view)
        last = ahead.lanes[-1]
        if ahead.distance > view or network.lanes[last].internal:
            return nothing
        entries = [
            link
            for lane in network.edge_lanes(network.lanes[last].edge)
            for link in network.links_from(lane.id)
            if _ring(network, link.to_lane) is not None
        ]
        if not entries:
            return nothing
        entry = next((link for link in entries if link.from_lane == last), None)
        if entry is None:
            return Refusal("its lane does not lead into the roundabout")
        ring = _ring(network, entry.to_lane)
        lanes = [*ahead.lanes, *entry.via, entry.to_lane]
    assert ring is not None
    exits = tuple(_exits(network, lanes, ring))
    return Roundabout(_side(roads, ring), entry, len(lanes) - 1, exits)


def _side(roads: Roads, ring: frozenset[str]) -> Direction:
    """Return the side to which a roundabout is left, kept."""
    found: Direction | None = roads.sides.get(ring)
    if found is None:
        found = roads.sides[ring] = way_out(roads.network, ring)
    return found


def _ring(network: Network, lane: str) -> frozenset[str] | None:
    return network.roundabout(network.lanes[lane].edge)


def _exits(network: Network, lanes: list[str], ring: frozenset[str]) -> list[RingExit]:
    """Return the exits once round the ring, which the last of the lanes lies in."""
    found: list[RingExit] = []
    seen: set[str] = set()
    row = list(lanes)
    while True:
        edge = network.lanes[row[-1]].edge
        seen.add(edge)
        links = [x for lane in network.edge_lanes(edge) for x in network.links_from(lane.id)]
        out = tuple(link for link in links if network.lanes[link.to_lane].edge not in ring)
        around = [link for link in links if link not in out and link.direction != "turnaround"]
        own = next((link for link in around if link.from_lane == row[-1]), None)
        if out:
            found.append(RingExit(tuple(row), out, own))
        onto = own or next(iter(around), None)
        if onto is None or network.lanes[onto.to_lane].edge in seen:
            return found
        row += [*onto.via, onto.to_lane]


def ring_exits(network: Network, edge: str, ring: frozenset[str]) -> tuple[str, ...]:
    """Return the roads that leave a ring, in driving order once round from one of its edges on."""
    found: dict[str, None] = {}
    seen: set[str] = set()
    here: str | None = edge
    while here is not None and here not in seen:
        seen.add(here)
        links = [x for lane in network.edge_lanes(here) for x in network.links_from(lane.id)]
        after = [network.lanes[x.to_lane].edge for x in links if x.direction != "turnaround"]
        found.update(dict.fromkeys(name for name in after if name not in ring))
        here = next((name for name in after if name in ring), None)
    return tuple(found)
