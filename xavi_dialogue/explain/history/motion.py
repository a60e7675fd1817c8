"""Motion: what a vehicle has been seen to do, by its recorded positions and speeds.

Lane changes and turns follow from the shape of the path alone. A vehicle that moves sideways by a
lane's width and heads the same way again has changed lanes; one that heads elsewhere has turned.
"""

import math
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate, chain, pairwise
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from planner.prediction.goals import BRANCHES
from planner.record.trace import SAMPLE_PERIOD, GoalPrediction, TrajectoryPrediction
from sim.scene import Point
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.history.thresholds import (
    ALONG,
    BEGINNING,
    BEGUN,
    BROKEN,
    CHANGED,
    LANE_SHIFT,
    LANE_TIME,
    PAUSE,
    REBOUND,
    SLANT,
    STANDING,
    TREND,
    TREND_TIME,
    TURN_LENGTH,
    TURNED,
    WAVER,
)

Array: TypeAlias = NDArray[np.float64]
Trend: TypeAlias = Literal["slowing", "steady", "speeding-up", "standing"]

EPSILON = 1e-6  # [s]
LEVEL = 0.05  # [m/s] within which two speeds are the same
BORE = 0.1  # [rad] minimum change of heading that passengers feel
STRAIGHT = 0.01  # [rad] range of headings below which no lane was changed


@dataclass(frozen=True, slots=True)
class Sighting:
    """Something that a vehicle was seen to do."""

    action: ActionName
    start: float  # [s]
    end: float  # [s]
    angle: float = 0.0  # [rad] of a turn, to the left

    @property
    def span(self) -> tuple[float, float]:
        """The begin and end [s]."""
        return self.start, self.end


