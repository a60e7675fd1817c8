"""Roads as surfaces, for viewers."""

import math
from collections.abc import Iterable, Iterator, Sequence

from sim.roads.lanes import Lane
from sim.roads.network import Network
from sim.scene import Point
from xavi_dialogue.viewers import colours
from xavi_dialogue.viewers.messages import Colour, Part, Place, line, surface

MARKING_WIDTH = 0.15  # [m]
LIFTS = {"others": 0.0, "junction": 0.01, "lane": 0.02, "crossing": 0.03, "marking": 0.04}  # [m]


def drawn(network: Network) -> tuple[Part, ...]:
    """Return lanes, the ways through junctions, crossings, and the edges of lanes."""
    lanes = [lane for lane in network.lanes.values() if not lane.internal]
    inside = [lane for lane in network.lanes.values() if lane.internal]
    return (
        *_strips(network.other_lanes.values(), LIFTS["others"], colours.ROAD_OF_OTHERS),
        *_strips(inside, LIFTS["junction"], colours.ROAD),
        *_strips(lanes, LIFTS["lane"], colours.ROAD),
        *(
            _strip(crossing.line, crossing.width, LIFTS["crossing"], colours.CROSSING)
            for crossing in network.crossings
        ),
        *_markings(lanes),
    )


def beside(points: Sequence[Point], offset: float, z: float) -> list[Place]:
    """Return a line [m] to the left of another, at a height [m]."""
    result = []
    for k, (x, y) in enumerate(points):
        before, after = points[max(k - 1, 0)], points[min(k + 1, len(points) - 1)]
        dx, dy = after[0] - before[0], after[1] - before[1]
        length = math.hypot(dx, dy) or 1.0
        result.append((x - offset * dy / length, y + offset * dx / length, z))
    return result


def _strips(lanes: Iterable[Lane], z: float, colour: Colour) -> Iterator[Part]:
    for lane in lanes:
        yield _strip(lane.centreline, lane.width, z, colour)


def _strip(points: Sequence[Point], width: float, z: float, colour: Colour) -> Part:
    left, right = beside(points, width / 2.0, z), beside(points, -width / 2.0, z)
    corners = [corner for pair in zip(left, right, strict=True) for corner in pair]
    triangles = []
    for k in range(0, len(corners) - 2, 2):
        triangles += [k, k + 1, k + 2, k + 2, k + 1, k + 3]
    return surface(corners, triangles, colour)


def _markings(lanes: Sequence[Lane]) -> Iterator[Part]:
    for lane in lanes:
        sides = (lane.width / 2.0,) if lane.index else (lane.width / 2.0, -lane.width / 2.0)
        for side in sides:
            points = beside(lane.centreline, side, LIFTS["marking"])
            yield line(points, MARKING_WIDTH, [colours.MARKING])
