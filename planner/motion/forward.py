"""Forward simulation: one vehicle drives an action plan among vehicles whose motion is known.

Recognition, search and driving all use it. Time runs in steps of DT; all motions of one
simulation share their time base. Car-following is Krauss' safe speed (Krauss 1998, Eq. 4.18),
which never collides with a leader that brakes no harder than assumed. What is computed step by
step is compiled: see `planner.kernels`.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from planner.kernels import driving, limits
from planner.kernels.along import braking_caps
from planner.kernels.course import Course, Ints
from planner.manoeuvres.actions import ActionPlan
from planner.motion.obstacles import HOW, Occupancy, Traffic, meeting
from planner.record.trace import SAMPLE_PERIOD, HoldUp
from planner.roads.trajectory import KEPT, Array, Path
from planner.traffic_lights.signals import Lights
from sim.scene import Signal

DT = SAMPLE_PERIOD  # [s] step of the simulation
assert DT == limits.STEP


@dataclass(frozen=True, slots=True)
class Hindrance:
    """Another vehicle that keeps a vehicle below its free speed."""

    vehicle: int
    how: HoldUp
    speed: float  # [m/s] of the hindering vehicle


@dataclass(frozen=True, slots=True)
class Keeping:
    """The reason for a speed below the free one: another vehicle, a light, both or neither."""

    hindrance: Hindrance | None  # the other vehicle
    light: Signal | None  # which light, alone or with a queue before it


@dataclass(frozen=True, slots=True, eq=False)
class Stops:
    """The steps in which lights kept a vehicle below its free speed, in order."""

    step: Ints  # [R] of DT, in the common time base
    which: Ints  # [R] index into `signals`
    signals: tuple[Signal, ...]

    def before(self, step: int) -> "Stops":
        """Return the stops before a step."""
        if len(self.step) == 0 or self.step[-1] < step:
            return self
        n = int(np.searchsorted(self.step, step))
        return Stops(self.step[:n], self.which[:n], self.signals)


@dataclass(frozen=True, slots=True, eq=False)
class Hindrances:
    """The steps in which others kept a vehicle below its free speed, in order."""

    step: Ints  # [H] of DT, in the common time base
    vehicle: Ints  # [H]
    how: Ints  # [H] index into HOW
    speed: Array  # [m/s] [H] of the hindering vehicle

    def before(self, step: int) -> "Hindrances":
        """Return the hindrances before a step."""
        if len(self.step) == 0 or self.step[-1] < step:
            return self
        n = int(np.searchsorted(self.step, step))
        return Hindrances(self.step[:n], self.vehicle[:n], self.how[:n], self.speed[:n])


NOTHING: Ints = np.empty(0, np.int64)
NO_STOPS = Stops(NOTHING, NOTHING, ())
NO_HINDRANCES = Hindrances(NOTHING, NOTHING, NOTHING, np.empty(0))


@dataclass(frozen=True, slots=True)
class Motion:
    """One vehicle's motion at one instant along its path."""

    arc: float  # [m]
    speed: float  # [m/s]
    acceleration: float  # [m/s2]


@dataclass(frozen=True, slots=True, eq=False)
class Drive:
    """The result of driving an action plan."""

    first: int  # step of the first sample
    motion: Array  # [S >= 1, 3] arc [m], speed [m/s], acceleration [m/s2] from `first` on
    finished: bool  # the action's end was reached (else the horizon came first)
    goal_time: float | None  # [s] of the common time base at which the goal was passed
    hindrances: Hindrances
    stops: Stops


class Lane:
    """A path prepared for driving: the highest speeds that allow braking for every bend ahead."""

    def __init__(self, path: Path, end: float = math.inf) -> None:
        """Prepare a path; where the road ends, a vehicle stops before `end` [m]."""
        self.end = end  # [m]
        self.caps = braking_caps(path.cap, path.arc, limits.COMFORT)  # [m/s] at every metre
        if math.isfinite(end):
            room = np.maximum(end - np.arange(len(self.caps)), 0.0)
            self.caps = np.minimum(self.caps, np.sqrt(2.0 * limits.COMFORT * room))

    def speed(self, arc: float) -> float:
        """Return the highest speed [m/s] at an arc [m]."""
        return float(self.caps[min(int(arc), len(self.caps) - 1)])


@lru_cache(maxsize=KEPT)
def lane_of(path: Path) -> Lane:
    """Return a path prepared for driving; results are cached."""
    return Lane(path)


