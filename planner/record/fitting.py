"""Fitting: a trace within its bounds, without the lines that it has no room for."""

from collections.abc import Collection
from typing import TypeAlias

import msgspec

from planner.record.places import LightChange
from planner.record.trace import (
    ROOM,
    SAMPLE_PERIOD,
    GoalPrediction,
    PlanTrace,
    Track,
    TrajectoryPrediction,
    VehiclePrediction,
    encode,
)
from sim.scene import EGO

RECENT = 11  # samples of the history of who is not predicted: what came before is in older traces
IMPROBABLE = (0.1, 0.2, 0.35, 0.5)  # probabilities up to which predicted lines are dropped first

_Place: TypeAlias = tuple[int, int, int]  # vehicle, index of a goal, index of a trajectory


def fitted(trace: PlanTrace) -> PlanTrace:
    """Return the trace without the lines that it has no room for.

    Where it is larger than ROOM, the histories of those who are not predicted shrink to
    RECENT samples; then the less probable predictions lose path, speed and who
    holds them up, then the rollouts recorded last lose path and speed, then all predictions do;
    what rollouts came to, and why, always stays, even if that alone is larger than ROOM.
    """
    excess = len(encode(trace)) - ROOM
    if excess <= 0:
        return trace
    shorter = _without_past(trace)
    excess -= _size(trace.history) - _size(shorter.history)
    trace, lines = shorter, _lines(trace)
    for below in IMPROBABLE:
        if excess > 0:
            dropped = {place: size for place, (chance, size) in lines.items() if chance <= below}
            trace, excess = _without_lines(trace, dropped), excess - sum(dropped.values())
            lines = {place: line for place, line in lines.items() if place not in dropped}
    if excess <= 0:
        return trace
    rollouts = list(trace.rollouts)
    for k in range(len(rollouts) - 1, -1, -1):
        path, speed = rollouts[k].path, rollouts[k].speed
        if excess > 0 and path is not None:
            excess -= _size(path) + _size(speed) - 2 * _size(None)
            rollouts[k] = msgspec.structs.replace(rollouts[k], path=None, speed=None)
    trace = msgspec.structs.replace(trace, rollouts=tuple(rollouts))
    return trace if excess <= 0 else _without_lines(trace, lines)


def _size(part: object) -> int:
    """Return how many bytes a part of a trace takes."""
    return len(msgspec.json.encode(part))


def _without_past(trace: PlanTrace) -> PlanTrace:
    """Return the trace with the latest samples alone of those who are not predicted."""
    kept = {EGO, *(known.vehicle for known in trace.predictions)}
    history = {
        name: track if name in kept else _recent(track) for name, track in trace.history.items()
    }
    return msgspec.structs.replace(trace, history=history)


def _recent(track: Track) -> Track:
    """Return the latest samples of a track, with the lights shown since."""
    left_out = max(len(track.speed) - RECENT, 0)
    if left_out == 0:
        return track
    start = round(track.start + left_out * SAMPLE_PERIOD, 3)
    before = [change for change in track.lights if change.time <= start + 1e-3]
    since = tuple(change for change in track.lights if change.time > start + 1e-3)
    shown = (LightChange(start, before[-1].shown),) if before else ()
    return Track(
        start,
        track.position[-RECENT:],
        track.heading[-RECENT:],
        track.speed[-RECENT:],
        (*shown, *since),
        tuple(span for span in track.assumed if span[1] > start),
    )


def _lines(trace: PlanTrace) -> dict[_Place, tuple[float, int]]:
    """Return the probability of each predicted trajectory, and the bytes of its lines."""
    return {
        (known.vehicle, g, w): (
            goal.probability * way.probability,
            _size(way) - _size(_bare(way)),
        )
        for known in trace.predictions
        for g, goal in enumerate(known.goals)
        for w, way in enumerate(goal.trajectories)
    }


def _without_lines(trace: PlanTrace, dropped: Collection[_Place]) -> PlanTrace:
    """Return the trace without the lines of some predicted trajectories."""

    def stripped(vehicle: int, g: int, goal: GoalPrediction) -> GoalPrediction:
        ways = (
            _bare(way) if (vehicle, g, w) in dropped else way
            for w, way in enumerate(goal.trajectories)
        )
        return msgspec.structs.replace(goal, trajectories=tuple(ways))

    predictions = tuple(
        VehiclePrediction(
            known.vehicle,
            tuple(stripped(known.vehicle, g, goal) for g, goal in enumerate(known.goals)),
        )
        for known in trace.predictions
    )
    return msgspec.structs.replace(trace, predictions=predictions)


def _bare(way: TrajectoryPrediction) -> TrajectoryPrediction:
    return msgspec.structs.replace(way, path=(), speed=(), held_up=())
