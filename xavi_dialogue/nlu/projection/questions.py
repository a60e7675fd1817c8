"""Questions: each type of question as query fields. One function for a family of types."""

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Changed,
    Compare,
    Doing,
    Fault,
    HowAvoid,
    HowDecide,
    HowKnow,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Identify,
    Listing,
    Peak,
    Question,
    Summarise,
    WhatIf,
    WhatWouldChange,
    When,
    Where,
    Whether,
    Which,
    Whither,
    Why,
)
from xavi_dialogue.domain.terms import (
    Ago,
    Believed,
    Caused,
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Measured,
    Not,
    Proposition,
    Start,
    Thing,
    Wanted,
)
from xavi_dialogue.nlu.grounding.rewriting import parts
from xavi_dialogue.nlu.projection.comparisons import compare, compared, of_choices
from xavi_dialogue.nlu.projection.fields import FieldTense, QueryFields, QueryType
from xavi_dialogue.nlu.projection.propositions import PROPOSITIONS, subject, tense
from xavi_dialogue.nlu.projection.terms import (
    actions_of,
    actor_of,
    denied_of,
    event_actions,
    events_of,
    is_beyond,
    is_open,
    plain,
    tense_of,
)

Projector: TypeAlias = Callable[[Any], QueryFields]
_TIMES = frozenset(("time-to-go", "arrival-time", "waiting-time", "duration"))
#: What tells which way somebody goes.
_WAYS = frozenset(("heading", "exit-number", "route", "turn"))
#: What is done on account of its object: whom one waits for is why one waits.
_CAUSED = frozenset(("wait", "stop", "brake", "slow-down"))
_OUTSIDE = {"law": "legality", "weather": "off-topic", "money": "off-topic",
            "world": "off-topic", "battery": "capability"}  # fmt: skip
_VERDICTS = {"allowed": "legality", "at-fault": "blame"}
#: What is listed as it is now.
_STANDING = frozenset(("vehicles", "options", "capabilities"))
_UNSEEN = frozenset(("pedestrian", "emergency"))


def question_fields(question: Question) -> QueryFields:
    """Project a question."""
    found = _PROJECTORS[type(question)](question)
    open_side = any(is_open(event) for event in parts(question, Event))
    if open_side and (found.factual or found.counterfactual):
        found = replace(found, underspecified="direction")
    return found


def _why(question: Why) -> QueryFields:
    of = question.of.content if isinstance(question.of, Believed) else question.of
    negated = isinstance(of, Not)
    said, other = actions_of(of), actions_of(question.instead)
    if any(is_beyond(event) for event in events_of(of)):
        return declined("not-an-action", tense(of))
    collision = any(event.action == "collide" for event in events_of(of))
    held = question.of.tense if isinstance(question.of, Believed) else None
    unreal = any(event.modal in ("could", "would") for event in events_of(of))
    return QueryFields(
        type="why_not" if negated else "why",
        actor=actor_of(subject(of)),
        factual=other if negated else said,
        counterfactual=said if negated else other,
        tense=plain(held) if held is not None else "past" if unreal else tense(of),
        event="collision" if collision else None,
        hypothesised_cause=None if question.suspect is None else actor_of(question.suspect),
    )


def _what_if(question: WhatIf) -> QueryFields:
    supposed, then = question.supposed, question.then
    negated = isinstance(supposed, Not)
    inner = supposed.content if isinstance(supposed, Not) else supposed
    if isinstance(then, Whether) and _still(then.that):
        return _sensitivity(then.that, inner)
    removed = isinstance(inner, Exists)
    when = "future" if then is not None and _ahead(then) else tense(inner)
    if isinstance(then, Doing) and then.tense == "past":
        when = "past"
    return QueryFields(
        type="what_if",
        actor=actor_of(subject(inner)),
        factual=denied_of(inner),
        counterfactual=actions_of(inner),
        negated=negated,
        tense=when,
        intervention="remove" if removed and negated else None,
    )


def _sensitivity(that: Proposition, condition: Proposition) -> QueryFields:
    return QueryFields(
        type="sensitivity",
        actor=actor_of(subject(that)),
        factual=actions_of(that),
        tense=tense(that),
        condition=actor_of(subject(condition)),
    )


def _whether(question: Whether) -> QueryFields:
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
        return _how_sure(HowSure())
    if isinstance(that, Is) and that.event is not None and that.state in ("better", "worth-it"):
        return QueryFields(type="compare", factual=event_actions(that.event), tense=tense(that))
    return _what(subject(that), tense(that), actions_of(that), beyond=_beyond(that))


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


def _how_much(question: HowMuch) -> QueryFields:
    of = question.of
    if of.attribute == "probability" and of.about is not None:
        return _how_sure(HowSure(of.about))
    if of.attribute in _OUTSIDE:
        return declined(_OUTSIDE[of.attribute], plain(of.tense))
    if of.attribute in _WAYS:
        return _bound(of.thing, plain(of.tense))
    actions = event_actions(of.event)
    thing = of.thing if of.event is None else of.event.actor
    if of.attribute == "delay" and actions is not None:
        when = plain(of.tense)
        return QueryFields(type="compare", factual=actions, tense=when)
    if of.attribute in _TIMES:
        return QueryFields(
            type="when", actor=actor_of(thing), factual=actions, tense=plain(of.tense)
        )
    return _what(thing, plain(of.tense), actions)


