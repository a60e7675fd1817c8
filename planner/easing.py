"""Wide bends that a map draws with few corners, as the curves that they stand for.

Between two corners a cubic leads from the direction of one to that of the other. At a corner the
direction divides the turn as a circle through the corners would: in proportion to the sides.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

COARSE = 5.0  # [m] from which on a side is long
ALIKE = 4.0  # times the length of one side that the other may have in a bend
SHARPEST = 0.6  # [rad] of turn at a corner that is part of a wide bend
AWAY = 0.4  # [m] by which a curve may lead away from a side
SPACING = 1.0  # [m] between points on a curve


def eased(points: Array) -> tuple[Array, Ints]:
    """Draw the wide bends of a line as curves through its corners.

    Args:
        points: [m] [N >= 2, 2]

    Returns:
        The points [m] [M >= N, 2], and the index among them of each of the given ones [N].
    """
    steps = np.diff(points, axis=0)
    long = np.hypot(steps[:, 0], steps[:, 1])
    heading = np.unwrap(np.arctan2(steps[:, 1], steps[:, 0]))
    begin, end = _slopes(long, heading)
    bent = np.abs(begin) + np.abs(end) > 1e-3
    if not np.any(bent):
        return points, np.arange(len(points))
    rows, index = [points[:1]], [0]
    for k in range(len(steps)):
        count = int(np.ceil(long[k] / SPACING)) if bent[k] else 1
        t = np.arange(1, count + 1) / count
        aside = long[k] * (begin[k] * t * (1.0 - t) ** 2 - end[k] * t**2 * (1.0 - t))
        normal = np.array([-steps[k, 1], steps[k, 0]]) / max(long[k], 1e-9)
        rows.append(points[k] + t[:, None] * steps[k] + aside[:, None] * normal)
        index.append(index[-1] + count)
    return np.concatenate(rows), np.array(index)


def _slopes(long: Array, heading: Array) -> tuple[Array, Array]:
    """The slopes of the curves against each side at its begin and its end [N - 1]."""
    turn = np.diff(heading)
    less, more = np.minimum(long[:-1], long[1:]), np.maximum(long[:-1], long[1:])
    wide = (np.abs(turn) <= SHARPEST) & (less >= COARSE) & (more <= ALIKE * less)
    turn = np.where(wide, turn, 0.0)
    share = long[:-1] / np.maximum(long[:-1] + long[1:], 1e-9)
    most = 4.0 * AWAY / np.maximum(long, 1e-9)
    begin, end = np.zeros(len(long)), np.zeros(len(long))
    begin[1:], end[:-1] = -turn * (1.0 - share), turn * share
    return np.clip(begin, -most, most), np.clip(end, -most, most)
