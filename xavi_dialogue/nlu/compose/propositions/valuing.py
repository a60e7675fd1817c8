"""Valuing: predicates that rate what may happen, or prefer one deed to another."""

from typing import Any

from xavi_dialogue.domain.terms import (
    At,
    Believed,
    Compares,
    Ego,
    Event,
    Happens,
    Measured,
    Not,
    Pronoun,
    Proposition,
    Quantity,
    That,
    Unsaid,
)
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.nominal import done_by, event_in
from xavi_dialogue.nlu.compose.clauses.sem import as_thing
from xavi_dialogue.nlu.compose.verbs.deeds import event_of, tense_of, time_of
from xavi_dialogue.nlu.compose.verbs.expecting import feared


def rated(special: Special, about: Proposition) -> Proposition:
    """Read "you rated the lorry turning right at 91 percent"."""
    sems = tuple(special.match.phrases.values())
    event = next((e for sem in sems if (e := event_in(sem)) is not None), None)
    if event is not None:
        about = Happens(done_by(event, special.match.second, special.match.object))
    for sem in sems:
        if isinstance(sem, Quantity) and not isinstance(about, That):
            measured = Measured(
                "probability", about=about, time=time_of(special), tense=tense_of(special)
            )
            return Compares(measured, "same", sem)
    return believed(special, about)


def believed(special: Special, about: Proposition) -> Proposition:
    """Read what was believed, and how likely: "that it would turn, at 91 percent"."""
    clause, time = special.clause, time_of(special)
    inner = (clause, clause.that, clause.gerund, clause.infinitive)
    share = next((c.share for c in inner if c is not None and c.share is not None), None)
    if share is None or not isinstance(about, Happens):
        return Believed(feared(about), time, tense_of(special))
    if isinstance(time, Unsaid) and isinstance(about.event.time, At):
        time, about = about.event.time, Happens(with_fields(about.event, time=Unsaid()))
    measured = Measured("probability", about=about, time=time, tense=tense_of(special))
    return Compares(measured, "same", share)


def preferred(special: Special) -> Proposition:
    """Read "stopping came out ahead of going on", "you put a stop before it"."""
    second: Any = next(iter(special.match.phrases.values()), special.object)
    if isinstance(special.content, Happens):
        second = with_fields(special.content.event, actor=Ego())
    first = special.clause.subject if special.name == "prefer" else special.object
    return Compares(_valued(first, special), "more", _valued(second, special))


def given_up(special: Special) -> Proposition:
    """Read "you dropped continue" as not doing it."""
    if isinstance(special.object, Event):
        return Not(Happens(special.object))
    return Happens(event_of(special, "change-plan", None))


def shifted(special: Special) -> Proposition:
    """Read "you went from turning to stopping": the one is valued more from then on."""
    named = special.match.phrases
    then: Any = named.get("into")
    if isinstance(special.content, Happens):
        then = special.content.event
    return Compares(_valued(then, special), "more", _valued(named.get("from"), special))


def _valued(sem: Any, special: Special) -> Measured:
    time, tense = time_of(special), tense_of(special)
    if isinstance(sem, Event):
        deed = with_fields(sem, actor=Ego())
        return Measured("value", event=deed, time=time, tense=tense)
    return Measured("value", as_thing(sem) or Pronoun("that"), time=time, tense=tense)
