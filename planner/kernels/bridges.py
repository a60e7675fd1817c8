"""Bodies on a lane that passes above or below a path."""

import math
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Ints = NDArray[np.int64]

_jit = njit(cache=True, error_model="numpy")


class Sides(NamedTuple):
    """A line of straight sides."""

    points: Floats  # [m] [N, 2]
    length: Floats  # [m] [N - 1]
    arc: Floats  # [m] [N] along the line up to each point
    heading: Floats  # [rad] [N - 1]


@_jit
def sides_of(points: Floats) -> Sides:
    """Return a line through different points [m] [N, 2]."""
    count = len(points)
    length, arc, heading = np.empty(count - 1), np.zeros(count), np.empty(count - 1)
    for k in range(count - 1):
        dx, dy = points[k + 1, 0] - points[k, 0], points[k + 1, 1] - points[k, 1]
        length[k], heading[k] = math.hypot(dx, dy), math.atan2(dy, dx)
        arc[k + 1] = arc[k] + length[k]
    return Sides(points, length, arc, heading)


@_jit
def mark_along(
    found: Bools,
    states: Floats,
    sizes: Floats,
    which: Ints,
    line: Sides,
    place: tuple[float, float],
    reach: float,
    before: float,
    after: float,
    wide: float,
    turn: float,
    both_ways: bool,
) -> None:
    """Mark the steps at which bodies are on a lane, where it is above or below another one.

    Args:
        found: [M, T] what is marked.
        states, sizes: [M, T, 4], [M, 2 or more] of all bodies.
        which: [K] indices of those to look at.
        line: the middle of the lane.
        place: [m] where the lanes cross.
        reach: [m] around it, within which a body may be above or below the other lane.
        before, after: [m] along the line between which a front is; a body's length comes to it.
        wide: [m] from the line.
        turn: [rad] from the heading of the line up to which one moves along it.
        both_ways: whether one moves along it backwards, too.
    """
    for m in which:
        for t in range(states.shape[1]):
            x, y = states[m, t, 0], states[m, t, 1]
            if not (x - place[0]) ** 2 + (y - place[1]) ** 2 <= reach * reach:
                continue
            k, arc, away = _nearest_side(line, x, y)
            turned = states[m, t, 2] - line.heading[k]
            turned = abs(math.atan2(math.sin(turned), math.cos(turned)))
            if both_ways:
                turned = min(turned, math.pi - turned)
            if away <= wide and turned <= turn and before <= arc <= after + sizes[m, 0]:
                found[m, t] = True


@_jit
def _nearest_side(line: Sides, x: float, y: float) -> tuple[int, float, float]:
    """Return the index of the nearest side, the arc [m] along the line, and the distance [m]."""
    nearest, arc, least = 0, 0.0, math.inf
    for k in range(len(line.length)):
        ax, ay = line.points[k, 0], line.points[k, 1]
        dx, dy = line.points[k + 1, 0] - ax, line.points[k + 1, 1] - ay
        share = ((x - ax) * dx + (y - ay) * dy) / line.length[k] ** 2
        share = min(max(share, 0.0), 1.0)
        away = math.hypot(x - ax - share * dx, y - ay - share * dy)
        if away < least:
            nearest, arc, least = k, line.arc[k] + share * line.length[k], away
    return nearest, arc, least
