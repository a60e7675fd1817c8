"""Positions: "are we out yet", "is he through", "is it out of our way": a state told by a move."""

from typing import Any

from msgspec.structs import replace

from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Exit,
    Feature,
    Happens,
    Is,
    Junction,
    Measured,
    Not,
    Pronoun,
    Proposition,
    Related,
    Thing,
)
from xavi_dialogue.domain.vocabulary import ActionName, Comparator
from xavi_dialogue.nlu.compose.clauses.clause import Clause, Complement
from xavi_dialogue.nlu.compose.clauses.sem import Sem, as_thing
from xavi_dialogue.nlu.compose.clauses.tree import words_of
from xavi_dialogue.nlu.compose.verbs.lights import BY, on_light

#: What somebody has done who is so: "out" has come out.
_MOVED: dict[str, ActionName] = {"out": "pull-out", "off": "leave", "in": "enter"}
_LIMITED: dict[str, Comparator] = {
    "over": "more", "above": "more", "under": "less", "below": "less", "within": "at-most",
}  # fmt: skip
_OVER = frozenset(("through", "past", "over"))


_PLACES: dict[str, Thing] = {
    "leave": Exit(), "arrive": Destination(), "exit-left": Junction("junction", 1),
    "exit-right": Junction("junction", 1), "turn": Junction("junction", 1),
}  # fmt: skip


def place_of(deed: Proposition | None) -> Thing | None:
    """Give the place where a deed of ours is done: "where we get off", "where we turn"."""
    return _PLACES.get(deed.event.action) if isinstance(deed, Happens) else None


def stuck_at(clause: Clause, thing: Thing | None) -> Proposition | None:
    """Read who is stuck at a traffic light as waiting there; None where nothing tells."""
    places = [as_thing(on_light(c.key, c.sem, ())) for c in clause.complements if c.key in BY]
    light = next((p for p in places if isinstance(p, Feature) and p.kind == "light"), None)
    if light is None or thing is None:
        return None
    tense: Any = clause.tense
    return Happens(Event("wait", thing, light, time=clause.time, tense=tense))


def by_particle(clause: Clause) -> Proposition | None:
    """Read who is out, in, through or past as having moved so; None where nothing tells."""
    thing: Thing = as_thing(clause.subject) or Pronoun("it")
    tense: Any = clause.tense
    words = {leaf.key for leaf in clause.particles}
    if not words or any(bearing != "behind" for bearing, _ in clause.bearings):
        return None
    if words & _OVER:
        return Is("over", thing, time=clause.time, tense=tense)
    action = next((_MOVED[word] for word in _MOVED if word in words), None)
    if action is None:
        return None
    if action == "leave" and thing == Ego() and tense == "present":
        return Happens(Event("go", time=clause.time, tense=tense))  # "are we off now?"
    moved: Any = "perfect" if tense == "present" else tense
    return Happens(Event(action, thing, time=clause.time, tense=moved))


def passed(thing: Thing, place: Thing | None, phrase: Complement, clause: Clause) -> Happens | None:
    """Read "are we past it", "he is through the junction" as having passed it."""
    if place is None or words_of(phrase.node).split()[0] not in ("past", "beyond", "through"):
        return None
    tense: Any = "perfect" if clause.tense == "present" else clause.tense
    return Happens(Event("pass", thing, place, time=clause.time, tense=tense))


def exceeded(thing: Thing, it: Thing | None, phrase: Complement, clause: Clause) -> Compares | None:
    """Read "are we over it": of what one may be over that is no place, there is the limit."""
    first = words_of(phrase.node).split()[0]
    if first not in _LIMITED or not isinstance(it, Pronoun) or it.form not in ("it", "that"):
        return None
    tense: Any = clause.tense
    speed = Measured("speed", thing, time=clause.time, tense=tense)
    return Compares(speed, _LIMITED[first], Measured("limit", time=clause.time))


def by_event(clause: Clause, event: Event) -> Proposition | None:
    """Read "has something got in the way", "did he come too" as states that moves lead to."""
    where = event.where
    match where:
        case Related(relation="on", to=Feature(kind="way", of=whose)):
            now: Any = "present" if event.tense == "perfect" else event.tense
            return Related("in-the-way-of", event.actor, whose or Ego(), event.time, now)
    if event.action == "come" and "too" in clause.focus and not isinstance(event.actor, Ego):
        return Related("with", event.actor, Ego(), event.time, event.tense)
    return None


def by_origin(thing: Thing, place: Thing, clause: Clause) -> Proposition:
    """Read "out of the way" as not being in it; "from the left road" as coming from there."""
    tense: Any = clause.tense
    if isinstance(place, Feature) and place.kind == "way":
        there = Related("in-the-way-of", thing, place.of or Ego(), clause.time, tense)
        return Not(there, lexical=True)
    return Related("from", thing, place, clause.time, tense)


def placeless(sem: Sem) -> Sem:
    """Give a description without where the thing is."""
    return replace(sem, bearing=None, of=None) if isinstance(sem, Described) else sem
