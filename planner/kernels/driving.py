"""Driving along a path: car-following, giving way, lights, stopping, within limits of comfort."""

import math

import numpy as np
from numba import njit

from planner.kernels.course import Bools, Course, Floats, Ints, Motion
from planner.kernels.giving_way import awaited, braking, stands_first
from planner.kernels.limits import (
    ALIGNED,
    AMBER,
    AT_LINE,
    BEYOND,
    BLOCKED,
    COMFORT,
    CRAWL,
    CUT_IN,
    CUT_IN_MEMORY,
    EMERGENCY,
    FIRM,
    FOLLOWING,
    FORESIGHT,
    HALT,
    HINDERED,
    JAM,
    LEADER,
    LEAST,
    MIN_GAP,
    NEWCOMER,
    OPEN,
    REACTION,
    RELAXATION,
    RIGHT_OF_WAY,
    STANDING,
    STANDING_TIME,
    STEP,
    cap,
    safe_speed,
    towards,
)
from planner.kernels.stretches import Stretches, stay_behind

_jit = njit(cache=True, error_model="numpy")
_inline = njit(cache=True, error_model="numpy", inline="always")  # avoids reference counting


@_inline
def accelerate(
    course: Course,
    motion: Motion,
    step: int,
    others: Stretches,
    ignored: Bools,
    crossing: Stretches,
    firsts: Bools,
    foreseen: Stretches,
    length: float,
    dt: float,
) -> tuple[float, int, int, int]:
    """Return the acceleration in the coming step, and the vehicle or light that limits it.

    Args:
        course, motion, length [m]: of the vehicle; step, dt [s]: of the coming step.
        others, ignored: the vehicles to stay behind; [M] whether each is behind this one.
        crossing: [C] the vehicles that may have the right of way.
        firsts: [L, C, T] whether a vehicle goes first, by line and step; the last step stays.
        foreseen: motions to make room for where they lead onto the path.

    Returns:
        Acceleration [m/s2], the index of the vehicle in the way (-1: none), the kind of hold-up,
        and the index of the light that holds up directly or by a queue (-1: none).
    """
    caps, lines = course.caps, course.lines
    arc, speed, acceleration = motion
    free = cap(caps, arc + speed * RELAXATION)
    free = min(free, stands_first(arc, lines, crossing, firsts, step)[0])
    wanted, hardest, who = _follow(motion, step, others, ignored, length, free)
    if course.halting > 0.0:
        free, wanted, who = 0.0, 0.0, -1
        hardest = EMERGENCY if hardest == EMERGENCY else course.halting
    how = LEADER if who < 0 else _manner(others, who, step)
    safe, newcomer = _make_room(motion, step, foreseen, length, wanted)
    if newcomer >= 0:
        wanted, who, how = safe, newcomer, NEWCOMER
    safe, jam = _keep_clear(motion, step, others, ignored, course.rooms, wanted)
    if jam >= 0:
        wanted, who, how = safe, jam, BLOCKED
    t = min(step, firsts.shape[2] - 1)
    for line in range(len(lines)):
        gap = lines[line, 0] - arc
        safe = safe_speed(gap, 0.0, COMFORT)
        if gap <= _near(speed) and arc < lines[line, 1] and safe < wanted:
            blocker = awaited(caps, motion, step, arc + gap, crossing, firsts[line, :, t], length)
            if blocker >= 0:
                wanted, who, how = safe, blocker, RIGHT_OF_WAY
                hardest = braking(caps, motion, step, gap, crossing, blocker, length, hardest)
    light, gap = _shut(course, motion, step)
    safe = safe_speed(gap, 0.0, COMFORT)
    if light >= 0 and safe < wanted:
        needed = min(speed * speed / (2.0 * max(gap, LEAST)), EMERGENCY)
        wanted, who = min(safe, max(speed - needed * RELAXATION, 0.0)), -1
        hardest = max(hardest, needed)
    elif safe > free - HINDERED and not _queues(others, who, how, step, arc + gap):
        light = -1
    chosen = towards(speed, acceleration, wanted, hardest, dt)
    return (chosen, -1, LEADER, -1) if wanted > free - HINDERED else (chosen, who, how, light)


@_inline
def _shut(course: Course, motion: Motion, step: int) -> tuple[int, float]:
    """Return the next light to stop at (amber: only if gently; -1: none), and its distance [m]."""
    arc, speed, acceleration = motion
    found, nearest = -1, math.inf
    for k in range(len(course.lights)):
        gap = course.lights[k] - arc
        shown = course.shows[k, min(step, course.shows.shape[1] - 1)]
        halted = shown == HALT and gap <= AT_LINE and (speed < STANDING or acceleration > 0.0)
        if shown <= OPEN or halted or not -BEYOND <= gap < nearest:
            continue
        gently = FIRM if acceleration < -HINDERED else FOLLOWING
        if speed * speed <= 2.0 * (gently if shown == AMBER else EMERGENCY) * (gap + BEYOND):
            found, nearest = k, gap
    return found, nearest


@_jit
def _queues(others: Stretches, who: int, how: int, step: int, stop: float) -> bool:
    """Check whether somebody in the way stands or crawls before the place [m] of a light."""
    if who < 0 or how in (RIGHT_OF_WAY, NEWCOMER):
        return False
    t = min(step, others.low.shape[1] - 1)
    return bool(others.low[who, t] < stop and others.speed[who, t] < JAM)


