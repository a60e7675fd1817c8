"""Propositions: who or what they are about, and when they are said to hold."""

from xavi_dialogue.domain.terms import (
    Believed,
    Both,
    Caused,
    Compares,
    Exists,
    Happens,
    Has,
    Is,
    Not,
    Proposition,
    Related,
    That,
    Thing,
)
from xavi_dialogue.nlu.projection.fields import FieldTense
from xavi_dialogue.nlu.projection.terms import plain, tense_of

#: The members of `Proposition`.
PROPOSITIONS = (*(Happens, Related, Is, Has, Compares, Exists, Caused, Believed, Not, Both, That),)


def subject(proposition: Proposition | None) -> Thing | None:
    """Return who or what a proposition is about."""
    match proposition:
        case Happens(event=event):
            return event.actor
        case Related(thing=thing) | Has(thing=thing) | Exists(thing=thing):
            return thing
        case Is(thing=thing, event=event):
            return thing if thing is not None or event is None else event.actor
        case Not(content=content) | Believed(content=content):
            return subject(content)
        case Compares(left=left):
            return left.thing if left.event is None else left.event.actor
        case Both(contents=contents) if contents:
            return subject(contents[0])
        case Caused(effect=effect):
            return subject(effect)
    return None


def tense(proposition: Proposition | None) -> FieldTense:
    """Return when a proposition is said to hold."""
    match proposition:
        case Happens(event=event):
            return tense_of(event)
        case Related(tense=said) | Has(tense=said) | Is(tense=said) | Exists(tense=said):
            return plain(said)
        case Not(content=content):
            return tense(content)
        case Believed(content=content):
            return tense(content)
        case Compares(left=left):
            return plain(left.tense)
        case Both(contents=contents) if contents:
            return tense(contents[0])
        case Caused(effect=effect):
            return tense(effect)
    return "past"
