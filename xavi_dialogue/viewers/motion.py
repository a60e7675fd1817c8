"""The scenes of a ride, close enough in time to be watched."""

import math
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

from planner.record.trace import SAMPLE_PERIOD, PlanTrace, Track
from sim.scene import PersonState, Scene, VehicleState
from xavi_dialogue.library.ride import Ride

SPARSE = 0.35  # [s] between scenes; where they are farther apart, others are put in between
MOST = 0.09  # [s] least time between two scenes that are shown: ten a second and a little more
SLACK = 1e-6  # [s]


def scenes(ride: Ride) -> Iterator[Scene]:
    """Yield the scenes of a ride in order of time, at most about ten a second.

    Where they are far apart, as in a saved ride, which has one for each decision, others are put in
    between: decisions hold where everybody was, five times a second.
    """
    traces = [one.trace for one in ride.decisions]
    last = -math.inf
    for scene in _filled(ride.scenes, traces):
        if scene.time - last >= MOST or scene is ride.scenes[-1]:
            last = scene.time
            yield scene


def _filled(told: Sequence[Scene], traces: Sequence[PlanTrace]) -> Iterator[Scene]:
    times = [trace.sim_time for trace in traces]
    for here, there in pairwise(told):
        yield here
        steps = round((there.time - here.time) / SAMPLE_PERIOD)
        for step in range(1, steps) if there.time - here.time > SPARSE else ():
            time = here.time + step * (there.time - here.time) / steps
            index = bisect_left(times, time - SLACK)
            if index < len(traces) and (vehicles := _vehicles(traces[index], time)):
                yield replace(
                    here, time=time, vehicles=vehicles, people=_people(here, there, step / steps)
                )
    yield from told[-1:]


def _vehicles(trace: PlanTrace, time: float) -> Mapping[int, VehicleState]:
    """Return the vehicles at a time [s] as a later decision remembers them."""
    seen = {who: _remembered(trace, who, time) for who in trace.scene}
    return {who: state for who, state in seen.items() if state is not None}


def _remembered(trace: PlanTrace, who: int, time: float) -> VehicleState | None:
    track = trace.history.get(who)
    index = None if track is None else _index(track, time)
    if track is None or index is None:
        return None
    return replace(
        trace.scene[who],
        position=track.position[index],
        heading=track.heading[index],
        speed=track.speed[index],
    )


def _index(track: Track, time: float) -> int | None:
    index = round((time - track.start) / SAMPLE_PERIOD)
    return index if 0 <= index < len(track.position) else None


def _people(here: Scene, there: Scene, share: float) -> Mapping[int, PersonState]:
    """Return the people who are in both scenes, at a share of the time between them."""
    result = {}
    for who, state in here.people.items():
        if (later := there.people.get(who)) is not None:
            (x, y), (u, v) = state.position, later.position
            result[who] = replace(state, position=(x + share * (u - x), y + share * (v - y)))
    return result
