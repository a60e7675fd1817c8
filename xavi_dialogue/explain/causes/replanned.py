"""A decision planned again with lights or views supposed: the plan, and whether it saves time."""

from typing import Final

from planner.trace import PlanTrace
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.explain.causes.contrast import factual
from xavi_dialogue.explain.history.ride import Ride, Unanswered

LEAST: Final = 0.5  # [s] of reward from which a plan made again counts as better


def replanned(ride: Ride, trace: PlanTrace, need: NeedRollout) -> PlanTrace | None:
    """Find the plan made again from a decision with what is supposed of lights and views.

    None where the planner could not make it.

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
    """Tell whether a plan made again is better by at least LEAST; None where it is not known."""
    if again is None:
        return None
    try:
        here = factual(ride.model(trace), trace)
        there = factual(ride.model(again), again)
    except Unanswered:
        return None
    return there.value - here.value >= LEAST
