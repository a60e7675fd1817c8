"""Where a body is in the corridor of a path."""

import math

import numpy as np
from numba import njit

from planner.kernels.lines import Line, nearest

BENT = 0.03  # [rad] by which a path turns within a body's length if it is not straight there
SHALLOW = 0.6  # [m] in the corridor, up to which a body may be out of it if the path is bent
APART = 0.5  # [m] between places at the sides of a body

_jit = njit(cache=True, error_model="numpy")


@_jit
def beside(
    line: Line,
    k: int,
    x: float,
    y: float,
    direction: float,
    length: float,
    width: float,
    corridor: float,
) -> bool:
    """Check whether a body is outside the corridor of a bent path, measured along its sides.

    Args:
        line: the path.
        k: index of the path point that is nearest to the middle of the body.
        x, y, direction: [m], [rad] of its middle.
        length, width: [m]
        corridor: [m] to either side of the path.
    """
    arc, heading = line.arc, line.heading
    before = np.searchsorted(arc, arc[k] - length)
    after = min(np.searchsorted(arc, arc[k] + length), len(arc) - 1)
    if max(abs(heading[before] - heading[k]), abs(heading[after] - heading[k])) < BENT:
        return False
    cos, sin, count = math.cos(direction), math.sin(direction), math.ceil(length / APART)
    for left in (-0.5 * width, 0.5 * width):
        for j in range(count + 1):
            ahead = (j / count - 0.5) * length
            px, py = x + ahead * cos - left * sin, y + ahead * sin + left * cos
            near = nearest(line, px, py, k, math.inf)
            dx, dy = px - line.points[near, 0], py - line.points[near, 1]
            if abs(dy * line.cos[near] - dx * line.sin[near]) < corridor:
                return False
    return True


@_jit
def extent(
    length: float, width: float, aside: float, cos: float, sin: float, corridor: float
) -> tuple[float, float]:
    """Return the least and greatest arc [m], from a body's centre, of its part in a corridor.

    Args:
        length, width: [m] of the body.
        aside: [m] of its centre to the left of the path.
        cos, sin: of its heading against that of the path.
        corridor: [m] to either side of the path; the body must reach into it.
    """
    low, high = math.inf, -math.inf
    for corner in range(4):
        x, y = _corner(corner, length, width, cos, sin, aside)
        to_x, to_y = _corner((corner + 1) % 4, length, width, cos, sin, aside)
        if min(y, to_y) > corridor or max(y, to_y) < -corridor:
            continue
        slope = 0.0 if abs(to_y - y) < 1e-9 else (to_x - x) / (to_y - y)
        if slope == 0.0:
            begin, end = x, to_x
        else:  # cut off where the edge leaves the corridor
            begin = x + (min(max(y, -corridor), corridor) - y) * slope
            end = to_x + (min(max(to_y, -corridor), corridor) - to_y) * slope
        low, high = min(low, begin, end), max(high, begin, end)
    return low, high


@_jit
def _corner(
    corner: int, length: float, width: float, cos: float, sin: float, aside: float
) -> tuple[float, float]:
    ahead = 0.5 * length if corner < 2 else -0.5 * length
    left = 0.5 * width if corner in (0, 3) else -0.5 * width
    return ahead * cos - left * sin, aside + ahead * sin + left * cos
