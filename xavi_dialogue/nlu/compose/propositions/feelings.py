"""Feelings: what verbs such as "worry" and "surprise" say of the road."""

from typing import Final

from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Happens,
    Is,
    Next,
    Passenger,
    Pronoun,
    Proposition,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.sem import as_thing
from xavi_dialogue.nlu.compose.verbs.deeds import tense_of, time_of

_FEARING: Final = frozenset({"feel:nervous", "feel:afraid"})


def felt(name: str, special: Special) -> Proposition:
    """Return what a verb of feeling says: of a danger, somebody in our way, a surprise, comfort."""
    if name in _FEARING and special.clause.modal in ("should", "must"):
        return Is("dangerous", Ego(), time=time_of(special), tense=tense_of(special))  # "worry"?
    feared = next((x for x in (special.subject, special.object) if isinstance(x, Wanted)), None)
    if name in _FEARING and feared is not None:  # "who worries you most?"
        return Is("dangerous", feared, time=Next(), tense="future")
    if name == "feel:surprised" and isinstance(as_thing(special.object), Ego):
        by = special.subject  # who surprises us does not do what we expected
        named = isinstance(by, Vehicle | Pronoun) or (isinstance(by, Described) and by.definite)
        whom = by if named else Ego()
        return Is("wrong", whom, time=time_of(special), tense=tense_of(special))
    if isinstance(special.object, Event):  # "how did you feel about that braking?"
        return Is("comfortable", event=special.object, time=time_of(special), tense="past")
    return Is("comfortable", as_thing(special.object) or Passenger())


def sensed(special: Special) -> Proposition | None:
    """Read "I felt us brake" as slowing down: how strong it was is not felt."""
    match special.content:
        case Happens(event=Event(action="brake", manner=()) as braking):
            return Happens(with_fields(braking, action="slow-down"))
    return special.content
