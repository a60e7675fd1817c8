"""Collision of oriented boxes along a driven line."""

import math
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from planner.kernels.lines import Box, box_of

Floats = NDArray[np.float64]

SAFE_CUT_IN = 1.5  # [s] to collision with a follower, below which a lane change hits it
BERTH = 1.0  # [m] kept free before and behind a lane change, as predictions are inexact
ALIKE = 0.7  # least cosine of the angle between the headings of a vehicle and its follower

_jit = njit(cache=True, error_model="numpy")


@_jit
def overlap(
    ax: float, ay: float, a: float, a_size: Any, bx: float, by: float, b: float, b_size: Any
) -> bool:
    """Check whether boxes overlap (separating axes): front bumper [m], heading [rad], size [m]."""
    a_cos, a_sin, b_cos, b_sin = math.cos(a), math.sin(a), math.cos(b), math.sin(b)
    dx = (bx - 0.5 * b_size[0] * b_cos) - (ax - 0.5 * a_size[0] * a_cos)
    dy = (by - 0.5 * b_size[0] * b_sin) - (ay - 0.5 * a_size[0] * a_sin)
    cos, sin = abs(a_cos * b_cos + a_sin * b_sin), abs(a_cos * b_sin - a_sin * b_cos)
    long, wide = 0.5 * a_size[0], 0.5 * a_size[1]
    b_long, b_wide = 0.5 * b_size[0], 0.5 * b_size[1]
    return bool(
        abs(dx * a_cos + dy * a_sin) < long + b_long * cos + b_wide * sin
        and abs(dy * a_cos - dx * a_sin) < wide + b_long * sin + b_wide * cos
        and abs(dx * b_cos + dy * b_sin) < b_long + long * cos + wide * sin
        and abs(dy * b_cos - dx * b_sin) < b_wide + long * sin + wide * cos
    )


@_jit
def first_hit(
    own: Floats,
    size: tuple[float, float],
    first: int,
    states: Floats,
    sizes: Floats,
    careless: bool,
    braking: float,
) -> tuple[int, int]:
    """Return the first collision along a driven line, or (-1, -1).

    A follower that would have braked does not count. Who is careless changes lanes without
    regard for those behind: then they do, and so does one that is right behind at the end, and
    too fast to brake, or to be SAFE_CUT_IN away. A lane change that leaves less than BERTH before
    or behind hits too, unless there was less from the beginning.

    Args:
        own: [S, 4] states at steps `first`, `first` + 1, ...
        size: length and width [m] of the vehicle.
        states, sizes: of the others.
        careless, braking: see above; [m/s2] of a follower, 0 where others do not react.

    Returns:
        The sample, and the index of the other vehicle.
    """
    found, whom, last = len(own), -1, len(own) - 1
    box = box_of(own)
    for m in range(len(states)):
        berth = BERTH if careless else 0.0
        until = min(len(own), states.shape[1] - first, found)
        if _apart(box, box_of(states[m, first : first + until]), _reach(size, sizes[m], berth)):
            until = 0
        for k in range(until):
            other = states[m, first + k]
            if k == 0 and berth > 0.0 and _meets(own[k], size, other, sizes[m], berth):
                berth = 0.0
            if _meets(own[k], size, other, sizes[m], berth):
                if careless or not _follows(own[k], other):
                    found, whom = k, m
                break
        else:
            ends = careless and last < found and first + last < states.shape[1]
            if ends and _cut_off(own[last], size[0], states[m, first + last], braking):
                found, whom = last, m
    return (found, whom) if whom >= 0 else (-1, -1)


@_jit
def _meets(own: Floats, size: Any, other: Floats, other_size: Any, berth: float) -> bool:
    """Check whether another body is within `berth` [m] before or behind ours, or touches it."""
    dx, dy = other[0] - own[0], other[1] - own[1]
    near = _reach(size, other_size, berth)
    if not dx * dx + dy * dy < near * near:  # also where it is not in the network
        return False
    x, y = own[0] + berth * math.cos(own[2]), own[1] + berth * math.sin(own[2])
    longer = (size[0] + 2.0 * berth, size[1])
    return overlap(x, y, own[2], longer, other[0], other[1], other[2], other_size)


@_jit
def _reach(size: Any, other_size: Any, berth: float) -> float:
    """Return the distance [m] of two fronts from which on their bodies are apart."""
    return float(size[0] + other_size[0] + size[1] + other_size[1] + 2.0 * berth)


@_jit
def _apart(a: Box, b: Box, reach: float) -> bool:
    """Check whether two boxes are at least `reach` [m] apart along an axis."""
    return bool(max(a[0] - b[2], b[0] - a[2], a[1] - b[3], b[1] - a[3]) >= reach)


@_jit
def _follows(own: Floats, other: Floats) -> bool:
    """Check whether another is behind us and heads the same way; who crosses does not follow."""
    return bool(_in_front(own, other) < -1.0 and math.cos(other[2] - own[2]) > ALIKE)


@_jit
def _in_front(own: Floats, other: Floats) -> float:
    """Return how far [m] another front is ahead of ours, in our direction."""
    ahead = (other[0] - own[0]) * math.cos(own[2]) + (other[1] - own[1]) * math.sin(own[2])
    return float(ahead)


@_jit
def _cut_off(own: Floats, length: float, other: Floats, braking: float) -> bool:
    """Check whether a faster follower is right behind."""
    gap = -_in_front(own, other) - length
    aside = (other[1] - own[1]) * math.cos(own[2]) - (other[0] - own[0]) * math.sin(own[2])
    closing = other[3] - own[3]
    needed = closing * SAFE_CUT_IN
    if braking > 0.0:
        needed = max(closing, 0.0) ** 2 / (2.0 * braking)
    return bool(abs(aside) < 1.5 and gap > -length and gap < needed)
