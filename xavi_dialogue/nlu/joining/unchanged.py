"""Unchanged: what is supposed to go on as it does supposes nothing: "if we carry on like this".

What is asked beside another supposition is asked of that world, also in the present tense.
"""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    HowLong,
    HowMuch,
    WhatIf,
    When,
    Where,
    Whether,
    Whither,
)
from xavi_dialogue.domain.terms import (
    Both,
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
_HALTING: Final = frozenset(("stop", "brake", "avoid"))
_PLAIN = (HowMuch, When, HowLong, Where, Whither)


def as_it_is(act: Act) -> Act:
    """Ask "when do we arrive if we carry on like this" plainly."""
    match act:
        case Ask(question=WhatIf(supposed=supposed, then=then)) if isinstance(
            then, _PLAIN
        ) and _goes_on(supposed):
            return Ask(then)
        case Ask(question=WhatIf(then=Whether(that=Both() as both)) as question) if (
            hurt := spared(both)
        ) is not None:
            return Ask(replace(question, then=Whether(hurt)))
    return act


def spared(of: Proposition) -> Proposition | None:
    """Take "do you stop in time, or do we hit him" for the one question that it is."""
    parts = of.contents if isinstance(of, Both) and of.join == "or" else (of,)
    deeds = [part.event for part in parts if isinstance(part, Happens)]
    if len(deeds) < len(parts) or not all(isinstance(one.actor, Ego) for one in deeds):
        return None
    halts = [one for one in deeds if one.action in _HALTING]
    hits = [one for one in deeds if one.action == "collide"]
    if len(halts) + len(hits) < len(deeds) or any(e.tense in ("past", "perfect") for e in deeds):
        return None
    early = [one for one in halts if "early" in one.manner or one.modal in ("can", "could")]
    if not (early or hits):
        return None
    first = (early or hits)[0]
    return Happens(replace(first, modal=first.modal or "would"))


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
