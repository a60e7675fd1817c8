"""Giving way at lines and beyond them, to those who go first."""

import math

from numba import njit

from planner.kernels.course import Bools, Floats, Motion
from planner.kernels.limits import (
    ALIGNED,
    BEFORE,
    COMFORT,
    EMERGENCY,
    FIRM,
    FOLLOWING,
    GAP_HORIZON,
    INTRUSION,
    JAM,
    READY,
    RELAXATION,
    STEP,
    cap,
    towards,
)
from planner.kernels.stretches import Stretches

_jit = njit(cache=True, error_model="numpy")


@_jit
def braking(
    caps: Floats,
    motion: Motion,
    step: int,
    gap: float,
    others: Stretches,
    m: int,
    length: float,
    hardest: float,
) -> float:
    """Return the hardest braking [m/s2] to let a vehicle pass: to stop at the line, or before it.

    Beyond a line that cannot be kept, harder braking than usual is for collisions alone.

    Args:
        caps, motion, length [m]: of the one who brakes.
        step: now.
        gap: [m] to the line.
        others, m: the vehicle.
        hardest: [m/s2] where that suffices, or nothing does.
    """
    arc, speed, _ = motion
    room = gap
    if speed * speed >= 2.0 * FIRM * gap:
        if not _hits(caps, motion, step, others, m, length):
            return hardest
        room = _lowest(others, m, step) - BEFORE - arc
    if not 0.0 < 2.0 * FOLLOWING * room < speed * speed:
        return hardest
    return min(speed * speed / (2.0 * room), EMERGENCY)


@_jit
def _hits(
    caps: Floats, motion: Motion, step: int, others: Stretches, m: int, length: float
) -> bool:
    """Check whether driving on freely ends in a collision with a vehicle on the path."""
    here, pace, push = motion
    for ahead in range(step + 1, min(step + GAP_HORIZON, others.low.shape[1])):
        push = towards(pace, push, cap(caps, here + pace * RELAXATION), FOLLOWING, STEP)
        before, pace = pace, max(pace + push * STEP, 0.0)
        here += 0.5 * (before + pace) * STEP
        if others.low[m, ahead] < here and others.high[m, ahead] > here - length:
            return True
    return False


@_jit
def _lowest(others: Stretches, m: int, step: int) -> float:
    """Return the lowest arc [m] of a vehicle on the path from a step on; inf without any."""
    found = math.inf
    for t in range(min(step, others.low.shape[1] - 1), others.low.shape[1]):
        if not math.isnan(others.low[m, t]):
            found = min(found, others.low[m, t])
    return found


@_jit
def stands_first(
    arc: float, lines: Floats, crossing: Stretches, firsts: Bools, step: int
) -> tuple[float, int]:
    """Return the speed [m/s] towards a line where one with priority stands, and who (-1: none)."""
    found, who = math.inf, -1
    now, t = min(step, crossing.speed.shape[1] - 1), min(step, firsts.shape[2] - 1)
    for line in range(len(lines)):
        gap = lines[line, 0] - arc
        ready = math.sqrt(READY * READY + 2.0 * COMFORT * max(gap, 0.0))
        if gap > 0.0 and lines[line, 2] > 0.0 and ready < found:
            for m in range(firsts.shape[1]):
                if firsts[line, m, t] and crossing.speed[m, now] < JAM:
                    found, who = ready, m
    return found, who


@_jit
def awaited(
    caps: Floats,
    motion: Motion,
    step: int,
    line: float,
    others: Stretches,
    firsts: Bools,
    length: float,
) -> int:
    """Return the vehicle to wait for: one with priority, in the way of driving on; else -1.

    Beyond the line, a vehicle counts only if it is still possible to stop before it.
    """
    arc, speed, acceleration = motion
    last = others.low.shape[1] - 1
    concerned = firsts.copy()
    passed, until = -math.inf, -1.0
    t = min(step, last)
    for m in range(len(firsts)):
        leads = others.low[m, t] > arc and others.cosine[m, t] > ALIGNED
        concerned[m] = firsts[m] and others.last[m] >= step and not leads
        if concerned[m]:
            passed, until = max(passed, others.top[m]), max(until, others.last[m])
    passed += length + 1.0
    here, pace, push = arc, speed, acceleration
    for ahead in range(step + 1, int(min(step + GAP_HORIZON, until + 1.0))):
        push = towards(pace, push, cap(caps, here + pace * RELAXATION), FOLLOWING, STEP)
        before, pace = pace, max(pace + push * STEP, 0.0)
        here += 0.5 * (before + pace) * STEP
        if here > passed:
            return -1
        t = min(ahead, last)
        for m in range(len(firsts)):
            low, high = others.wide_low[m, t], others.wide_high[m, t]
            if concerned[m] and low < here + 1.0 and high > here - length - 1.0:
                stopping = speed * speed / (2.0 * FOLLOWING)
                if not (arc > line and low - arc < stopping - INTRUSION):
                    return m
                concerned[m] = False
    return -1