def drive(
    plan: ActionPlan,
    start: Motion,
    first: int,
    traffic: Traffic,
    size: tuple[float, float],
    horizon: int,
    pace: float | Array = math.inf,
) -> Drive:
    """Drive an action plan until it ends.

    Args:
        plan: what to drive; its path is the vehicle's own.
        start: where on the path the vehicle is, and how fast.
        first: step at which it is there.
        traffic: the other vehicles, in the common time base.
        size: length and width [m] of the vehicle.
        horizon: the last step.
        pace: [m/s] the highest speed that the vehicle wants; [N]: at every metre of the path.
    """
    last = horizon + limits.GAP_HORIZON
    others = meeting(plan.path, plan.met, traffic, size[1], first, last)
    motion, held, finished, goal_time = driving.drive(
        _course(plan, np.minimum(lane_of(plan.path).caps, pace), traffic.lights, size[0]),
        float(plan.end),
        math.inf if plan.goal is None else float(plan.goal),
        others.firsts(plan.lines),
        (float(start.arc), float(start.speed), float(start.acceleration)),
        first,
        horizon,
        others.stretches,
        float(size[0]),
    )
    return Drive(
        first,
        motion,
        finished,
        None if math.isnan(goal_time) else goal_time,
        _hindrances(held, first, others),
        _stops(held, first, plan),
    )


def advance(motion: Motion, acceleration: float, dt: float) -> Motion:
    """Move on by `dt` [s] at constant acceleration [m/s2]; a vehicle never rolls back."""
    speed = max(motion.speed + acceleration * dt, 0.0)
    return Motion(motion.arc + 0.5 * (motion.speed + speed) * dt, speed, acceleration)


def accelerate(
    plan: ActionPlan,
    lane: Lane,
    motion: Motion,
    seen: Occupancy,
    crossing: Occupancy,
    foreseen: Occupancy,
    length: float,
    dt: float,
) -> tuple[float, Keeping]:
    """Return the acceleration in the coming step, and what is in the way.

    Args:
        plan: what is being driven.
        lane: its path, prepared.
        motion: where on the path the vehicle is.
        seen: the vehicles to stay behind, from now on, and the lights.
        crossing: motions that the vehicle must give way to, from now on.
        foreseen: motions that will enter the path, for which it makes room, from now on.
        length: [m] of the vehicle.
        dt: [s] length of the coming step.

    Returns:
        Acceleration [m/s2], and what is in the way.
    """
    acceleration, who, how, light = driving.accelerate(
        _course(plan, lane.caps, seen.traffic.lights, length),
        (float(motion.arc), float(motion.speed), float(motion.acceleration)),
        0,
        seen.stretches,
        seen.behind(motion.arc, length),
        crossing.stretches,
        crossing.firsts(plan.lines),
        foreseen.stretches,
        float(length),
        dt,
    )
    signal = None if light < 0 else plan.obey_lights[light].signal
    if who < 0:
        return acceleration, Keeping(None, signal)
    others = {limits.RIGHT_OF_WAY: crossing, limits.NEWCOMER: foreseen}.get(how, seen)
    speed = float(others.stretches.speed[who, 0])
    manner = others.manner(np.array([who]), np.array([0]), np.array([how]))
    hindrance = Hindrance(others.vehicle(who), HOW[int(manner[0])], speed)
    return acceleration, Keeping(hindrance, signal)


def _course(plan: ActionPlan, caps: Array, lights: Lights, length: float) -> Course:
    """Return a plan in the form that kernels take, with the highest speed [m/s] at every metre."""
    rooms = np.add(plan.room_arcs, (0.0, length))
    shown = lights.table(plan.signals)
    return Course(caps, plan.halting, plan.line_arcs, rooms, plan.light_arcs, shown)


def _stops(held: Ints, first: int, plan: ActionPlan) -> Stops:
    """Return the stops, from what held the vehicle up at every step [S - 1, 3]."""
    if not plan.signals:
        return NO_STOPS
    at = np.flatnonzero(held[:, 2] >= 0)
    return Stops(first + at, held[at, 2], plan.signals)


def _hindrances(held: Ints, first: int, others: Occupancy) -> Hindrances:
    """Return the hindrances, from what held the vehicle up at every step [S - 1, 3]."""
    at = np.flatnonzero(held[:, 0] >= 0)
    if len(at) == 0:
        return NO_HINDRANCES
    who, step = held[at, 0], first + at
    names = np.array(others.traffic.vehicles, dtype=np.int64)[others.which]
    speeds = others.stretches.speed
    speed = speeds[who, np.minimum(step, speeds.shape[1] - 1)]
    return Hindrances(step, names[who], others.manner(who, step, held[at, 1]), speed)
