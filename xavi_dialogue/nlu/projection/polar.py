"""Polar questions as query fields: whether, and couldn't you have."""

from typing import Any

from xavi_dialogue.domain.meaning import HowSure, Whether
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import (
    Caused,
    Compares,
    Described,
    Happens,
    Has,
    Is,
    Measured,
    Not,
    Proposition,
    Thing,
)
from xavi_dialogue.nlu.projection.comparisons import compared, of_choices
from xavi_dialogue.nlu.projection.fields import FieldTense, QueryFields
from xavi_dialogue.nlu.projection.propositions import PROPOSITIONS, subject, tense
from xavi_dialogue.nlu.projection.terms import (
    actions_of,
    actor_of,
    event_actions,
    events_of,
    is_beyond,
)

_VERDICTS = {"allowed": "legality", "at-fault": "blame"}
_UNSEEN = frozenset(("pedestrian", "emergency"))


def whether(question: Whether) -> QueryFields:
    """Project whether something holds."""
    that = question.that.content if isinstance(question.that, Not) else question.that
    unreal = _unreal(question.that)
    if unreal is not None:
        return unreal
    if isinstance(that, Caused):
        cause = that.cause
        named = None if isinstance(cause, PROPOSITIONS) else actor_of(cause)
        return QueryFields(
            type="why",
            actor=actor_of(subject(that.effect)),
            factual=actions_of(that.effect),
            tense=tense(that.effect),
            hypothesised_cause=named,
        )
    if isinstance(that, Is) and that.state in _VERDICTS:
        return declined(_VERDICTS[that.state], tense(that))
    if _of_weather(that):
        return declined("unsupported-condition", tense(that))
    if any(d.kind in _UNSEEN for d in parts(that, Described)):
        return declined("perception", tense(that))
    if isinstance(that, Compares) and of_choices(that):
        return compared(that)
    if isinstance(that, Is) and that.state == "sure":
        return how_sure(HowSure())
    if isinstance(that, Is) and that.event is not None and that.state in ("better", "worth-it"):
        return QueryFields(type="compare", factual=event_actions(that.event), tense=tense(that))
    return what_fields(subject(that), tense(that), actions_of(that), beyond=_beyond(that))


def _of_weather(that: Proposition) -> bool:
    has = any(one.attribute == "weather" for one in parts(that, Has))
    return has or any(one.attribute == "weather" for one in parts(that, Measured))


def _unreal(that: Proposition) -> QueryFields | None:
    """Project "couldn't you have waited", "could you have turned", "would it have stopped"."""
    inner = that.content if isinstance(that, Not) else that
    actions = actions_of(inner)
    if not isinstance(inner, Happens) or actions is None or tense(inner) != "past":
        return None
    actor, modal = actor_of(inner.event.actor), inner.event.modal
    if isinstance(that, Not) and modal in ("could", "should", "might"):
        return QueryFields(type="why_not", actor=actor, counterfactual=actions)
    if modal == "could":
        return QueryFields(type="what_if", actor=actor, counterfactual=actions)
    if modal == "would":
        return QueryFields(type="sensitivity", actor=actor, factual=actions)
    return None


def what_fields(
    thing: Thing | None, when: FieldTense, actions: Any, beyond: bool = False
) -> QueryFields:
    """Project what is or is done, or that it is none of our actions."""
    if beyond:
        return declined("not-an-action", when)
    return QueryFields(type="what", actor=actor_of(thing), factual=actions, tense=when)


def declined(reason: str, when: FieldTense = "present") -> QueryFields:
    """Return the fields of what the car does not speak of."""
    return QueryFields(type="out_of_scope", tense=when, reason=reason)


def _beyond(that: Proposition) -> bool:
    return any(is_beyond(event) for event in events_of(that))


def how_sure(question: HowSure) -> QueryFields:
    """Project how sure we are of something."""
    of = question.of
    return QueryFields(
        type="confidence",
        actor=actor_of(subject(of)),
        factual=actions_of(of),
        tense=foreseen(of),
    )


def foreseen(of: Proposition | None) -> FieldTense:
    """Tell when it was to happen: what he would do is yet to come."""
    open_ = any(event.modal == "would" for event in events_of(of))
    return "future" if open_ else tense(of)
