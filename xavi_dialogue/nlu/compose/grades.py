"""Grades: "how fast", "how long", "how many": measures asked of a clause."""

from typing import Any, cast

from xavi_dialogue.domain.meaning import (
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Question,
    When,
    Whether,
)
from xavi_dialogue.domain.terms import (
    Described,
    Destination,
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Related,
    Relative,
    That,
    Thing,
    Wanted,
)
from xavi_dialogue.nlu.compose.candidates import Special
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.nominal import counted
from xavi_dialogue.nlu.compose.sem import Measure, Moment, Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.specials import proposition_of

_ARRIVALS = frozenset({"arrive", "stop"})


def _time(clause: Clause) -> Any:
    return clause.time


def measured(attribute: str, clause: Clause, thing: Thing | None, **more: Any) -> HowMuch:
    """Ask for an attribute of a thing at the time of the clause."""
    extreme = more.pop("extreme", None)
    actor = Ego() if thing is None or isinstance(thing, Passenger) else thing
    if actor == more.get("to") == Ego():
        actor = Pronoun("it")  # "how much room was there between us"
    return HowMuch(
        Measured(cast(Any, attribute), actor, time=_time(clause), tense=cast(Any, clause.tense),
                 **more), extreme,
    )  # fmt: skip


def graded(grade: str, words: tuple[str, ...], clause: Clause, value: Any) -> Question:
    """Ask for the measure that "how" and an adjective name of a clause."""
    event = value.event if isinstance(value, Happens) else None
    if isinstance(value, Not) and isinstance(value.content, Happens):
        event = value.content.event
    actor = event.actor if event is not None else as_thing(clause.subject)
    match grade:
        case "fast":
            return measured("speed", clause, actor)
        case "hard":
            return measured("deceleration", clause, actor, event=event)
        case "far":
            return _far(clause, event, value, actor)
        case "close":
            return _close(clause, event, value, actor)
        case "long":
            return long_lasting(clause, event, value, actor)
        case "big":
            return measured("size", clause, actor)
        case "likely":
            return _sure(clause, value)
        case "often":
            return HowMany(event) if event is not None else HowMany(Event("do"))
        case "late":
            if event is not None:
                return When(Happens(event))
            return measured("delay", clause, actor)
        case "faster" if event is None and actor is not None and clause.verb is None:
            than = None if isinstance(clause.than, Clause) else as_thing(clause.than)
            return measured("speed", clause, actor, to=than)
        case "faster":
            return measured("delay", clause, actor, event=event)
        case "many":
            return HowMany(actor or Described(plural=True, definite=False))
        case "much":
            return _much(clause, value, actor)
        case _:
            return _quality(clause, words, value, actor)


def _quality(clause: Clause, words: tuple[str, ...], value: Any, actor: Thing | None) -> Question:
    state = {"safe": "safe", "dangerous": "dangerous", "risky": "dangerous", "bad": "dangerous",
             "important": "necessary", "necessary": "necessary", "well": "visible",
             "free": "free", "busy": "busy", "old": "right", "crowded": "busy"}  # fmt: skip
    if isinstance(value, Related) and value.relation == "can-see":
        return HowMuch(Measured("visibility", value.to, time=clause.time))
    event = value.event if isinstance(value, Happens) else None
    name: Any = state.get(words[-1], "safe")
    return Whether(Is(name, None if event else actor, event, time=clause.time,
                      tense=cast(Any, clause.tense)))  # fmt: skip


def _sure(clause: Clause, value: Any) -> Question:
    content: Proposition | None = None
    if isinstance(value, Special):
        content = value.content
    elif isinstance(value, Happens) and not isinstance(value.event.object, Wanted):
        content = value
    return HowSure(content, clause.time)


def _far(clause: Clause, event: Event | None, value: Any, actor: Thing | None) -> Question:
    to = _reference(clause)
    arriving = event is not None and event.action == "arrive"
    if arriving or isinstance(to, Destination):
        return measured("distance-to-go", clause, Ego())
    if event is not None and isinstance(actor, Ego) and to is None and event.tense != "present":
        return measured("distance-driven", clause, Ego())
    if isinstance(actor, Pronoun) and actor.form == "it" and to is None and event is None:
        return measured("distance", clause, actor)
    if isinstance(actor, Destination):
        return measured("distance-to-go", clause, Ego())
    return measured("distance", clause, actor, to=to)


def _reference(clause: Clause) -> Thing | None:
    for phrase in clause.complements:
        thing = as_thing(phrase.sem)
        if thing is not None and phrase.key not in ("at", "by"):
            return thing
    for sem, _ in clause.objects:
        thing = as_thing(sem)
        if thing is not None:
            return thing
    if isinstance(clause.than, Clause) or clause.than is None:
        return None
    return as_thing(clause.than)


def _close(clause: Clause, event: Event | None, value: Any, actor: Thing | None) -> Question:
    to = _reference(clause) or (event.object if event is not None else None)
    past = clause.tense in ("past", "perfect")
    extreme = "lowest" if past or event is not None else None
    return measured("distance", clause, actor, to=to, extreme=extreme)


