"""Course: when things happen in the rollouts of a plan, according to their recorded lines."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import overload

import numpy as np

from planner.record.trace import SAMPLE_PERIOD, Action, PlanTrace, Rollout
from sim.roads.network import angle_between
from sim.scene import Point
from xavi_dialogue.causal.effects import HIGH, LOW, quantile
from xavi_dialogue.causal.model import Intervention
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.thresholds import STANDING

TURNS: tuple[ActionName, ...] = ("exit-left", "exit-right")
#: Actions that the speed shows, and not the actions of a rollout.
SPEED_MARKS: tuple[ActionName, ...] = ("slow-down", "speed-up", "stop", "give-way")
BEGUN = 0.15  # share of its whole angle from which a turn has begun
SLIGHT = math.radians(20.0)  # an angle that is no turn
STRIDE = 0.5  # [m] below which two positions give no heading
MOVING = 1.0  # [m/s] minimum speed of a vehicle that moves on after standing
HARD = 4.0  # [m/s2] of braking that passengers call hard


@dataclass(frozen=True, slots=True)
class Expected:
    """When something happens under a plan, over those rollouts in which it does."""

    share: float  # weight of the rollouts in which it happens
    moment: float  # [s] median
    low: float  # [s] 5 % point
    high: float  # [s] 95 % point


class Lines(Mapping[int, Motion]):
    """The motion of the ego in each rollout whose line is recorded, by the rollout's index.

    Rollouts that share another's line are included. Sample k lies k periods after the decision.
    Each line is read when it is asked for.
    """

    def __init__(self, trace: PlanTrace) -> None:
        """Lines of the rollouts of a decision."""
        self._start = trace.sim_time
        drawn = {r.index: r for r in trace.rollouts if r.path and r.speed}
        self._drawn = drawn | {
            r.index: drawn[r.same_as] for r in trace.rollouts if r.same_as in drawn
        }
        self._read: dict[int, Motion] = {}
        self._times: tuple[float, ...] = ()

    def __getitem__(self, index: int) -> Motion:
        """Return a line.

        Raises:
            KeyError: it is not recorded.
        """
        rollout = self._drawn[index]
        if rollout.index not in self._read:
            self._read[rollout.index] = self._motion(rollout)
        return self._read[rollout.index]

    def __iter__(self) -> Iterator[int]:
        """Yield the indices of the rollouts."""
        return iter(self._drawn)

    def __len__(self) -> int:
        """Count the rollouts."""
        return len(self._drawn)

    def _motion(self, rollout: Rollout) -> Motion:
        path, speed = rollout.path or (), rollout.speed or ()
        count = min(len(path), len(speed))
        for k in range(len(self._times), count):
            self._times += (round(self._start + k * SAMPLE_PERIOD, 3),)
        return Motion(self._times[:count], path[:count], Headings(path[:count]), speed[:count])


def lines(trace: PlanTrace) -> Lines:
    """Return the motion of the ego in each rollout whose line is recorded."""
    return Lines(trace)


def expected(
    trace: PlanTrace, plan: Intervention, moment: Callable[[Rollout, Motion], float | None]
) -> Expected | None:
    """Return when something happens under a plan; None if no line is recorded, or it never does."""
    known = lines(trace)
    times, weights, total = [], [], 0.0
    for result, weight in zip(plan.results, plan.weights, strict=True):
        motion = known.get(result.rollout.index)
        if motion is None or weight <= 0.0:
            continue
        total += weight
        if (time := moment(result.rollout, motion)) is not None:
            times.append(time)
            weights.append(weight)
    if not times:
        return None
    found, mass = np.array(times), np.array(weights)
    low, middle, high = (quantile(found, mass, share) for share in (LOW, 0.5, HIGH))
    return Expected(min(sum(weights) / total, 1.0), middle, low, high)


def begins(
    action: ActionName, names: tuple[Action, ...]
) -> Callable[[Rollout, Motion], float | None]:
    """Return a function that finds when [s] an action begins in a rollout.

    A turn begins where the heading changes, not with the macro action that leads up to it.

    Args:
        action: the action, as the question calls it.
        names: the macro actions that it stands for.
    """

    def moment(rollout: Rollout, motion: Motion) -> float | None:
        if action in SPEED_MARKS:
            return speed_mark(motion, action)
        for start, end, step in _stretches(rollout, motion):
            if step in names:
                return _turning(motion, start, end) if step in TURNS else start
        return None

    return moment


def speed_mark(motion: Motion, action: ActionName) -> float | None:
    """Return when [s] a change of speed begins; of a stop, when the vehicle stands."""
    wanted = "stop" if action == "give-way" else action
    return motion.first(wanted)


def moves_on(_: Rollout, motion: Motion) -> float | None:
    """Return when [s] the ego, standing at first, drives on."""
    return next(
        (t for t, speed in zip(motion.time, motion.speed, strict=True) if speed >= MOVING), None
    )


def stands(motion: Motion) -> bool:
    """Check whether a vehicle comes to stand."""
    return bool(motion.speed) and min(motion.speed) < STANDING


def brakes(motion: Motion) -> float:
    """Return the hardest braking [m/s2], over two samples so that rounding does not count."""
    drops = [a - b for a, b in zip(motion.speed, motion.speed[2:], strict=False)]
    return max(drops, default=0.0) / (2.0 * SAMPLE_PERIOD)


def hard_braking(motion: Motion) -> float | None:
    """Return when [s] a vehicle last began to brake hard."""
    drops = [a - b for a, b in zip(motion.speed, motion.speed[2:], strict=False)]
    hard = [k for k, drop in enumerate(drops) if drop >= HARD * 2.0 * SAMPLE_PERIOD - 1e-9]
    if not hard:
        return None
    first = hard[-1]
    while first - 1 in hard:
        first -= 1
    return motion.time[first]


def _stretches(rollout: Rollout, motion: Motion) -> Iterator[tuple[float, float, Action]]:
    """Yield the actions of a rollout with their start and end [s]."""
    ends = [*(timed.start for timed in rollout.actions[1:]), motion.time[-1]]
    for timed, end in zip(rollout.actions, ends, strict=True):
        yield timed.start, end, timed.action


def _turning(motion: Motion, start: float, end: float) -> float:
    """Return when [s] the turn itself begins within an action that leads up to it."""
    inside = [k for k, time in enumerate(motion.time) if start - 1e-6 <= time <= end + 1e-6]
    if len(inside) < 2:
        return start
    first = motion.heading[inside[0]]
    turned = [angle_between(motion.heading[k], first) for k in inside]
    most = max(turned, key=abs)
    if abs(most) < SLIGHT:
        return start
    sign = math.copysign(1.0, most)
    begun = next(
        k for k, angle in zip(inside, turned, strict=True) if sign * angle >= BEGUN * abs(most)
    )
    return motion.time[begun]


class Headings(Sequence[float]):
    """The heading [rad] at each position of a line, computed when it is first needed."""

    def __init__(self, path: tuple[Point, ...]) -> None:
        """Headings along a line of positions [m]."""
        self._path = path

    @cached_property
    def _found(self) -> tuple[float, ...]:
        return _headings(self._path)

    @overload
    def __getitem__(self, index: int) -> float: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[float, ...]: ...
    def __getitem__(self, index: int | slice) -> float | tuple[float, ...]:
        """Return one heading, or those of a slice."""
        return self._found[index]

    def __len__(self) -> int:
        """Count the positions."""
        return len(self._path)


def _headings(path: tuple[Point, ...]) -> tuple[float, ...]:
    """Return the heading [rad] at each position; after a move below STRIDE, the last one."""
    found: list[float] = []
    anchor, heading = 0, 0.0
    for k, (x, y) in enumerate(path):
        dx, dy = x - path[anchor][0], y - path[anchor][1]
        if math.hypot(dx, dy) >= STRIDE:
            fresh = math.atan2(dy, dx)
            if anchor == 0 and not any(found):
                found = [fresh] * len(found)
            anchor, heading = k, fresh
        found.append(heading)
    return tuple(found)
