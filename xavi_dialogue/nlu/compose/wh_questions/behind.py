"""Behind what: who is ahead of somebody, or holds him up: "what are we stuck behind?"."""

from dataclasses import replace
from typing import Any, Final, cast

from msgspec import structs

from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Feature,
    Happens,
    Is,
    Pronoun,
    Proposition,
    Related,
    Thing,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause, Complement
from xavi_dialogue.nlu.compose.clauses.sem import as_thing
from xavi_dialogue.nlu.compose.propositions.specials import proposition_of
from xavi_dialogue.nlu.compose.states.predicates import tense_of
from xavi_dialogue.nlu.grammar.chart import Node

#: What one does where one is held up.
_HELD: Final = frozenset({"stand", "sit", "wait", "queue", "line-up", "park", "hold"})
#: Where somebody stays, by where he is seen.
_PLACES: Final = {"ahead": "ahead-of", "behind": "behind", "left": "left-of", "right": "right-of",
                  "beside": "beside"}  # fmt: skip
_HINDERED: Final = frozenset({"stuck", "occupied"})
_STANDING: Final = frozenset({"stuck", "stationary"})
_DRIVEN: Final = frozenset({"drive", "travel", "crawl", "go"})


def by_whom(clause: Clause) -> None:
    """Take what is asked for as the doer of a "by" at the end: "who were we overtaken by?"."""
    told = [leaf for leaf in clause.particles if leaf.words == ("by",)]
    hindered = any(key in _HINDERED for key, _ in clause.adjectives)
    if not told or not isinstance(clause.gap, Wanted) or not (clause.passive or hindered):
        return
    clause.particles = [leaf for leaf in clause.particles if leaf not in told]
    doer = None if hindered else clause.gap
    clause.gap = clause.gap if hindered else None
    clause.complements.append(Complement("by", doer, Node("stranded", (), 0, 0, 0.0)))


def behind_what(clause: Clause) -> tuple[Clause, Proposition] | None:
    """Read a place without its thing as of what is asked for; None where no such place is named.

    "What are we stuck behind" and "who are we waiting behind" ask what holds us up, "who are we
    behind" and "who is the bus driving behind" who is ahead.
    """
    subject = as_thing(clause.subject)
    if not isinstance(clause.gap, Wanted) or subject is None or clause.objects:
        return None
    verb = "" if clause.verb is None else clause.verb.key
    stuck = any(key in _HINDERED for key, _ in clause.adjectives)
    still = verb in _HELD or any(key in _STANDING for key, _ in clause.adjectives)
    places = {bearing for bearing, _ in clause.bearings}
    places |= {c.key.removeprefix("bearing-") for c in clause.complements if c.sem is None}
    bare = replace(clause, gap=None, bearings=[])
    time, tense = clause.time, tense_of(clause)
    if (stuck and places) or (still and "behind" in places):
        return bare, Happens(Event("block", clause.gap, subject, time=time, tense=tense))
    open_ = not verb and not clause.adjectives and not clause.there
    if "behind" in places and (open_ or verb in _DRIVEN):
        ahead = Related("behind", subject, clause.gap, time, tense)
        return bare, ahead
    return None


def following(clause: Clause) -> Event | None:
    """Give the following that a place behind somebody stands for: "time lost behind the lorry"."""
    for phrase in clause.complements:
        if phrase.key == "in" and phrase.sem == Feature("queue"):
            return Event("wait", Ego(), tense=tense_of(clause))  # "time lost in the queue"
        whom = as_thing(phrase.sem) if phrase.key == "bearing-behind" else None
        if isinstance(whom, Described | Vehicle | Pronoun):
            return Event("follow", Ego(), whom, tense=tense_of(clause))
    return None


def blamed_for(clause: Clause) -> Thing | None:
    """Give who is said to have cost us time: "how much do we lose because of him?"."""
    cause = clause.because
    whom = None if isinstance(cause, Clause) else as_thing(cause)
    return whom if isinstance(whom, Described | Vehicle | Pronoun) else None


def staying(clause: Clause, value: object) -> Proposition | None:
    """Read "has the van been behind us", "was it in view" as where it was, not as which it is.

    The place behind a noun is read as part of its description.
    """
    thing = as_thing(clause.subject)
    named = isinstance(value, Is) and value.state == "present"
    if not isinstance(thing, Described) or not (value is None or named):
        return None
    place = thing.bearing or ""
    if clause.tense == "present" or (place != "around" and place not in _PLACES):
        return None
    there = structs.replace(thing, bearing=None, of=None)
    tense: Any = clause.tense
    if place == "around":
        return Is("visible", there, time=clause.time, tense=tense)
    return Related(cast(Any, _PLACES[place]), there, thing.of or Ego(), clause.time, tense)


def seen(value: Special) -> Proposition:
    """Take knowing of a vehicle for seeing it."""
    sems = (value.object, *value.match.phrases.values())
    thing = next((t for t in map(as_thing, sems) if t is not None), None)
    if thing is None:
        return proposition_of(value)
    return Related(
        "can-see", value.subject, thing, value.clause.time, cast(Any, value.clause.tense)
    )