def long_lasting(clause: Clause, event: Event | None, value: Any, actor: Thing | None) -> Question:
    """Ask how long something lasts, or how long it is until it happens."""
    if isinstance(clause.time, Relative) and clause.time.relation == "until":
        return until(clause.time.anchor)
    if isinstance(value, Special) and value.name in ("cost", "delay", "save"):
        return measured("delay", clause, actor)
    if isinstance(value, Special) and value.name in ("take-time", "last"):
        content = value.content
        if any(isinstance(sem, Destination) for sem in value.match.phrases.values()):
            return HowMuch(Measured("time-to-go"))
        if isinstance(content, Happens):
            if content.event.action == "arrive":
                return HowMuch(Measured("time-to-go"))
            return HowLong(content.event)
        if isinstance(clause.subject, Event):
            return HowLong(clause.subject)
        return measured("duration", clause, actor)
    if event is not None:
        if event.action == "wait" or event.action == "stand":
            return HowLong(event)
        if event.action == "arrive":
            return HowMuch(Measured("time-to-go"))
        return HowLong(event)
    subject = clause.subject
    if isinstance(subject, Event):
        return HowLong(subject)
    if isinstance(subject, Noun) and subject.key == "ride":
        return HowMuch(Measured("time" if clause.tense == "past" else "time-to-go"))
    if isinstance(actor, Pronoun) or (isinstance(actor, Ego) and clause.bearings):
        return measured("duration", clause, actor)
    return measured("size", clause, actor) if actor is not None else HowMuch(Measured("time-to-go"))


def until(anchor: Any) -> Question:
    """Ask how long it is until something happens."""
    if isinstance(anchor, Event) and anchor.action in ("arrive",):
        return HowMuch(Measured("time-to-go"))
    if isinstance(anchor, Destination):
        return HowMuch(Measured("time-to-go"))
    if isinstance(anchor, Event):
        return When(Happens(anchor))
    if anchor is not None and not isinstance(anchor, (Ego, Pronoun)):
        return When(Happens(Event("arrive", Ego(), anchor, tense="future")))
    return HowMuch(Measured("time-to-go"))


_DIFFERENCES = {"fast": "speed", "slow": "speed", "close": "distance", "far": "distance"}


def _much(clause: Clause, value: Any, actor: Thing | None) -> Question:
    subject = clause.subject
    if isinstance(subject, Measure):
        return HowMuch(subject.of, subject.extreme)
    if clause.comparisons and clause.comparisons[0][0] in _DIFFERENCES:
        than = None if isinstance(clause.than, Clause) else as_thing(clause.than)
        return measured(_DIFFERENCES[clause.comparisons[0][0]], clause, actor, to=than)
    if isinstance(value, Special) and value.name in ("cost", "delay", "save", "take-time"):
        return measured("delay", clause, actor)
    if any(key == "allowed" for key, _ in clause.adjectives):
        return measured("limit", clause, Ego())
    if isinstance(value, Happens):
        return measured("deceleration" if value.event.action in ("brake", "slow-down") else "speed",
                        clause, actor, event=value.event)  # fmt: skip
    return measured("count", clause, actor)


def amounts(sem: Sem, clause: Clause, value: Any) -> Question:
    """Ask "how many cars", "how much time" of a clause."""
    actor = as_thing(clause.subject)
    event = value.event if isinstance(value, Happens) else None
    if isinstance(sem, Moment) and sem.unit == "times":
        return HowMany(event or Event("do"))
    if (isinstance(sem, Moment) and sem.unit in ("s", "min", "h")) or (
        isinstance(sem, Noun) and sem.key == "time"
    ):
        return _stretch(clause, value, actor, event)
    if isinstance(sem, Moment):
        return _lengths(sem, clause, value, actor, event)
    if isinstance(sem, Measure):
        to = _reference(clause)
        return measured(sem.of.attribute, clause, sem.of.to or actor, to=to)
    if isinstance(sem, Noun) and sem.key in ("side",):
        return measured("distance", clause, actor)
    question = counted(sem)
    if isinstance(question, HowMany):
        return HowMany(_restricted(question.of, value))
    return question or measured("count", clause, actor)


def _stretch(clause: Clause, value: Any, actor: Thing | None, event: Event | None) -> Question:
    if isinstance(clause.time, Relative) and clause.time.relation == "until":
        return until(clause.time.anchor)
    if isinstance(value, Special) and value.name in ("cost", "delay", "save"):
        return measured("delay", clause, actor)
    if event is not None:
        return HowLong(event) if event.action != "arrive" else HowMuch(Measured("time-to-go"))
    return long_lasting(clause, event, value, actor)


def _lengths(
    sem: Moment, clause: Clause, value: Any, actor: Thing | None, event: Event | None
) -> Question:
    if sem.unit in ("kmh", "mph", "ms"):
        return measured("speed", clause, actor)
    if sem.unit == "percent":
        return _sure(clause, value)
    return _far(clause, event, value, actor)


def _restricted(of: Thing | Event, value: Any) -> Thing | Event:
    """Say of what is counted what it does: "how many cars can you see"."""
    if not isinstance(of, Described):
        return of
    fields: dict[str, Any] = {k: getattr(of, k) for k in of.__struct_fields__}
    if isinstance(value, Special):
        value = proposition_of(value)
    if isinstance(value, Happens):
        fields["doing"] = value.event
    elif value is not None and not isinstance(value, That):
        fields["such"] = value
    fields.update(plural=True, definite=False)
    return Described(**fields)
