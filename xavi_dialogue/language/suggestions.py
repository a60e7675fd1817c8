"""Suggestions: which questions an answer or the situation invites."""

from collections.abc import Iterable

from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.context import SpeechContext

_PLAN = Query(type="what", tense="future")
_GOAL = Query(type="where_goal", tense="present")
_SURE = Query(type="confidence", tense="present")


def follow_ups(
    query: Query, found: Explanation, named: tuple[int, ...], asked: tuple[Query, ...] = ()
) -> tuple[Query, ...]:
    """Questions that an answer invites: about the vehicles it names, then about the plan.

    Those that repeat this question, or one `asked` before it, are left out.
    """
    invited: list[Query] = []
    for number in named[:1]:
        actor = f"vehicle:{number}"
        if found.causes:
            invited.append(Query(type="what_if", actor=actor, negated=True, intervention="remove"))
        invited.append(Query(type="where_goal", actor=actor, tense="present"))
    invited += [_PLAN, _GOAL, _SURE]
    return fresh(invited, (query, *asked))


def from_situation(context: SpeechContext) -> tuple[Query, ...]:
    """Questions that can be asked at any time: about the last manoeuvre, others, and the plan.

    Those that have been asked are left out, and those to which there is no answer now.
    """
    invited: list[Query] = []
    if context.done:
        invited.append(Query(type="why", factual=context.done[-1:]))
    invited += [
        Query(type="what", actor=f"vehicle:{number}", tense="present")
        for number in sorted(context.vehicles)[:1]
    ]
    return answerable(fresh((*invited, _PLAN, _GOAL, _SURE), context.asked), context)


def about_vehicle(query: Query, context: SpeechContext) -> tuple[Query, ...]:
    """What can be asked about the vehicle of a question, where it is in view."""
    _, _, number = query.actor.partition(":")
    if not number.isdecimal() or int(number) not in context.vehicles:
        return ()
    asked = Query(type="what", actor=query.actor, tense="present")
    return fresh((asked,), context.asked)


def answerable(offered: Iterable[Query], context: SpeechContext) -> tuple[Query, ...]:
    """The questions to which there is an answer now."""
    return tuple(query for query in offered if query not in context.closed)


def fresh(offered: Iterable[Query], asked: tuple[Query, ...]) -> tuple[Query, ...]:
    """The questions that repeat none of those asked."""
    return tuple(q for q in offered if not any(_repeats(q, other) for other in asked))


def _repeats(offered: Query, asked: Query) -> bool:
    """Whether a question is asked already, if only in passing: with a contrast, or as "that"."""
    if (offered.type, offered.actor) != (asked.type, asked.actor):
        return False
    if offered.type == "what" and offered.tense != asked.tense:
        return False
    if (offered.tense == "future") != (asked.tense == "future"):
        return False
    if offered.type in ("what_if", "why_not", "compare"):
        return offered.counterfactual == asked.counterfactual
    return asked.factual in (None, offered.factual)
