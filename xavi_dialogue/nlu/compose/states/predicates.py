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
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.clause import Clause, Complement
from xavi_dialogue.nlu.compose.clauses.followers import relation_of
from xavi_dialogue.nlu.compose.clauses.risks import is_danger
from xavi_dialogue.nlu.compose.clauses.sem import (
    Group,
    Measure,
    Noun,
    Sem,
    SideOf,
    as_speed,
    as_thing,
)
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of, words_of
from xavi_dialogue.nlu.compose.states.causes import CAUSED, cause_named, cleft
from xavi_dialogue.nlu.compose.verbs.events import when
from xavi_dialogue.nlu.compose.verbs.lights import faced_by, is_colour
from xavi_dialogue.nlu.grammar.chart import Part

Found = tuple[Proposition, float]
#: What a ride can be said to be; "a good ride" is a comfortable one.
_QUALITIES = {"better": "comfortable"} | {
    state: state for state in ("safe", "dangerous", "comfortable", "uncomfortable")
}
_PACES: dict[str | None, str] = {"fastest": "more", "slowest": "less"}
_GOOD = frozenset({"right", "correct", "good", "best", "proper", "wise"})
_AMISS = frozenset({"wrong", "bad", "poor"})
_FACTS = frozenset({"it", "that", "this"})
SLOWEST = 6  # [km/h] from which on a bare number said of a vehicle is its speed
#: [km/h] numbers that are limits where nothing else is said.
LIMITS = frozenset({20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0, 110.0, 120.0, 130.0})


NOMINATIVE = 1.0  # cost of "the car in front is he", where "is he" rather begins a question
_NOMINATIVE = frozenset({"he", "she", "they", "we", "i"})


def lights(clause: Clause, subject: Measure) -> list[Found]:
    """Compose "its brake lights are on", "is his left indicator on"."""
    value = clause.side or next((leaf.key for leaf in clause.particles), "on")
    lights = subject.of
    return [(Has(lights.attribute, value, lights.thing, clause.time, tense_of(clause)), 0.0)]


_MOTIONS = frozenset({"stationary", "moving", "stuck", "move", "park", "fast", "slow", "close"})


def nominal(clause: Clause, sem: Sem) -> list[Found]:
    """Compose "it is a truck", "it was the bus", "is it blue"."""
    subject = as_thing(clause.subject) or Pronoun("it")
    time, tense = when(clause, None), tense_of(clause)
    if (cause := cleft(sem, subject) or cause_named(clause, subject, tense)) is not None:
        rest = _is(clause, sem, subject, time, tense) if isinstance(cause, Caused) else []
        return [(cause, 0.0), *((of, cost + CAUSED) for of, cost in rest)]
    return _is(clause, sem, subject, time, tense)


