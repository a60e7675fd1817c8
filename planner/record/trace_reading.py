"""Reading of traces: from JSON, and the check of what a planner may not have written.

Traces come over the bus and from files, of any planner. Answers compute with their figures and
say their texts, so both are checked where they come in.
"""

from collections.abc import Iterable, Iterator
from typing import Final

import msgspec

from planner.errors import TraceError
from planner.record.foreign_text import unprintable
from planner.record.trace import LARGEST, MAX_BYTES, READABLE, PlanTrace, Rollout
from sim.scene import EGO

ROUNDING: Final = 1e-6  # by which a probability may exceed 1
LATEST: Final = 1e7  # [s] maximum of a simulation time, as on the bus
FARTHEST: Final = 1e8  # [m] maximum of a coordinate; no map projection exceeds it
FASTEST: Final = 1e3  # [m/s] maximum of a speed
MOST: Final = 2**53 - 1  # maximum of a vehicle's number; every language reads it exactly
HEAVIEST: Final = 1e9  # maximum of a weight
#: The least and the most of each setting: planning again with them ends in a bearable time.
SETTINGS: Final = (
    ("rollouts", 0.0, 10_000.0, ""),
    ("min_rollouts", 0.0, 10_000.0, ""),
    ("comparisons", 0.0, 10_000.0, ""),
    ("depth", 1.0, 100.0, ""),
    ("trees", 1.0, 64.0, ""),
    ("horizon", 1.0, 600.0, "s"),
    ("period", 0.0, LATEST, "s"),
    ("rationality", 0.0, 1e3, ""),
    ("view_radius", 0.0, FARTHEST, "m"),
)


def decode(data: bytes) -> PlanTrace:
    """Read a trace from JSON.

    Raises:
        TraceError: too large, not JSON, not of this schema, or a field is wrong.
    """
    if len(data) > MAX_BYTES:
        raise TraceError(f"trace of {len(data)} bytes; at most {MAX_BYTES} are accepted")
    try:
        strange = unprintable(data)
        if strange is not None:
            raise TraceError(f"not a plan trace: {strange}")
        trace = msgspec.json.decode(data, type=PlanTrace)
    except RecursionError as error:
        raise TraceError("not a plan trace: it is nested too deeply") from error
    except (msgspec.MsgspecError, UnicodeDecodeError) as error:
        raise TraceError(f"not a plan trace: {error}") from error
    check(trace)
    return trace


def check(trace: PlanTrace) -> None:
    """Check a trace.

    Raises:
        TraceError: it is of an unknown schema, or its fields contradict each other.
    """
    if trace.schema not in READABLE:
        known = " and ".join(repr(name) for name in READABLE)
        raise TraceError(f"trace schema is {trace.schema!r}; this version reads {known}")
    fault = fault_of(trace)
    if fault is not None:
        raise TraceError(f"not a plan trace: {fault}")


def fault_of(trace: PlanTrace) -> str | None:
    """Return the inconsistency in a trace, if any."""
    return next(_faults(trace), None)


def _faults(trace: PlanTrace) -> Iterator[str]:
    yield from _times(trace)
    yield from _figures(trace)
    yield from _seen(trace)
    yield from _chances(trace)
    yield from _lists(trace)
    yield from _drawn(trace)
    yield from _named(trace)


def _times(trace: PlanTrace) -> Iterator[str]:
    yield from _outside("sim_time", (trace.sim_time,), 0.0, LATEST, "s")
    for name, least, most, unit in SETTINGS:
        value = getattr(trace.settings, name)
        if value is not msgspec.UNSET:
            yield from _outside(f"settings.{name}", (value,), least, most, unit)


def _figures(trace: PlanTrace) -> Iterator[str]:
    for one in trace.rollouts:
        parts = (value for value in one.components.values() if value is not None)
        if not all(abs(value) <= LARGEST for value in (*parts, *one.terms.values(), one.reward)):
            yield f"rollout {one.index} has a figure that is none, or beyond {LARGEST:g}"
        weight = () if one.weight is None else (one.weight,)
        yield from _outside(f"rollouts.weight of rollout {one.index}", weight, 0.0, HEAVIEST)


def _seen(trace: PlanTrace) -> Iterator[str]:
    """Yield what is wrong with scene and history."""
    if EGO not in trace.scene:
        yield f"the ego, {EGO}, is missing in `scene`"
    for vehicle in trace.scene:
        if not EGO <= vehicle <= MOST:
            yield f"a vehicle in `scene` has a number that is not from {EGO} to {MOST}"
    for vehicle, track in trace.history.items():
        of = f"of vehicle {vehicle} in `history`"
        if not len(track.position) == len(track.heading) == len(track.speed) > 0:
            yield f"the history of vehicle {vehicle} has lists of different lengths, or is empty"
        for axis in zip(*track.position, strict=True):
            yield from _outside(f"position {of}", axis, -FARTHEST, FARTHEST, "m")
        yield from _outside(f"speed {of}", track.speed, -FASTEST, FASTEST, "m/s")
        yield from _outside(f"start {of}", (track.start,), -LATEST, LATEST, "s")
        for span in track.assumed:
            yield from _outside(f"time in `assumed` {of}", span, -LATEST, LATEST, "s")
            if span[0] > span[1]:
                yield f"a span in `assumed` {of} ends before it begins"


