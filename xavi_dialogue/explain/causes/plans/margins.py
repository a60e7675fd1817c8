"""Margins: by how much the chosen first action was better than the next best one."""

from collections.abc import Sequence

from planner.record.trace import ACTIONS, Action, PlanTrace, Rollout


def rival(trace: PlanTrace) -> Action | None:
    """Return the next best first action; None if the decision did not weigh several."""
    tried = weighed(trace)
    if not trace.plan or len(tried) < 2 or trace.plan[0].action not in tried:
        return None
    others = [action for action in tried if action != trace.plan[0].action]
    return max(others, key=lambda one: (value(tried[one]), -ACTIONS.index(one)))


def margin(trace: PlanTrace) -> tuple[Action, float] | None:
    """Return the next best first action, and by how much [s] the chosen one was better.

    None if the decision did not weigh several.
    """
    other = rival(trace)
    if other is None:
        return None
    tried = weighed(trace)
    return other, value(tried[trace.plan[0].action]) - value(tried[other])


def weighed(trace: PlanTrace) -> dict[Action, list[Rollout]]:
    """Return the rollouts that compare the first actions, by first action."""
    found: dict[Action, list[Rollout]] = {}
    for one in trace.rollouts:
        if one.weight is not None and one.actions:
            found.setdefault(one.actions[0].action, []).append(one)
    return found


def value(rollouts: Sequence[Rollout]) -> float:
    """Return the expected reward [s] over the situations that were tried."""
    return sum((one.weight or 0.0) * one.reward for one in rollouts)
