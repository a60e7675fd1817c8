"""Nearing: distances of the last decision, and speeds, as of the time that is asked about.

A decision records how far junctions and the destination are from where it was taken. The distance
driven since is subtracted. Speeds are those at the time, since positions and speeds are recorded
between decisions, too.
"""

from collections.abc import Iterable

import numpy as np
from msgspec.structs import replace

from planner.record.places import RouteStep
from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.explain.history.thresholds import BROKEN

PASSED = -2.0  # [m] distance to a junction's entry below which it lies behind us


def driven(motion: Motion, begin: float, end: float) -> float:
    """Return the distance [m] driven between two times [s], also between samples."""
    if not motion.time:
        return 0.0
    first, last = np.interp((begin, end), motion.arrays[0], motion.arc)
    return max(float(last - first), 0.0)


def speed_at(ride: Ride, time: float, vehicle: int = EGO) -> float | None:
    """Return the speed [m/s] of a vehicle at a time [s], or when seen last; None: never seen."""
    motion = ride.motion(vehicle)
    k = motion.index(time)
    if k is None:
        return None
    if k + 1 == len(motion.time) or motion.time[k + 1] - motion.time[k] > BROKEN:
        return motion.speed[k]
    return float(np.interp(time, motion.time[k : k + 2], motion.speed[k : k + 2]))


def tellable(deed: Episode | None, moment: float) -> float:
    """Return the time [s] whose speeds explain an episode: `moment`, while it goes on.

    A vehicle that slows down for another has reached its speed at the end, so that counts for
    slowing down. Otherwise it is the begin.
    """
    if deed is None or deed.end is None:
        return moment
    return deed.end if deed.action in ("slow-down", "brake") else deed.begin


def with_speeds(ride: Ride, causes: Iterable[MotionCause], time: float) -> tuple[MotionCause, ...]:
    """Add to causes the speeds [m/s] of their vehicles at a time [s]."""
    return tuple(
        cause
        if cause.vehicle is None or (speed := speed_at(ride, time, cause.vehicle)) is None
        else replace(cause, speed=speed)
        for cause in causes
    )


def with_lowest(
    ride: Ride, causes: Iterable[MotionCause], begin: float, end: float
) -> tuple[MotionCause, ...]:
    """Add to causes the lowest speeds [m/s] of their vehicles between two times [s]."""
    found = []
    for cause in causes:
        motion = None if cause.vehicle is None else ride.motion(cause.vehicle)
        seen = [] if motion is None else [motion.speed[k] for k in motion.within(begin, end)]
        found.append(replace(cause, speed=min(seen)) if seen else cause)
    return tuple(found)


def still_to(ride: Ride, distance: float, time: float) -> float:
    """Return how far [m] it is at a time [s] to a place that the last decision had at a distance.

    It is negative if the place lies behind us by then.
    """
    trace = ride.at(time)
    return distance - (0.0 if trace is None else driven(ride.motion(EGO), trace.sim_time, time))


def junctions_ahead(ride: Ride, time: float) -> tuple[RouteStep, ...]:
    """List the junctions on our way at a time [s], nearest first, without those passed by then.

    Their distances [m] are from where we are at that time. A decision whose plan does not lead to
    the destination records no way there; then an earlier decision gives the way.
    """
    trace = ride.at(time)
    if trace is None or trace.road is None:
        return ()
    on_way = [t for t in ride.traces if t.sim_time <= time and _knows_way(t)]
    trace = trace if _knows_way(trace) or not on_way else on_way[-1]
    way = driven(ride.motion(EGO), trace.sim_time, time)
    route = () if trace.road is None else trace.road.route
    left = [(step, step.distance - way) for step in route]
    return tuple(replace(step, distance=max(m, 0.0)) for step, m in left if m > PASSED)


def _knows_way(trace: PlanTrace) -> bool:
    """Check whether a decision has recorded how far the destination is."""
    return trace.road is not None and trace.road.distance is not None


def to_destination(ride: Ride, time: float) -> float | None:
    """Return how far [m] along the road the destination is at a time [s]; None: not recorded."""
    trace = ride.at(time)
    if trace is None or trace.road is None or trace.road.distance is None:
        return None
    return max(still_to(ride, trace.road.distance, time), 0.0)
