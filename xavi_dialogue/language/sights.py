"""Content of answers to what is seen: how fast, how far, where, which colour, how many."""

from dataclasses import dataclass

from xavi_dialogue.explain.details import Sight
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.sights import ONCOMING
from xavi_dialogue.language.doings import doing, plain
from xavi_dialogue.language.morphology import EGO, Doing, Vehicle
from xavi_dialogue.language.quantities import KMH, Quantity, nearest
from xavi_dialogue.language.wording import lexicon

LISTED = 4  # vehicles that are named one by one


@dataclass(frozen=True, slots=True)
class SightPoint:
    """What is seen of a vehicle, or of all."""

    about: str
    mine: bool
    vehicle: Vehicle
    gone: Quantity | None  # when it was seen last, where it is out of view
    past: bool
    halted: bool
    trend: str | None
    speed: Quantity | None
    distance: Quantity | None
    place: str | None
    oncoming: bool
    asks_oncoming: bool  # it is asked whether it is
    colour: str | None
    nobody: str | None  # that nobody is where it is asked who is there ...
    then: bool  # ... or was, at an earlier time
    others: tuple[Vehicle, ...]  # where they are few enough to be listed
    many: Quantity  # how many there are
    forecast: Doing | None  # what is expected of it
    rival: Doing | None  # and almost as probably
    probability: float | None


def pace(speed: float | None, trend: str | None) -> str | None:
    """What a speed [m/s] is doing; one that would be told as 0 km/h is none."""
    return "standing" if speed is not None and nearest(speed * KMH) == 0 else trend


def sight_point(query: Query, found: Explanation, sight: Sight) -> SightPoint:
    """What to say of what is seen."""
    mine = sight.vehicle == EGO
    trend = pace(sight.speed, sight.trend)
    past = found.seen is not None and not mine
    activity = found.activity
    known = activity is not None and activity.vehicle == sight.vehicle and not mine
    actions = plain(activity.actions) if activity is not None and known else ()
    return SightPoint(
        about=sight.about,
        mine=mine,
        vehicle=Vehicle(sight.vehicle),
        gone=Quantity(found.seen, "clock") if past and found.seen is not None else None,
        past=past,
        halted=trend == "standing",
        trend=trend,
        speed=None if sight.speed is None else Quantity(sight.speed, "km/h"),
        distance=None if sight.distance is None else Quantity(sight.distance, "m"),
        place=sight.place,
        oncoming=sight.oncoming,
        asks_oncoming=query.event == ONCOMING,
        colour=sight.colour,
        nobody=lexicon().nobody_at(sight.place or "") if sight.about == "nobody" else None,
        then=found.then is not None,
        others=tuple(map(Vehicle, sight.others)) if len(sight.others) <= LISTED else (),
        many=Quantity(len(sight.others), "count"),
        forecast=doing(sight.vehicle, actions, "future"),
        rival=doing(sight.vehicle, plain(found.rival), "future") if known else None,
        probability=activity.probability if activity is not None else None,
    )
