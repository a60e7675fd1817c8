"""Projection of other vehicles on a path: the stretch that each occupies at every step."""

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from planner.kernels.along import LONG
from planner.kernels.corridor import SHALLOW, beside, extent
from planner.kernels.lines import Line, box_of, clearance, distance, nearest, prepared
from planner.kernels.stretches import Stretches, empty

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

SIDE_MARGIN = 0.3  # [m] kept free beside the body
BEFORE, AFTER = 4, 5  # steps that a stretch is blocked after, and before, a vehicle with priority
FOREVER = 1 << 30  # a step that never comes
SLACK = 1e-3  # [m] greatest error of distances
PATIENCE = 5  # steps between two measurements of how far a vehicle is from the path

_jit = njit(cache=True, error_model="numpy")
_inline = njit(cache=True, error_model="numpy", inline="always")  # avoids reference counting


@_jit
def project(
    points: Floats,
    arc: Floats,
    heading: Floats,
    states: Floats,
    sizes: Floats,
    width: float,
    first: int,
    last: int,
    which: Ints,
) -> tuple[Ints, Stretches]:
    """Return the stretches of a path that vehicles occupy at each step; distant ones cost little.

    Args:
        points, arc, heading: of the path, [N, 2] [m], [N] [m], [N] [rad].
        states, sizes: of all vehicles.
        width: [m] of the vehicle that drives along the path.
        first, last: steps from and up to which this is needed.
        which: [K] indices of the vehicles to look at.

    Returns:
        The stretches of the vehicles that come onto the path; and [K] the row of each in them, or
        -1 for one that never comes onto it.
    """
    total, rows = states.shape[1], np.full(len(which), -1, np.int64)
    line = prepared(points, arc, heading)
    start, stop = min(max(first - 1, 0), total - 1), min(last + AFTER, total)
    corridor = 0.5 * width + SIDE_MARGIN
    near = np.empty(len(which), np.int64)
    count = 0
    for k in range(len(which)):
        if _may_come(line, states[which[k], start:stop], sizes[which[k]], corridor):
            near[count] = k
            count += 1
    found = empty(count, total)
    on = 0
    for k in near[:count]:
        m = which[k]
        _occupied(line, states[m, start:stop], sizes[m], corridor, found, on, start)
        _widen(found, on)
        if found.last[on] >= 0.0:
            _note_entries(found.low[on], found.entered[on])
            found.speed[on] = states[m, :, 3]
            rows[k] = on
            on += 1
    low, high, wide_low, wide_high, along, cosine, speed, entered, ends, top = found
    some = (low[:on], high[:on], wide_low[:on], wide_high[:on], along[:on], cosine[:on])
    return rows, Stretches(*some, speed[:on], entered[:on], ends[:on], top[:on])


@_jit
def _may_come(line: Line, states: Floats, size: Floats, corridor: float) -> bool:
    """Check whether a vehicle may come onto a path, by the box that contains its front."""
    low_x, low_y, high_x, high_y = box_of(states)
    if not low_x <= high_x:
        return False  # it is never in the network
    widest, behind, reach = _reaches(size, corridor)
    box = line.box
    off = max(box[0] - high_x, low_x - box[2], box[1] - high_y, low_y - box[3])
    if off <= reach:
        return True
    ahead, left, right = math.inf, -math.inf, math.inf
    for x in (low_x, high_x):
        for y in (low_y, high_y):
            dx, dy = x - line.points[0, 0], y - line.points[0, 1]
            aside = dy * line.cos[0] - dx * line.sin[0]
            ahead = min(ahead, dx * line.cos[0] + dy * line.sin[0])
            left, right = max(left, aside), min(right, aside)
    most = widest + behind + SLACK
    return bool(ahead < behind + SLACK and left > -most and right < most)  # in line, behind


@_jit
def _reaches(size: Floats, corridor: float) -> tuple[float, float, float]:
    """Return the greatest distances [m] between a path and a vehicle that is on it.

    Returns:
        Greatest distance of its middle to the side; of its front beyond the path's beginning while
        its middle is before it; and of its front from the path.
    """
    length, width = size[0], size[1]
    widest = corridor + 0.5 * (length + width)
    return widest, 0.5 * length + SLACK, widest + 1.5 * length + SLACK


@_jit
def _occupied(
    line: Line,
    states: Floats,
    size: Floats,
    corridor: float,
    found: Stretches,
    m: int,
    start: int,
) -> None:
    """Fill in the steps of one vehicle, from step `start` on.

    Its distance from the path is not measured at every step: until the vehicle has moved that far,
    it cannot be on the path.
    """
    low, high = found.low[m, start:], found.high[m, start:]
    along, cosine = found.along[m, start:], found.cosine[m, start:]
    points = line.points
    widest, behind, reach = _reaches(size, corridor)
    near, room, again, long = 0, 0.0, 0, size[0] > LONG
    for t in range(len(states)):
        x, y = states[t, 0], states[t, 1]
        if t > 0 and _alike(states[t], states[t - 1]):
            low[t], high[t], cosine[t] = low[t - 1], high[t - 1], cosine[t - 1]
            along[t] = states[t, 3] * cosine[t]
            continue
        if not math.isfinite(x):
            room = 0.0
            continue
        if t > 0 and room > 0.0:
            room -= distance(x, y, states[t - 1, 0], states[t - 1, 1])
        dx, dy = x - points[0, 0], y - points[0, 1]
        ahead = dx * line.cos[0] + dy * line.sin[0]
        aside = dy * line.cos[0] - dx * line.sin[0]
        if ahead >= behind or abs(aside) >= widest + behind:  # not in line behind the path
            if not room > 0.0 and t >= again:
                room = clearance(line, x, y, reach) - reach
                again = t + PATIENCE
            if room > 0.0:
                continue
        if long:
            near, low[t], high[t], cosine[t] = _in_parts(line, states[t], size, corridor, near)
        else:
            near, low[t], high[t], cosine[t] = _stretch(
                line, x, y, states[t, 2], size[0], size[1], corridor, near
            )
        along[t] = states[t, 3] * cosine[t]


