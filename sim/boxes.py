"""Vehicles and people as oriented boxes: the ground truth for collisions."""

import math
from typing import Protocol

from sim.scene import Point


class Box(Protocol):
    """Anything with a position, a heading and a size; see `VehicleState` for the fields."""

    @property
    def position(self) -> Point: ...

    @property
    def heading(self) -> float: ...

    @property
    def length(self) -> float: ...

    @property
    def width(self) -> float: ...


def corners(state: Box) -> tuple[Point, Point, Point, Point]:
    """Return the front left, front right, rear right and rear left corner [m] of a box."""
    x, y = state.position
    ahead_x, ahead_y = math.cos(state.heading), math.sin(state.heading)
    side_x, side_y = -ahead_y * state.width / 2.0, ahead_x * state.width / 2.0
    rear_x, rear_y = x - ahead_x * state.length, y - ahead_y * state.length
    return (
        (x + side_x, y + side_y),
        (x - side_x, y - side_y),
        (rear_x - side_x, rear_y - side_y),
        (rear_x + side_x, rear_y + side_y),
    )


def overlap(a: Box, b: Box) -> bool:
    """Check whether two boxes share ground; touching is not overlapping.

    Two boxes are apart exactly if they do not overlap when projected onto the normal of one of
    their sides (separating axis theorem; Gottschalk, Lin and Manocha, "OBBTree", SIGGRAPH 1996).
    """
    corners_a, corners_b = corners(a), corners(b)
    for heading in (a.heading, b.heading):
        ahead = (math.cos(heading), math.sin(heading))
        for axis in (ahead, (-ahead[1], ahead[0])):
            low_a, high_a = _extent(corners_a, axis)
            low_b, high_b = _extent(corners_b, axis)
            if high_a <= low_b or high_b <= low_a:
                return False
    return True


def _extent(points: tuple[Point, ...], axis: Point) -> tuple[float, float]:
    """Return the interval [m] that points cover along an axis."""
    along = [x * axis[0] + y * axis[1] for x, y in points]
    return min(along), max(along)
