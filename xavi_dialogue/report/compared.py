"""The rollouts that a decision compared, by first action."""

from collections.abc import Sequence

from planner.record.trace import Action, PlanTrace, Rollout

Weighed = Sequence[tuple[Rollout, float]]  # rollouts with their weights


def compared(trace: PlanTrace) -> dict[Action, Weighed]:
    """Return the rollouts that the decision compared, by first action, with their weights."""
    found: dict[Action, list[tuple[Rollout, float]]] = {}
    for one in trace.rollouts:
        if one.weight is not None and one.actions:
            found.setdefault(one.actions[0].action, []).append((one, one.weight))
    return dict(found)


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