def _is(clause: Clause, sem: Sem, subject: Thing, time: Time, tense: Any) -> list[Found]:
    """Compose what it is, or is like."""
    if isinstance(sem, Measure) and isinstance(clause.subject, Quantity):  # "40 is the limit"
        measured = cast(Measured, with_fields(sem.of, time=time, tense=tense))
        return [(Compares(measured, "same", clause.subject), 0.0)]
    if isinstance(sem, Described) and isinstance(subject, Ego) and sem.extreme in _PACES:
        speed = Measured("speed", subject, time=time, tense=tense)
        others = Measured("speed", Everyone(), time=time, tense=tense)
        return [(Compares(speed, cast(Any, _PACES[sem.extreme]), others), 0.0)]
    if isinstance(sem, Described):
        if sem.colour and not isinstance(subject, Wanted) and is_colour(clause.objects[0]):
            faced = faced_by(sem.colour, subject, clause.complements)
            return [(Has("colour", sem.colour, faced, time, tense), 0.0)]
        return _described(clause, sem, subject, time)
    if isinstance(sem, Measure) and sem.of.attribute == "right-of-way":
        other = sem.of.to or Everyone()
        return [(Related("has-priority-over", sem.of.thing, other, time, tense), 0.0)]
    if is_danger(sem) and isinstance(subject, Described | Vehicle | Wanted):
        return [(Is("dangerous", subject, time=time, tense=tense), 0.0)]
    if isinstance(sem, Measure) and (kept := _kept(clause, sem, subject)) is not None:
        return [(Is("safe", kept, time=time, tense=tense), 0.0)]
    if isinstance(sem, Measure):
        paced = sem.of.attribute == "limit" and isinstance(subject, Pronoun)
        attribute: Any = "speed" if paced else sem.of.attribute  # "is that the limit?"
        whose = Ego() if paced else subject
        left = Measured(attribute, whose, time=time, tense=tense)
        return [(Compares(left, "same", sem.of), 0.2)]
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
    if isinstance(sem, Event) and (deed := _deed_judged(clause)) is not None:
        amiss = _AMISS & {*words_of(clause.objects[0][1]).split()}
        if amiss:
            return [(_mistake(clause, deed), 0.1)]
        return [(Is("right", None, deed, time=time, tense=tense), 0.1)]
    if isinstance(sem, Event) and sem.action == "nearly-collide":
        return [(Is("close", subject, time=time, tense=tense), 0.1)]  # "it was a near miss"
    if isinstance(sem, Event):
        words = {*words_of(clause.objects[0][1]).split()}
        if words & _AMISS:
            return [(Is("wrong", None, sem, time=time, tense=tense), 0.1)]
        cost = 0.1 if words & _GOOD else 0.5
        return [(Is("right", subject, sem, time=time, tense=tense), cost)]
    return _same(clause, as_thing(sem), subject, time)


def _same(clause: Clause, thing: Thing | None, subject: Thing, time: Time) -> list[Found]:
    """Compose "it was him", "that is our exit", "it is there"."""
    tense = tense_of(clause)
    if isinstance(thing, Unknown) and thing.words in ("here", "there"):
        if isinstance(subject, Ego):
            return [(arrived(clause), 0.0)]
        return [(Is("present", subject, time=time, tense=tense), 0.0)]
    thing = thing or Pronoun("it")
    if isinstance(subject, Ego) and isinstance(thing, Exit | Junction):
        subject = Pronoun("it")  # "ours is the next exit" is said of the exit
    placed = _placed(thing, subject, time, tense)
    if placed is not None:
        return [(placed, 0.05)]
    if thing == Feature("way") and not isinstance(subject, Ego):  # "all these people in your way"
        return [(Related("in-the-way-of", subject, Ego(), time, tense), 0.0)]
    if isinstance(subject, Feature) and subject.kind == "light" and isinstance(thing, Ego):
        return [(Exists(subject, time, tense), 0.0)]  # "is that light ours?"
    same: Proposition = Related("same-as", subject, thing, time, tense)
    words, named = words_of(clause.objects[0][1]), isinstance(subject, Described)
    if words in _NOMINATIVE or (named and words == "it"):  # "the car in front is it waiting"
        return [(same, NOMINATIVE)]
    if isinstance(thing, (Described, Everyone)) or not isinstance(subject, Pronoun):
        return [(same, 0.1)]
    return [(Caused(thing), 0.1), (same, 0.15)]


def _kept(clause: Clause, sem: Measure, subject: Thing) -> Thing | None:
    """Find to whom the distance is said to be a safe one: "a safe distance from him"."""
    safe = {"safe", "safety"} & {*words_of(clause.objects[0][1]).split()}
    if sem.of.attribute not in ("gap", "distance") or not safe:
        return None
    named = [as_thing(c.sem) for c in clause.complements if c.key in ("from", "into")]
    return sem.of.to or next(iter(named), None) or subject


