"""A decision planned again with lights or views supposed: the plan, and whether it saves time."""

import itertools
import math
from typing import Final

from planner.record.trace import PlanTrace
from xavi_dialogue.causal.model import Intervention
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.explain.causes.plans.contrast import factual
from xavi_dialogue.explain.causes.vehicles.course import lines
from xavi_dialogue.explain.history.ride import Ride, Unanswered

LEAST: Final = 0.5  # [s] minimum gain in reward of a plan that counts as better
FURTHER: Final = 5.0  # [m] minimum distance by which it leads further, about a place in a queue


def replanned(ride: Ride, trace: PlanTrace, need: NeedRollout) -> PlanTrace | None:
    """Find the plan made again from a decision with what is supposed of lights and views.

    None if the planner could not make it.

    Raises:
        Unanswered: it must be made first.
    """
    for extra in ride.record.extra:
        same = (extra.sim_time, extra.decision) == (trace.sim_time, trace.decision)
        tried = extra.what_if
        if same and tried and (tried.lights, tried.seen_past) == (need.lights, need.seen_past):
            return extra
    if ride.cannot_have(need):
        return None
    raise Unanswered(need)


def saves_time(ride: Ride, trace: PlanTrace, again: PlanTrace | None) -> bool | None:
    """Check whether a plan made again is better by LEAST or more; None if that is not known."""
    if again is None:
        return None
    try:
        here = factual(ride.model(trace), trace)
        there = factual(ride.model(again), again)
    except Unanswered:
        return None
    return there.value - here.value >= LEAST


def gets_further(ride: Ride, trace: PlanTrace, again: PlanTrace) -> bool:
    """Check whether a plan made again leads further within the time that is looked ahead.

    So it may save time that no rollout is long enough to show.
    """
    try:
        here = _driven(trace, factual(ride.model(trace), trace))
        there = _driven(again, factual(ride.model(again), again))
    except Unanswered:
        return False
    return here is not None and there is not None and there - here >= FURTHER


def _driven(trace: PlanTrace, plan: Intervention) -> float | None:
    """Return how far [m] rollouts of a plan that run out of time lead, in the mean.

    None if no line of them is recorded.
    """
    known = lines(trace)
    found = [
        (sum(math.dist(a, b) for a, b in itertools.pairwise(known[index].position)), weight)
        for result, weight in zip(plan.results, plan.weights, strict=True)
        if (index := result.rollout.index) in known and result.rollout.outcome == "termination"
    ]
    mass = sum(weight for _, weight in found)
    return sum(far * weight for far, weight in found) / mass if mass > 0.0 else None
