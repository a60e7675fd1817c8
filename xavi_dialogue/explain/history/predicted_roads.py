"""Predicted roads: the roads that others were expected to take, and those they took.

Later decisions record on which road a vehicle was seen. It went to the first of these roads that
is the road of one of its predicted goals and not the one it was on. A prediction is wrong if
another goal was more probable.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from planner.record.trace import Action, PlanTrace, VehiclePrediction


@dataclass(frozen=True, slots=True)
class Goals:
    """The goals of a prediction that end on the same road."""

    edge: str
    place: str
    probability: float
    kind: Action  # the macro action that ends at it


@dataclass(frozen=True, slots=True)
class Wrong:
    """One decision that expected a vehicle elsewhere than it went."""

    trace: PlanTrace
    vehicle: int
    expected: Goals
    truth: Goals
    came_at: float  # [s]


def wrong_predictions(traces: Sequence[PlanTrace]) -> list[Wrong]:
    """List the predictions that turned out wrong, decision by decision."""
    found = []
    for k, trace in enumerate(traces):
        for prediction in trace.predictions:
            goals = _goals(prediction)
            came = _came(trace, prediction.vehicle, goals, traces[k + 1 :])
            if came is None:
                continue
            truth, at = came
            best = max(goals.values(), key=lambda goal: goal.probability)
            if best.probability > truth.probability:
                found.append(Wrong(trace, prediction.vehicle, best, truth, at))
    return found


def _goals(prediction: VehiclePrediction) -> dict[str, Goals]:
    """Return the goals of a vehicle by road."""
    found: dict[str, Goals] = {}
    for goal in prediction.goals:
        if goal.edge is not None and goal.kind != "cross":
            before = found.get(goal.edge)
            place = goal.place if before is None else before.place
            chance = goal.probability + (0.0 if before is None else before.probability)
            kind = goal.kind if before is None else before.kind
            found[goal.edge] = Goals(goal.edge, place, chance, kind)
    return found


def _came(
    trace: PlanTrace, vehicle: int, goals: dict[str, Goals], later: Sequence[PlanTrace]
) -> tuple[Goals, float] | None:
    """Return the goal that a vehicle reached, and when [s] it was seen there; None: unknown."""
    here = _edge(trace, vehicle)
    for one in later:
        edge = _edge(one, vehicle)
        if edge is not None and edge != here and edge in goals:
            return goals[edge], one.sim_time
    return None


def _edge(trace: PlanTrace, vehicle: int) -> str | None:
    if trace.road is None or vehicle not in trace.road.places:
        return None
    return trace.road.places[vehicle].edge


def turn_to(traces: Sequence[PlanTrace], vehicle: int, edge: str, before: float) -> Action | None:
    """Return the kind of the goal by which a vehicle was to come to a road; None if unknown.

    Args:
        traces: the decisions.
        vehicle: whose way it is.
        edge: the road.
        before: [s] when it came into the junction.
    """
    for trace in reversed(traces):
        if trace.sim_time <= before and _edge(trace, vehicle) is not None:
            known = (p for p in trace.predictions if p.vehicle == vehicle)
            goals = [g for p in known for g in p.goals if g.edge == edge]
            return next((g.kind for g in goals), None)
    return None
