"""Causes named by what they are: "was it that blue one?", "so it was the light?"."""

from typing import Any, Final

from xavi_dialogue.domain.terms import (
    Caused,
    Described,
    Event,
    Feature,
    Happens,
    Junction,
    Pronoun,
    Proposition,
    Thing,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Sem, Specified, as_thing
from xavi_dialogue.nlu.compose.clauses.tree import words_of

CAUSED: Final = 0.05  # cost of another reading than that of a cause
_HINDERING: Final = ("light", "bend", "crossing", "queue", "obstacle")
_POINTING: Final = ("the", "that", "this", "those", "these")
_TURNS: Final = ("turn", "exit-left", "exit-right")


def cause_named(clause: Clause, subject: Thing, tense: Any) -> Caused | None:
    """Give what may have been the cause, where "it" is said to be that very thing.

    "Is it red?" names no thing, "is that a light?" none that is known. Whether a cause was asked
    for is left to grounding.
    """
    if not isinstance(subject, Pronoun) or subject.form not in ("it", "that", "this"):
        return None
    sem, node = clause.objects[0]
    words = words_of(node).split()
    if not words or words[0] not in _POINTING or clause.adjectives:
        return None
    if isinstance(sem, Event):
        plain = len(words) == 2 and tense == "past"
        return Caused(Junction()) if plain and sem.action in _TURNS else None
    match thing := as_thing(sem):
        case Described(colour=str(), definite=True) if {"one", "ones"} & {*words}:
            return Caused(thing)
        case Feature(kind=kind) if kind in _HINDERING:
            return Caused(thing)
    return None


def cleft(sem: Sem, subject: Thing) -> Proposition | None:
    """Read "it was the truck that made you stop": the clause, of the thing."""
    if not isinstance(subject, Pronoun):
        return None
    clause = sem.clause if isinstance(sem, Specified) else getattr(sem, "such", None)
    thing = as_thing(sem)
    if isinstance(thing, Described):
        thing = with_fields(thing, such=None, doing=None)
    if isinstance(clause, Caused) and isinstance(clause.cause, Wanted) and thing is not None:
        return Caused(thing, clause.effect)
    if isinstance(sem, Specified) and isinstance(clause, Happens):
        return Happens(with_fields(clause.event, actor=thing))
    return None
