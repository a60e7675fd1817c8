"""States: where everybody was at any time of a ride, as far as it was seen."""

import math
from bisect import bisect_left
from collections.abc import Callable, Hashable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from planner.record.places import RoadFacts, RoadPlace, RouteStep
from planner.record.trace import SAMPLE_PERIOD, PlanTrace
from sim.roads.network import angle_between
from sim.scene import EGO, VehicleState
from xavi_dialogue.domain.facts import Gap
from xavi_dialogue.explain.facts.bearings import Offset, offset
from xavi_dialogue.explain.history.joining import Seen
from xavi_dialogue.explain.history.motion import EPSILON, Array, Motion
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.explain.history.thresholds import STALE

Kept = TypeVar("Kept")


@dataclass(frozen=True)
class Pair:
    """One vehicle seen from another, at the times at which both were seen; arrays [N]."""

    time: Array  # [s]
    ahead: Array  # [m] centre of the vehicle that is seen, in the frame of the other
    left: Array  # [m]
    turn: Array  # [rad] heading relative to the other's, in (-pi, pi]
    speed: Array  # [m/s] of the vehicle that is seen
    eye_speed: Array  # [m/s] of the other
    clear: float  # [m] half the lengths of both


class States:
    """The states of all vehicles over a ride; results are computed once and kept."""

    def __init__(self, ride: Ride) -> None:
        self.ride = ride
        self._shapes: dict[int, VehicleState | None] = {}
        self._pairs: dict[tuple[int, int], Pair | None] = {}
        self._memo: dict[Hashable, Any] = {}

    def memo(self, key: Hashable, work_out: Callable[[], Kept]) -> Kept:
        """Return the result that was computed under a key before, or compute it now."""
        if key not in self._memo:
            self._memo[key] = work_out()
        found: Kept = self._memo[key]
        return found

    @cached_property
    def begin(self) -> float:
        """The first moment [s] of the record."""
        times = [trace.sim_time for trace in self.ride.traces[:1]]
        times += self.ride.motion(EGO).time[:1]
        return min(times, default=self.ride.now)

    def seen(self, vehicle: int) -> Seen:
        """Return what was seen of a vehicle."""
        return self.ride.seen(vehicle)

    def motion(self, vehicle: int) -> Motion:
        """Return the recorded motion of a vehicle."""
        return self.ride.seen(vehicle).motion

    def trace(self, time: float) -> PlanTrace | None:
        """Return the last decision at or before a time [s]."""
        k = self.ride.index(time)
        return None if k is None else self.ride.traces[k]

    def shape(self, vehicle: int) -> VehicleState | None:
        """Return the last recorded state of a vehicle, for what does not change, such as length."""
        if vehicle not in self._shapes:
            seen = (t.scene[vehicle] for t in reversed(self.ride.traces) if vehicle in t.scene)
            here = None if self.ride.scene is None else self.ride.scene.vehicles.get(vehicle)
            self._shapes[vehicle] = here or next(seen, None)
        return self._shapes[vehicle]

    def hidden(self, vehicle: int, time: float) -> float | None:
        """Return since when [s] a vehicle is hidden at a time; None if it is not."""
        for begin, end in self.seen(vehicle).hidden:
            if begin + EPSILON < time <= end + EPSILON:
                return begin
        trace = self.trace(time)
        if trace is None or time - trace.sim_time > STALE or self._seen_since(vehicle, time):
            return None
        return trace.unseen.get(vehicle)

    def _seen_since(self, vehicle: int, time: float) -> bool | None:
        """Check whether the scene after the last decision has a vehicle; None: no such scene."""
        scene = self.ride.scene
        if scene is None or time < scene.time - EPSILON:
            return None
        return vehicle in scene.vehicles

    def known(self, vehicle: int, time: float) -> bool:
        """Check whether it is known where a vehicle is at a time [s]: seen, or hidden but known."""
        motion = self.motion(vehicle)
        k = motion.index(time)
        if k is None:
            return False
        if time - motion.time[k] <= SAMPLE_PERIOD + 0.01:
            return True
        if k + 1 < len(motion.time) and motion.time[k + 1] - motion.time[k] < 0.5:
            return True
        trace = self.trace(time)
        if trace is None or vehicle not in trace.scene or time - trace.sim_time > STALE:
            return False
        return vehicle in trace.unseen or self._seen_since(vehicle, time) is not False

    def visible(self, vehicle: int, time: float) -> bool:
        """Check whether a vehicle is in view at a time [s]."""
        return self.known(vehicle, time) and self.hidden(vehicle, time) is None

    def in_view(self, time: float) -> tuple[int, ...]:
        """Return the other vehicles in view at a time [s], in order of their numbers."""
        return tuple(v for v in self.ride.vehicles if self.visible(v, time))

    def last_seen(self, vehicle: int, time: float) -> float | None:
        """Return when [s] a vehicle was in view last, up to a time; None if it never was."""
        if self.visible(vehicle, time):
            return time
        since = self.hidden(vehicle, time)
        motion = self.motion(vehicle)
        k = motion.index(time if since is None else since)
        if k is None:
            return None
        last = motion.time[k]
        before = self.hidden(vehicle, last)
        return last if before is None else before

    def state(self, vehicle: int, time: float) -> VehicleState | None:
        """Return a vehicle's state at a time [s], also between samples; None if not known."""
        if not self.known(vehicle, time):
            return None
        return self._at(vehicle, time)

    def lately(self, vehicle: int, time: float) -> VehicleState | None:
        """Return where a vehicle was when it was in view last, up to a time [s]."""
        last = self.last_seen(vehicle, time)
        return None if last is None else self._at(vehicle, last)

    def _at(self, vehicle: int, time: float) -> VehicleState | None:
        motion, shape = self.motion(vehicle), self.shape(vehicle)
        k = motion.index(time)
        if k is None or shape is None:
            return None
        (x, y), heading, speed = motion.position[k], motion.heading[k], motion.speed[k]
        rest, seen = time - motion.time[k], self._seen_since(vehicle, time)
        if rest > EPSILON and k + 1 < len(motion.time) and motion.time[k + 1] - time < 0.5:
            share = rest / (motion.time[k + 1] - motion.time[k])
            x += share * (motion.position[k + 1][0] - x)
            y += share * (motion.position[k + 1][1] - y)
            heading += share * angle_between(motion.heading[k + 1], heading)
            speed += share * (motion.speed[k + 1] - speed)
        return replace(
            shape,
            position=(x, y),
            heading=math.remainder(heading, math.tau),
            speed=speed,
            acceleration=shape.acceleration if seen else motion.rate[k],
            signals=self.lights(vehicle, time) or (),
        )

    def offset(self, eye: int, other: int, time: float) -> Offset | None:
        """Return where one vehicle is, seen from another, at a time [s]; None if not known."""
        a, b = self.state(eye, time), self.state(other, time)
        return None if a is None or b is None else offset(a, b)

    def lights(self, vehicle: int, time: float) -> tuple[str, ...] | None:
        """Return the lights that a vehicle shows at a time [s]; None if that is not known."""
        changes = [c for c in self.seen(vehicle).lights if c.time <= time + EPSILON]
        return changes[-1].shown if changes else None

    def road(self, time: float) -> RoadFacts | None:
        """Return the road as it was known at a time [s]."""
        trace = self.trace(time)
        return None if trace is None else trace.road

    def junction(self, time: float) -> RouteStep | None:
        """Return the junction that we are in at a time [s], or come to next."""
        known = self.ride.index(time)
        for trace in reversed(self.ride.traces[: 0 if known is None else known + 1]):
            if trace.road is None:
                return None
            here = trace.road.places.get(EGO)
            if here is None or here.roundabout or not here.in_junction:
                return next(iter(trace.road.route), None)
        return None

    def place(self, vehicle: int, time: float) -> RoadPlace | None:
        """Return where on the road a vehicle is at a time [s], from the decision nearest to it."""
        traces, after = self.ride.traces, bisect_left(self.ride.times, time - EPSILON)
        near = [k for k in (after - 1, after) if 0 <= k < len(traces)]
        near.sort(key=lambda k: abs(traces[k].sim_time - time))
        for k in near:
            road = traces[k].road
            if abs(traces[k].sim_time - time) <= STALE and road and vehicle in road.places:
                return road.places[vehicle]
        return None

    def pair(self, eye: int, other: int) -> Pair | None:
        """Return one vehicle seen from another over the whole ride; None if they never met."""
        if (eye, other) not in self._pairs:
            self._pairs[eye, other] = self._pair(eye, other)
        return self._pairs[eye, other]

    def _pair(self, eye: int, other: int) -> Pair | None:
        mine, theirs = self.motion(eye), self.motion(other)
        a, b = self.shape(eye), self.shape(other)
        if a is None or b is None or not mine.time or not theirs.time:
            return None
        time, ours = theirs.arrays[0], mine.arrays
        k = np.clip(np.searchsorted(ours[0], time), 1, max(len(ours[0]) - 1, 1))
        if len(ours[0]) < 2:
            return None
        held = (time >= ours[0][0] - EPSILON) & (time <= ours[0][-1] + EPSILON)
        held &= ours[0][k] - ours[0][k - 1] < 0.5
        if not held.any():
            return None
        time = time[held]
        x, y, heading, speed = (column[held] for column in theirs.arrays[1:])
        ex, ey, eh, es = (np.interp(time, ours[0], column) for column in ours[1:])
        forward, aside = np.cos(eh), np.sin(eh)  # of the viewer's heading
        dx = x - b.length / 2 * np.cos(heading) - ex + a.length / 2 * forward
        dy = y - b.length / 2 * np.sin(heading) - ey + a.length / 2 * aside
        turn = np.mod(heading - eh + np.pi, 2.0 * np.pi) - np.pi
        ahead, left = dx * forward + dy * aside, dy * forward - dx * aside
        return Pair(time, ahead, left, turn, speed, es, (a.length + b.length) / 2.0)

    def lost(self, begin: float, end: float) -> bool:
        """Check whether some of the record between two times [s] was lost in transmission."""
        return any(a <= end + EPSILON and begin <= b + EPSILON for a, b in self.ride.gaps)

    def gap(self, vehicle: int, time: float) -> Gap | None:
        """Return why it is not known where a vehicle is at a time [s]; None if it is known."""
        if time > self.ride.now + EPSILON:
            return "in-future"
        if time < self.begin - EPSILON:
            return "before-record"
        if self.known(vehicle, time):
            return "hidden" if self.hidden(vehicle, time) is not None else None
        if self.lost(time, time):
            return "gap-in-record"
        return "gap-in-record" if vehicle == EGO else "out-of-view"


def states_of(ride: Ride) -> States:
    """Return the states of a ride; there is one object for each ride object."""
    found = ride.notes.get("states")
    if not isinstance(found, States):
        found = ride.notes["states"] = States(ride)
    return found
