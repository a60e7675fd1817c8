"""Decisions: by how much the chosen action was better than the next best one."""

from collections.abc import Sequence

from planner.record.trace import PlanTrace, Rollout
from planner.search.comparison import standard_error
from xavi_dialogue.audit.values import Choice
from xavi_dialogue.explain.causes.plans.margins import rival, value, weighed


def choices(traces: Sequence[PlanTrace]) -> tuple[Choice, ...]:
    """Return the decisions that weighed several first actions, oldest first."""
    found = (choice(trace) for trace in traces)
    return tuple(one for one in found if one is not None)


def choice(trace: PlanTrace) -> Choice | None:
    """Return the margin of a decision; None if it did not weigh several first actions."""
    other = rival(trace)
    if other is None:
        return None
    chosen, tried = trace.plan[0].action, weighed(trace)
    ours, theirs = tried[chosen], tried[other]
    return Choice(
        at=trace.sim_time,
        trace_id=trace.trace_id,
        chosen=chosen,
        rival=other,
        margin=round(value(ours) - value(theirs), 3),
        error=round(_error(ours, theirs), 3),
    )


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
