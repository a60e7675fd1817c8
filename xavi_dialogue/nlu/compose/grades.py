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
    Junction,
    Measured,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Related,
    Relative,
    That,
    Thing,
    Unknown,
    Wanted,
)
from xavi_dialogue.nlu.compose.adoption import with_fields
from xavi_dialogue.nlu.compose.candidates import Special
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.lasting import long_lasting, meanwhile, measured, until
from xavi_dialogue.nlu.compose.nominal import counted
from xavi_dialogue.nlu.compose.sem import Group, Measure, Moment, Noun, Sem, as_thing
from xavi_dialogue.nlu.compose.specials import proposition_of


def graded(grade: str, words: tuple[str, ...], clause: Clause, value: Any) -> Question:
    """Ask for the measure that "how" and an adjective name of a clause."""
    event = value.event if isinstance(value, Happens) else None
    if isinstance(value, Not) and isinstance(value.content, Happens):
        event = value.content.event
    actor = event.actor if event is not None else as_thing(clause.subject)
    match grade:
        case "fast":
            return measured("speed", clause, actor, time=meanwhile(clause, event))
        case "hard" if isinstance(clause.subject, Event):
            deed = clause.subject
            return measured("deceleration", clause, deed.actor, event=deed)
        case "hard":
            return measured("deceleration", clause, actor, event=event)
        case "far":
            if {"further", "farther"} & set(words) and not isinstance(actor, Described):
                return measured("distance-to-go", clause, Ego())
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
        case "faster" if event is None and clause.verb is None and _PACES & set(words):
            than = None if isinstance(clause.than, Clause) else as_thing(clause.than)
            return measured("speed", clause, actor, to=than or Pronoun("it"))
        case "faster" if clause.verb is not None and clause.verb.key in ("get", "become", "grow"):
            return measured("speed-change", clause, actor)
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
    """Ask how far it is to something; what is left is to the destination."""
    if clause.side == "left" and not clause.objects:
        return HowMuch(Measured("distance-to-go"))
    to = _reference(clause)
    if to is None and _remaining(clause, actor):
        return measured("distance-to-go", clause, Ego())
    arriving = event is not None and event.action == "arrive"
    if arriving or isinstance(to, Destination):
        return measured("distance-to-go", clause, Ego())
    if event is not None and isinstance(actor, Ego) and to is None and event.tense != "present":
        return measured("distance-driven", clause, Ego())
    if isinstance(actor, Pronoun) and actor.form == "it" and event is None:
        return measured("distance", clause, actor if to is None else Ego(), to=to)
    if isinstance(actor, Destination):
        return measured("distance-to-go", clause, Ego())
    return measured("distance", clause, actor, to=to)


def _remaining(clause: Clause, actor: Thing | None) -> bool:
    """Say whether "left" asks for what remains: "how far is left", "how much distance is left"."""
    subject = clause.subject
    if isinstance(subject, Event) and subject.action == "exit-left":
        return True
    if not isinstance(actor, (Pronoun, type(None))):
        return False
    leaving = clause.verb is not None and clause.verb.key == "leave"
    bare = clause.verb is None and isinstance(subject, (Measure, type(None)))
    leaving |= bare and clause.side == "left"
    named = [getattr(node, "words", ()) for bearing, node in clause.bearings if bearing == "left"]
    return leaving or ("left",) in named


def _reference(clause: Clause) -> Thing | None:
    for phrase in clause.complements:
        thing = _reached(phrase.sem)
        if thing is not None and phrase.key not in ("at", "by"):
            return thing
    for sem, _ in clause.objects:
        thing = _reached(sem)
        if thing is not None:
            return thing
    if isinstance(clause.than, Clause) or clause.than is None:
        return None
    return as_thing(clause.than)


def _reached(sem: Sem | None) -> Thing | None:
    """Take "the next turn" for the place where it is."""
    if isinstance(sem, Event) and sem.action in ("turn", "exit-left", "exit-right"):
        return Junction("junction", 1)
    if isinstance(sem, Group):  # "between you and the bus"
        things = [as_thing(member) for member in sem.members]
        return next((t for t in things if t not in (None, Ego(), Passenger())), None)
    return as_thing(sem)


