"""Predicate nouns: "it was the bus", "it is blue", "it is his fault", "the lights are on"."""

from typing import Any, cast

from xavi_dialogue.domain.terms import (
    Caused,
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Everyone,
    Exists,
    Exit,
    Feature,
    Happens,
    Has,
    Is,
    Junction,
    Lane,
    Measured,
    Not,
    Pronoun,
    Proposition,
    Quantity,
    Related,
    Road,
    Thing,
    Time,
    Unknown,
    Wanted,
)
from xavi_dialogue.nlu.compose.adoption import with_fields
from xavi_dialogue.nlu.compose.clause import Clause, Complement
from xavi_dialogue.nlu.compose.events import when
from xavi_dialogue.nlu.compose.sem import (
    Group,
    Measure,
    Noun,
    Sem,
    SideOf,
    Specified,
    as_thing,
)
from xavi_dialogue.nlu.compose.tree import words_of

Found = tuple[Proposition, float]
_PACES: dict[str | None, str] = {"fastest": "more", "slowest": "less"}
#: [km/h] numbers that are limits where nothing else is said.
LIMITS = frozenset({20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0, 110.0, 120.0, 130.0})


def lights(clause: Clause, subject: Measure) -> list[Found]:
    """Compose "its brake lights are on", "is his left indicator on"."""
    value = clause.side or next((leaf.key for leaf in clause.particles), "on")
    lights = subject.of
    return [(Has(lights.attribute, value, lights.thing, clause.time, tense_of(clause)), 0.0)]


def nominal(clause: Clause, sem: Sem) -> list[Found]:
    """Compose "it is a truck", "it was the bus", "is it blue"."""
    subject = as_thing(clause.subject) or Pronoun("it")
    time, tense = when(clause, None), tense_of(clause)
    cleft = _cleft(sem) if isinstance(subject, Pronoun) else None
    if cleft is not None:
        return [(cleft, 0.0)]
    if isinstance(sem, Described) and isinstance(subject, Ego) and sem.extreme in _PACES:
        speed = Measured("speed", subject, time=time, tense=tense)
        others = Measured("speed", Everyone(), time=time, tense=tense)
        return [(Compares(speed, cast(Any, _PACES[sem.extreme]), others), 0.0)]
    if isinstance(sem, Described):
        plain = Described(colour=sem.colour, definite=sem.definite)
        if sem.colour and sem == plain and not isinstance(subject, Wanted):
            return [(Has("colour", sem.colour, subject, time, tense), 0.0)]
        return _described(clause, sem, subject, time)
    if isinstance(sem, Measure) and sem.of.attribute == "right-of-way":
        other = sem.of.to or Everyone()
        return [(Related("has-priority-over", sem.of.thing, other, time, tense), 0.0)]
    if isinstance(sem, Measure):
        return [
            (
                Compares(
                    Measured(sem.of.attribute, subject, time=time, tense=tense), "same", sem.of
                ),
                0.2,
            )
        ]
    if isinstance(sem, Quantity):
        return [(_numbered(clause, sem), 0.1)]
    if isinstance(sem, Noun):
        return [(_noun_state(clause, sem, subject, time), 0.1)]
    if isinstance(sem, SideOf):
        return [(Has("turn", sem.side, subject, time, tense), 0.2)]
    if isinstance(sem, Group):
        return [(Related("same-as", subject, as_thing(sem) or subject, time, tense), 0.3)]
    if isinstance(sem, Event) and sem.action == "turn" and sem.side is None:
        going = Event("go", sem.actor, None, None, ("first",), time, tense, "should")
        return [(Happens(going), 0.0)]  # "it is our turn"
    if isinstance(sem, Event) and isinstance(clause.subject, Event):
        return [(Is("right", None, clause.subject, time=time, tense=tense), 0.1)]
    if isinstance(sem, Event):
        return [(Is("right", subject, sem, time=time, tense=tense), 0.5)]
    thing = as_thing(sem)
    if isinstance(thing, Unknown) and thing.words in ("here", "there"):
        if isinstance(subject, Ego):
            return [(arrived(clause), 0.0)]
        return [(Is("present", subject, time=time, tense=tense), 0.0)]
    thing = thing or Pronoun("it")
    placed = _placed(thing, subject, time, tense)
    if placed is not None:
        return [(placed, 0.05)]
    if isinstance(thing, (Described, Everyone)) or not isinstance(subject, Pronoun):
        return [(Related("same-as", subject, thing, time, tense), 0.1)]
    return [(Caused(thing), 0.1), (Related("same-as", subject, thing, time, tense), 0.15)]


