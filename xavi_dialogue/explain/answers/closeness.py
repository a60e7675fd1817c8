"""Closeness: how near a vehicle came, how soon it could have been hit, and what the risk was."""

from typing import Literal

from xavi_dialogue.domain.answers import Closeness
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.explain.answers.asked import Asked
from xavi_dialogue.explain.answers.foreseen import collision_chance
from xavi_dialogue.explain.answers.moments import SHORT, Window

How = Literal["safe", "dangerous", "close", "hit", "room"]
NEARER = 0.5  # [m] by which a vehicle was nearer at another time
URGENT = 10.0  # [s] beyond which a time to collision says nothing


def closeness(
    asked: Asked, vehicle: int | None, about: Window, how: How, *, past: bool = True
) -> Closeness:
    """Tell how close a vehicle came in a stretch of the ride, or the one that came closest.

    Args:
        asked: the act and its setting.
        vehicle: the one asked about; None: whichever came closest.
        about: the stretch of the ride.
        how: what was asked.
        past: whether it is asked of what lies behind; else of now and what is to come.
    """
    near = about.widened() if about.instant else about
    seen = near if past else Window(asked.now, asked.now)  # a present tense speaks of now
    who = nearest_vehicle(asked, seen) if vehicle is None else vehicle
    risk = collision_chance(asked, about.begin if past else asked.now, vehicle)
    if who is None:
        return Closeness(None, None, None, risk, how, about.end, past)
    closest = closest_approach(asked, who, seen)
    ever = closest_approach(asked, who, Window(asked.world.begin, asked.now))
    least, then = ever.value or 0.0, closest.value
    nearer = then is not None and least < then - NEARER
    soon = shortest_time(asked, who, near)
    return Closeness(who, closest, soon, risk, how, about.end, past, overall=not nearer)


def closest_approach(asked: Asked, vehicle: int, about: Window) -> Measure:
    """Give the smallest distance between a vehicle and us in a stretch of the ride."""
    world = asked.world
    begin, end = max(about.begin, world.begin), min(about.end, asked.now)
    if end - begin <= SHORT / 10.0:
        return world.measure("distance", Ego(), end, Vehicle(vehicle))
    return world.extreme("distance", Ego(), "lowest", begin, end, Vehicle(vehicle))


def shortest_time(asked: Asked, vehicle: int, about: Window) -> Measure | None:
    """Give the shortest time to a collision in a stretch of the ride, where it was ever short."""
    begin, end = max(about.begin, asked.world.begin), min(about.end, asked.now)
    found = asked.world.extreme("time-to-collision", Ego(), "lowest", begin, end, Vehicle(vehicle))
    short = found.value is not None and found.value <= URGENT
    return found if short else None


def nearest_vehicle(asked: Asked, about: Window) -> int | None:
    """Give the vehicle that came closest to us in a stretch of the ride."""
    found = ((v, closest_approach(asked, v, about)) for v in asked.world.vehicles)
    ranked = [(m.value, v) for v, m in found if m.value is not None]
    return min(ranked, default=(0.0, None))[1]
