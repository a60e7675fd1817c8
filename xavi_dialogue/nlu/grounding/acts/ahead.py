"""Ahead: what is asked of the present or of another world, and is of our driving to come.

"Do we have to stop up there?" is to come while we do not stop yet. "Would we be in the right lane
without him?" asks whether we would have changed it.
"""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Act, Ask, WhatIf, Whether
from xavi_dialogue.domain.terms import (
    Ego,
    Event,
    Feature,
    Happens,
    Junction,
    Lane,
    Related,
    Relative,
    Time,
    Unsaid,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.grounding.context import Grounder

HALTING: Final = frozenset[ActionName](("stop", "wait", "brake", "slow-down", "stand"))


def to_come(spoken: Act, g: Grounder) -> Act:
    """Take what we have to do, and do not do yet, for what is to come."""
    match spoken:
        case Ask(question=Whether(Happens(Event(actor=Ego(), object=None) as event)) as asked):
            due = event.action in HALTING and event.tense == "present" and event.modal == "must"
            if due and _is_open(event.time) and not event.manner and not _halts(g):
                return Ask(replace(asked, that=Happens(replace(event, tense="future"))))
    return spoken


def _is_open(time: Time) -> bool:
    """Tell whether no time is named, or a place on our way: "at the junction"."""
    match time:
        case Unsaid() | Relative("during", Junction() | Feature()):
            return True
    return False


def _halts(g: Grounder) -> bool:
    """Tell whether we stand, or slow down, now."""
    now = g.context.now
    on = g.context.deeds(Ego(), max(g.context.begin, now - 0.5), now)
    return any(e.action in HALTING and e.end is None for e in on)


def in_lane(spoken: Act, g: Grounder) -> Act:
    """Take being in a lane in a supposed world for having kept to it, or moved to it."""
    match spoken:
        case Ask(
            question=WhatIf(
                supposed,
                Whether(
                    Related("on", Ego(), Lane(which="left" | "right" as side, of=None))
                ) as then,
            )
        ):
            here = _is_here(side, g)
            if here is None:
                return spoken
            moves: ActionName = "change-left" if side == "left" else "change-right"
            action: ActionName = moves if here else "keep-lane"
            lane = None if here else Lane(side)
            deed = Event(action, Ego(), lane, tense="past", modal="would")
            return Ask(WhatIf(supposed, Whether(Happens(deed), then.tag)))
    return spoken


def _is_here(side: str, g: Grounder) -> bool | None:
    """Tell whether we are in the lane on a side; None where there is one lane, or none is known."""
    road = g.context.world.road(g.context.now)
    place = None if road is None else road.places.get(0)
    if place is None or place.lane is None or place.lanes < 2:
        return None
    return place.lane == (place.lanes - 1 if side == "left" else 0)
