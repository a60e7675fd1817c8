"""Hidden areas: what hides the road, who might come from there, and what if we saw past it."""

from typing import Any

from xavi_dialogue.domain.hidden_areas import AllRound, Hider, SightTold, SupposedSeeing
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.nlg.content.clauses.plan import Plan
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.surface.message import message
from xavi_dialogue.nlg.surface.values import Chance, Moment, Quantity, Who

SAVED = 0.5  # [s] minimum difference that matters


def plan_sight(answer: SightTold, context: SpeechContext) -> Plan:
    """Plan what we cannot see, and whether somebody might be there."""
    slots: dict[str, Any] = {
        "asked": answer.asked,
        "none": not answer.hiders,
        "past": answer.past,
        "slowed": answer.slowed,
        **_named(answer.hiders),
    }
    return Plan((message("SIGHT", **slots),))


def plan_all_round(answer: AllRound, context: SpeechContext) -> Plan:
    """Plan that we look to all sides, and who was nearest to us."""
    rows = tuple(
        message(
            "ALL_ROUND_ROW",
            who=Who(Vehicle(look.vehicle), look.time),
            far=Quantity(look.distance, "m"),
        )
        for look in answer.looks
    )
    told = message(
        "ALL_ROUND_NEAR", rows=rows, one=len(rows) == 1, past=answer.past, when=Moment(answer.time)
    )
    return Plan((message("ALL_ROUND"), told))


def plan_seeing(answer: SupposedSeeing, context: SpeechContext) -> Plan:
    """Plan what we would do if we could see past what hides the road."""
    saved = Quantity(answer.saved, "s") if answer.saved >= SAVED else None
    slots: dict[str, Any] = {
        "none": not answer.hiders,
        "past": answer.past,
        "saved": saved,
        **_named(answer.hiders),
    }
    return Plan((message("SEEING_PAST", **slots),))


def _named(hiders: tuple[Hider, ...]) -> dict[str, Any]:
    """Return the first two hiders: a vehicle by its look, a building by its side."""
    slots: dict[str, Any] = dict.fromkeys(("who", "side", "another", "aside", "chance"))
    names = (("who", "side"), ("another", "aside"))
    for one, (who, side) in zip(hiders, names, strict=False):
        slots[who] = None if one.vehicle is None else Who(Vehicle(one.vehicle))
        slots[side] = one.side
    if hiders:
        nobody = 1.0
        for one in hiders:
            nobody *= 1.0 - (one.probability or 0.0)
        known = any(one.probability is not None for one in hiders)
        slots["chance"] = Chance(1.0 - nobody) if known else None
    return slots
