"""The rollouts that a decision compared, by first action."""

from collections.abc import Sequence

from planner.record.trace import Action, PlanTrace, Rollout
from xavi_dialogue.causal.model import Intervention

Weighed = Sequence[tuple[Rollout, float]]  # rollouts with their weights


def compared(trace: PlanTrace) -> dict[Action, Weighed]:
    """Return the rollouts that the decision compared, by first action, with their weights."""
    found: dict[Action, list[tuple[Rollout, float]]] = {}
    for one in trace.rollouts:
        if one.weight is not None and one.actions:
            found.setdefault(one.actions[0].action, []).append((one, one.weight))
    return dict(found)


def weighed(trace: PlanTrace, plan: Intervention) -> Weighed:
    """Return the rollouts of a plan of a decision with their weights: every figure goes by these.

    They are those that the decision compared its first action by, so that an option has the same
    figures wherever it is shown; where it weighed nothing, those of the causal model.
    """
    own = compared(trace).get(plan.plan[0]) if plan.plan else None
    return own or [(r.rollout, w) for r, w in zip(plan.results, plan.weights, strict=True)]


def hits(rows: Weighed) -> dict[int, float]:
    """Return the share of weight of rollouts that collide with each other one, largest first."""
    mass = sum(weight for _, weight in rows)
    found: dict[int, float] = {}
    for one, weight in rows:
        if one.collided_with is not None:
            found[one.collided_with] = found.get(one.collided_with, 0.0) + weight
    if mass <= 0.0:
        return {}
    ranked = sorted(found.items(), key=lambda item: (-item[1], item[0]))
    return {vehicle: min(weight / mass, 1.0) for vehicle, weight in ranked}
