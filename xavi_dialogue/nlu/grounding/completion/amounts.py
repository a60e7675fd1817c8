"""Amounts: "by how much?" and "until when?", asked of what the question before was about."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import (
    Compare,
    HowMuch,
    HowSure,
    Listing,
    Question,
    WhatIf,
    When,
    Whether,
    Why,
)
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Event,
    Feature,
    Happens,
    Has,
    Is,
    Measured,
    Proposition,
    Related,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.completion.discussion import asserted, proposition_of
from xavi_dialogue.nlu.grounding.context import Context

_PACED: Final = frozenset(("slow-down", "brake", "speed-up", "stop"))
_HALTED: Final = frozenset(("stand", "wait", "stop", "give-way"))
_DELAY: Final = HowMuch(Measured("delay"))


def by_how_much(question: Question | None, context: Context) -> Question | None:
    """Ask for the difference, or the amount, of what was asked about; None: it has none."""
    if (apart := difference(question, context)) is not None:
        return apart
    match question:
        case WhatIf():
            return replace(question, then=_DELAY)
        case Compare(options=(Happens(event=Event(actor=Ego()) as event),), by="time" | "best"):
            return WhatIf(Happens(replace(event, modal=None)), _DELAY)
        case Compare(options=(Ego() | Vehicle() as one, Ego() | Vehicle() as other), by="speed"):
            return HowMuch(Measured("speed", one, other))
        case Compare() | HowMuch() | HowSure() | Listing(of="rivals" | "options"):
            return question
        case Whether(that=Compares() | Is(state="late")):
            return question
    deed = first(question, Event)
    if isinstance(question, Why | Whether) and deed is not None and deed.action in _PACED:
        return Whether(Happens(deed))  # its answer tells from how much to how much
    return None


def difference(question: Question | None, context: Context) -> HowMuch | None:
    """Give what "and by how much?" asks after a comparison of speeds."""
    match proposition_of(question) or asserted(context):
        case Compares(left=Measured(attribute="speed") as left, right=right):
            if isinstance(right, Measured) and right.attribute == "limit":
                return HowMuch(replace(left, attribute="excess"))
            if isinstance(right, Measured):
                return HowMuch(replace(left, to=right.thing))
    return None


def until_when(question: Question | None, of: Proposition | None) -> Question | None:
    """Ask when it ends that was asked about: of a halt, when we go on."""
    event = first(of, Event)
    if event is not None and event.actor == Ego() and event.action in _HALTED:
        if event.tense == "present":
            return When(Happens(Event("go", tense="future")))
        return None if of is None else When(of, "end")
    match of:
        case Has(attribute="colour", thing=Feature(kind="light") as light, tense="present"):
            return When(Happens(Event("turn-colour", light, tense="future")))
        case Happens() | Is() | Related():
            return When(of, "end")
    return question if isinstance(question, When) else None
