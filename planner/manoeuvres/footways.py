"""Crossings for people on foot that ways through junctions lead over."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from planner.manoeuvres.plans import LetCross
from planner.roads.trajectory import Roads
from sim.roads.network import Crossing, Link, cumulative, point_at, project

BEFORE = 1.0  # [m] before a crossing at which to wait for people on it
ROOM = 5.5  # [m] that a car needs between two crossings to wait there
PASSED = BEFORE + 0.5  # [m] beyond a line; farther on, a car has set out over the crossing
SAMPLING = 0.25  # [m] between the places along a way that are tested
BEYOND = 1.0  # [m] beyond each end of a crossing's line that still belongs to it


@dataclass(frozen=True, slots=True)
class Over:
    """A crossing that a link leads over."""

    crossing: Crossing
    begin: float  # [m] along the link to where its centreline comes onto the crossing
    end: float  # [m] along the link to where its centreline leaves the crossing


def over(roads: Roads, link: Link) -> tuple[Over, ...]:
    """Return the crossings that a link leads over, nearest first."""
    key = (link.junction, link.index)
    found = roads.footways.get(key)
    if found is None:
        met = (_over(roads, link, crossing) for crossing in roads.network.crossings_on(link))
        known = sorted((x for x in met if x is not None), key=lambda x: x.begin)
        found = roads.footways[key] = tuple(known)
    return tuple(found)


def lines_over(roads: Roads, link: Link, begin: float) -> Iterator[LetCross]:
    """Yield the places to let people cross on a path, given the arc [m] at which a link begins.

    The arc is negative where the path begins inside the junction. Crossings passed are left out.
    Where there is no room to wait between two crossings, the car waits before the first one for
    people on both.
    """
    before: Over | None = None
    for one in over(roads, link):
        if begin + one.end > 0.0:
            key = (link.junction, one.crossing.index)
            first = one.crossing.index in link.other_yields_to
            stop, clear = begin + one.begin - BEFORE, begin + one.end
            line = LetCross(stop, clear, frozenset((key,)), one.crossing, first)
            if before is not None and one.begin - BEFORE - before.end < ROOM:
                early = begin + before.begin - BEFORE
                if early > -PASSED:
                    yield replace(line, stop=early, clear=early + PASSED)
            yield line
        before = one


def crossings_along(
    roads: Roads, lane: str, edges: Sequence[str], reach: float
) -> tuple[Crossing, ...]:
    """Return the crossings that a way leads over.

    Args:
        roads: the road network.
        lane: the lane at which the way begins.
        edges: the edges of the way, in order.
        reach: [m] greatest distance along them.
    """
    network = roads.network
    inside = network.link_via(lane)
    links = [] if inside is None else [inside]
    for edge, after in pairwise(edges):
        lanes = network.edge_lanes(edge)
        leading = (link for one in lanes for link in network.links_from(one.id))
        links += [link for link in leading if network.lanes[link.to_lane].edge == after]
        if edge != network.lanes[lane].edge:
            reach -= lanes[0].length
        if reach < 0.0:
            break
    found = {one.crossing.id: one.crossing for link in links for one in over(roads, link)}
    return tuple(found.values())


def _over(roads: Roads, link: Link, crossing: Crossing) -> Over | None:
    """Return where a link leads over a crossing; None if it does not."""
    length, half = cumulative(crossing.line)[-1], 0.5 * crossing.width
    inside: list[float] = []
    passed = 0.0
    for name in link.via:
        lane = roads.network.lanes[name]
        for along in np.linspace(0.0, lane.length, max(2, math.ceil(lane.length / SAMPLING))):
            position, _ = point_at(lane.centreline, float(along))
            offset, aside, _ = project(crossing.line, position)
            if abs(aside) <= half and -BEYOND <= offset <= length + BEYOND:
                inside.append(passed + float(along))
        passed += lane.length
    return Over(crossing, inside[0], inside[-1]) if inside else None
