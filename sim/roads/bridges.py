"""Roads that cross at different levels, such as a bridge over a road; maps may lack heights.

If roads cross at one level, the map has a junction, at which their lanes end.
"""

import math
from collections.abc import Sequence

from sim.boxes import Box
from sim.roads.lines import ON_LANE, crossings
from sim.roads.network import Lane, Location, Network
from sim.scene import Point


def apart(network: Network, one: Box, other: Box) -> bool:
    """Check whether two boxes that overlap on the map are on roads at different levels."""
    first, second = _lane(network, one), _lane(network, other)
    if first is None or second is None or first.edge == second.edge:
        return False
    return any(
        any(crossings(own.centreline, line))
        for own, other in ((first, second), (second, first))
        for line in _around(network, other)
    )


def _lane(network: Network, box: Box) -> Lane | None:
    """Return the lane that a box is on; None if it is on none or inside a junction.

    Lanes that cars may not use match any heading, since people walk both ways on pavements.
    """
    every = {**network.other_lanes, **network.lanes}
    beside = network.locate_aside(box.position, box.heading, turn=math.pi)
    found = min((*network.locate(box.position, box.heading), *beside), key=_away, default=None)
    if found is None or _away(found) > ON_LANE or every[found.lane].internal:
        return None
    return every[found.lane]


def _away(place: Location) -> float:
    return abs(place.lateral)


def _around(network: Network, lane: Lane) -> list[Sequence[Point]]:
    """Return the centrelines of a lane and of those before and after it, which a box may reach."""
    before = [link for link in network.links_to(lane.id) if link.to_lane == lane.id]
    names = [name for link in before for name in (link.from_lane, *link.via)]
    names += [name for link in network.links_from(lane.id) for name in (*link.via, link.to_lane)]
    return [lane.centreline, *(network.lanes[name].centreline for name in names)]
