"""Lanes that continue to the side of the lane before: a gentle line leads over.

Maps draw such a lane with a jog of a few metres, as where a lane for turning begins beside it.
People lead over early, within the room that their lane leaves them.
"""

import math
from collections.abc import Iterator
from itertools import product

import numpy as np
from numpy.typing import NDArray

from planner.kernels.elementary import arctan2

Array = NDArray[np.float64]

ASIDE = (1.2, 3.6)  # [m] to the side, from a jog that is driven as it is drawn to a lane's width
ALIKE = 0.05  # [rad] by which the directions before and after may differ
WITHIN = (4, 6, 8)  # path points to each side of its middle within which a jog lies
#: Path points to each side in which to lead over.
LASTING = (32, 28, 24, 20, 16, 14, 12, 11, 10, 9, 8, 7, 6)
MOVED = (0, 1, -1, 2, -2, 3, -3)  # shifts of its middle that are tried, in path points
ROOM = 0.7  # [m] by which a car may be off the middle of its lane


def shifted(points: Array, joints: Array) -> Array:
    """Smooth the line where a lane goes on to the side of where the one before it came from.

    Args:
        points: [m] [N, 2] of a line with even spacing.
        joints: where lanes begin on it, as indices that need not be whole.

    Returns:
        The points; the same object where the line has no jog.
    """
    if len(joints) == 0 or len(points) <= 2 * WITHIN[0] + 2:
        return points
    found = points
    for middle in _middles(points):
        if not np.any(np.abs(joints - middle) <= WITHIN[-1]):
            continue
        for reach, moved in product(LASTING, MOVED):
            low, high = middle + moved - reach, middle + moved + reach
            over = _over(points, low, high) if low >= 0 and high + 1 < len(points) else None
            if over is not None:
                found = found.copy() if found is points else found
                found[low : high + 1] = over
                break
    return found


def _middles(points: Array) -> Iterator[int]:
    """Yield the middles of jogs, in order: of a row of places that would do, the one halfway."""
    steps = np.diff(points, axis=0)
    heading = np.unwrap(arctan2(steps[:, 1], steps[:, 0]))
    jogs = np.zeros(len(points), np.bool_)
    for reach in WITHIN:
        middle = np.arange(reach + 1, len(points) - reach - 1)
        before, after = heading[middle - reach - 1], heading[middle + reach]
        dx, dy = (points[middle + reach] - points[middle - reach]).T
        direction = 0.5 * (before + after)
        aside = np.abs(dy * np.cos(direction) - dx * np.sin(direction))
        found = (np.abs(after - before) <= ALIKE) & (aside > ASIDE[0]) & (aside <= ASIDE[1])
        jogs[middle[found]] = True
    edges = np.flatnonzero(np.diff(np.concatenate(([0], jogs.astype(np.int64), [0]))))
    for first, last in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        yield (first + last - 1) // 2


def _over(points: Array, low: int, high: int) -> Array | None:
    """Return a quintic between two points; None if it leads too far off the line."""
    before, after = points[low + 1] - points[low], points[high + 1] - points[high]
    start, end = math.atan2(before[1], before[0]), math.atan2(after[1], after[0])
    turned = math.remainder(end - start, 2.0 * math.pi)
    if abs(turned) > ALIKE:
        return None
    direction = start + 0.5 * turned
    ahead = np.array([math.cos(direction), math.sin(direction)])
    left = np.array([-ahead[1], ahead[0]])
    offset = points[low : high + 1] - points[low]
    along, aside = offset @ ahead, offset @ left
    if np.any(np.diff(along) <= 0.0):
        return None
    u = along / along[-1]
    gently = aside[-1] * u**3 * (10.0 - 15.0 * u + 6.0 * u**2)
    if np.max(np.abs(gently - aside)) > ROOM:
        return None
    led: Array = points[low] + along[:, None] * ahead + gently[:, None] * left
    return led
