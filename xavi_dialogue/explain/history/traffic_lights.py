"""Traffic lights: what each showed over a ride, and when the ego passed its line.

A light is one place of a controller. Decisions record every change of it that was seen; the newest
scene adds what came since. What was out of view is not known, and is not filled in.
"""

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from planner.record.light_record import UNSEEN
from planner.record.places import LightAhead, RoadFacts, RouteStep, Rule
from sim.scene import EGO, LightState, Signal
from xavi_dialogue.explain.history.nearing import driven, speed_at
from xavi_dialogue.explain.history.ride import ROUNDING, Ride
from xavi_dialogue.explain.history.thresholds import STALE

SAME_PLACE = 3.0  # [m] maximum difference of the distances of a junction and its light
REACHED = 1.5  # [m] from a line at which a light that is no longer ahead counts as passed


@dataclass(frozen=True, slots=True)
class Stretch:
    """A time over which a light was seen to show one thing."""

    state: str  # a letter; see sim.scene.LightState
    begin: float  # [s]
    end: float  # [s] up to which it is known to have shown that
    begun: bool  # it was seen to change to it
    changed: bool  # it was seen to change to something else at the end


@dataclass(frozen=True, slots=True)
class Passing:
    """A moment at which the ego's front passed the line of a light."""

    signal: Signal
    time: float  # [s]
    speed: float  # [m/s]
    shown: Stretch | None  # what it showed then; None if that was not seen


def stretches(ride: Ride, signal: Signal) -> tuple[Stretch, ...]:
    """List what a light was seen to show, oldest first."""
    key = f"light {signal.controller} {signal.index}"
    found = ride.notes.get(key)
    if not isinstance(found, tuple):
        found = ride.notes[key] = tuple(_joined(ride, signal))
    return found


def shown(ride: Ride, signal: Signal, time: float) -> Stretch | None:
    """Find what a light showed at a time [s]; None if it was not seen then."""
    known = stretches(ride, signal)
    k = bisect_right([one.begin for one in known], time + ROUNDING) - 1
    if k < 0:
        return None
    one = known[k]
    slack = STALE if one is known[-1] else ROUNDING  # the last one goes on until the next decision
    within = time < one.end - ROUNDING if one.changed else time <= one.end + slack
    return one if within else None


def _joined(ride: Ride, signal: Signal) -> Iterator[Stretch]:
    changes = sorted(_changes(ride, signal).items())
    known = _known(ride, signal)
    letter, begin, begun = UNSEEN, 0.0, False
    for time, now in changes:
        if now == letter:
            continue
        if letter != UNSEEN:
            end = _last(known, time) if now == UNSEEN else time
            yield Stretch(letter, begin, max(end, begin), begun, now != UNSEEN)
        letter, begin, begun = now, time, letter != UNSEEN
    if letter != UNSEEN:
        yield Stretch(letter, begin, max(_last(known, ride.now), begin), begun, False)


def _changes(ride: Ride, signal: Signal) -> dict[float, str]:
    """Return the letters that a light changed to, by time [s]; UNSEEN when it went out of view."""
    found: dict[float, str] = {}
    for trace in ride.traces:
        for light in trace.lights:
            if light.controller == signal.controller and signal.index in light.places:
                at = light.places.index(signal.index)
                found |= {change.time: change.states[at] for change in light.seen}
    scene = ride.scene
    light_now = None if scene is None else scene.light(signal)
    if light_now is not None:
        found[light_now.since] = light_now.state.value
    return found


def _known(ride: Ride, signal: Signal) -> list[float]:
    """Return the times [s] of decisions and the newest scene that saw a light."""
    found = [
        trace.sim_time
        for trace in ride.traces
        for light in trace.lights
        if light.controller == signal.controller and light.state(signal.index) != UNSEEN
    ]
    scene = ride.scene
    if scene is not None and scene.light(signal) is not None:
        found.append(scene.time)
    return found


def _last(known: list[float], time: float) -> float:
    """Return the last of some times [s] up to another one."""
    return max((one for one in known if one <= time + ROUNDING), default=0.0)


def ahead(ride: Ride, time: float) -> tuple[LightAhead, ...]:
    """List the lights on our way, nearest first, with their distances at a time [s]."""
    trace = ride.at(time)
    if trace is None or trace.road is None:
        return ()
    way = driven(ride.motion(EGO), trace.sim_time, time)
    return tuple(
        LightAhead(
            max(one.distance - way, 0.0), one.controller, one.place, one.state, one.since,
            one.change_seen,
        )
        for one in trace.road.lights
        if one.distance > way - ROUNDING
    )  # fmt: skip


def at_step(road: RoadFacts, step: RouteStep) -> LightAhead | None:
    """Return the light in view of a junction on our way; None if there is none."""
    return next((x for x in road.lights if abs(x.distance - step.distance) < SAME_PLACE), None)


def rule_at(road: RoadFacts, step: RouteStep) -> Rule:
    """Return the rule for us at a junction: a light by which all others stop overrides signs."""
    light = at_step(road, step)
    return "priority" if light is not None and light.state == LightState.GREEN.value else step.rule


def passings(ride: Ride) -> tuple[Passing, ...]:
    """List the lines of lights that we passed, oldest first."""
    found = ride.notes.get("light passings")
    if not isinstance(found, tuple):
        found = ride.notes["light passings"] = tuple(_passings(ride))
    return found


def _passings(ride: Ride) -> Iterator[Passing]:
    for k, trace in enumerate(ride.traces):
        first = None if trace.road is None else next(iter(trace.road.lights), None)
        if first is None:
            continue
        after = next(iter(ride.traces[k + 1 : k + 2]), None)
        left = () if after is None or after.road is None else after.road.lights[:1]
        if any(_same(first, one) for one in left):
            continue
        until = ride.now if after is None else after.sim_time
        slack = 0.0 if after is None else REACHED
        time = _reached(ride, (trace.sim_time, until), first.distance, slack)
        if time is None:
            continue
        signal = Signal(first.controller, first.place)
        speed = speed_at(ride, time)
        yield Passing(signal, time, 0.0 if speed is None else speed, shown(ride, signal, time))


def _same(one: LightAhead, other: LightAhead) -> bool:
    return (one.controller, one.place) == (other.controller, other.place)


def _reached(
    ride: Ride, window: tuple[float, float], distance: float, slack: float
) -> float | None:
    """Return when [s] in a window the ego had driven a distance [m]; None: it had not."""
    motion, (begin, end) = ride.motion(EGO), window
    if driven(motion, begin, end) < distance - slack or not motion.time:
        return None
    start = float(np.interp(begin, motion.arrays[0], motion.arc))
    inside = motion.within(begin, end)
    arcs = [float(motion.arc[k]) - start for k in inside]
    times = [motion.time[k] for k in inside]
    if not times:
        return None
    return round(float(np.interp(distance, arcs, times)), 2)