def _chances(trace: PlanTrace) -> Iterator[str]:
    """Yield probabilities that are none."""
    for known in trace.predictions:
        for k, goal in enumerate(known.goals):
            where = f"of goal {k} of vehicle {known.vehicle} in `predictions`"
            yield from _outside(f"probability {where}", (goal.probability,), 0.0, 1.0)
            yield from _outside(f"prior {where}", (goal.prior,), 0.0, 1.0)
            ways = tuple(way.probability for way in goal.trajectories)
            yield from _outside(f"probability of a trajectory {where}", ways, 0.0, 1.0)
    for light in trace.lights:
        courses = tuple(course.probability for course in light.courses)
        where = f"of a course of {light.controller!r} in `lights`"
        yield from _outside(f"probability {where}", courses, 0.0, 1.0)
    for k, phantom in enumerate(trace.phantoms):
        yield from _outside(f"probability of {k} in `phantoms`", (phantom.probability,), 0.0, 1.0)


def _lists(trace: PlanTrace) -> Iterator[str]:
    """Yield lists that are empty or do not belong together."""
    for known in trace.predictions:
        if not known.goals or not all(goal.trajectories for goal in known.goals):
            yield f"vehicle {known.vehicle} has no goal, or one with no trajectory"
        ways = (way for goal in known.goals for way in goal.trajectories)
        if not all(len(way.path) == len(way.speed) for way in ways):
            who = f"a trajectory of vehicle {known.vehicle}"
            yield f"{who} has a path and speeds of different lengths"
    indices = {one.index for one in trace.rollouts}
    if len(indices) < len(trace.rollouts):
        yield "two rollouts have the same index"
    for one in trace.rollouts:
        if one.same_as is not None and (one.same_as == one.index or one.same_as not in indices):
            yield f"rollout {one.index} has the line of rollout {one.same_as}, which has none"
        if len(one.path or ()) != len(one.speed or ()):
            yield f"rollout {one.index} has a path and speeds of different lengths"
    yield from (light.fault for light in trace.lights if light.fault is not None)
    placed = () if trace.road is None else trace.road.places.keys()
    told = () if trace.road is None else {fact.vehicle for fact in trace.road.priority}
    for vehicle in sorted({*placed, *told} - trace.scene.keys()):
        yield f"vehicle {vehicle} is on the road and not in the scene"


def _drawn(trace: PlanTrace) -> Iterator[str]:
    """Yield what rollouts draw that is not there."""
    ways = {one.vehicle: [len(g.trajectories) for g in one.goals] for one in trace.predictions}
    courses = {light.controller: len(light.courses) for light in trace.lights}
    hidden = {*range(len(trace.phantoms))}
    for one in trace.rollouts:
        for s in one.samples:
            counts = ways.get(s.vehicle, [])
            if not (0 <= s.goal < len(counts) and 0 <= s.trajectory < counts[s.goal]):
                yield f"rollout {one.index} samples what is not predicted"
        for drawn in one.lights:
            if not 0 <= drawn.course < courses.get(drawn.controller, 0):
                yield f"rollout {one.index} samples what is not predicted of a light"
        if not _imagined(one) <= hidden:
            yield f"rollout {one.index} names somebody who is not imagined"


def _named(trace: PlanTrace) -> Iterator[str]:
    """Yield where somebody is named who is not in the scene, which holds all that are seen."""
    others = trace.scene.keys() - {EGO}
    for known in trace.predictions:
        who = f"vehicle {known.vehicle} in `predictions`"
        if known.vehicle not in others:
            yield f"{who} is not another one in `scene`"
        ways = (way for goal in known.goals for way in goal.trajectories)
        if not {held.vehicle for way in ways for held in way.held_up} <= trace.scene.keys():
            yield f"`held_up` of {who} names a vehicle that is not in `scene`"
    for one in trace.rollouts:
        struck = set() if one.collided_with is None else {one.collided_with}
        held = {held.vehicle for held in one.held_up}
        for field, named in (("collided_with", struck), ("held_up", held)):
            for vehicle in sorted(named - others):
                of = f"`{field}` of rollout {one.index} names vehicle {vehicle}"
                yield f"{of}, which is not another one in `scene`"


def _imagined(rollout: Rollout) -> set[int]:
    return {
        *(drawn.phantom for drawn in rollout.phantoms),
        *(held.phantom for held in rollout.held_by_hidden),
    }


def _outside(
    what: str, values: Iterable[float], least: float, most: float, unit: str = ""
) -> Iterator[str]:
    """Yield the first of some values that is outside of a range, or none (NaN)."""
    for value in values:
        if not least - ROUNDING <= value <= most + ROUNDING:
            unit = f" {unit}" if unit else ""
            yield f"{what} is {value:.10g}; give {least:g} to {most:g}{unit}"
            return
