"""A path for kernels, and the search for its nearest point."""

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Box = tuple[float, float, float, float]

PIECE = 16  # points of a path that are looked at together

_jit = njit(cache=True, error_model="numpy")
_inline = njit(cache=True, error_model="numpy", inline="always")  # avoids reference counting


class Line(NamedTuple):
    """A path, with values that are needed repeatedly."""

    points: Floats  # [m] [N, 2]
    arc: Floats  # [m] [N]
    heading: Floats  # [rad] [N]
    cos: Floats  # [N] of the heading
    sin: Floats  # [N]
    box: Box  # [m] least x and y, greatest x and y
    middle: Floats  # [m] [P, 2] of each piece of PIECE points
    reach: float  # [m] greatest distance of a point from the middle of its piece


@_jit
def prepared(points: Floats, arc: Floats, heading: Floats) -> Line:
    """Return a path [N, 2] [m], with its arc [m] [N] and heading [rad] [N], for kernels."""
    middle, reach = _pieces(points)
    cos, sin = np.cos(heading), np.sin(heading)
    return Line(points, arc, heading, cos, sin, box_of(points), middle, reach)


@_jit
def box_of(points: Floats) -> Box:
    """Return the least x and y, and the greatest x and y [m], of points [N, 2 or more].

    NaN does not count; without any point, the least are infinite.
    """
    low_x, low_y, high_x, high_y = math.inf, math.inf, -math.inf, -math.inf
    for k in range(len(points)):
        x, y = points[k, 0], points[k, 1]
        if x < low_x:
            low_x = x
        if x > high_x:
            high_x = x
        if y < low_y:
            low_y = y
        if y > high_y:
            high_y = y
    return low_x, low_y, high_x, high_y


@_jit
def _pieces(points: Floats) -> tuple[Floats, float]:
    """Return the middle [m] [P, 2] of each piece of a path, and the greatest distance from it."""
    count = (len(points) + PIECE - 1) // PIECE
    middle, reach = np.empty((count, 2)), 0.0
    for p in range(count):
        begin, end = p * PIECE, min((p + 1) * PIECE, len(points))
        x = 0.5 * (points[begin, 0] + points[end - 1, 0])
        y = 0.5 * (points[begin, 1] + points[end - 1, 1])
        middle[p, 0], middle[p, 1] = x, y
        for k in range(begin, end):
            reach = max(reach, distance(points[k, 0], points[k, 1], x, y))
    return middle, reach + 1e-9


@_inline
def clearance(line: Line, x: float, y: float, reach: float) -> float:
    """Return a distance [m] that exceeds `reach` only if (x, y) is at least as far from a path."""
    box = line.box
    off = max(box[0] - x, x - box[2], box[1] - y, y - box[3])
    if off > reach:
        return off
    least = math.inf
    for p in range(len(line.middle)):
        dx, dy = line.middle[p, 0] - x, line.middle[p, 1] - y
        least = min(least, dx * dx + dy * dy)
    return math.sqrt(least) - line.reach


@_inline
def nearest(line: Line, x: float, y: float, hint: int, within: float) -> int:
    """Return the index of the path point nearest to (x, y), or -1 if none is within `within` [m].

    Only pieces of the path that may have a nearer point than the best one known are looked at.
    """
    points, middle, reach = line.points, line.middle, line.reach
    dx, dy = points[hint, 0] - x, points[hint, 1] - y
    best, found = within * within, -1
    if dx * dx + dy * dy < best:
        best, found = dx * dx + dy * dy, hint
    far = (math.sqrt(best) + reach) ** 2
    for p in range(len(middle)):
        dx, dy = middle[p, 0] - x, middle[p, 1] - y
        if dx * dx + dy * dy > far:
            continue
        for k in range(p * PIECE, min((p + 1) * PIECE, len(points))):
            dx, dy = points[k, 0] - x, points[k, 1] - y
            d = dx * dx + dy * dy
            if d < best or (d == best and k < found):
                best, found = d, k
        far = (math.sqrt(best) + reach) ** 2
    return found


@_jit
def distance(px: float, py: float, x: float, y: float) -> float:
    """Return the distance [m] of two points."""
    dx, dy = px - x, py - y
    return math.sqrt(dx * dx + dy * dy)
