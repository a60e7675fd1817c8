"""Simulations: how many a decision ran and how they ended, and how many options it had."""

from collections import Counter
from collections.abc import Mapping
from typing import Final

from planner.record.trace import OUTCOMES, Outcome, PlanTrace
from xavi_dialogue.domain.answers import Answer, Evidence, NotRecorded, Options, Simulations
from xavi_dialogue.domain.terms import Event, Happens, Measured, Unsaid
from xavi_dialogue.domain.vocabulary import MACRO_ACTIONS, ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import window
from xavi_dialogue.explain.causes.plans.options import of_trace
from xavi_dialogue.explain.causes.vehicles.actions import names_of
from xavi_dialogue.explain.facts.plans import last_choice

#: How a simulation ends, by what is said to happen in it.
_ENDS: Final[Mapping[ActionName, Outcome]] = {"collide": "collision", "arrive": "done"}


def simulations(of: Measured, asked: Asked) -> Answer:
    """Return how many simulations a decision ran, of which option, and how they ended.

    Raises:
        Unanswered: the record holds no decision.
    """
    trace = _decision(of, asked)
    option = of.about.event if isinstance(of.about, Happens) else None
    begun = [r for r in trace.rollouts if r.actions]
    names = () if option is None else names_of(option)
    runs = begun if option is None else [r for r in begun if r.actions[0].action in names]
    named = next((name for name in MACRO_ACTIONS if name in names), None)
    first = next((run.actions[0].action for run in runs), named)
    ends = Counter(run.outcome for run in runs)
    struck = Counter(run.collided_with for run in runs if run.collided_with is not None)
    ended = _ENDS.get(of.event.action) if isinstance(of.event, Event) else None
    return Simulations(
        trace.sim_time,
        len(runs),
        tuple((outcome, ends[outcome]) for outcome in OUTCOMES if ends[outcome]),
        Evidence("tree", len(runs), traces=(trace.trace_id,)),
        asked=ended,
        of=None if option is None else first,
        struck=tuple(struck.most_common()),
        options=len({run.actions[0].action for run in begun}),
        apart=of.event is not None and ended is None,
    )


def options(of: Measured, asked: Asked) -> Answer:
    """Return how many options a decision had, and which.

    Raises:
        Unanswered: the record holds no decision.
    """
    trace = _decision(of, asked)
    earlier = trace is not last_choice(asked.ride, asked.now)
    evidence = Evidence("tree", traces=(trace.trace_id,))
    known = of_trace(asked.ride, trace)
    return Options(known, trace.sim_time, evidence, earlier=earlier, counted=True)


def _decision(of: Measured, asked: Asked) -> PlanTrace:
    """Find the decision that is meant: that of the time or deed spoken of, else the last one."""
    told = not isinstance(of.time, Unsaid) or asked.past is not None
    about = window(asked, of.time, of.tense)
    whole = about.begin <= asked.world.begin and about.end >= asked.now
    at = about.begin if told and not whole else asked.now
    trace = last_choice(asked.ride, at)
    if trace is None or not trace.rollouts:
        raise Unanswered(NotRecorded("not-recorded", about=of.attribute, since=at))
    return trace
