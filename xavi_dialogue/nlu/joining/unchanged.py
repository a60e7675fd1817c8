"""Unchanged: what is supposed to go on as it does supposes nothing: "if we carry on like this"."""

from typing import Final

from xavi_dialogue.domain.meaning import Act, Ask, HowLong, HowMuch, WhatIf, When, Where, Whither
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Happens,
    Nobody,
    Not,
    Pronoun,
    Proposition,
    Unsaid,
)

_GOING_ON: Final = frozenset(("continue", "keep-lane", "follow"))
_PLAIN = (HowMuch, When, HowLong, Where, Whither)


def as_it_is(act: Act) -> Act:
    """Ask "when do we arrive if we carry on like this" plainly."""
    match act:
        case Ask(question=WhatIf(supposed=supposed, then=then)) if isinstance(
            then, _PLAIN
        ) and _goes_on(supposed):
            return Ask(then)
    return act


def _goes_on(of: Proposition) -> bool:
    match of:
        case Happens(event=Event(action="change-plan", actor=Nobody())):
            return True  # "if nothing changes"
        case Happens(event=Event(actor=Ego(), tense="present", modal=None) as event):
            plain = isinstance(event.time, Unsaid) and event.side is None and event.then is None
            return plain and not event.manner and event.action in _GOING_ON
        case Happens(event=Event(action="go", actor=Pronoun("this" | "that" | "it"), modal=None)):
            return True  # "if this goes on"
        case Not(content=Happens(event=Event(action="change-plan" | "overtake" | "change-lane"))):
            return True  # "if we don't get past him"
    return False
