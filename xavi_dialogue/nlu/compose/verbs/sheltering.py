"""Sheltering: somebody behind something, and somebody who comes out from behind it."""

from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.terms import (
    Described,
    Exists,
    Feature,
    Happens,
    Junction,
    Proposition,
    Related,
    Thing,
)
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import as_thing
from xavi_dialogue.nlu.compose.verbs.deeds import event_of, tense_of, time_of


def emerge(special: Special) -> Proposition:
    """Read "come out from behind the lorry"."""
    return Happens(event_of(special, "come", beside(special)))


def lurk(special: Special) -> Proposition:
    """Read "is hiding behind the lorry"; "is about to hide behind us" is a manoeuvre."""
    if cast(Any, special.clause.verb).form == "base":
        return Happens(event_of(special, "merge", beside(special)))
    to, time = beside(special), time_of(special)
    return Related("behind", special.subject, to, time, tense_of(special))


def beside(special: Special) -> Thing:
    """The thing behind the preposition; a junction or corner is one that cannot be seen round."""
    phrases = special.match.phrases
    keys = ("over", "bearing-around", "bearing-behind")
    to = next((as_thing(phrases[key]) for key in keys if key in phrases), None)
    return Feature("blind") if to is None or isinstance(to, Junction) else to


def concealed(clause: Clause) -> Exists | None:
    """Read "is anybody hidden behind the bus": whether there is anybody."""
    who = as_thing(clause.subject)
    hidden = clause.verb is None and "hidden" in {key for key, _ in clause.adjectives}
    where = [as_thing(c.sem) for c in clause.complements if c.key == "bearing-behind"]
    if not hidden or not isinstance(who, Described) or who.definite or where[:1] in ([], [None]):
        return None
    there = structs.replace(who, bearing="behind", of=where[0])
    return Exists(there, time=clause.time, tense=cast(Any, clause.tense))
