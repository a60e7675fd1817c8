"""Decisions: by how much the chosen action was better than the next best one."""

from collections.abc import Sequence

from planner.record.trace import ACTIONS, Action, PlanTrace, Rollout
from planner.search.comparison import standard_error
from xavi_dialogue.audit.values import Choice


def choices(traces: Sequence[PlanTrace]) -> tuple[Choice, ...]:
    """Return the decisions that weighed several first actions, oldest first."""
    found = (choice(trace) for trace in traces)
    return tuple(one for one in found if one is not None)


def choice(trace: PlanTrace) -> Choice | None:
    """Return the margin of a decision; None if it did not weigh several first actions."""
    tried = weighed(trace)
    if not trace.plan or len(tried) < 2 or trace.plan[0].action not in tried:
        return None
    chosen = trace.plan[0].action
    others = [action for action in tried if action != chosen]
    rival = max(others, key=lambda one: (value(tried[one]), -ACTIONS.index(one)))
    ours, theirs = tried[chosen], tried[rival]
    return Choice(
        at=trace.sim_time,
        trace_id=trace.trace_id,
        chosen=chosen,
        rival=rival,
        margin=round(value(ours) - value(theirs), 3),
        error=round(_error(ours, theirs), 3),
    )


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


def _error(ours: Sequence[Rollout], theirs: Sequence[Rollout]) -> float:
    """Return the standard error [s] of the mean difference, as the planner reckons it.

    All first actions are driven with the same situations in the same order. Traces of other
    planners may not do so; then the errors of both means add up.
    """
    if [one.samples for one in ours] == [one.samples for one in theirs]:
        weights = [one.weight or 0.0 for one in ours]
        gains = [a.reward - b.reward for a, b in zip(ours, theirs, strict=True)]
        return standard_error(weights, gains)
    errors = (
        standard_error([one.weight or 0.0 for one in side], [one.reward for one in side])
        for side in (ours, theirs)
    )
    return float(sum(error**2 for error in errors) ** 0.5)
