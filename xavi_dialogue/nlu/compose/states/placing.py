"""Places: "it is behind us", "he is in our lane", "are we there": what is said with a place."""

from typing import Any, cast

from xavi_dialogue.domain.terms import (
    Both,
    Caused,
    Described,
    Ego,
    Event,
    Feature,
    Happens,
    Has,
    Is,
    Lane,
    Next,
    Passenger,
    Pronoun,
    Proposition,
    Quantity,
    Related,
    Thing,
    Unknown,
    Unsaid,
)
from xavi_dialogue.nlu.compose.clauses.adoption import is_crossing, with_fields
from xavi_dialogue.nlu.compose.clauses.clause import Clause, Complement
from xavi_dialogue.nlu.compose.clauses.followers import relation_of
from xavi_dialogue.nlu.compose.clauses.sem import Measure, as_thing, each_other
from xavi_dialogue.nlu.compose.clauses.tree import words_of
from xavi_dialogue.nlu.compose.states.positions import by_origin, by_particle, exceeded, passed
from xavi_dialogue.nlu.compose.states.predicates import against, arrived, beyond, tense_of

LOOSE = 0.25  # cost of a particle beside "be"
RELATIVE = 0.2  # cost of "past us" beside "be" where a relative clause may hold it
Found = tuple[Proposition, float]


def placed(clause: Clause) -> list[Found]:
    """Compose "it is behind us", "he is in our lane"."""
    thing = _still_there(clause) or as_thing(clause.subject) or Pronoun("it")
    time, tense = clause.time, tense_of(clause)
    for phrase in clause.complements:
        if (found := _by_phrase(clause, thing, phrase)) is not None:
            return [found]
    if clause.origin is not None:
        return [(Has("origin", clause.origin, thing, time, tense), 0.0)]
    moved = by_particle(clause)
    if moved is not None:
        return [(moved, -LOOSE)]
    if clause.bearings:
        return [_by_bearing(clause, thing)]
    if isinstance(clause.subject, Lane):
        return [(Is("free", thing, time=time, tense=tense), 1.0)]
    gap = as_thing(clause.gap)
    if gap is not None:
        if any(phrase.key == "with" for phrase in clause.complements):
            return [(Related("with", thing, gap, time, tense), 0.4)]  # "who would that be with?"
        return [(Related("same-as", thing, gap, time, tense), 0.4)]
    if isinstance(time, Next) and isinstance(thing, Ego | Pronoun | Described):
        going = Event("go", thing, None, None, ("first",), tense=tense, modal="should")
        return [(Happens(going), 0.1)]
    if not isinstance(time, Unsaid):
        return [(Is("present", thing, time=time, tense=tense), 0.5)]
    return []


def _still_there(clause: Clause) -> Thing | None:
    """Take "behind us" for what tells whom is meant: "is that fellow behind us still there?"."""
    sem = clause.subject
    phrase = next((c for c in clause.complements if c.key.startswith("bearing-")), None)
    if phrase is None or not isinstance(sem, Described) or sem.bearing is not None:
        return None
    if "there" not in [bearing for bearing, _ in clause.bearings]:
        return None
    of = as_thing(phrase.sem)
    clause.complements.remove(phrase)
    bearing: Any = phrase.key.removeprefix("bearing-")
    return cast(Thing, with_fields(sem, bearing=bearing, of=None if of == Ego() else of))


def in_lane(clause: Clause, state: str) -> list[Found]:
    """Compose "was it driving in our lane", "is it stopped in our lane": where it is, and so."""
    named = (as_thing(c.sem) for c in clause.complements if c.key in ("in", "on"))
    lane = next((place for place in named if isinstance(place, Lane)), None)
    thing = as_thing(clause.subject)
    if lane is None or thing is None or state not in ("moving", "stationary"):
        return []
    time, tense = clause.time, tense_of(clause)
    there = Related("on", thing, lane, time, tense)
    if state == "moving":
        return [(there, 0.0)]
    return [(Both((Is(cast(Any, state), thing, time=time, tense=tense), there)), 0.0)]


