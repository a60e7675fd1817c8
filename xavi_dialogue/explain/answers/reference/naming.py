"""Naming: the vehicles that a term stands for, and refusals where there is none of that name."""

from typing import TypeAlias

from sim.scene import EGO
from xavi_dialogue.domain.answers import CannotSay, NoSuchVehicle
from xavi_dialogue.domain.facts import Look, Somebody
from xavi_dialogue.domain.terms import (
    Ego,
    Everyone,
    Feature,
    Nobody,
    Passenger,
    Thing,
    Unknown,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.vocabulary import Kind
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered

Somebodies: TypeAlias = tuple[Somebody, ...]
#: Kinds that passengers mean any vehicle by.
ANY: frozenset[Kind] = frozenset(("vehicle", "car"))
#: Kinds that nobody calls a car.
NO_CAR: frozenset[Kind] = frozenset(("pedestrian", "bicycle", "bike", "wheelchair", "scooter"))


def number(thing: Thing | None) -> int | None:
    """Give the number of another vehicle; None for all else."""
    return thing.number if isinstance(thing, Vehicle) else None


def is_building(thing: object) -> bool:
    """Tell whether it is a building, behind which nobody can be seen."""
    return isinstance(thing, Feature) and thing.kind == "building"


def is_us(thing: Thing | None) -> bool:
    """Tell whether it is our car, or whoever sits in it."""
    return isinstance(thing, Ego | Passenger)


def somebodies(asked: Asked, thing: Thing | None, at: float) -> Somebodies:
    """Give the road users that a term stands for at a time [s]; nobody where it is a place.

    Raises:
        Unanswered: a vehicle of that number was never seen.
    """
    match thing:
        case Ego() | Passenger():
            return (Ego(),)
        case Vehicle(number=name):
            return (Ego(),) if name == EGO else (known(asked, thing, at),)
        case Vehicles(numbers=names):
            return tuple(known(asked, Vehicle(name), at) for name in names)
        case Everyone(kind=kind):
            return tuple(Vehicle(v) for v in of_kind(asked, asked.world.in_view(at), kind, at))
    return ()


def known(asked: Asked, thing: Vehicle, at: float) -> Vehicle:
    """Give a vehicle that has been seen.

    Raises:
        Unanswered: it has not.
    """
    if thing.number not in asked.world.vehicles:
        raise Unanswered(NoSuchVehicle(thing, at, looks(asked, asked.world.in_view(at), at)))
    return thing


def of_kind(
    asked: Asked, vehicles: tuple[int, ...], kind: Kind, at: float, *, strict: bool = False
) -> tuple[int, ...]:
    """Keep those of a kind; "car" is taken for any motor vehicle unless `strict`."""
    if kind == "vehicle":
        return vehicles
    found = ((v, asked.world.look(v, at)) for v in vehicles)
    if kind in ANY and not strict:
        return tuple(v for v, look in found if look is None or look.kind not in NO_CAR)
    return tuple(v for v, look in found if look is not None and look.kind == kind)


def looks(asked: Asked, vehicles: tuple[int, ...], at: float) -> tuple[Look, ...]:
    """Give the vehicles as they are seen at a time [s], those never seen left out."""
    found = (asked.world.look(v, at) for v in vehicles)
    return tuple(look for look in found if look is not None)


def look_of(asked: Asked, thing: Thing | None, at: float) -> Look | None:
    """Tell how a vehicle is seen at a time [s]; None for all else."""
    name = number(thing)
    return None if name is None else asked.world.look(name, at)


def first_look(asked: Asked, vehicle: int, at: float) -> Look | None:
    """Give a vehicle at a time [s]; where it had not come into view yet, as it was first seen."""
    found = asked.world.look(vehicle, at)
    if found is not None:
        return found
    later = (t.sim_time for t in asked.ride.traces if t.sim_time > at)
    return next((look for t in later if (look := asked.world.look(vehicle, t)) is not None), None)


def check_sense(thing: Thing | None) -> None:
    """Refuse what has no sense here.

    Raises:
        Unanswered: the words name nothing that the car knows.
    """
    if isinstance(thing, Unknown):
        raise Unanswered(CannotSay("perception", thing.words))


def nobody(thing: Thing | None) -> bool:
    """Tell whether a term was found to fit no vehicle."""
    return isinstance(thing, Nobody)
