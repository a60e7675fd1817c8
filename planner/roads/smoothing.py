"""Smooth bends and curvature for roads that a map draws with corners.

Wide bends with few corners are drawn as the curves that they stand for.
Between two corners a cubic leads from the direction of one to that of the other. At a corner the
direction divides the turn as a circle through the corners would: in proportion to the sides.
"""

import math

import numpy as np
from numpy.typing import NDArray

from planner.kernels.along import averaged
from planner.kernels.elementary import arctan2

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

COARSE = 5.0  # [m] minimum length of a side in a wide bend
SIDES = 4.0  # greatest ratio of the lengths of two sides in a bend
SHARPEST = 0.6  # [rad] of turn at a corner that is part of a wide bend
AWAY = 0.4  # [m] maximum distance of a curve from a side
SPACING = 1.0  # [m] between points on a curve
CUT = 0.3  # [m] by which a vehicle may cut the corners of a polygon
WINDOWS = (2, 3, 4, 6, 8, 12, 16, 24, 32)  # path points on each side to average curvature over
JOG, ALIKE = 1.2, 0.15  # [m] to the side, and [rad] that a road may go on aside as it came
SWERVE = 2.0 * math.pi  # curvature of a sine that leads aside, times length^2 / way aside
_WINDOWS: Ints = np.array(WINDOWS, np.int64)


def smoothed(points: Array) -> tuple[Array, Ints]:
    """Draw the wide bends of a line as curves through its corners.

    Args:
        points: [m] [N >= 2, 2]

    Returns:
        The points [m] [M >= N, 2], and the index among them of each of the given ones [N].
    """
    steps = np.diff(points, axis=0)
    long = np.hypot(steps[:, 0], steps[:, 1])
    heading = np.unwrap(arctan2(steps[:, 1], steps[:, 0]))
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
    """Return the slopes of the curves relative to each side at its two ends [N - 1]."""
    turn = np.diff(heading)
    less, more = np.minimum(long[:-1], long[1:]), np.maximum(long[:-1], long[1:])
    wide = (np.abs(turn) <= SHARPEST) & (less >= COARSE) & (more <= SIDES * less)
    turn = np.where(wide, turn, 0.0)
    share = long[:-1] / np.maximum(long[:-1] + long[1:], 1e-9)
    most = 4.0 * AWAY / np.maximum(long, 1e-9)
    begin, end = np.zeros(len(long)), np.zeros(len(long))
    begin[1:], end[:-1] = -turn * (1.0 - share), turn * share
    return np.clip(begin, -most, most), np.clip(end, -most, most)


def curvature_of(heading: Array, arc: Array) -> Array:
    """Return the curvature [1/m] of the smoothest line that stays within CUT of a polygon.

    Curvature is averaged over the widest window in which turning evenly instead of at the
    corners moves a vehicle aside by no more than CUT: a small kink costs no speed, a bend does.
    If a lane continues a little to the side, the curvature is that of a swerve.
    """
    return averaged(heading, arc, _WINDOWS, CUT, SWERVE, JOG, ALIKE)