def _described(clause: Clause, sem: Described, subject: Thing, time: Time) -> list[Found]:
    """Compose "it is a truck", "it was the bus that stopped us"."""
    tense = tense_of(clause)
    shown = float(sem.number or 0)
    if shown in LIMITS and not sem.definite and isinstance(subject, Pronoun):
        limit = Measured("limit", time=clause.time)  # "isn't this a seventy?"
        return [(Compares(limit, "same", Quantity(round(shown / 3.6, 6), "m/s")), 0.0)]
    sort = not sem.definite and sem.kind != "vehicle" and sem.bearing is None
    if sort and isinstance(subject, (Pronoun, Described)):
        finer = _finer(clause.objects[0][1])
        kind = f"{finer} {sem.kind}" if finer else sem.kind
        return [(Has("kind", kind, subject, time, tense), 0.0)]
    if sem == Described(bearing=sem.bearing, of=sem.of) and isinstance(subject, Described):
        relation: Any = relation_of(sem.bearing or "near")  # "the red one is the one ahead"
        return [(Related(relation, subject, sem.of or Ego(), time, tense), 0.0)]
    if not sem.definite and sem.bearing is not None and isinstance(subject, Pronoun):
        return [(Exists(sem, time, tense), 0.0)]  # "is that a bus over on the left?"
    same: Proposition = Related("same-as", subject, sem, time, tense)
    alike = "same" in words_of(clause.objects[0][1]).split()
    if isinstance(subject, Pronoun) and subject.form in ("it", "that", "this") and not alike:
        return [(Caused(sem), 0.0), (same, 0.1)]
    return [(same, 0.0)]


def _finer(node: Part) -> str:
    """Give what is said of a sort before its noun: "racing" of "a racing car"."""
    named = [leaf for leaf in leaves_of(node) if leaf.category in ("ADJ", "VING", "UNK")]
    return " ".join(word for leaf in named if leaf.key not in _MOTIONS for word in leaf.words)


def _placed(thing: Thing, subject: Thing, time: Time, tense: Any) -> Proposition | None:
    """Read "this is the main road", "is that our exit", "that is a roundabout"."""
    if not isinstance(subject, Pronoun) or subject.form not in ("it", "that", "this"):
        return None
    match thing:
        case Feature(kind="way"):  # "is this the way?"
            return Related("on", Ego(), Road("fitting"), time, tense)
        case Road(which="side"):
            return Exists(thing, time, tense)
        case Road() | Lane():
            return Related("on", Ego(), thing, time, tense)
        case Exit():
            return Happens(Event("leave", Ego(), thing, time=time, tense=tense))
        case Destination():
            return Happens(Event("arrive", Ego(), time=time, tense=tense))
        case Junction(form="junction") if tense == "present":
            return Related("same-as", thing, Junction(rank=1), time, tense)  # "our turning"
        case Junction() | Feature():
            return Exists(thing, time, tense)
    return None


def _deed_judged(clause: Clause) -> Event | None:
    """Return the deed that a clause judges: "was stopping a mistake", "... right to stop"."""
    undone = clause.infinitive is not None and clause.infinitive.negated
    deed = clause.subject if isinstance(clause.subject, Event) else clause.inner
    return None if undone else deed


def _mistake(clause: Clause, deed: Event) -> Proposition:
    tense = tense_of(clause)
    return Is("wrong", None, with_fields(deed, tense=tense), time=clause.time, tense=tense)


def _noun_state(clause: Clause, sem: Noun, subject: Thing, time: Time) -> Proposition:
    quality = _quality(clause) if sem.key == "ride" else None
    if quality is not None:  # "was this a safe ride?"
        return Is(cast(Any, quality), Unknown(sem.word), time=time, tense=tense_of(clause))
    if sem.key == "fault":
        event = sem.clause.event if isinstance(sem.clause, Happens) else None
        thing = as_thing(sem.owner) or as_thing(sem.of) or subject
        return Is("at-fault", thing, event, time=time, tense=tense_of(clause))
    if sem.key == "danger":
        return Is("dangerous", subject, time=time, tense=tense_of(clause))
    if sem.key == "problem":
        return Is("wrong", subject, time=time, tense=tense_of(clause))
    if sem.key in ("option", "plan") and sem.negative:
        return Not(Is("possible", subject, time=time, tense=tense_of(clause)))
    if sem.key in ("prediction", "wrong-prediction"):
        deed = _deed_judged(clause)
        if deed is not None:
            return _mistake(clause, deed)
        return Is("wrong", subject, time=time, tense=tense_of(clause))
    if sem.key == "truth":
        return Is("right", subject, time=time, tense=tense_of(clause))
    if sem.key in ("reason", "factor"):
        deed = next((one for one in (sem.about, sem.of) if isinstance(one, Event)), None)
        return Caused(subject, sem.clause if deed is None else Happens(deed))
    return Related("same-as", subject, Unknown(sem.word), time, tense_of(clause))