def _close(clause: Clause, event: Event | None, value: Any, actor: Thing | None) -> Question:
    to = _reference(clause) or (event.object if event is not None else None)
    if to is None and _remaining(clause, actor):
        return measured("distance-to-go", clause, Ego())
    before = isinstance(clause.time, Relative) and clause.time.relation == "before"
    if isinstance(clause.time, Relative) and before and to in (None, Ego()):
        anchor = clause.time.anchor  # "how much room before he reaches us"
        if isinstance(anchor, Event) and anchor.tense == "present":
            return HowMuch(Measured("distance", to=anchor.actor))
    owned = clause.verb is not None and clause.verb.words == ("got",)  # "have we got"
    past = clause.tense in ("past", "perfect") and not owned
    extreme = "lowest" if past or event is not None else None
    return measured("distance", clause, actor, to=to, extreme=extreme)


_DIFFERENCES = {"fast": "speed", "slow": "speed", "close": "distance", "far": "distance"}


def _much(clause: Clause, value: Any, actor: Thing | None) -> Question:
    subject = clause.subject
    if isinstance(subject, Measure) and subject.of.attribute == "speed" and clause.verb is not None:
        return measured("speed-change", clause, subject.of.thing)
    if isinstance(subject, Measure):
        return HowMuch(subject.of, subject.extreme)
    if isinstance(value, Happens) and value.event.action in _CHANGING:
        return measured("speed-change", clause, actor, event=value.event)
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


def amounts(sem: Sem, clause: Clause, value: Any, words: tuple[str, ...] = ()) -> Question:
    """Ask "how many cars", "how much time" of a clause; "how many more turns" are to come."""
    if isinstance(sem, Event) and _to_come(clause, value, words):
        return HowMany(cast(Event, with_fields(sem, tense="future")))
    actor = as_thing(clause.subject)
    event = value.event if isinstance(value, Happens) else None
    counting = isinstance(sem, Noun) and sem.key == "time" and sem.plural
    if (isinstance(sem, Moment) and sem.unit == "times") or counting:
        if event is not None and isinstance(event.actor, Unknown):
            event = with_fields(event, actor=Ego())  # it is the word "times"
        return HowMany(event or Event("do"))
    if (isinstance(sem, Moment) and sem.unit in ("s", "min", "h")) or (
        isinstance(sem, Noun) and sem.key == "time"
    ):
        return _stretch(clause, value, actor, event)
    if isinstance(sem, Moment):
        return _lengths(sem, clause, value, actor, event)
    if isinstance(sem, Measure) and sem.of.attribute == "speed" and _changes(clause, event):
        return measured("speed-change", clause, actor, event=event)
    if isinstance(sem, Measure):
        to = _reference(clause)
        if sem.of.attribute == "distance" and to is None and _remaining(clause, actor):
            return measured("distance-to-go", clause, Ego())
        return measured(sem.of.attribute, clause, sem.of.to or actor, to=to)
    if isinstance(sem, Noun) and sem.key in ("side",):
        return measured("distance", clause, actor)
    question = counted(sem)
    if isinstance(question, HowMany):
        return HowMany(_restricted(question.of, value))
    return question or measured("count", clause, actor)


def _to_come(clause: Clause, value: Any, words: tuple[str, ...]) -> bool:
    """Say whether it is asked how many are left, or still to come."""
    coming = isinstance(value, Happens) and value.event.action in ("come", "go", "leave", "move")
    left = clause.side == "left" and clause.verb is None
    ahead = any(key == "ahead" for key, _ in clause.bearings) or clause.tense == "future"
    return "more" in words or left or ahead or (coming and clause.tense != "past")


_PACES = frozenset({"faster", "slower", "quicker"})
_CHANGING = frozenset({"slow-down", "speed-up"})
_GAINING = frozenset({"lose", "gain", "drop", "shed", "put", "add"})


def _changes(clause: Clause, event: Event | None) -> bool:
    """Say whether a clause is of a change of speed: "how much speed did we lose"."""
    if event is not None and event.action in _CHANGING:
        return True
    return clause.verb is not None and clause.verb.key in _GAINING


def _left_over(event: Event | None) -> bool:
    """Say whether it is "left" that stands as a verb: "how much time have we left"."""
    return event is not None and event.action == "leave" and event.object is None


def _stretch(clause: Clause, value: Any, actor: Thing | None, event: Event | None) -> Question:
    if isinstance(clause.time, Relative) and clause.time.relation == "until":
        return until(clause.time.anchor)
    if isinstance(value, Special) and value.name in ("cost", "delay", "save"):
        by = value.match.phrases.get("by")
        deed = with_fields(by, tense=clause.tense) if isinstance(by, Event) else None
        return measured("delay", clause, actor, event=deed)
    if _left_over(event):
        return HowMuch(Measured("time-to-go"))  # "how much time have we left"
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
    if sem.unit in ("km", "mile") and _reference(clause) is None and event is None:
        return measured("distance-to-go", clause, Ego())
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
