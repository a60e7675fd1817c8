"""A line resampled at other places along it."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_jit = njit(cache=True, error_model="numpy")


@_jit
def resampled(
    at: Floats,
    arc: Floats,
    columns: tuple[Floats, Floats, Floats],
    cap: Floats,
    direction: tuple[float, float],
) -> tuple[Floats, Floats, Floats, Floats]:
    """Interpolate a line as `numpy.interp` does; beyond its end it leads straight on.

    Args:
        at: [N] arcs [m] wanted, increasing.
        arc: [K] of the line.
        columns: its points [K, 2], headings [K] and curvatures [K].
        cap: [K] highest speeds at its points; between two points, that of the next one counts.
        direction: cosine and sine of the heading at its end.

    Returns:
        Points [N, 2], headings, curvatures and caps [N] there.
    """
    line, line_heading, line_curvature = columns
    count, last = len(at), len(arc) - 1
    points, heading = np.empty((count, 2)), np.empty(count)
    curvature, caps = np.empty(count), np.empty(count)
    j = after = 0
    for k in range(count):
        x = at[k]
        while j < last and arc[j + 1] <= x:
            j += 1
        while after < last and arc[after] < x + 1e-9:
            after += 1
        caps[k] = cap[after]
        if j == last or x <= arc[j]:
            beyond = max(x - arc[last], 0.0)
            points[k, 0] = line[j, 0] + beyond * direction[0]
            points[k, 1] = line[j, 1] + beyond * direction[1]
            heading[k] = line_heading[j]
            curvature[k] = 0.0 if beyond > 0.0 else line_curvature[j]
            continue
        step, along = arc[j + 1] - arc[j], x - arc[j]
        points[k, 0] = (line[j + 1, 0] - line[j, 0]) / step * along + line[j, 0]
        points[k, 1] = (line[j + 1, 1] - line[j, 1]) / step * along + line[j, 1]
        heading[k] = (line_heading[j + 1] - line_heading[j]) / step * along + line_heading[j]
        slope = (line_curvature[j + 1] - line_curvature[j]) / step
        curvature[k] = slope * along + line_curvature[j]
    return points, heading, curvature, caps


@_jit
def nearest(points: Floats, count: int, x: float, y: float) -> int:
    """Return the index of the point [N, 2] nearest to (x, y) among the first `count`."""
    best, found = np.inf, 0
    for k in range(min(count, len(points))):
        dx, dy = points[k, 0] - x, points[k, 1] - y
        square = dx * dx + dy * dy
        if square < best:
            best, found = square, k
    return found
