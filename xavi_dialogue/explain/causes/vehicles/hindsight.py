"""Hindsight: plans weighted by what the others turned out to do.

What an action depended on is a question about what happened, not about what was thought possible.
So rollouts are weighted by where the others went, as far as the record knows by now. This is the
road that a vehicle took, else the last belief about the same goals.
"""

from dataclasses import replace

from planner.record.trace import GoalPrediction, PlanTrace
from xavi_dialogue.causal.model import CausalModel, Intervention
from xavi_dialogue.explain.history.ride import Ride, prediction

LEAST = 0.01  # minimum believed probability of a goal that is corrected
KEPT = 0.02  # minimum share of the weight that must remain


def in_hindsight(ride: Ride, model: CausalModel, plan: Intervention) -> Intervention:
    """Weight the results of a plan by what the others did since; unchanged if too few fit."""
    factors = {v: _factors(ride, model.trace, v) for v in model.vehicles}
    weights = []
    for result, weight in zip(plan.results, plan.weights, strict=True):
        for vehicle, goal, _ in result.joint:
            weight *= factors.get(vehicle, {}).get(goal, 1.0)
        weights.append(weight)
    mass = sum(weights)
    if mass < KEPT:
        return plan
    return replace(plan, weights=tuple(weight / mass for weight in weights))


def _factors(ride: Ride, trace: PlanTrace, vehicle: int) -> dict[int, float]:
    """Return the factor by which each goal is more probable than was believed; {}: not known."""
    then = prediction(trace, vehicle)
    if then is None:
        return {}
    now = {_name(goal): goal.probability for goal in then.goals}
    names = [_name(goal) for goal in then.goals]
    for later in ride.traces:
        if later.sim_time <= trace.sim_time:
            continue
        place = None if later.road is None else later.road.places.get(vehicle)
        taken = [name for name in names if place is not None and name[1] == place.edge]
        if taken:
            now = {name: float(name in taken) for name in names}
            break
        known = prediction(later, vehicle)
        found = {} if known is None else {_name(g): g.probability for g in known.goals}
        if sum(found.get(name, 0.0) for name in names) > 0.5:
            now = {name: found.get(name, 0.0) for name in names}
    return {
        k: now[_name(goal)] / goal.probability
        for k, goal in enumerate(then.goals)
        if goal.probability >= LEAST
    }


def _name(goal: GoalPrediction) -> tuple[str, str | None]:
    return goal.kind, goal.edge
