"""Simulations: counts of what a decision simulated or chose from, and what is counted of them."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import HowMany, HowMuch, Question
from xavi_dialogue.domain.terms import Described, Event, Happens, Is, Measured, Pronoun
from xavi_dialogue.nlu.grounding.context import Grounder

COUNTED: Final = frozenset(("simulations", "options"))


def of_them(spoken: Question, g: Grounder) -> HowMuch | None:
    """Take "how many of them crashed?" for simulations, where these were just counted."""
    counted = g.context.discourse.question
    if not isinstance(counted, HowMuch) or counted.of.attribute != "simulations":
        return None
    match spoken:
        case HowMany(of=Described(kind="vehicle", among=Pronoun() | None) as of) if (
            ending := _ending(of)
        ) is not None and of.definite is False:
            g.notes.leaned = True
            return HowMuch(replace(counted.of, event=ending))
    return None


def _ending(of: Described) -> Event | None:
    match of.such:
        case Is(event=Event() as event) | Happens(event=event):
            return Event(event.action, tense="past")
    return None if of.doing is None else Event(of.doing.action, tense="past")


def plain(spoken: Measured) -> Measured:
    """Leave out "for that decision": the time tells which one is meant."""
    match spoken.about:
        case Happens(event=Event(action="do")):
            return replace(spoken, about=None)
    return spoken
