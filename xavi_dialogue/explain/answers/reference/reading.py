"""Reading: what a question is about, according to its propositions."""

from planner.record.trace import ON_FOOT
from sim.scene import EGO
from xavi_dialogue.domain.answers import CannotSay, NoSuchVehicle
from xavi_dialogue.domain.facts import Look, Somebody
from xavi_dialogue.domain.terms import (
    Believed,
    Both,
    Caused,
    Compares,
    Ego,
    Event,
    Happens,
    Is,
    Measured,
    Nobody,
    Not,
    Now,
    Passenger,
    Proposition,
    Thing,
    Vehicle,
    Vehicles,
)
from xavi_dialogue.domain.vocabulary import BEYOND, Manner
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.causes.plans.premise import OPEN, Subject
from xavi_dialogue.explain.causes.vehicles.actions import names_of


def unwrapped(of: Proposition | None) -> tuple[Proposition | None, bool]:
    """Return a proposition without negations, and whether it is negated; of several, the first."""
    negated = False
    while isinstance(of, Not | Both):
        if isinstance(of, Not):
            of, negated = of.content, not negated
        else:
            of = of.contents[0] if of.contents else None
    return of, negated


def event_of(of: Proposition | None) -> Event | None:
    """Find the event that a proposition is about, if any."""
    of, _ = unwrapped(of)
    match of:
        case Happens(event):
            return event
        case Is(event=event) if event is not None:
            return event
        case Compares(left=Measured(event=event)) if event is not None:
            return event
        case Caused(effect=effect) if effect is not None:
            return event_of(effect)
        case Believed(content):
            return event_of(content)
    return None


def is_own(thing: Thing | None) -> bool:
    """Check whether a thing is our car, as is assumed if none is named."""
    return thing is None or isinstance(thing, Ego | Passenger) or thing == Vehicle(EGO)


def vehicle_in(thing: Thing | Proposition | None) -> int | None:
    """Return the number of another vehicle; of several, the first."""
    return next(iter(numbers_in(thing)), None)


def numbers_in(thing: Thing | Proposition | None) -> tuple[int, ...]:
    """Return the numbers of other vehicles."""
    if isinstance(thing, Vehicle) and thing.number != EGO:
        return (thing.number,)
    return thing.numbers if isinstance(thing, Vehicles) else ()


def somebody(vehicle: int) -> Somebody:
    """Return the road user with a number."""
    return Ego() if vehicle == EGO else Vehicle(vehicle)


def check_seen(scene: Asked, thing: Thing | Proposition | None) -> int | None:
    """Return the number of another vehicle that has been seen; None for all else.

    Raises:
        Unanswered: nobody of that number or description was ever seen.
    """
    if isinstance(thing, Nobody):
        raise Unanswered(NoSuchVehicle(thing, scene.moment, looks(scene)))
    vehicle = vehicle_in(thing)
    if vehicle is not None and vehicle not in scene.world.vehicles:
        raise Unanswered(NoSuchVehicle(Vehicle(vehicle), scene.moment, looks(scene)))
    return vehicle


def walking(scene: Asked) -> frozenset[int]:
    """Return all who have been seen on foot."""
    found = ((v, scene.world.look(v, scene.moment)) for v in scene.world.vehicles)
    return frozenset(v for v, look in found if look is not None and look.kind in ON_FOOT)


def looks(scene: Asked) -> tuple[Look, ...]:
    """Return the vehicles in view at the time asked about."""
    at = scene.moment
    found = (scene.world.look(v, at) for v in scene.world.in_view(at))
    return tuple(look for look in found if look is not None)


def subject(scene: Asked, event: Event | None) -> Subject:
    """Return which action of ours a question names, and whether it is about the past."""
    if event is None:
        return Subject(None, (), True, scene.span)
    past = event.tense in ("past", "perfect") or scene.past is not None
    names = () if event.action in OPEN else names_of(event)
    span = scene.span if past else None
    return Subject(event, names, past, span, coming=event.tense == "future")


def foil_subject(scene: Asked, event: Event | None) -> Subject:
    """Return the time that a question about what was not done is about, if it names no action.

    A time inferred from earlier questions counts only if the question refers back. Of now, it is
    the decision in force that counts.
    """
    span = None if event is not None and _is_of_now(event) else scene.span
    inferred = span is not None and not (span.said or span.ahead or scene.act.leaned)
    return Subject(None, (), is_past(scene, event), None if inferred else span)


def _is_of_now(event: Event) -> bool:
    return event.tense == "present" and isinstance(event.time, Now)


def is_past(scene: Asked, event: Event | None) -> bool:
    """Check whether a question is about the past."""
    if event is not None and _is_of_now(event):
        return False
    return scene.past is not None or event is None or event.tense in ("past", "perfect")


def check_able(event: Event) -> None:
    """Refuse what no car of this kind can do.

    Raises:
        Unanswered: it cannot be done.
    """
    if event.action in BEYOND:
        raise Unanswered(CannotSay("capability", event.action, "not-an-action"))


def manner_of(event: Event | None, *wanted: Manner) -> Manner | None:
    """Return which of some manners an event has."""
    found = () if event is None else event.manner
    return next((manner for manner in found if manner in wanted), None)