@_inline
def _follow(
    motion: Motion, step: int, others: Stretches, ignored: Bools, length: float, wanted: float
) -> tuple[float, float, int]:
    """Return the wanted speed [m/s] and hardest braking [m/s2] behind others, and which one."""
    arc, speed, _ = motion
    who, hardest = -1, FOLLOWING
    t = min(step, others.low.shape[1] - 1)
    for m in range(len(others.low)):
        low, high = others.low[m, t], others.high[m, t]
        if ignored[m] or math.isnan(low) or 0.5 * (low + high) < arc - 0.5 * length:
            continue
        gap = low - arc
        leader = max(others.along[m, t], 0.0)
        if gap <= 0.0 and leader < JAM:
            leader = 0.0  # it crawls beside this one
        safe = safe_speed(gap - MIN_GAP, leader, FOLLOWING)
        if safe < wanted:
            wanted, who = safe, m
            hardest = EMERGENCY if gap < MIN_GAP or safe < speed - 3.0 else FOLLOWING
    return wanted, hardest, who


@_inline
def _make_room(
    motion: Motion, step: int, others: Stretches, length: float, wanted: float
) -> tuple[float, int]:
    """Return the wanted speed [m/s] behind those about to move in, as if they led, and which."""
    arc, who, last = motion[0], -1, others.low.shape[1] - 1
    for m in range(len(others.low)):
        if others.last[m] < step or not math.isnan(others.low[m, min(step, last)]):
            continue
        for t in range(min(step + 1, last), min(step + FORESIGHT, last) + 1):
            if not math.isnan(others.low[m, t]) and others.cosine[m, t] > ALIGNED:
                pace = max(others.along[m, t], 0.0)
                back = pace * (t - step) * STEP
                low, high = others.low[m, t] - back, others.high[m, t] - back
                safe = safe_speed(low - arc - MIN_GAP, pace, FOLLOWING)
                if 0.5 * (low + high) > arc - 0.5 * length and safe < wanted:
                    wanted, who = safe, m
                break
    return wanted, who


@_jit
def _near(speed: float) -> float:
    """Return the distance [m] before a line at which the line begins to matter."""
    return speed * speed / (2.0 * COMFORT) + speed * REACTION + 3.0


@_inline
def _keep_clear(
    motion: Motion, step: int, others: Stretches, ignored: Bools, rooms: Floats, wanted: float
) -> tuple[float, int]:
    """Return the wanted speed [m/s] before junctions without room beyond, and the one in it."""
    arc, speed, _ = motion
    who = -1
    for k in range(len(rooms)):
        gap = rooms[k, 0] - arc
        safe = safe_speed(gap, 0.0, COMFORT)
        if 0.0 <= gap <= _near(speed) and safe < wanted:
            jam = _jam(others, ignored, step, rooms[k, 0], rooms[k, 1])
            if jam >= 0:
                wanted, who = safe, jam
    return wanted, who


@_jit
def _jam(others: Stretches, ignored: Bools, step: int, enter: float, room: float) -> int:
    """Return the nearest vehicle between `enter` and `room` [m] if it crawls, else -1."""
    t = min(step, others.low.shape[1] - 1)
    found, nearest = -1, room + MIN_GAP
    for m in range(len(others.low)):
        low = others.low[m, t]
        if not ignored[m] and enter <= low < nearest and others.cosine[m, t] > ALIGNED:
            found, nearest = m, low
    return found if found >= 0 and others.speed[found, t] < JAM else -1


@_jit
def _manner(others: Stretches, m: int, step: int) -> int:
    """Return the kind of hold-up of a vehicle ahead."""
    t = min(step, others.low.shape[1] - 1)
    entered, speed = others.entered[m, t], others.speed[m, t]
    if entered > 0 and t - entered <= CUT_IN_MEMORY and speed > CRAWL:
        return CUT_IN
    return BLOCKED if speed <= CRAWL else LEADER


@_jit
def drive(
    course: Course,
    end: float,
    goal: float,
    firsts: Bools,
    start: Motion,
    first: int,
    horizon: int,
    others: Stretches,
    length: float,
) -> tuple[Floats, Ints, bool, float]:
    """Drive until the end of an action, the goal, or the horizon.

    Args:
        course, firsts, others, length: as for `accelerate`.
        end, goal: [m] arcs where the action ends (ignored for a stop) and of the goal, or infinite.
        start: motion at step `first`.
        first, horizon: the first and the last step.

    Returns:
        Motion [S, 3]; the vehicle that held it up, the kind of hold-up and the light [S - 1, 3];
        whether it reached the end; and the time [s] since step 0 at the goal, else NaN.
    """
    motion = np.empty((max(horizon - first, 0) + 1, 3))
    hindrance = np.empty((len(motion) - 1, 3), np.int64)
    arc, speed, acceleration = start
    motion[0] = arc, speed, acceleration
    ignored = np.zeros(len(others.low), np.bool_)
    stay_behind(ignored, others, first, arc - 0.5 * length)
    waits, standing = firsts & ~ignored.reshape((1, -1, 1)), 0
    for step in range(first, horizon):
        k, now = step - first, (arc, speed, acceleration)
        stay_behind(ignored, others, step, arc - 0.5 * length)
        acceleration, who, how, light = accelerate(
            course, now, step, others, ignored, others, waits, others, length, STEP
        )
        before, speed = arc, max(speed + acceleration * STEP, 0.0)
        arc += 0.5 * (now[1] + speed) * STEP
        motion[k + 1] = arc, speed, acceleration
        hindrance[k] = who, how, light
        if arc >= goal:
            share = (goal - before) / max(arc - before, 1e-9)
            time = (step + min(max(share, 0.0), 1.0)) * STEP
            return motion[: k + 2], hindrance[: k + 1], True, time
        standing = standing + 1 if speed < STANDING else 0
        if (standing * STEP >= STANDING_TIME) if course.halting > 0.0 else (arc >= end):
            return motion[: k + 2], hindrance[: k + 1], True, math.nan
    return motion, hindrance, False, math.nan