def _quality(clause: Clause) -> str | None:
    """Give what is said of a ride before its noun: "safe" of "a safe ride"."""
    leaves = leaves_of(clause.objects[0][1])
    return next((_QUALITIES[leaf.key] for leaf in leaves if leaf.key in _QUALITIES), None)


def against(clause: Clause, thing: Thing, phrase: Complement) -> Proposition:
    """Read "over the limit", "under the limit"."""
    measure = cast(Measure, phrase.sem)
    attribute: Any = "speed" if measure.of.attribute == "limit" else measure.of.attribute
    below = any(word in ("under", "below", "within") for word in words_of(phrase.node).split())
    left = Measured(attribute, thing, time=clause.time, tense=tense_of(clause))
    if phrase.key in ("at", "into"):  # "back up to the limit"
        return Compares(left, "at-least", measure.of)
    return Compares(left, "less" if below else "more", measure.of)


def arrived(clause: Clause) -> Proposition:
    """Read "are we there yet" as having arrived."""
    tense: Any = "perfect" if clause.tense == "present" else clause.tense
    if "long" in clause.manner:  # "are we going to be here forever?"
        return Happens(Event("stand", Ego(), manner=("long",), time=clause.time, tense=tense))
    return Happens(Event("arrive", Ego(), time=clause.time, tense=tense))


UNITS = {"m/s": "speed", "m": "distance", "s": "time", "%": "probability"}  # what they measure


def _of_number(subject: object, value: float) -> str:
    """Tell what a number is that is said of a subject: "it is thirty here", "we're 30"."""
    if isinstance(subject, Pronoun) and subject.form in _FACTS:
        return "limit" if value in LIMITS else "count"
    moves = isinstance(subject, Ego | Vehicle | Described | Pronoun) and value >= SLOWEST
    return "speed" if moves else "count"


def _numbered(clause: Clause, sem: Quantity) -> Proposition:
    subject = clause.subject
    measured = subject.of if isinstance(subject, Measure) else None
    if measured is None:
        attribute = UNITS.get(sem.unit, "count")
        if attribute == "count":
            attribute = _of_number(subject, sem.value)
            sem = sem if attribute == "count" else as_speed(sem)
        if attribute == "limit":
            return Compares(Measured("limit", time=clause.time), "same", sem)
        measured = _measured(attribute, as_thing(subject) or Ego(), clause, clause.time)
    return Compares(measured, "same", sem)


def beyond(clause: Clause, thing: Thing, sem: Quantity, words: str) -> Proposition:
    """Read "over 50", "under ten metres": a bare number is a speed."""
    attribute = UNITS.get(sem.unit, "speed")
    if sem.unit == "count":
        sem = Quantity(round(sem.value / 3.6, 6), "m/s")
    below = words.split()[0] in ("under", "below", "within")
    measured = with_fields(_measured(attribute, thing, clause, clause.time), tense=tense_of(clause))
    return Compares(cast(Measured, measured), "less" if below else "more", sem)


def _measured(attribute: str, thing: Thing, clause: Clause, time: Time) -> Measured:
    """Say what is measured: "it is 20 metres to the bus" is our distance to it."""
    to = next((as_thing(c.sem) for c in clause.complements if c.key in ("into", "from")), None)
    if attribute != "distance" or to is None:
        return Measured(cast(Any, attribute), thing, time=time)
    return Measured("distance", Ego() if isinstance(thing, Pronoun) else thing, to, time=time)


def tense_of(clause: Clause) -> Any:
    """Tell the tense of a clause."""
    return clause.tense
