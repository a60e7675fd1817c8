"""Wavering: why a plan was given up and resumed, by its risk each time."""

from itertools import pairwise
from typing import Final

from msgspec import structs

from planner.record.trace import Action, PlanTrace
from xavi_dialogue.domain.answers import Answer, DidNotHappen, Wavered
from xavi_dialogue.domain.journeys import AbandonedPlan
from xavi_dialogue.domain.meaning import Why
from xavi_dialogue.domain.terms import Ego, Happens
from xavi_dialogue.explain.answers.events.decisions import last_change, why_changed
from xavi_dialogue.explain.answers.propositions import reasons
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import Window, window
from xavi_dialogue.explain.answers.reference.reading import unwrapped
from xavi_dialogue.explain.causes.plans.options import of_trace
from xavi_dialogue.explain.history.ride import planned

BACK: Final = 20.0  # [s] to which "each time" reaches back if no time is named
RISKY: Final = 0.05  # minimum risk of a collision that counts as the reason for giving up a plan


def wavered(question: Why, asked: Asked) -> Answer:
    """Return why we changed our mind: what made us give up a plan, each time.

    Raises:
        Unanswered: the record does not hold it, or rollouts are needed.
    """
    of, _ = unwrapped(question.of)
    assert isinstance(of, Happens)
    about = window(asked, of.event.time)
    if about.instant or about.end >= asked.now - 1.0:
        about = Window(max(about.end, asked.now) - BACK, asked.now)
    near = [t for t in asked.ride.traces if about.begin <= t.sim_time <= about.end]
    given = [
        (plan, turn)
        for before, after in pairwise(near)
        if (plan := _given_up(before, after)) is not None
        and (turn := _turn(asked, after, plan)) is not None
    ]
    if not given:
        found = last_change(asked, asked.world.begin)
        if found is None:
            if asked.world.episodes(Ego(), ("change-plan",), asked.world.begin, asked.now):
                return reasons.why(question, asked)
            raise Unanswered(DidNotHappen(of.event))
        return structs.replace(found, reason=why_changed(asked, found))
    plan = given[-1][0]
    turns = tuple(turn for given_up, turn in given if given_up == plan)
    later = [t for t in near if t.sim_time > turns[-1].time]
    return Wavered(plan, turns, any(planned(t)[:1] == (plan,) for t in later))


def _given_up(before: PlanTrace, after: PlanTrace) -> Action | None:
    """Return the first step of a plan that was given up for a stop."""
    old, new = planned(before)[:1], planned(after)[:1]
    return old[0] if new == ("stop",) and old and old != new else None


def _turn(asked: Asked, trace: PlanTrace, plan: Action) -> AbandonedPlan | None:
    """Return the risk of a plan at a decision; None if the risk was not the reason."""
    found = next((o for o in of_trace(asked.ride, trace) if o.action == plan), None)
    if found is None or found.collision < RISKY:
        return None
    return AbandonedPlan(trace.sim_time, found.collision, found.collided_with)
