"""Moments: which moment of a ride a report is about.

Errors:

    UsageFault
    └── ReportError   there is no such moment; the message says which there are
"""

import math

from planner.record.events import Event
from sim.scene import EGO
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.thresholds import CLOSE, HARD, MOVING
from xavi_dialogue.process.clock_time import seconds_of
from xavi_dialogue.process.exit_status import UsageFault
from xavi_dialogue.report.content import Chosen
from xavi_dialogue.report.figures import Figure, Source, rounded
from xavi_dialogue.report.ridden import Ridden
from xavi_dialogue.report.road_users.tracks import Tracks

NAMES = {
    "collision": "collision",
    "the collision": "collision",
    "hardest braking": "hardest-braking",
    "the hardest braking": "hardest-braking",
    "closest approach": "closest-approach",
    "the closest approach": "closest-approach",
    "red light": "red-light",
    "the red light": "red-light",
}
OFFERED = "a time [s or m:ss], collision, hardest braking, closest approach, red light"


class ReportError(UsageFault):
    """A report that cannot be made."""


def choose(ridden: Ridden, tracks: Tracks, at: float | str | None) -> Chosen:
    """Return the moment that is asked for; by default, the most remarkable one.

    That is a collision, else hard braking, else an approach nearer than CLOSE, else the hardest
    braking that there was, else the closest approach, else the end.

    Raises:
        ReportError: there is no such moment in the ride.
    """
    if at is None:
        return _remarkable(ridden, tracks)
    if isinstance(at, str):
        kind = NAMES.get(at.strip().lower().replace("-", " "))
        if kind is not None:
            found = _named(kind, ridden, tracks, at)
            if found is None:
                raise ReportError(f"the ride has no {kind.replace('-', ' ')}; give {OFFERED}")
            return found
    time = seconds_of(at)
    if time is None:
        raise ReportError(f"{at!r} names no moment; give {OFFERED}")
    if not ridden.begin <= time <= ridden.end:
        told = f"the ride has no moment {time:g} s"
        raise ReportError(f"{told}; give one from {ridden.begin:g} to {ridden.end:g}")
    return Chosen("time", time, str(at), _speeds(tracks, time))


def _remarkable(ridden: Ridden, tracks: Tracks) -> Chosen:
    """Return the most remarkable moment."""
    crash = _collision(ridden, tracks, "")
    if crash is not None:
        return crash
    braking = _braking(tracks, "")
    if braking is not None and braking.figures["deceleration"].value >= HARD:
        return braking
    near = _approach(ridden, tracks, "")
    if near is not None and near.figures["gap"].value < CLOSE:
        return near
    found = braking or near
    if found is not None:
        return found
    return Chosen("time", ridden.end, "", _speeds(tracks, ridden.end))


def _named(kind: str, ridden: Ridden, tracks: Tracks, asked: str) -> Chosen | None:
    match kind:
        case "collision":
            return _collision(ridden, tracks, asked)
        case "hardest-braking":
            return _braking(tracks, asked)
        case "closest-approach":
            return _approach(ridden, tracks, asked)
    return _red_light(ridden, tracks, asked)


def _collision(ridden: Ridden, tracks: Tracks, asked: str) -> Chosen | None:
    """Return the first collision."""
    number, event = _first(ridden, "collided")
    if event is None:
        return None
    time = event.sim_time
    known = {"time": Figure(time, "s", Source("event", "sim_time", number, time))}
    return Chosen("collision", time, asked, known | _speeds(tracks, time), event.vehicle)


def _red_light(ridden: Ridden, tracks: Tracks, asked: str) -> Chosen | None:
    """Return the first stop at a light."""
    number, event = _first(ridden, "stopped-at-light")
    if event is None:
        return None
    time = event.sim_time
    known = {"time": Figure(time, "s", Source("event", "sim_time", number, time))}
    return Chosen("red-light", time, asked, known | _speeds(tracks, time))


def _first(ridden: Ridden, kind: str) -> tuple[int, Event | None]:
    events = enumerate(ridden.record.events)
    return next(((k, event) for k, event in events if event.kind == kind), (0, None))


def _braking(tracks: Tracks, asked: str) -> Chosen | None:
    """Return the hardest braking of the car."""
    motion = tracks.motion(EGO)
    if len(motion.time) < 3:
        return None
    k = min(range(1, len(motion.time) - 1), key=lambda j: (motion.rate[j], j))
    if motion.rate[k] >= 0.0:
        return None
    time = motion.time[k]
    return Chosen("hardest-braking", time, asked, {"deceleration": deceleration(tracks, motion, k),
                  **_speeds(tracks, time)})  # fmt: skip


def deceleration(tracks: Tracks, motion: Motion, k: int) -> Figure:
    """Return how hard [m/s2] the car brakes at a sample of its motion."""
    apart = motion.time[min(k + 1, len(motion.time) - 1)] - motion.time[max(k - 1, 0)]
    how = f"change of speed over {apart:.1f} s around {motion.time[k]:.1f} s"
    return Figure(rounded(-motion.rate[k]), "m/s2", tracks.source("speed", EGO, how=how))


def _approach(ridden: Ridden, tracks: Tracks, asked: str) -> Chosen | None:
    """Return the closest approach of another road user while the car moves."""
    ours, best = tracks.motion(EGO), (math.inf, 0.0, -1)
    moving = [t for t, speed in zip(ours.time, ours.speed, strict=True) if speed >= MOVING]
    for vehicle in tracks.motions:
        if vehicle == EGO:
            continue
        for time in moving:
            state, here = tracks.state(vehicle, time), tracks.state(EGO, time)
            if state is None or here is None:
                continue
            if math.dist(state.position, here.position) - state.length - here.length > best[0]:
                continue
            gap = tracks.gap(vehicle, time)
            if gap is not None and (gap, time, vehicle) < best:
                best = (gap, time, vehicle)
    gap, time, vehicle = best
    if vehicle < 0:
        return None
    figure = Figure(rounded(gap), "m", tracks.source("position", EGO, vehicle, how="of bodies"))
    return Chosen("closest-approach", time, asked, {"gap": figure} | _speeds(tracks, time), vehicle)


def _speeds(tracks: Tracks, time: float) -> dict[str, Figure]:
    """Return the speed [m/s] of the car at a time, if it is known."""
    state = tracks.state(EGO, time)
    if state is None:
        return {}
    how = f"at {time:g} s"
    return {"speed": Figure(rounded(state.speed), "m/s", tracks.source("speed", EGO, how=how))}
