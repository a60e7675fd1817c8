"""Mediated causes: vehicles that make another one wait for them, or pull out to pass them.

What they made the other vehicle do cannot be undone at later decisions. So they are removed at the
first recent decision that predicted it (mediation: Pearl 2009, Causality, 4.5).
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence

from planner.record.trace import PlanTrace, TrajectoryPrediction
from sim.scene import EGO, VehicleState
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES
from xavi_dialogue.explain.history.ride import Ride, prediction

EARLIER = 8.0  # [s] before the decision that is explained, in which a wait is looked for ...
MOVED = 12.0  # ... and a change of lanes, which stays done
SHARE = 0.25  # minimum probability of what counts as predicted
MOSTLY = 0.75  # minimum share of the decisions, from first to last, that predicted it
LATELY = 2.5  # [s] maximum time since the last decision that predicted a wait
REACH = 80.0  # [m] ahead of a vehicle, in which another may make it leave its lane
TRIED = 2  # maximum number of vehicles that are tried


def holders(ride: Ride, decision: PlanTrace, vehicle: int) -> Mapping[int, PlanTrace]:
    """Find who has recently made a vehicle wait or pull out.

    Args:
        ride: the record.
        decision: the decision that is explained.
        vehicle: the vehicle that waits or pulls out.

    Returns:
        By holder, the first decision that predicted this; those predicted most often come first.
    """
    now = decision.sim_time
    recent = [t for t in ride.traces if now - MOVED <= t.sim_time <= now]
    recent = [t for t in recent if vehicle in t.scene and t.under_way is None]
    waits = _foreseen([t for t in recent if t.sim_time >= now - EARLIER], vehicle, _held)
    waits = {holder: at for holder, at in waits.items() if at[-1].sim_time >= now - LATELY}
    moved = [t for t in recent if _lane(t, vehicle) != _lane(decision, vehicle)]
    if not moved and leaves(decision, vehicle) >= SHARE:
        moved = recent  # it is only about to do so
    found = {**_foreseen(moved, vehicle, _passed), **waits}
    ranked = sorted(found, key=lambda holder: (-len(found[holder]), holder))
    return {holder: found[holder][0] for holder in ranked[:TRIED]}


def _foreseen(
    recent: Sequence[PlanTrace],
    vehicle: int,
    look: Callable[[PlanTrace, int], Mapping[int, float]],
) -> dict[int, list[PlanTrace]]:
    """Return, by holder, the decisions that predicted it, if nearly all in between did, too."""
    seen: dict[int, list[int]] = {}
    for k, trace in enumerate(recent):
        for holder, share in look(trace, vehicle).items():
            if share >= SHARE:
                seen.setdefault(holder, []).append(k)
    return {
        holder: [recent[k] for k in at]
        for holder, at in seen.items()
        if len(at) >= MOSTLY * (at[-1] - at[0] + 1)
    }


def _held(trace: PlanTrace, vehicle: int) -> dict[int, float]:
    """Return who is predicted to hold a vehicle up, and how probably, except for the ego."""
    found: dict[int, float] = {}
    for way, share in _ways(trace, vehicle):
        for holder in {held.vehicle for held in way.held_up} - {EGO}:
            found[holder] = found.get(holder, 0.0) + share
    return found


def _passed(trace: PlanTrace, vehicle: int) -> dict[int, float]:
    """Return the nearest ahead in the lane that a vehicle is predicted to leave, with how probably.

    Nobody, if the vehicle is not predicted to leave its lane.
    """
    lane = _lane(trace, vehicle)
    share = leaves(trace, vehicle)
    if lane is None or share <= 0.0:
        return {}
    gaps = {
        other: math.dist(state.position, trace.scene[vehicle].position)
        for other, state in trace.scene.items()
        if other not in (EGO, vehicle)
        and _lane(trace, other) == lane
        and _is_ahead(trace.scene[vehicle], state)
    }
    nearest = min(gaps, key=lambda other: gaps[other], default=None)
    return {} if nearest is None or gaps[nearest] > REACH else {nearest: share}


def leaves(trace: PlanTrace, vehicle: int) -> float:
    """Return the predicted probability that a vehicle leaves its lane next."""
    return sum(p for way, p in _ways(trace, vehicle) if set(way.actions[:1]) & set(CHANGES))


def _ways(trace: PlanTrace, vehicle: int) -> Iterator[tuple[TrajectoryPrediction, float]]:
    """Yield the predicted ways of a vehicle, with their probabilities."""
    known = prediction(trace, vehicle)
    for goal in () if known is None else known.goals:
        for way in goal.trajectories:
            yield way, goal.probability * way.probability


def _lane(trace: PlanTrace, vehicle: int) -> tuple[str, int | None] | None:
    place = None if trace.road is None else trace.road.places.get(vehicle)
    return None if place is None else (place.edge, place.lane)


def _is_ahead(one: VehicleState, other: VehicleState) -> bool:
    """Check whether another is ahead of a vehicle, along its heading."""
    dx, dy = (b - a for a, b in zip(one.position, other.position, strict=True))
    return dx * math.cos(one.heading) + dy * math.sin(one.heading) > 0.0
