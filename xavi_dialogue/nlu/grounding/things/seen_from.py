"""Seen from another vehicle: "the car behind the lorry"."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.terms import Thing, Vehicle
from xavi_dialogue.domain.vocabulary import Bearing
from xavi_dialogue.nlu.grounding.context import Context
from xavi_dialogue.nlu.grounding.things import looks

_FROM: Final[dict[str, str]] = {
    "ahead": "ahead-of", "behind": "behind", "left": "left-of", "right": "right-of",
    "beside": "beside", "beside-left": "left-of", "beside-right": "right-of", "here": "near",
}  # fmt: skip
_IN_LINE: Final = ("ahead", "behind")


def seen_from(
    context: Context, bearing: Bearing, of: Thing, vehicle: int, moment: float
) -> float:  # fmt: skip
    """Weigh where a vehicle is, seen from another one."""
    if not isinstance(of, Vehicle) or of.number == vehicle:
        return 1.0
    mine, theirs = (context.look(n, moment) for n in (vehicle, of.number))
    if mine is None or theirs is None:
        return 1.0
    if bearing in _IN_LINE and _lanes_apart(context, vehicle, of.number, moment):
        return 1.0  # beside the lane of the lorry, nobody is in front of it
    relation = _FROM.get(bearing, "near")
    held = context.world.relation(relation, Vehicle(vehicle), of, moment)  # type: ignore[arg-type]
    if held is not None:
        return 0.0 if held else 1.0
    moved = replace(mine, bearing="around", ahead=mine.ahead - theirs.ahead,
                    left=mine.left - theirs.left, oncoming=False)  # fmt: skip
    return looks.bearing_cost(bearing, moved)


def _lanes_apart(context: Context, one: int, other: int, moment: float) -> bool:
    """Tell whether two vehicles are on the same road, but not in the same lane."""
    road = context.world.road(moment)
    here, there = (None if road is None else road.places.get(n) for n in (one, other))
    if here is None or there is None or here.edge != there.edge:
        return False
    return here.lane is not None and there.lane is not None and here.lane != there.lane
