"""Walks: when people on foot walked across the way that the ego drove afterwards."""

import math
from collections.abc import Iterator
from itertools import groupby

import numpy as np

from planner.record.trace import SAMPLE_PERIOD, PlanTrace
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.domain.vocabulary import Side
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.motion import Array, Motion
from xavi_dialogue.explain.history.ride import prediction
from xavi_dialogue.explain.history.thresholds import STALE

LONGEST = 60.0  # [s] between somebody who crosses and the ego at the same place
ROAD = 4.0  # [m] to each side of the ego's line, within which somebody is on its way
LIKELY = 0.5  # probability above which somebody on our road crosses our way
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


def steps_onto(states: States, vehicle: int) -> Iterator[Episode]:
    """Yield when somebody was on foot on our road, and was expected to cross our way."""
    known = [trace for trace in states.ride.traces if vehicle in trace.scene]
    for on, run in groupby(known, lambda trace: _is_onto(trace, vehicle)):
        times = [trace.sim_time for trace in run]
        over = times[-1] < known[-1].sim_time or times[-1] < states.ride.now - STALE
        if on and not (over and len(times) == 1):
            until = times[-1] if over or states.ride.ended else None
            yield Episode(Vehicle(vehicle), "cross", times[0], until, Ego())


def _is_onto(trace: PlanTrace, vehicle: int) -> bool:
    """Check whether somebody on foot is on the road that we are on, and about to cross our way."""
    places = {} if trace.road is None else trace.road.places
    ours, theirs = places.get(EGO), places.get(vehicle)
    if ours is None or theirs is None or ours.edge != theirs.edge:
        return False
    known = prediction(trace, vehicle)
    goals = () if known is None else known.goals
    return sum(goal.probability for goal in goals if goal.kind == "cross") > LIKELY


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
