"""Who is in another vehicle's way, as it is said where that vehicle brakes or stands."""

from dataclasses import dataclass

from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Tense
from xavi_dialogue.language.morphology import EGO, Doing, Vehicle
from xavi_dialogue.language.quantities import Quantity

KNOWN = 0.67  # probability from which a goal is spoken of in passing
STANDSTILL = 0.5  # [m/s] slower than this counts as standing


@dataclass(frozen=True, slots=True)
class InTheWay:
    """Whom another vehicle gives way to, or has in its way."""

    vehicle: Vehicle
    me: bool  # it is us
    past: bool
    yields: bool  # gives it right of way; else it is ahead, or gets in its way
    cuts_in: bool
    standing: bool  # whoever is in the way stands
    speed: Quantity  # of whoever is in the way
    probability: float
    chance: Quantity
    aim: Doing | None  # what the vehicle does once it has given way


def in_the_way(
    tense: Tense, found: Explanation, actor: int, aims: tuple[str, ...]
) -> InTheWay | None:
    """Whom a vehicle gives way to or has in its way, and which of its aims come after that."""
    cause = found.causes[0] if found.causes else None
    if cause is None or cause.mechanism is None:
        return None
    mechanism, activity = cause.mechanism, found.activity
    speed = mechanism.speed_to or 0.0
    known = activity is not None and (activity.probability or 0.0) >= KNOWN and not found.rival
    turns = known and aims not in ((), ("continue",), ("stop",))
    return InTheWay(
        vehicle=Vehicle(cause.vehicle),
        me=cause.vehicle == EGO,
        past=tense == "past",
        yields=mechanism.how == "right-of-way",
        cuts_in=mechanism.how == "cut-in",
        standing=speed < STANDSTILL,
        speed=Quantity(speed, "km/h"),
        probability=mechanism.share,
        chance=Quantity(mechanism.share, "probability"),
        aim=Doing(actor, aims, tense) if turns else None,
    )
