"""Comparisons: which of two courses is better, as query fields."""

from xavi_dialogue.domain.meaning import Compare
from xavi_dialogue.domain.terms import Compares, Ego, Happens, Measured, Pronoun, That
from xavi_dialogue.nlu.projection.fields import QueryFields
from xavi_dialogue.nlu.projection.propositions import PROPOSITIONS, subject
from xavi_dialogue.nlu.projection.terms import actor_of, event_actions, plain, tense_of

#: What tells that one course is better than another.
_MERITS = frozenset(("value", "duration", "time-to-go", "delay", "comfort", "cost"))


def compared(that: Compares) -> QueryFields:
    """Project the comparison of an event with another: quicker, safer than."""
    left = that.left.event
    right = that.right.event if isinstance(that.right, Measured) else None
    if left is None:
        return QueryFields(type="compare", tense=plain(that.left.tense))
    unreal = left.modal in ("would", "could", "should")
    return QueryFields(
        type="compare",
        actor=actor_of(left.actor),
        factual=event_actions(right) if unreal else event_actions(left),
        counterfactual=event_actions(left) if unreal else event_actions(right),
        tense=plain(that.left.tense),
    )


def of_choices(that: Compares) -> bool:
    """Tell whether it compares what was or might have been done, rather than how things are."""
    spoken_of = isinstance(that.left.thing, Pronoun)
    if that.left.attribute == "delay" and isinstance(that.left.thing, Ego):
        return True
    return that.left.event is not None or (spoken_of and that.left.attribute in _MERITS)


def compare(question: Compare) -> QueryFields:
    """Project the question which of two is better."""
    events = [one.event for one in question.options if isinstance(one, Happens)]
    if That() in question.options or not question.options:
        others = [event_actions(event) for event in events]
        return QueryFields(type="compare", counterfactual=others[0] if others else None)
    if not events:
        option = question.options[0] if question.options else Ego()
        named = subject(option) if isinstance(option, PROPOSITIONS) else option
        return QueryFields(type="what", actor=actor_of(named), tense="present")
    first, rest = events[0], events[1:]
    unreal = first.modal in ("would", "could", "should", "might")
    other = event_actions(rest[0]) if rest else None
    return QueryFields(
        type="compare",
        actor=actor_of(first.actor),
        factual=other if unreal else event_actions(first),
        counterfactual=event_actions(first) if unreal else other,
        tense=tense_of(first),
    )
