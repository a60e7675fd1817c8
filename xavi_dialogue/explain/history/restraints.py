"""Restraints: what kept the ego from driving faster, and when, as its driving recorded it."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import msgspec

from planner.record.events import SETTLED, LightPlace, RestraintKind
from sim.scene import EGO
from xavi_dialogue.explain.history.ride import Ride

SHARE = 0.3  # minimum share of the speed lost, or of the time, of what is stated as a reason


@dataclass(frozen=True, slots=True)
class Restraint:
    """Who or what keeps the ego from driving faster."""

    by: RestraintKind
    vehicle: int | None = None
    light: LightPlace | None = None


@dataclass(frozen=True, slots=True)
class Restrained:
    """A stretch of time in which one restraint was in force."""

    restraint: Restraint
    begin: float  # [s]
    end: float  # [s]


def restraints(ride: Ride) -> Iterator[Restrained]:
    """Yield the restraints of a ride, oldest first; none if its record has no such events."""
    told = [event for event in ride.events if event.kind == "restrained"]
    ends = (*(event.sim_time - SETTLED for event in told), math.inf)
    for event, end in zip(told, ends[1:], strict=True):
        if event.by is not msgspec.UNSET:
            light = None if event.light is msgspec.UNSET else event.light
            found = Restraint(event.by, event.vehicle, light)
            yield Restrained(found, event.sim_time - SETTLED, end)


def restraint_at(ride: Ride, time: float) -> Restraint | None:
    """Return the restraint in force at a time [s]; None if none is recorded."""
    return next((r.restraint for r in restraints(ride) if r.begin <= time < r.end), None)


def held_by(ride: Ride, vehicle: int, begin: float, end: float) -> list[Restrained]:
    """List when the ego had to let a road user go first between two times [s], oldest first."""
    return [
        one
        for one in restraints(ride)
        if one.begin <= end and one.end >= begin
        if one.restraint.by == "right-of-way" and one.restraint.vehicle == vehicle
    ]


def lasted(ride: Ride, begin: float, end: float) -> dict[Restraint, float]:
    """Return for how long [s] each restraint was in force between two times [s]."""
    found: dict[Restraint, float] = {}
    for one in restraints(ride):
        span = min(one.end, end) - max(one.begin, begin)
        if span > 0.0:
            found[one.restraint] = found.get(one.restraint, 0.0) + span
    return found


def slowed(ride: Ride, begin: float, end: float) -> dict[Restraint, float]:
    """Return the speed [m/s] that each restraint took from the ego between two times [s]."""
    motion = ride.motion(EGO)
    samples = [(motion.time[k], motion.speed[k]) for k in motion.within(begin, end)]
    found: dict[Restraint, float] = {}
    for one in restraints(ride):
        for (time, speed), (after, then) in pairwise(samples):
            if one.begin <= (time + after) / 2.0 < one.end and then < speed:
                found[one.restraint] = found.get(one.restraint, 0.0) + speed - then
    return found


def slowed_for(ride: Ride, begin: float, end: float) -> dict[int, Restraint]:
    """Return who took much of the speed that the ego lost between two times [s], and how."""
    lost = {one: v for one, v in slowed(ride, begin, end).items() if one.by != "nothing"}
    least = SHARE * sum(lost.values())
    return {
        one.vehicle: one
        for one in sorted(lost, key=lambda one: lost[one])
        if one.vehicle is not None and lost[one] >= least
    }