def _by_phrase(clause: Clause, thing: Thing, phrase: Complement) -> Found | None:
    """Compose what a phrase of place says of a thing; None where it names no place."""
    time, tense = clause.time, tense_of(clause)
    if isinstance(phrase.sem, Event) and phrase.key in ("on", "in", "at"):
        deed = with_fields(phrase.sem, actor=thing, time=time, tense=tense)
        return Happens(deed), 0.0  # "are you on the brakes"
    to = as_thing(phrase.sem)
    if to is not None and words_of(phrase.node).startswith("down to"):
        return Caused(to), 0.0  # "is that down to us?"
    if phrase.key.startswith("bearing-") and words_of(phrase.node).startswith("close "):
        vague = isinstance(thing, Ego | Passenger) or thing in (Pronoun("that"), Pronoun("this"))
        other = to if vague and to is not None else thing  # "that was close to the van"
        return Is("close", other, None, "too" in clause.focus, time, tense), 0.0
    if phrase.key.startswith("bearing-"):
        relation: Any = relation_of(phrase.key.removeprefix("bearing-"))
        return Related(relation, thing, to or as_thing(clause.gap) or Ego(), time, tense), 0.0
    if phrase.key == "over" and (limited := exceeded(thing, to, phrase, clause)) is not None:
        return limited, 0.0
    if phrase.key == "over" and (gone := passed(thing, to, phrase, clause)) is not None:
        moving = isinstance(thing, Described) and thing.doing is not None
        return gone, RELATIVE if moving else 0.0  # "the car that went past us"
    if phrase.key in ("in", "on") and isinstance(to, Feature) and to.kind == "way":
        return Related("in-the-way-of", thing, to.of or Ego(), time, tense), 0.0
    if isinstance(phrase.sem, Quantity) and phrase.key == "over":
        return beyond(clause, thing, phrase.sem, words_of(phrase.node)), 0.0
    paced = isinstance(phrase.sem, Measure) and phrase.sem.of.attribute in ("limit", "speed")
    if paced and phrase.key in ("over", "in", "at", "into"):
        return against(clause, thing, phrase), 0.0
    if to is not None and is_crossing(phrase, to) and not isinstance(thing, Ego):
        return Happens(Event("cross", thing, Ego(), time=time, tense=tense)), 0.0
    return None if to is None else _by_preposition(clause, thing, to, phrase.key)


def _by_preposition(clause: Clause, thing: Thing, to: Thing, key: str) -> Found | None:
    """Compose "from", "in" and "with" with the thing behind them."""
    time, tense = clause.time, tense_of(clause)
    if key == "from":
        return by_origin(thing, to, clause), 0.1
    if key in ("in", "on", "at", "into"):
        if isinstance(to, Unknown) and key != "on":
            return Related("on", thing, to, time, tense), 0.5
        relation: Any = "on" if not isinstance(to, Described) else "near"
        return Related(relation, thing, to, time, tense), 0.0
    if key == "with":
        return Related("with", thing, to, time, tense), 0.1
    if key == "between" and each_other(to) is not None:
        return Related("between", thing, to, time, tense), 0.0
    return None


def _by_bearing(clause: Clause, thing: Thing) -> Found:
    """Compose "it is ahead", "are we there", "is he still around"."""
    time, tense = clause.time, tense_of(clause)
    bearing, part = clause.bearings[0]
    if words_of(part).startswith("close"):
        return Is("close", thing, None, "too" in clause.focus, time, tense), 0.0
    if bearing in ("there", "here"):
        if isinstance(thing, Ego) and "still" in (*clause.focus, *clause.manner):
            return Happens(Event("keep-lane", thing, time=time, tense=tense)), 0.0
        if isinstance(thing, Ego) or (isinstance(thing, Passenger) and bearing == "there"):
            return arrived(clause), 0.0
        return Is("present", thing, time=time, tense=tense), 0.05
    if bearing == "around" and not isinstance(thing, Ego):
        return Is("visible", thing, time=time, tense=tense), 0.0
    return Related(cast(Any, relation_of(bearing)), thing, Ego(), time, tense), 0.0
