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
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import (
    Ago,
    Believed,
    Destination,
    Ego,
    Event,
    Exists,
    Happens,
    Is,
    Not,
    Proposition,
    Start,
    Thing,
    Wanted,
)
from xavi_dialogue.nlu.projection.comparisons import compare
from xavi_dialogue.nlu.projection.fields import FieldTense, QueryFields, QueryType
from xavi_dialogue.nlu.projection.polar import declined, foreseen, how_sure, what_fields, whether
from xavi_dialogue.nlu.projection.propositions import subject, tense
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
_OUTSIDE = {"law": "legality", "weather": "off-topic", "sound": "perception", "money": "off-topic",
            "world": "off-topic", "battery": "capability"}  # fmt: skip
#: What is listed as it is now.
_STANDING = frozenset(("vehicles", "options", "rivals", "capabilities"))


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


def _how_much(question: HowMuch) -> QueryFields:
    of = question.of
    if of.attribute == "probability" and of.about is not None:
        return how_sure(HowSure(of.about))
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
    return what_fields(thing, plain(of.tense), actions)


def _where(question: Where) -> QueryFields:
    of = question.of
    if isinstance(of, Event) and of.action in ("go", "head", "move"):
        return _bound(of.actor, tense_of(of))
    if isinstance(of, Destination):
        return _bound(Ego(), "present")
    return what_fields(*_thing(of))


def _identify(question: Identify) -> QueryFields:
    if isinstance(question.thing, Destination):
        return _bound(Ego(), "present")
    return what_fields(question.thing, "present", None)


def _bound(actor: Thing, when: FieldTense) -> QueryFields:
    return QueryFields(type="where_goal", actor=actor_of(actor), tense=when)


def _about(kind: QueryType) -> Callable[[HowKnow | HowDecide | HowAvoid | When], QueryFields]:
    def projector(question: HowKnow | HowDecide | HowAvoid | When) -> QueryFields:
        of = question.of
        collision = any(event.action == "collide" for event in events_of(of))
        return QueryFields(
            type=kind,
            actor=actor_of(subject(of)),
            factual=actions_of(of),
            tense=foreseen(of) if kind == "how" else tense(of),
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
        return what_fields(question.thing, "present", None)
    match such:
        case Is(state="at-fault"):
            return declined("blame", tense(such))
        case Happens(event=Event(action=action, object=Wanted())) if action in _CAUSED:
            return _why(Why(such))
    return what_fields(question.thing, tense(such), actions_of(such))


def _doing(question: Doing) -> QueryFields:
    return what_fields(question.actor, plain(question.tense), None)


def _still(that: Proposition) -> bool:
    return any(isinstance(event.actor, Ego) for event in events_of(that))


def _ahead(then: Question) -> bool:
    return isinstance(then, Doing) and then.tense == "future"


def _thing(of: Thing | Event) -> tuple[Thing, FieldTense, Any]:
    if isinstance(of, Event):
        return of.actor, tense_of(of), event_actions(of)
    return of, "present", None


_PROJECTORS: Mapping[type, Projector] = {
    Why: _why,
    WhatIf: _what_if,
    Whether: whether,
    Which: _which,
    Identify: _identify,
    HowMuch: _how_much,
    HowMany: lambda q: what_fields(*_thing(q.of)),
    When: _about("when"),
    HowLong: lambda q: _about("when")(When(Happens(q.of) if isinstance(q.of, Event) else q.of)),
    Where: _where,
    Whither: lambda q: _bound(q.actor, "past" if isinstance(q.time, Start | Ago) else "present"),
    Doing: _doing,
    Compare: compare,
    Peak: lambda q: what_fields(Ego(), "past", None),
    Changed: lambda q: what_fields(Ego(), "past", None),
    Listing: lambda q: what_fields(q.about, "present" if q.of in _STANDING else "past", None),
    Summarise: lambda q: what_fields(_thing(q.about or Ego())[0], "past", None),
    HowKnow: _about("how"),
    HowSure: how_sure,
    HowDecide: _about("how"),
    WhatWouldChange: _hangs_on,
    HowAvoid: _about("how_avoid"),
    Fault: lambda q: declined("legality" if q.legal else "blame", tense(q.of)),
}
