"""Naming: the vehicles that a term stands for, and refusals if there are none of that name."""

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
#: Kinds by which passengers mean any motor vehicle.
ANY: frozenset[Kind] = frozenset(("vehicle", "car"))
#: Kinds that nobody calls a car.
BIKES: frozenset[Kind] = frozenset(("bicycle", "bike", "motorcycle", "scooter"))
NO_CAR: frozenset[Kind] = frozenset(("pedestrian", "bicycle", "bike", "wheelchair", "scooter"))


def number(thing: Thing | None) -> int | None:
    """Return the number of a vehicle; None for all else."""
    return thing.number if isinstance(thing, Vehicle) else None


def is_building(thing: object) -> bool:
    """Check whether a thing is a building, behind which nobody can be seen."""
    return isinstance(thing, Feature) and thing.kind == "building"


def is_us(thing: Thing | None) -> bool:
    """Check whether a thing is our car, or a passenger in it."""
    return isinstance(thing, Ego | Passenger)


def somebodies(asked: Asked, thing: Thing | None, at: float) -> Somebodies:
    """Return the road users that a term stands for at a time [s]; none for a place.

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
    """Return a vehicle if it has been seen.

    Raises:
        Unanswered: it has not been seen.
    """
    if thing.number not in asked.world.vehicles:
        raise Unanswered(NoSuchVehicle(thing, at, looks(asked, asked.world.in_view(at), at)))
    return thing


def of_kind(
    asked: Asked, vehicles: tuple[int, ...], kind: Kind, at: float, *, strict: bool = False
) -> tuple[int, ...]:
    """Return the vehicles of a kind; "car" means any motor vehicle unless `strict`.

    A "bike" may have a motor.
    """
    if kind == "vehicle":
        return vehicles
    found = ((v, asked.world.look(v, at)) for v in vehicles)
    if kind in ANY and not strict:
        return tuple(v for v, look in found if look is None or look.kind not in NO_CAR)
    kinds = BIKES if kind == "bike" else (kind,)
    return tuple(v for v, look in found if look is not None and look.kind in kinds)


def looks(asked: Asked, vehicles: tuple[int, ...], at: float) -> tuple[Look, ...]:
    """Return the vehicles as they are seen at a time [s], without those never seen."""
    found = (asked.world.look(v, at) for v in vehicles)
    return tuple(look for look in found if look is not None)


def look_of(asked: Asked, thing: Thing | None, at: float) -> Look | None:
    """Return a vehicle as it is seen at a time [s]; None for all else."""
    name = number(thing)
    return None if name is None else asked.world.look(name, at)


def first_look(asked: Asked, vehicle: int, at: float) -> Look | None:
    """Return a vehicle as it is seen at a time [s], or first seen if that was later."""
    found = asked.world.look(vehicle, at)
    if found is not None:
        return found
    later = (t.sim_time for t in asked.ride.traces if t.sim_time > at)
    return next((look for t in later if (look := asked.world.look(vehicle, t)) is not None), None)


def check_sense(thing: Thing | None) -> None:
    """Refuse a thing that makes no sense here.

    Raises:
        Unanswered: the words name nothing that the car knows.
    """
    if isinstance(thing, Unknown):
        raise Unanswered(CannotSay("perception", thing.words))


def nobody(thing: Thing | None) -> bool:
    """Check whether a term was found to fit no vehicle."""
    return isinstance(thing, Nobody)