@dataclass(frozen=True)
class Motion:
    """The recorded motion of one vehicle, oldest first; all lists have the same length N."""

    time: tuple[float, ...]  # [s] [N]
    position: tuple[Point, ...]  # [m] [N]
    heading: Sequence[float]  # [rad] [N]
    speed: tuple[float, ...]  # [m/s] [N]

    def until(self, time: float) -> "Motion":
        """Return the part up to a time [s]."""
        n = bisect_right(self.time, time + EPSILON)
        if n == len(self.time):
            return self
        return Motion(self.time[:n], self.position[:n], self.heading[:n], self.speed[:n])

    def index(self, time: float) -> int | None:
        """Return the last sample at or before a time [s]; None if the record begins later."""
        k = bisect_right(self.time, time + EPSILON) - 1
        return k if k >= 0 else None

    def within(self, begin: float, end: float) -> range:
        """Return the samples from `begin` to `end` [s]."""
        first = bisect_left(self.time, begin - EPSILON)
        return range(first, bisect_right(self.time, end + EPSILON))

    @property
    def trend(self) -> Trend | None:
        """How the speed changes at the end; None without a record."""
        if not self.time:
            return None
        if self.speed[-1] < STANDING:
            return "standing"
        back = bisect_left(self.time, self.time[-1] - TREND_TIME - EPSILON)
        span = self.time[-1] - self.time[back]
        rate = (self.speed[-1] - self.speed[back]) / span if span > 0.0 else 0.0
        if abs(rate) < TREND:
            return "steady"
        return "slowing" if rate < 0.0 else "speeding-up"

    def sightings(self) -> tuple[Sighting, ...]:
        """Return what was done, in order of its start."""
        return self._sightings

    @cached_property
    def _sightings(self) -> tuple[Sighting, ...]:
        found: list[Sighting] = []
        for part in self.parts():
            found += [*part._speeds(), *part._stops(), *turns(part), *lane_changes(part)]
        return tuple(sorted(found, key=lambda s: (s.start, s.end, s.action)))

    def times(self, action: ActionName) -> tuple[Sighting, ...]:
        """Return all sightings that an action of a question may mean, oldest first."""
        return tuple(s for s in self.sightings() if s.action in _means(action))

    def first(self, action: ActionName) -> float | None:
        """Return when [s] exactly this action was first done; None: never.

        For changes of speed and stops, lane changes and turns are not computed.
        """
        if action in ("slow-down", "speed-up"):
            sign = -1.0 if action == "slow-down" else 1.0
            runs = (part._changes_of_speed(action, sign) for part in self.parts())
            found: Iterable[Sighting] = chain.from_iterable(runs)
        elif action == "stop":
            found = (s for part in self.parts() for s in part._stops())
        else:
            found = (s for s in self.sightings() if s.action == action)
        return min((s.start for s in found), default=None)

    def last(self, action: ActionName) -> Sighting | None:
        """Return the last sighting that an action of a question may mean."""
        return next(reversed(self.times(action)), None)

    def _speeds(self) -> list[Sighting]:
        return [
            *self._changes_of_speed("slow-down", -1.0),
            *self._changes_of_speed("speed-up", 1.0),
        ]

    def _changes_of_speed(self, action: ActionName, sign: float) -> Iterator[Sighting]:
        """Yield the stretches over which the speed grows, or falls if the sign is -1."""
        foot = start = best = 0  # reference sample; begin of the change; its end so far
        for k in range(1, len(self.speed) + 1):
            ended = k == len(self.speed)
            still = None if ended else self._paused(k, start, best, sign)
            best = best if still is None else still
            if ended or still is not None or sign * (self.speed[k] - self.speed[best]) < -REBOUND:
                least = BEGINNING if ended else CHANGED
                if sign * (self.speed[best] - self.speed[foot]) >= least:
                    yield Sighting(action, self.time[start], self.time[best])
                foot = start = best = k
                continue
            change = sign * (self.speed[k] - self.speed[foot])
            if change <= 0.0:
                foot = k
            if change <= WAVER:  # a flat beginning is no part of it
                start = best = k
            elif sign * (self.speed[k] - self.speed[best]) > 0.0:
                best = k

    def _paused(self, k: int, start: int, best: int, sign: float) -> int | None:
        """Return the sample at which a change paused that began before; None: it goes on."""
        since = bisect_right(self.time, self.time[k] - PAUSE) - 1
        most = max(sign * self.speed[j] for j in (k, max(best, since)))
        flat = (j for j in range(since, k + 1) if sign * self.speed[j] >= most - LEVEL)
        return next(flat) if start < since and most <= sign * self.speed[since] + LEVEL else None

    def _stops(self) -> list[Sighting]:
        """Return the stops, without a standstill from the first sample on."""
        found: list[Sighting] = []
        for k in range(1, len(self.speed)):
            if self.speed[k] < STANDING <= self.speed[k - 1]:
                still = [j for j in range(k, len(self.speed)) if self.speed[j] >= STANDING]
                end = still[0] if still else len(self.speed) - 1
                found.append(Sighting("stop", self.time[k], self.time[end]))
        return found

    @cached_property
    def rate(self) -> tuple[float, ...]:
        """The acceleration [m/s2] at each sample, over its neighbours on both sides."""
        last = len(self.time) - 1
        found: list[float] = []
        for k in range(last + 1):
            first, after = max(k - 1, 0), min(k + 1, last)
            span = self.time[after] - self.time[first]
            change = self.speed[after] - self.speed[first]
            found.append(change / span if 0.0 < span < 2.0 * BROKEN else 0.0)
        return tuple(found)

    @cached_property
    def arrays(self) -> tuple[Array, Array, Array, Array, Array]:
        """Time [s], x and y [m], unwrapped heading [rad] and speed [m/s], each [N]."""
        x, y = np.array(self.position).reshape(-1, 2).T
        heading = np.unwrap(np.array(self.heading))
        return np.array(self.time), x, y, heading, np.array(self.speed)

    @cached_property
    def arc(self) -> tuple[float, ...]:
        """The distance driven [m] up to each sample, from the first one."""
        steps = (math.dist(a, b) for a, b in zip(self.position, self.position[1:], strict=False))
        return tuple(accumulate(steps, initial=0.0)) if self.time else ()

    def parts(self) -> tuple["Motion", ...]:
        """Return the stretches without a break in the samples."""
        breaks = [k for k in range(1, len(self.time)) if self.time[k] - self.time[k - 1] > BROKEN]
        if not breaks:
            return (self,) if self.time else ()
        return tuple(
            Motion(self.time[a:b], self.position[a:b], self.heading[a:b], self.speed[a:b])
            for a, b in pairwise((0, *breaks, len(self.time)))
        )


def turns(motion: Motion) -> Iterator[Sighting]:
    """Yield the turns of a path, each from where its heading begins to change to its end."""
    if len(motion.time) < 2:
        return
    heading, arc = motion.arrays[3], np.array(motion.arc)
    back = np.searchsorted(arc, arc - TURN_LENGTH)
    done = 0
    for k in np.flatnonzero(np.abs(heading - heading[back]) >= TURNED):
        first = max(int(back[k]), done)
        if k <= done or abs(heading[k] - heading[first]) < TURNED:
            continue
        end, sign = int(k), math.copysign(1.0, heading[k] - heading[first])
        while end + 1 < len(heading) and arc[end] - arc[k] <= TURN_LENGTH:
            ahead = int(np.searchsorted(arc, arc[end] + 4.0))
            rest = heading[end + 1 : max(ahead, end + 1) + 1] - heading[end]
            if sign * float(np.max(sign * rest)) * sign < BEGUN / 4.0:
                break
            end += 1
        angle = float(heading[end] - heading[first])
        inside = np.abs(heading[first : end + 1] - heading[first])
        start = first + int(np.argmax(inside >= BEGUN))
        action: ActionName = "exit-left" if angle > 0.0 else "exit-right"
        yield Sighting(action, motion.time[start], motion.time[end], angle)
        done = end