def _described(clause: Clause, sem: Described, subject: Thing, time: Time) -> list[Found]:
    """Compose "it is a truck", "it was the bus that stopped us"."""
    tense = tense_of(clause)
    sort = not sem.definite and sem.kind != "vehicle" and sem.bearing is None
    if sort and isinstance(subject, (Pronoun, Described)):
        return [(Has("kind", sem.kind, subject, time, tense), 0.0)]
    same: Proposition = Related("same-as", subject, sem, time, tense)
    if isinstance(subject, Pronoun) and subject.form in ("it", "that", "this"):
        return [(Caused(sem), 0.0), (same, 0.1)]
    return [(same, 0.0)]


def _placed(thing: Thing, subject: Thing, time: Time, tense: Any) -> Proposition | None:
    """Read "this is the main road", "is that our exit", "that is a roundabout"."""
    if not isinstance(subject, Pronoun) or subject.form not in ("it", "that", "this"):
        return None
    match thing:
        case Road() | Lane():
            return Related("on", Ego(), thing, time, tense)
        case Exit():
            return Happens(Event("leave", Ego(), thing, time=time, tense=tense))
        case Destination():
            return Happens(Event("arrive", Ego(), time=time, tense=tense))
        case Junction() | Feature():
            return Exists(thing, time, tense)
    return None


def _cleft(sem: Sem) -> Proposition | None:
    """Read "it was the truck that made you stop": the clause, of the thing."""
    clause = sem.clause if isinstance(sem, Specified) else getattr(sem, "such", None)
    thing = as_thing(sem)
    if isinstance(thing, Described):
        thing = with_fields(thing, such=None, doing=None)
    if isinstance(clause, Caused) and isinstance(clause.cause, Wanted) and thing is not None:
        return Caused(thing, clause.effect)
    if isinstance(sem, Specified) and isinstance(clause, Happens):
        return Happens(with_fields(clause.event, actor=thing))
    return None


def _noun_state(clause: Clause, sem: Noun, subject: Thing, time: Time) -> Proposition:
    if sem.key == "fault":
        event = sem.clause.event if isinstance(sem.clause, Happens) else None
        thing = as_thing(sem.owner) or as_thing(sem.of) or subject
        return Is("at-fault", thing, event, time=time, tense=tense_of(clause))
    if sem.key in ("problem",):
        return Is("wrong", subject, time=time, tense=tense_of(clause))
    if sem.key in ("option", "plan") and sem.negative:
        return Not(Is("possible", subject, time=time, tense=tense_of(clause)))
    if sem.key in ("prediction", "wrong-prediction"):
        return Is("wrong", subject, time=time, tense=tense_of(clause))
    if sem.key == "truth":
        return Is("right", subject, time=time, tense=tense_of(clause))
    if sem.key in ("reason", "factor"):
        deed = next((one for one in (sem.about, sem.of) if isinstance(one, Event)), None)
        return Caused(subject, sem.clause if deed is None else Happens(deed))
    return Related("same-as", subject, Unknown(sem.word), time, tense_of(clause))


def against(clause: Clause, thing: Thing, phrase: Complement) -> Proposition:
    """Read "over the limit", "under the limit"."""
    measure = cast(Measure, phrase.sem)
    attribute: Any = "speed" if measure.of.attribute == "limit" else measure.of.attribute
    below = any(word in ("under", "below", "within") for word in words_of(phrase.node).split())
    left = Measured(attribute, thing, time=clause.time, tense=tense_of(clause))
    return Compares(left, "less" if below else "more", measure.of)


def arrived(clause: Clause) -> Proposition:
    """Read "are we there yet" as having arrived."""
    tense: Any = "perfect" if clause.tense == "present" else clause.tense
    return Happens(Event("arrive", Ego(), time=clause.time, tense=tense))


def _numbered(clause: Clause, sem: Quantity) -> Proposition:
    subject = clause.subject
    measured = subject.of if isinstance(subject, Measure) else None
    if measured is None:
        attribute = {"m/s": "speed", "m": "distance", "s": "time", "%": "probability"}.get(
            sem.unit, "count"
        )
        if attribute == "count" and isinstance(subject, Pronoun) and sem.value in LIMITS:
            limit = Measured("limit", time=clause.time)  # "isn't it thirty here?"
            return Compares(limit, "same", Quantity(round(sem.value / 3.6, 6), "m/s"))
        measured = Measured(cast(Any, attribute), as_thing(subject) or Ego(), time=clause.time)
    return Compares(measured, "same", sem)


def tense_of(clause: Clause) -> Any:
    """Tell the tense of a clause."""
    return clause.tense
