"""Roads that cross at different levels: a bridge over a road, of which a map need not tell heights.

Where roads cross at one level, a map has a junction, at which their lanes end.
"""

import math
from collections.abc import Sequence

from sim.boxes import Box
from sim.roads.lines import ON_LANE, crossings
from sim.roads.network import Lane, Location, Network
from sim.scene import Point


def apart(network: Network, one: Box, other: Box) -> bool:
    """Whether two boxes that overlap on the map are on roads of which one crosses the other."""
    first, second = _lane(network, one), _lane(network, other)
    if first is None or second is None or first.edge == second.edge:
        return False
    return any(
        any(crossings(own.centreline, line))
        for own, other in ((first, second), (second, first))
        for line in _around(network, other)
    )


def _lane(network: Network, box: Box) -> Lane | None:
    """The lane outside of junctions that a box is on; on pavements, people walk both ways."""
    every = {**network.other_lanes, **network.lanes}
    beside = network.locate_aside(box.position, box.heading, turn=math.pi)
    found = min((*network.locate(box.position, box.heading), *beside), key=_away, default=None)
    if found is None or _away(found) > ON_LANE or every[found.lane].internal:
        return None
    return every[found.lane]


def _away(place: Location) -> float:
    return abs(place.lateral)


def _around(network: Network, lane: Lane) -> list[Sequence[Point]]:
    """A lane with those that lead to it and from it: a body may reach back, or ahead, to them."""
    before = [link for link in network.links_to(lane.id) if link.to_lane == lane.id]
    names = [name for link in before for name in (link.from_lane, *link.via)]
    names += [name for link in network.links_from(lane.id) for name in (*link.via, link.to_lane)]
    return [lane.centreline, *(network.lanes[name].centreline for name in names)]