def bends(motion: Motion) -> Iterator[Sighting]:
    """Yield the stretches over which a path bears to one side, also those that are no turns."""
    if len(motion.time) < 2:
        return
    heading = motion.arrays[3]
    for sign in (-1.0, 1.0):
        foot = best = 0
        for k in range(1, len(heading) + 1):
            ended = k == len(heading) or sign * (heading[k] - heading[best]) < -STRAIGHT
            if ended and sign * (heading[best] - heading[foot]) >= BORE:
                angle = float(heading[best] - heading[foot])
                yield Sighting("swerve", motion.time[foot], motion.time[best], angle)
            if ended or sign * (heading[k] - heading[foot]) <= 0.0:
                foot = best = k
            elif sign * (heading[k] - heading[best]) > 0.0:
                best = k


def lane_changes(motion: Motion) -> Iterator[Sighting]:
    """Yield the lane changes of a path: sideways by a lane's width, and on in the same direction.

    Offsets are along the headings at both ends, so neither a bend nor a slanted start counts.
    """
    count = len(motion.time)
    if count < 3:
        return
    shift = _sideways(motion)
    found = (np.abs(shift) >= LANE_SHIFT[0]) & (np.abs(shift) <= LANE_SHIFT[1])
    start = 0
    for k in np.flatnonzero(found.any(axis=1)):
        backs = [k - d for d in range(shift.shape[1] - 1, 0, -1) if k - d >= start and found[k, d]]
        if backs:
            back = backs[0]
            action: ActionName = "change-left" if shift[k, k - back] > 0.0 else "change-right"
            yield Sighting(action, motion.time[back], motion.time[k])
            start = int(k)


def _sideways(motion: Motion) -> Array:
    """Return how far [m] to the left a vehicle moved from d samples before [D] to each one [N]."""
    time, x, y, heading, _ = motion.arrays
    depth = min(round(LANE_TIME / SAMPLE_PERIOD) + 1, len(time))
    if float(np.ptp(heading)) < STRAIGHT or motion.arc[-1] < LANE_SHIFT[0]:
        return np.zeros((len(time), 1))
    before = np.arange(len(time))[:, None] - np.arange(depth)
    known = before >= 0
    before = np.where(known, before, 0)
    then, now = heading[before], heading[:, None]
    dx, dy = x[:, None] - x[before], y[:, None] - y[before]
    first = dy * np.cos(heading)[before] - dx * np.sin(heading)[before]
    last = dy * np.cos(now) - dx * np.sin(now)
    slant = np.maximum(
        np.maximum.accumulate(then, axis=1) - then, then - np.minimum.accumulate(then, axis=1)
    )
    fits = known & (np.abs(now - then) <= ALONG) & (slant <= SLANT) & (first * last > 0.0)
    fits &= time[:, None] - time[before] <= LANE_TIME + EPSILON
    return np.where(fits, np.where(np.abs(first) < np.abs(last), first, last), 0.0)


def branches_off(goal: GoalPrediction, way: TrajectoryPrediction) -> bool:
    """Check whether the way to a goal ends on a road that branches off the one that goes on."""
    return goal.place in BRANCHES.values() and way.actions[-1:] == ("continue",)


def steps(goal: GoalPrediction, way: TrajectoryPrediction) -> tuple[ActionName, ...]:
    """Return the actions on the way to a goal; the last is "leave" if its road branches off."""
    return (*way.actions[:-1], "leave") if branches_off(goal, way) else way.actions


def foretold(goal: GoalPrediction, way: TrajectoryPrediction, action: ActionName) -> bool:
    """Check whether the way to a goal contains an action; branching off is not straight on."""
    if not branches_off(goal, way):
        return foresees(way, action)
    if action in ("continue", "exit-straight"):
        return False
    return action == "leave" or foresees(way, action)


def foresees(way: TrajectoryPrediction, action: ActionName) -> bool:
    """Check whether a predicted trajectory contains an action or a change of speed.

    A vehicle that stands already stops if it stays. Without a line, only the actions are known.
    """
    if way.speed and action == "slow-down":
        return min(way.speed) <= way.speed[0] - CHANGED
    if way.speed and action == "speed-up":
        return max(way.speed) >= min(way.speed) + CHANGED
    if way.speed and action in ("stop", "give-way"):
        return "stop" in way.actions or _halts(way.speed)
    return any(step in _means(action) for step in way.actions)


def _halts(speed: Sequence[float]) -> bool:
    off = next((k for k, value in enumerate(speed) if value >= STANDING), None)
    return off is None or min(speed[off:]) < STANDING


def _means(action: ActionName) -> tuple[ActionName, ...]:
    """Return the actions, seen or predicted, that an action of a question may stand for."""
    meanings: dict[ActionName, tuple[ActionName, ...]] = {
        "continue": ("continue", "exit-straight"),
        "exit-straight": ("continue", "exit-straight"),
        "overtake": ("change-left", "change-right"),
        "give-way": ("stop",),
    }
    return meanings.get(action, (action,))
