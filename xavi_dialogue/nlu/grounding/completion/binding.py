"""Binding: what pronouns and omissions in the time of a question stand for in that question.

"When it first came into view" is of the vehicle asked about, and "when we did" of what was done.
"""

from typing import Final, TypeVar

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Ask, Claim
from xavi_dialogue.domain.rewriting import first, parts, substitute
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Pronoun,
    Relative,
    Thing,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.context import Grounder
from xavi_dialogue.nlu.grounding.events.anchors import points

Spoken = TypeVar("Spoken", Ask, Claim)
_SPOKEN: Final = ("it", "he", "she", "that", "this", "one")
_MEETING: Final = ("pass", "overtake")  # whom, where nobody is said


def bound(spoken: Spoken, g: Grounder) -> Spoken:
    """Bind the event that a question or claim is timed by to the rest of it."""
    time = first(spoken, Relative)
    if time is None or not isinstance(time.anchor, Event) or points(time.anchor):
        return spoken
    rest = substitute(spoken, time, Unsaid())
    anchor = _done(time.anchor, first(rest, Event))
    named = _named(rest)
    if named is None:
        return substitute(_taken_up(spoken, rest, time, g), time, replace(time, anchor=anchor))
    vague = first(anchor, Pronoun)
    met = anchor.action in _MEETING and anchor.actor == Ego() and anchor.object is None
    if not met and (vague is None or vague.form not in _SPOKEN):
        return substitute(spoken, time, replace(time, anchor=anchor))
    known = g.thing(named, g.window(Unsaid(), "past"))
    if not isinstance(known, Vehicle):
        return spoken
    anchor = replace(anchor, object=known) if met else substitute(anchor, vague, known)
    return substitute(substitute(spoken, time, replace(time, anchor=anchor)), named, known)


def _done(anchor: Event, main: Event | None) -> Event:
    """Put what the question is about in the place of "did": "has he braked when we did?"."""
    vague = anchor.object is None or anchor.object == Pronoun("it")
    if anchor.action != "do" or not vague or main is None or main.action == "do":
        return anchor
    return replace(main, actor=anchor.actor, object=None, time=Unsaid(), tense=anchor.tense)


def _named(rest: object) -> Described | Vehicle | None:
    """Find the one vehicle that is named."""
    number = first(rest, Vehicle)
    told = (thing for thing in parts(rest, Described) if thing.definite and not thing.plural)
    return number or next(told, None)


def _taken_up(spoken: Spoken, rest: Spoken, time: Relative, g: Grounder) -> Spoken:
    """Let "how fast was it when the bus passed us" be of the bus."""
    vague = first(rest, Pronoun)
    actor: Thing | None = time.anchor.actor if isinstance(time.anchor, Event) else None
    if vague is None or vague.form not in _SPOKEN or not isinstance(actor, Described | Vehicle):
        return spoken
    known = g.thing(actor, g.window(Unsaid(), "past"))
    return substitute(spoken, vague, known) if isinstance(known, Vehicle) else spoken
