"""Joining: the recorded histories of all decisions as one motion for each vehicle.

Joined motions are kept for the rides that were asked about last. If a ride has gone on, its new
decisions are added; an earlier state of it is a part of what is kept.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from planner.record.places import LightChange
from planner.record.trace import SAMPLE_PERIOD, PlanTrace, Track
from sim.roads.network import angle_between
from sim.scene import EGO, Scene, VehicleState
from xavi_dialogue.explain.history.motion import EPSILON, Motion

FILLED = 2.0  # [s] maximum time between the last decision and a scene that is filled in
KEPT = 4  # rides whose motions are kept
Traces = tuple[PlanTrace, ...]
Span = tuple[float, float]  # [s]
NOTHING = Motion((), (), (), ())


@dataclass(frozen=True)
class Seen:
    """What was seen of one vehicle."""

    recorded: Motion = NOTHING  # with what was assumed
    lights: tuple[LightChange, ...] = ()  # oldest first; () unknown
    hidden: tuple[Span, ...] = ()  # when it was behind something, and its motion estimated
    assumed: tuple[Span, ...] = ()  # such times that are over: it was seen again

    @cached_property
    def motion(self) -> Motion:
        """The motion, without what was assumed of times after which it was seen again.

        What it really did shows when it is seen again: an assumption would look like a jerk.
        """
        known = self.recorded
        if not self.assumed:
            return known
        seen = [
            k for k, t in enumerate(known.time)
            if not any(a + EPSILON < t < b - EPSILON for a, b in self.assumed)
        ]  # fmt: skip
        return Motion(
            tuple(known.time[k] for k in seen),
            tuple(known.position[k] for k in seen),
            tuple(known.heading[k] for k in seen),
            tuple(known.speed[k] for k in seen),
        )

    def until(self, time: float) -> "Seen":
        """Return what was known at the time [s] of a decision."""
        lights = tuple(change for change in self.lights if change.time <= time + EPSILON)
        hidden = tuple((a, min(b, time)) for a, b in self.hidden if a < time - EPSILON)
        assumed = tuple(span for span in self.assumed if span[1] <= time + EPSILON)
        return Seen(self.recorded.until(time), lights, hidden, assumed)


@dataclass(frozen=True, slots=True)
class Joined:
    """What was seen of all road users in some decisions."""

    traces: Traces = ()
    seen: Mapping[int, Seen] = field(default_factory=dict)

    def extended(self, traces: Traces) -> "Joined":
        """Return the same with further decisions.

        Args:
            traces: all decisions, the known ones first.
        """
        seen = dict(self.seen)
        parts: dict[int, _Part] = {}
        for trace in traces[len(self.traces) :]:
            for vehicle, track in trace.history.items():
                if vehicle not in parts:
                    parts[vehicle] = _Part(seen.get(vehicle, Seen()))
                parts[vehicle].add(trace, vehicle, track)
        for vehicle, part in parts.items():
            seen[vehicle] = part.seen()
        return Joined(traces, seen)

    def until(self, traces: Traces) -> "Joined":
        """Return the same with the first few decisions only."""
        time = traces[-1].sim_time
        seen = {v: known.until(time) for v, known in self.seen.items()}
        return Joined(traces, {v: known for v, known in seen.items() if known.recorded.time})

    def reaching(self, scene: Scene) -> "Joined":
        """Return the same with what was seen after the last decision.

        The time in between is filled in by linear interpolation.
        """
        last = self.traces[-1]
        seen = dict(self.seen)
        for vehicle, since in last.unseen.items():
            if vehicle in seen and vehicle not in scene.vehicles:
                known = seen[vehicle]
                hidden = (*(span for span in known.hidden if span[0] != since), (since, scene.time))
                seen[vehicle] = replace(known, hidden=hidden)
        for vehicle, state in scene.vehicles.items():
            known = seen.get(vehicle, Seen())
            lights, shown = known.lights, state.signals
            if not lights or lights[-1].shown != shown:
                lights = (*lights, LightChange(scene.time, shown))
            moved = _reaching(known.recorded, scene.time, state)
            seen[vehicle] = replace(known, recorded=moved, lights=lights)
        return Joined(self.traces, seen)


def _reaching(motion: Motion, time: float, state: VehicleState) -> Motion:
    """Return a motion with one more sample, at a time [s], and the missing ones in between."""
    since = motion.time[-1] if motion.time else -math.inf
    count = math.ceil((time - since) / SAMPLE_PERIOD - 0.01) if time - since <= FILLED else 1
    if time <= since + EPSILON or count < 1:
        return motion
    (x, y), heading, speed = state.position, state.heading, state.speed
    shares = [k * SAMPLE_PERIOD / (time - since) for k in range(1, count)]
    if shares:
        (x0, y0), h0, v0 = motion.position[-1], motion.heading[-1], motion.speed[-1]
        turn = angle_between(heading, h0)
    between = tuple(
        (x0 + s * (x - x0), y0 + s * (y - y0), h0 + s * turn, v0 + s * (speed - v0)) for s in shares
    )
    return Motion(
        motion.time + tuple(round(since + s * (time - since), 3) for s in shares) + (time,),
        motion.position + tuple((a, b) for a, b, _, _ in between) + ((x, y),),
        tuple(motion.heading) + tuple(h for _, _, h, _ in between) + (heading,),
        motion.speed + tuple(v for _, _, _, v in between) + (speed,),
    )


_kept: list[Joined] = []  # latest first


def joined(traces: Traces) -> Joined:
    """Return what was seen of all road users in some decisions of a ride, oldest first."""
    if not traces:
        return Joined()
    for known in tuple(_kept):
        if len(known.traces) >= len(traces):
            if _begins(known.traces, traces):
                return known if len(known.traces) == len(traces) else known.until(traces)
        elif _begins(traces, known.traces):
            return _keep(known.extended(traces), known)
    return _keep(Joined().extended(traces))


def _begins(traces: Traces, with_these: Traces) -> bool:
    last = len(with_these) - 1
    if traces[last] is not with_these[last]:
        return False
    return all(a is b for a, b in zip(traces, with_these, strict=False))


def _keep(found: Joined, instead: Joined | None = None) -> Joined:
    others = [known for known in _kept if known is not instead]
    _kept[:] = [found, *others][:KEPT]
    return found


class _Part:
    """The samples of one vehicle while they are collected."""

    def __init__(self, known: Seen) -> None:
        self._known = known
        self._last = known.recorded.time[-1] if known.recorded.time else float("-inf")
        self._time: list[float] = []
        self._position: list[tuple[float, float]] = []
        self._heading: list[float] = []
        self._speed: list[float] = []
        self._lights = list(known.lights)
        self._hidden = list(known.hidden)
        self._assumed = dict.fromkeys(known.assumed)

    def add(self, trace: PlanTrace, vehicle: int, track: Track) -> None:
        """Add the samples of a decision that those before it lack."""
        self._add_lights(trace, vehicle, track)
        since = trace.unseen.get(vehicle)
        if since is not None and trace.sim_time > since + EPSILON:
            if self._hidden and self._hidden[-1][0] == since:
                self._hidden.pop()
            self._hidden.append((since, trace.sim_time))
        for span in track.assumed:
            if since is None or span[1] < trace.sim_time - EPSILON:
                self._assumed[span] = None
        first, count = 0, len(track.speed)
        if self._last >= track.start - SAMPLE_PERIOD / 2.0:
            first = int((self._last - track.start) / SAMPLE_PERIOD + 0.5 + EPSILON) + 1
        if first >= count:
            return
        self._time += [round(track.start + k * SAMPLE_PERIOD, 3) for k in range(first, count)]
        self._position += track.position[first:]
        self._heading += track.heading[first:]
        self._speed += track.speed[first:]
        self._last = self._time[-1]

    def _add_lights(self, trace: PlanTrace, vehicle: int, track: Track) -> None:
        changes: Sequence[LightChange] = track.lights
        if not changes and vehicle in trace.scene and (vehicle == EGO or not trace.road):
            changes = (LightChange(trace.sim_time, trace.scene[vehicle].signals),)
        for change in changes:
            last = self._lights[-1] if self._lights else None
            fresh = last is None or change.time > last.time + EPSILON
            if fresh and (last is None or last.shown != change.shown):
                self._lights.append(change)

    def seen(self) -> Seen:
        """Return all that is known of the vehicle now."""
        motion = self._known.recorded
        if self._time:
            motion = Motion(
                motion.time + tuple(self._time),
                motion.position + tuple(self._position),
                tuple(motion.heading) + tuple(self._heading),
                motion.speed + tuple(self._speed),
            )
        assumed = tuple(self._assumed)
        return Seen(motion, tuple(self._lights), tuple(self._hidden), assumed)
