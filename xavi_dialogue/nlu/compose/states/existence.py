"""Existence: "there is nobody behind us", "is anyone in that car": what is there, and where."""

from typing import Any

from xavi_dialogue.domain.meaning import Listing, Question
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Exists,
    Feature,
    Happens,
    Has,
    Is,
    Junction,
    Nobody,
    Not,
    Passenger,
    Pronoun,
    Proposition,
    Related,
    Relative,
    Thing,
    Unknown,
    Unsaid,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.nlu.compose.clauses.adoption import placed_on, with_fields
from xavi_dialogue.nlu.compose.clauses.clause import PASSED_OVER, Clause
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Noun, as_thing
from xavi_dialogue.nlu.compose.clauses.tree import words_of
from xavi_dialogue.nlu.compose.states.predicates import tense_of
from xavi_dialogue.nlu.compose.states.rooms import roomy

#: What we would be who are alone.
_ONLY = ("only car", "only one", "only vehicle", "only people", "only driver", "only traffic")
_DONE = frozenset({"past", "perfect"})
_TURNS = frozenset({"turn", "exit-left", "exit-right"})
Found = tuple[Proposition, float]


def existing(clause: Clause) -> list[Found]:
    """Compose "there is a car behind us", "is there room"."""
    if not clause.objects:
        return [(Exists(Described(definite=False), clause.time, tense_of(clause)), 0.6)]
    sem = clause.objects[0][0]
    thing = as_thing(sem)
    if isinstance(sem, Event) and sem.action in _TURNS:
        turn = Exists(Junction(), clause.time, tense_of(clause))
        return [(Not(turn) if words_of(clause.objects[0][1]).startswith("no ") else turn, 0.0)]
    if isinstance(sem, Event) and tense_of(clause) == "future":
        return [(Happens(with_fields(sem, tense="future", time=clause.time)), 0.0)]
    if isinstance(sem, Event) and sem.actor == Ego() and tense_of(clause) in _DONE:
        tense = tense_of(clause)
        return [(Happens(with_fields(sem, tense=tense, time=clause.time)), 0.0)]
    if isinstance(sem, Event) and isinstance(sem.actor, Described):
        doing = with_fields(sem, actor=Wanted(), tense=tense_of(clause))
        thing = with_fields(sem.actor, doing=doing)  # "there is a red car braking"
    if isinstance(sem, Noun):
        thing = Unknown(sem.word)
        if sem.key == "danger":
            return [(_danger(clause, sem), 0.0)]
        if sem.key == "problem":
            state: Proposition = Is(
                "wrong", Pronoun("that"), time=clause.time, tense=tense_of(clause)
            )
            return [(Not(state) if sem.negative else state, 0.1)]
    if thing is None:
        return [(Exists(Described(definite=False), clause.time, tense_of(clause)), 0.8)]
    if isinstance(sem, Measure) and sem.of.attribute == "weather":  # "suppose there was ice"
        return [(Has("weather", "bad", time=clause.time, tense=tense_of(clause)), 0.0)]
    if isinstance(sem, Measure) and (
        sem.of.attribute in ("gap", "distance") or words_of(clause.objects[0][1]) == "place"
    ):
        return [(roomy(clause, clause.time), 0.0)]
    if isinstance(thing, Feature) and thing.kind == "space":
        return [(roomy(clause, clause.time), 0.0)]
    inside = next((as_thing(c.sem) for c in clause.complements if c.key == "in"), None)
    if isinstance(inside, Described) and isinstance(thing, Described | Nobody):
        return [(Has("occupant", "", inside, clause.time, tense_of(clause)), 0.0)]
    if isinstance(thing, Described | Nobody) and (way := _way_of(clause)) is not None:
        in_way = Related("in-the-way-of", thing, way.of or Ego(), clause.time, tense_of(clause))
        return [(in_way, 0.0)]  # "is there anybody in our way"
    thing = _where(thing, clause)
    if isinstance(thing, Nobody):
        described = thing.described or Described(definite=False)
        return [
            (
                Not(Exists(_where(described, clause), clause.time, tense_of(clause))),
                0.0,
            )
        ]
    there: Proposition = Exists(thing, clause.time, tense_of(clause))
    denied = clause.objects and words_of(clause.objects[0][1]).startswith("no ")
    past = 0.0 if clause.that is None else PASSED_OVER
    return [(Not(there) if denied else there, past)]


def _way_of(clause: Clause) -> Feature | None:
    """Find the way that somebody is said to be in."""
    places = (as_thing(c.sem) for c in clause.complements if c.key in ("in", "on"))
    return next((p for p in places if isinstance(p, Feature) and p.kind == "way"), None)


def from_whom(clause: Clause) -> Thing | None:
    """Tell who "were we in danger from him", "are we safe from that lorry" names."""
    named = (as_thing(c.sem) for c in clause.complements if c.key in ("from", "of", "with", "by"))
    return next((one for one in named if isinstance(one, Described | Vehicle | Pronoun)), None)


def _danger(clause: Clause, noun: Noun) -> Proposition:
    """Read "was there ever any danger from him" as whether we were in danger."""
    whom = from_whom(clause) or Ego()
    tense = tense_of(clause)
    ever = "ever" in clause.focus and isinstance(clause.time, Unsaid) and tense != "present"
    state = Is("dangerous", whom, time=WholeRide() if ever else clause.time, tense=tense)
    return Not(state) if noun.negative else state


def if_alone(words: str, clause: Clause) -> Question | None:
    """Ask "are we the only car here?", "are we alone?": whom we can see."""
    ours = isinstance(clause.subject, Ego | Passenger) and clause.verb is None
    alone = any(phrase in words for phrase in _ONLY) or "alone" in words.split()
    return Listing("vehicles", time=clause.time) if ours and alone else None


def _where(thing: Thing, clause: Clause) -> Thing:
    """Add to a description where it is said to be."""
    if not isinstance(thing, (Described, Nobody)):
        return thing
    described = thing.described or Described(definite=False) if isinstance(thing, Nobody) else thing
    bearing: Any = next((b for b, _ in clause.bearings if b not in ("there", "here")), None)
    of: Thing | None = None
    for phrase in clause.complements:
        if phrase.key.startswith("bearing-") and bearing is None:
            bearing = phrase.key.removeprefix("bearing-")
            of = as_thing(phrase.sem)
        elif phrase.key == "after" and described.doing is not None:
            after = as_thing(phrase.sem)  # "after the red one, is anyone else coming?"
            if after is not None:
                doing = with_fields(described.doing, time=Relative("after", after))
                described = with_fields(described, doing=doing)
        elif phrase.key in ("in", "on", "at") and described.such is None:
            place = as_thing(phrase.sem)
            if place is not None:
                described = placed_on(described, phrase, place)
    if bearing is None or described.bearing is not None:
        return Nobody(described) if isinstance(thing, Nobody) else described
    of = None if isinstance(of, (Ego, Passenger)) else of
    described = with_fields(described, bearing=bearing, of=of)
    return Nobody(described) if isinstance(thing, Nobody) else described
