"""In lane: "would we be in the right lane without him?" asks whether we would have changed it."""

from xavi_dialogue.domain.meaning import Act, Ask, WhatIf, Whether
from xavi_dialogue.domain.terms import Ego, Event, Happens, Lane, Related
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.grounding.context import Grounder


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
