"""Showing: "red?", "the light?" as asked of the light before us; "cars?" of who is there."""

from typing import Final

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Doing,
    Elliptic,
    HowKnow,
    HowLong,
    HowMany,
    HowMuch,
    HowSure,
    Listing,
    Question,
    WhatIf,
    When,
    Where,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Described, Ego, Event, Exists, Feature, Happens, Has, Vehicle
from xavi_dialogue.nlu.grounding.context import Grounder
from xavi_dialogue.nlu.grounding.things.lights import LIGHT, LIT

#: Questions that may be asked of a light as they were of something else.
_ALIKE: Final = (Where, When, HowLong, Why, WhatIf)

#: Questions that "the red one?" does not carry over to a vehicle, where they are of ours.
_OURS: Final = (HowMuch, HowLong, HowKnow, HowSure, When, Whether)
_COUNTS: Final = (HowMany, Listing, Which)  # questions that are asked of others likewise
SINCE: Final = 5.0  # [s] since the last question, after which what began meanwhile is meant
_HALTS: Final = frozenset(("stop", "stand", "brake", "slow-down"))


def showing(spoken: Elliptic, question: Question | None, g: Grounder) -> Act | None:
    """Ask what the light shows, where a fragment names it, or a colour of lights alone."""
    thing = spoken.thing
    if spoken != Elliptic(thing, form="same"):
        return None
    if thing == LIGHT and _in_view(g):
        far = isinstance(question, HowMuch) and question.of.attribute == "distance"
        return None if far or isinstance(question, _ALIKE) else Ask(Doing(LIGHT))
    if not isinstance(thing, Described):
        return None
    if thing == Described(kind=thing.kind, plural=True, definite=False):  # "cars?", "any bikes?"
        return None if isinstance(question, _COUNTS) else Ask(Whether(Exists(thing)))
    if thing.colour not in LIT:
        return None
    ours = question is None or (isinstance(question, _OURS) and first(question, Vehicle) is None)
    if thing != Described(colour=thing.colour) or not ours or _is_named(thing.colour, g):
        return None
    if not _in_view(g):
        return None
    return Ask(Whether(Has("colour", thing.colour, LIGHT)))


def _in_view(g: Grounder) -> bool:
    now = g.context.now
    shown = g.context.holds(Event("show", Feature("light")), now, now)
    return any(one.end is None or one.end >= now for one in shown)


def _is_named(colour: str, g: Grounder) -> bool:
    """Tell whether a vehicle of that colour was spoken of in the last turn."""
    discourse = g.context.discourse
    fresh = (m.thing for m in discourse.mentions if m.turn >= discourse.turn - 1)
    looks = (g.context.look(v.number, g.context.now) for v in fresh if isinstance(v, Vehicle))
    return any(look is not None and look.colour == colour for look in looks)


def anew(spoken: Elliptic, g: Grounder) -> Act | None:
    """Read "what is it now?" as why we stand or brake, where that began since the last question."""
    asked, now = g.context.discourse.asked_at, g.context.now
    if spoken != Elliptic(form="why") or asked is None or now - asked < SINCE:
        return None
    on = [e for e in g.context.deeds(Ego(), asked, now) if e.end is None and e.begin > asked]
    halts = [e.action for e in on if e.action in _HALTS]
    if not halts:
        return None
    action = "stand" if "stop" in halts or "stand" in halts else halts[-1]
    return Ask(Why(Happens(Event(action, tense="present"))))
