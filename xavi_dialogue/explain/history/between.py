"""What was seen between two decisions, from the tracks that the later one recorded."""

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import replace

from planner.record.light_record import UNSEEN, LightPrediction
from planner.record.trace import SAMPLE_PERIOD, PlanTrace, Track
from sim.roads.network import angle_between
from sim.scene import Light, LightState, Scene, Signal, VehicleState

ROUNDING = 1e-6  # [s]


def seen_last(kept: Scene | None, traces: Sequence[PlanTrace], now: float) -> Scene | None:
    """Return what was seen up to a time [s], if it is later than the last decision; else None.

    Args:
        kept: the newest scene that was kept, if any; it may be a little older.
        traces: the decisions of a ride, oldest first, maybe with later ones.
        now: [s]
    """
    since = max((t.sim_time for t in traces if t.sim_time <= now + ROUNDING), default=now)
    fresh = kept if kept is not None and since + ROUNDING < kept.time <= now + ROUNDING else None
    if fresh is not None and fresh.time >= now - ROUNDING:
        return fresh
    return seen_between(traces, now) or fresh


def seen_between(traces: Sequence[PlanTrace], time: float) -> Scene | None:
    """Return what was seen at a time [s] between two decisions, samples of tracks interpolated.

    As in traces, people on foot are among the vehicles. None: it is not between two decisions, or
    one between them is missing.

    Args:
        traces: the decisions of a ride, oldest first.
        time: [s] of what is seen.
    """
    last = bisect_right([trace.sim_time for trace in traces], time + ROUNDING) - 1
    if last < 0 or last + 1 >= len(traces):
        return None
    before, after = traces[last], traces[last + 1]
    apart = after.sim_time - before.sim_time
    missing = apart > before.settings.period + SAMPLE_PERIOD + ROUNDING
    if missing or time <= before.sim_time + ROUNDING:
        return None
    states = {v: _state(before, after, v, time) for v in sorted({*before.scene, *after.history})}
    vehicles = {vehicle: state for vehicle, state in states.items() if state is not None}
    return Scene(time, vehicles, tuple(_lights(before, after, time)))


def _state(before: PlanTrace, after: PlanTrace, vehicle: int, time: float) -> VehicleState | None:
    """Return the state of a road user at a time [s]; None if it was not seen."""
    track = after.history.get(vehicle)
    if track is None:
        if vehicle in before.unseen:
            return None
        return _gone_on(before.scene[vehicle], time - before.sim_time)
    hidden = after.unseen.get(vehicle, time) < time - ROUNDING
    if hidden or time < track.start - ROUNDING or _is_assumed(track, time):
        return None
    return _sampled(after.scene[vehicle], track, time)


def _is_assumed(track: Track, time: float) -> bool:
    """Check whether a track holds only an assumption for a time [s]."""
    return any(begin + ROUNDING < time < end - ROUNDING for begin, end in track.assumed)


def _sampled(later: VehicleState, track: Track, time: float) -> VehicleState:
    """Return the state of a road user at a time [s] within its track."""
    count = len(track.speed)
    if count == 1:
        return later
    at = max((time - track.start) / SAMPLE_PERIOD, 0.0)
    k = min(int(at + ROUNDING), count - 2)
    share = min(at - k, 1.0)
    (x, y), (x1, y1) = track.position[k], track.position[k + 1]
    speed, gained = track.speed[k], track.speed[k + 1] - track.speed[k]
    turned = angle_between(track.heading[k + 1], track.heading[k])
    return replace(
        later,
        position=(x + share * (x1 - x), y + share * (y1 - y)),
        heading=track.heading[k] + share * turned,
        speed=speed + share * gained,
        acceleration=gained / SAMPLE_PERIOD,
        signals=_shown(track, time),
    )


def _gone_on(state: VehicleState, elapsed: float) -> VehicleState:
    """Return the state of a road user that drove straight on for some time [s]."""
    way, (x, y) = state.speed * elapsed, state.position
    there = (x + way * math.cos(state.heading), y + way * math.sin(state.heading))
    return replace(state, position=there, acceleration=0.0)


def _shown(track: Track, time: float) -> tuple[str, ...]:
    """Return the lights that a vehicle showed at a time [s]."""
    known = [change.shown for change in track.lights if change.time <= time + ROUNDING]
    return known[-1] if known else ()


def _lights(before: PlanTrace, after: PlanTrace, time: float) -> list[Light]:
    """Return the traffic lights in view at a time [s]."""
    later = {light.controller: light for light in after.lights}
    found = []
    for light in before.lights:
        known = later.get(light.controller, light)
        for place in light.places:
            seen = _showing(known, place, time)
            if seen is not None:
                found.append(seen)
    return found


def _showing(light: LightPrediction, place: int, time: float) -> Light | None:
    """Return what one place of a controller showed at a time [s]; None if it was out of view."""
    if place not in light.places:
        return None
    at = light.places.index(place)
    seen = [(one.time, one.states[at]) for one in light.seen if one.time <= time + ROUNDING]
    if not seen or seen[-1][1] == UNSEEN:
        return None
    since, letter = seen.pop()
    while seen and seen[-1][1] == letter:
        since, _ = seen.pop()
    change_seen = bool(seen) and seen[-1][1] != UNSEEN
    return Light(Signal(light.controller, place), LightState(letter), since, change_seen)
