"""Waits at traffic lights: who is held at a light, and when, by the decisions of the ride.

For the ego, the rollouts count that do not stop of their own accord. For another vehicle, its
predicted ways count; such waits are never sure.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from planner.record.light_record import HeldByLight
from planner.record.trace import PlanTrace
from sim.scene import EGO, Signal
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Feature
from xavi_dialogue.explain.facts.actions import named
from xavi_dialogue.explain.history.kept import of_decision
from xavi_dialogue.explain.history.ride import ROUNDING, Ride, prediction
from xavi_dialogue.explain.history.thresholds import AT_ONCE, HELD_UP, STALE

LIGHT = Feature("light")


@dataclass(frozen=True, slots=True)
class Hold:
    """A stretch of decisions at which a light held somebody."""

    signal: Signal
    begin: float  # [s]
    end: float  # [s] of the last of these decisions
    goes_on: bool  # it is the last decision of the record
    share: float  # of the rollouts or ways at the first of them in which it does


def held_at(trace: PlanTrace, vehicle: int) -> tuple[Signal, float] | None:
    """Find the light that holds a vehicle at a decision, and the probability that it does."""
    return of_decision(trace, ("held by light", vehicle), lambda: _held_at(trace, vehicle))


def _held_at(trace: PlanTrace, vehicle: int) -> tuple[Signal, float] | None:
    found: dict[tuple[str, int], float] = {}
    for weight, holds in _ego(trace) if vehicle == EGO else _other(trace, vehicle):
        for light in {
            (h.controller, h.place) for h in holds if h.since <= trace.sim_time + AT_ONCE
        }:
            found[light] = found.get(light, 0.0) + weight
    if not found:
        return None
    (controller, place), share = max(found.items(), key=lambda item: item[1])
    return Signal(controller, place), share


def _ego(trace: PlanTrace) -> Iterator[tuple[float, tuple[HeldByLight, ...]]]:
    way = next((step.action for step in trace.plan if step.action != "stop"), None)
    drives = [r for r in trace.rollouts if r.actions and r.actions[0].action == way]
    weighed = any(drive.weight for drive in drives)
    weights = [(drive.weight or 0.0) if weighed else 1.0 for drive in drives]
    total = sum(weights)
    for weight, drive in zip(weights, drives, strict=True):
        yield weight / total, drive.held_by_lights


def _other(trace: PlanTrace, vehicle: int) -> Iterator[tuple[float, tuple[HeldByLight, ...]]]:
    known = prediction(trace, vehicle)
    for goal in () if known is None else known.goals:
        for way in goal.trajectories:
            yield goal.probability * way.probability, way.held_by_lights


def holds(ride: Ride, vehicle: int) -> tuple[Hold, ...]:
    """List the times at which lights held a vehicle, oldest first."""
    key = f"held by lights {vehicle}"
    found = ride.notes.get(key)
    if not isinstance(found, tuple):
        found = ride.notes[key] = tuple(_holds(ride, vehicle))
    return found


def _holds(ride: Ride, vehicle: int) -> Iterator[Hold]:
    run: Hold | None = None
    for k, trace in enumerate(ride.traces):
        if not trace.lights and run is None:
            continue
        last = k + 1 == len(ride.traces) and ride.now - trace.sim_time <= STALE
        found = held_at(trace, vehicle)
        held = found is not None and found[1] >= HELD_UP
        if run is not None and (not held or found is None or found[0] != run.signal):
            yield run
            run = None
        if held and found is not None:
            begin = trace.sim_time if run is None else run.begin
            share = found[1] if run is None else run.share
            run = Hold(found[0], begin, trace.sim_time, last, share)
    if run is not None:
        yield run


def holding(ride: Ride, vehicle: int, begin: float, end: float, slack: float = 1.0) -> Hold | None:
    """Find the light that held a vehicle between two times [s]; the last, if several did."""
    found = [
        one
        for one in holds(ride, vehicle)
        if one.begin <= end + slack and (one.goes_on or one.end >= begin - slack)
    ]
    return found[-1] if found else None


def held_then(ride: Ride, time: float) -> bool:
    """Check whether a light held the ego at a time [s]."""
    return holding(ride, EGO, time, time, slack=0.0) is not None


def facing(ride: Ride, vehicle: int, time: float) -> Signal | None:
    """Find the light that holds another vehicle at a time [s]; None if none is known to."""
    trace = ride.at(time, vehicle)
    if trace is None or time - trace.sim_time > STALE:
        return None
    found = held_at(trace, vehicle)
    return None if found is None or found[1] < HELD_UP else found[0]


def waits_at_lights(ride: Ride, vehicle: int, stood: Iterable[Episode]) -> Iterator[Episode]:
    """Yield the parts of standstills in which a light held a vehicle."""
    for still in stood:
        end = ride.now if still.end is None else still.end
        for hold in holds(ride, vehicle):
            over = end if hold.goes_on else min(hold.end + 1.0, end)
            if hold.begin > end + ROUNDING or over < still.begin:
                continue
            begin = max(still.begin, hold.begin)
            until = still.end if over >= end - ROUNDING else over
            if until is not None and until - begin < AT_ONCE:
                continue
            yield Episode(
                named(vehicle), "wait", begin, until, LIGHT, speed_to=0.0, standing=True,
                sure=vehicle == EGO,
            )  # fmt: skip
