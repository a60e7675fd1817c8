"""Walks: when people on foot walked across the way that the ego drove afterwards."""

import math
from collections.abc import Iterator

import numpy as np

from planner.record.trace import SAMPLE_PERIOD
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.domain.vocabulary import Side
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.motion import Array, Motion

LONGEST = 60.0  # [s] between somebody who crosses and the ego at the same place
ROAD = 4.0  # [m] to each side of the ego's line, within which somebody is on its way
LEAST = 0.05  # [m] minimum way between samples


def walks_across(states: States, vehicle: int) -> Iterator[Episode]:
    """Yield when somebody on foot walked across the ego's way before the ego came there."""
    walk, drive = states.motion(vehicle), states.motion(EGO)
    if len(walk.time) < 2 or len(drive.time) < 2:
        return
    for k in range(len(walk.time) - 1):
        met = _meets(walk, k, drive)
        if met is None:
            continue
        when, side = met
        if 0.0 < when - walk.time[k] <= LONGEST:
            first, last = _on_way(walk, k)
            begin, end = walk.time[first], walk.time[last]
            yield Episode(Vehicle(vehicle), "cross", begin, end, Ego(), side)


def _meets(walk: Motion, k: int, drive: Motion) -> tuple[float, Side] | None:
    """Return when [s] the ego drove over a step of a walk, and from which side it came."""
    step = np.subtract(walk.position[k + 1], walk.position[k])
    if walk.time[k + 1] - walk.time[k] > 5.0 * SAMPLE_PERIOD or math.hypot(*step) < LEAST / 5.0:
        return None
    line: Array = np.array(drive.position)
    a, b = line[:-1], line[1:]
    ahead = b - a
    here = np.asarray(walk.position[k])
    before, after = _cross(ahead, here - a), _cross(ahead, here + step - a)
    start, stop = _cross(step, a - here), _cross(step, b - here)
    hit = ((before < 0.0) != (after < 0.0)) & ((start < 0.0) != (stop < 0.0))
    hit &= np.hypot(*ahead.T) >= LEAST
    found = np.flatnonzero(hit)
    if not len(found):
        return None
    j = int(found[0])
    return drive.time[j], "left" if before[j] > 0.0 else "right"


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _on_way(walk: Motion, k: int) -> tuple[int, int]:
    """Return the first and last sample of a walk near the step at which it meets the ego's way."""
    here = walk.position[k]
    near = [math.dist(here, place) <= ROAD for place in walk.position]
    first = last = k
    while first > 0 and near[first - 1]:
        first -= 1
    while last + 1 < len(near) and near[last + 1]:
        last += 1
    return first, last
