"""Crossing: when we would have been where our way meets another's, had we not waited or slowed.

Nothing is simulated. Our way, as recorded and then as planned, is driven at the speed that we had
before we slowed, or by setting off from a speed. This is compared with the motion of the other
vehicle, as recorded and then as predicted.
"""

import math
from dataclasses import dataclass
from itertools import accumulate, pairwise
from typing import TypeAlias

from planner.kernels.limits import ACCELERATION
from planner.record.trace import SAMPLE_PERIOD, PlanTrace
from sim.scene import EGO, Point
from xavi_dialogue.explain.causes.vehicles.course import lines
from xavi_dialogue.explain.history.ride import Ride, planned, prediction
from xavi_dialogue.explain.history.thresholds import STANDING

PASSED = 1.5  # [s] before the beginning in which a vehicle that crossed our way counts
POSSIBLE = 0.2  # minimum probability of a predicted way that counts
MEETING = 2.5  # [m] within which two lines meet
JUMP = 8.0  # [m] maximum gap between our driven way and the planned one that continues it
MOVING = 0.5  # [m/s] above which a vehicle moves along its way
LIMIT = 13.9  # [m/s] speed limit to assume if none is known

Passing: TypeAlias = tuple[float, Point, float]  # time [s], place [m], speed [m/s]


@dataclass(frozen=True, slots=True)
class Crossing:
    """When we and a vehicle would have been where our ways meet."""

    vehicle: int
    ours: float  # [s] had we not waited
    theirs: float  # [s] as recorded or predicted

    @property
    def ahead(self) -> float:
        """The lead [s] with which we would have been there first; negative: the other would."""
        return self.theirs - self.ours


def crossing(
    ride: Ride, vehicle: int, begin: float, speed: float, *, setting_off: bool = False
) -> Crossing | None:
    """Return when we and a vehicle would have been where our ways meet; None if they do not.

    Args:
        ride: the record.
        vehicle: the other one.
        begin: [s] the time from which we would have driven on.
        speed: [m/s] our speed then.
        setting_off: whether we would have sped up from that speed; else we would have kept it.
    """
    if speed < MOVING and not setting_off:
        return None
    ours = _our_way(ride, begin)
    if not ours:
        return None
    along = list(accumulate((math.dist(a, b) for a, b in pairwise(ours)), initial=0.0))
    limit = _limit(ride, begin)
    found = []
    for theirs in _their_ways(ride, vehicle, begin):
        met = _meeting(ours, along, theirs)
        if met is not None:
            far, then = met
            took = _setting_off(speed, far, limit) if setting_off else far / speed
            found.append(Crossing(vehicle, begin + took, then))
    return min(found, key=lambda one: abs(one.ahead), default=None)


def _meeting(
    ours: list[Point], along: list[float], theirs: list[Passing]
) -> tuple[float, float] | None:
    """Return how far [m] along our way the ways first meet, and when [s] the vehicle is there."""
    met = [
        (far, math.dist(here, place), time)
        for here, far in zip(ours, along, strict=True)
        for time, place, speed in theirs
        if speed > MOVING and math.dist(here, place) <= MEETING
    ]
    if not met:
        return None
    far, _, time = min(met)
    return far, time


def _our_way(ride: Ride, begin: float) -> list[Point]:
    """Return our way from a time on: as driven up to now, then as planned."""
    motion = ride.motion(EGO)
    driven = [motion.position[k] for k in motion.within(begin, ride.now)]
    ahead = _planned_way(ride.latest, ride.now)
    joined = not driven or not ahead or math.dist(driven[-1], ahead[0]) <= JUMP
    return [*driven, *ahead] if joined else driven


def _planned_way(trace: PlanTrace, now: float) -> tuple[Point, ...]:
    """Return the rest of the longest line among the rollouts that begin as planned."""
    plan, known = planned(trace)[:1], lines(trace)
    fitting = [
        known[r.index]
        for r in trace.rollouts
        if r.index in known and tuple(a.action for a in r.actions[:1]) == plan
    ]
    if not fitting:
        return ()
    line = max(fitting, key=lambda m: m.arc[-1] if m.arc else 0.0)
    return tuple(p for t, p in zip(line.time, line.position, strict=True) if t > now)


def _their_ways(ride: Ride, vehicle: int, begin: float) -> list[list[Passing]]:
    """Return the possible ways of a vehicle: as driven, then as each prediction continues."""
    motion = ride.motion(vehicle)
    driven = [
        (motion.time[k], motion.position[k], motion.speed[k])
        for k in motion.within(begin - PASSED, ride.now)
    ]
    trace = ride.latest
    known = prediction(trace, vehicle)
    likely = () if known is None else (
        way
        for goal in known.goals
        for way in goal.trajectories
        if goal.probability * way.probability >= POSSIBLE
    )  # fmt: skip
    ahead = [
        [
            (time, place, speed)
            for k, (place, speed) in enumerate(zip(way.path, way.speed, strict=False))
            if (time := trace.sim_time + k * SAMPLE_PERIOD) > ride.now
        ]
        for way in likely
    ]
    return [driven + way for way in ahead] or [driven]


def _limit(ride: Ride, time: float) -> float:
    """Return the speed [m/s] allowed where we are at a time."""
    trace = ride.at(time)
    place = None if trace is None or trace.road is None else trace.road.places.get(EGO)
    return LIMIT if place is None else max(place.limit, STANDING)


def _setting_off(speed: float, far: float, limit: float) -> float:
    """Return the time [s] that a distance [m] takes, speeding up to the limit on the way."""
    run_up = max(limit * limit - speed * speed, 0.0) / (2.0 * ACCELERATION)
    if far <= run_up:
        return (math.sqrt(speed * speed + 2.0 * ACCELERATION * far) - speed) / ACCELERATION
    return max(limit - speed, 0.0) / ACCELERATION + (far - run_up) / max(limit, speed)