def _where(question: Where) -> QueryFields:
    of = question.of
    if isinstance(of, Event) and of.action in ("go", "head", "move"):
        return _bound(of.actor, tense_of(of))
    if isinstance(of, Destination):
        return _bound(Ego(), "present")
    return _what(*_thing(of))


def _identify(question: Identify) -> QueryFields:
    if isinstance(question.thing, Destination):
        return _bound(Ego(), "present")
    return _what(question.thing, "present", None)


def _bound(actor: Thing, when: FieldTense) -> QueryFields:
    return QueryFields(type="where_goal", actor=actor_of(actor), tense=when)


def _how_sure(question: HowSure) -> QueryFields:
    of = question.of
    return QueryFields(
        type="confidence",
        actor=actor_of(subject(of)),
        factual=actions_of(of),
        tense=_foreseen(of),
    )


def _foreseen(of: Proposition | None) -> FieldTense:
    """Tell when it was to happen: what he would do is yet to come."""
    open_ = any(event.modal == "would" for event in events_of(of))
    return "future" if open_ else tense(of)


def _about(kind: QueryType) -> Callable[[HowKnow | HowDecide | HowAvoid | When], QueryFields]:
    def projector(question: HowKnow | HowDecide | HowAvoid | When) -> QueryFields:
        of = question.of
        collision = any(event.action == "collide" for event in events_of(of))
        return QueryFields(
            type=kind,
            actor=actor_of(subject(of)),
            factual=actions_of(of),
            tense=_foreseen(of) if kind == "how" else tense(of),
            event="collision" if collision else None,
        )

    return projector


def _hangs_on(question: WhatWouldChange) -> QueryFields:
    of = question.of
    negated = isinstance(of, Not)
    open_ = any(event.modal in ("would", "could", "will") for event in events_of(of))
    actions = actions_of(of)
    unreal = (negated or open_) and not question.most
    return QueryFields(
        type="sensitivity",
        actor=actor_of(subject(of)),
        factual=None if unreal else actions,
        counterfactual=actions if unreal else None,
        tense="future" if unreal and tense(of) == "present" else tense(of),
    )


def _which(question: Which) -> QueryFields:
    such = question.such
    if such is None:
        return _what(question.thing, "present", None)
    match such:
        case Is(state="at-fault"):
            return declined("blame", tense(such))
        case Happens(event=Event(action=action, object=Wanted())) if action in _CAUSED:
            return _why(Why(such))
    return _what(question.thing, tense(such), actions_of(such))


def _doing(question: Doing) -> QueryFields:
    return _what(question.actor, plain(question.tense), None)


def _what(thing: Thing | None, when: FieldTense, actions: Any, beyond: bool = False) -> QueryFields:
    if beyond:
        return declined("not-an-action", when)
    return QueryFields(type="what", actor=actor_of(thing), factual=actions, tense=when)


def declined(reason: str, when: FieldTense = "present") -> QueryFields:
    """Return the fields of what the car does not speak of."""
    return QueryFields(type="out_of_scope", tense=when, reason=reason)


def _still(that: Proposition) -> bool:
    return any(isinstance(event.actor, Ego) for event in events_of(that))


def _ahead(then: Question) -> bool:
    return isinstance(then, Doing) and then.tense == "future"


def _beyond(that: Proposition) -> bool:
    return any(is_beyond(event) for event in events_of(that))


def _thing(of: Thing | Event) -> tuple[Thing, FieldTense, Any]:
    if isinstance(of, Event):
        return of.actor, tense_of(of), event_actions(of)
    return of, "present", None


_PROJECTORS: Mapping[type, Projector] = {
    Why: _why,
    WhatIf: _what_if,
    Whether: _whether,
    Which: _which,
    Identify: _identify,
    HowMuch: _how_much,
    HowMany: lambda q: _what(*_thing(q.of)),
    When: _about("when"),
    HowLong: lambda q: _about("when")(When(Happens(q.of) if isinstance(q.of, Event) else q.of)),
    Where: _where,
    Whither: lambda q: _bound(q.actor, "past" if isinstance(q.time, Start | Ago) else "present"),
    Doing: _doing,
    Compare: compare,
    Peak: lambda q: _what(Ego(), "past", None),
    Changed: lambda q: _what(Ego(), "past", None),
    Listing: lambda q: _what(q.about, "present" if q.of in _STANDING else "past", None),
    Summarise: lambda q: _what(_thing(q.about or Ego())[0], "past", None),
    HowKnow: _about("how"),
    HowSure: _how_sure,
    HowDecide: _about("how"),
    WhatWouldChange: _hangs_on,
    HowAvoid: _about("how_avoid"),
    Fault: lambda q: declined("legality" if q.legal else "blame", tense(q.of)),
}
