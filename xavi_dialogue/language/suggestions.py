"""Suggestions: which questions an answer or the situation invites."""

from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.context import SpeechContext

_PLAN = Query(type="what", tense="future")
_GOAL = Query(type="where_goal", tense="present")


def follow_ups(query: Query, found: Explanation, named: tuple[int, ...]) -> tuple[Query, ...]:
    """Questions that an answer invites: about the vehicles it names, then about the plan."""
    invited: list[Query] = []
    for number in named[:1]:
        actor = f"vehicle:{number}"
        if found.causes:
            invited.append(Query(type="what_if", actor=actor, negated=True, intervention="remove"))
        invited.append(Query(type="where_goal", actor=actor, tense="present"))
    invited += [_PLAN, _GOAL]
    return tuple(q for q in invited if (q.type, q.actor) != (query.type, query.actor))


def from_situation(context: SpeechContext) -> tuple[Query, ...]:
    """Questions that can be asked at any time: about the last manoeuvre, others, and the plan."""
    invited: list[Query] = []
    if context.done:
        invited.append(Query(type="why", factual=context.done[-1:]))
    invited += [
        Query(type="what", actor=f"vehicle:{number}", tense="present")
        for number in sorted(context.vehicles)[:1]
    ]
    return (*invited, _PLAN, _GOAL)