@_jit
def _alike(state: Floats, before: Floats) -> bool:
    """Check whether a vehicle stands still."""
    same = state[0] == before[0] and state[1] == before[1] and state[2] == before[2]
    return bool(same)


@_jit
def _in_parts(
    line: Line, state: Floats, size: Floats, corridor: float, near: int
) -> tuple[int, float, float, float]:
    """Return the stretch of a path on which a long body lies, as `_stretch` does for a short one.

    The cosine is that of its foremost part on the path.
    """
    count = math.ceil(size[0] / LONG)
    length, along, across = size[0] / count, math.cos(state[2]), math.sin(state[2])
    low, high, cosine, hint = math.nan, math.nan, 0.0, near
    for part in range(count):
        back = part * length
        x, y = state[0] - back * along, state[1] - back * across
        hint, least, most, cos = _stretch(line, x, y, state[2], length, size[1], corridor, hint)
        near = hint if part == 0 else near
        if not math.isnan(least):
            cosine = cos if math.isnan(low) else cosine
            low, high = _least(low, least), _most(high, most)
    return near, low, high, cosine


@_jit
def _least(known: float, other: float) -> float:
    return other if math.isnan(known) else min(known, other)


@_jit
def _most(known: float, other: float) -> float:
    return other if math.isnan(known) else max(known, other)


@_inline
def _stretch(
    line: Line,
    x: float,
    y: float,
    direction: float,
    length: float,
    width: float,
    corridor: float,
    near: int,
) -> tuple[int, float, float, float]:
    """Return the stretch of a path on which a body lies.

    Args:
        line: the path.
        x, y, direction: [m], [rad] of its front.
        length, width: [m]
        corridor: [m] to either side of the path.
        near: index of a path point that may be near.

    Returns:
        The index of the nearest path point, the lowest and highest arc [m] of the body, and the
        cosine of its angle to the path; NaN and 0 if it is not on the path.
    """
    points, arc, heading, box = line.points, line.arc, line.heading, line.box
    line_cos, line_sin = line.cos, line.sin
    widest = corridor + 0.5 * (length + width)  # a body reaches no farther aside
    x, y = x - 0.5 * length * math.cos(direction), y - 0.5 * length * math.sin(direction)
    dx, dy = x - points[0, 0], y - points[0, 1]
    ahead, aside = dx * line_cos[0] + dy * line_sin[0], dy * line_cos[0] - dx * line_sin[0]
    follows = ahead < 0.0 and abs(aside) < widest  # in line behind the path, however far
    within = math.inf if follows else widest + length
    off = max(box[0] - x, x - box[2], box[1] - y, y - box[3])
    k = nearest(line, x, y, near, within) if follows or off < within else -1
    if k < 0:
        return near, math.nan, math.nan, 0.0
    dx, dy = x - points[k, 0], y - points[k, 1]
    ahead, aside = dx * line_cos[k] + dy * line_sin[k], dy * line_cos[k] - dx * line_sin[k]
    if abs(aside) >= widest or (k == len(arc) - 1 and ahead > length):
        return k, math.nan, math.nan, 0.0
    turned = direction - heading[k]
    cos, sin = math.cos(turned), math.sin(turned)
    into = 0.5 * (length * abs(sin) + width * abs(cos)) + corridor - abs(aside)
    if 0.0 < into < SHALLOW and beside(line, k, x, y, direction, length, width, corridor):
        into = 0.0
    if into <= 0.0:
        return k, math.nan, math.nan, 0.0
    least, most = extent(length, width, aside, cos, sin, corridor)
    return k, arc[k] + ahead + least, arc[k] + ahead + most, cos


@_jit
def _note_entries(low: Floats, entered: Floats) -> None:
    since = 0
    for t in range(len(low)):
        if math.isnan(low[t]):
            since = t + 1
        entered[t] = since


@_jit
def _widen(found: Stretches, m: int) -> None:
    """Fill in the union of the stretches within the safety time around each step."""
    low, high = found.low[m], found.high[m]
    wide_low, wide_high = found.wide_low[m], found.wide_high[m]
    last, top = -1, -math.inf
    total = len(low)
    here = np.flatnonzero(~np.isnan(low))
    begin, end = (
        (max(here[0] - AFTER, 0), min(here[-1] + BEFORE + 1, total)) if len(here) else (0, 0)
    )
    for t in range(begin, end):
        least, most = math.inf, -math.inf
        for k in range(max(t - BEFORE, 0), min(t + AFTER + 1, total)):
            if not math.isnan(low[k]):
                least, most = min(least, low[k]), max(most, high[k])
        if least < math.inf:
            wide_low[t], wide_high[t] = least, most
            last, top = t, max(top, most)
    found.last[m], found.top[m] = FOREVER if last == total - 1 else last, top
