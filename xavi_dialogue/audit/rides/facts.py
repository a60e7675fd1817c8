"""The facts of a ride that deserve a look: hard braking, close calls, collisions."""

from sim.scene import EGO
from xavi_dialogue.audit.rides.choices import choices
from xavi_dialogue.audit.rides.mistakes import mistakes
from xavi_dialogue.audit.rides.naming import name
from xavi_dialogue.audit.values import Ending, Facts, Peak
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.domain.vocabulary import Attribute
from xavi_dialogue.explain.facts.world import World, world_of
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.library.ride import Ride

URGENT = 10.0  # [s] maximum time to a collision that is told


def world(ride: Ride) -> World:
    """Return what the whole record of a ride shows."""
    recorded = ride.record
    scene = ride.scenes[-1] if ride.scenes else None
    traces, events = tuple(recorded.traces), tuple(recorded.events)
    return world_of(Record(ride.end, traces, events, recorded.ended is not None, scene=scene))


def look_through(ride: Ride, ride_hash: str, size: int) -> Facts:
    """Return the facts of a ride.

    Args:
        ride: the ride.
        ride_hash: SHA-256 of its file.
        size: [bytes] of its file.
    """
    known = world(ride)
    return Facts(
        scenario=ride.scenario,
        seed=ride.seed,
        end=round(ride.end, 3),
        ending=_ending(ride),
        decisions=len(ride.decisions),
        ride_hash=ride_hash,
        ride_bytes=size,
        collision=_collision(ride, known),
        braking=_braking(known),
        distance=_least(known, "distance", None),
        time_to_collision=_least(known, "time-to-collision", URGENT),
        choices=choices(ride.record.traces),
        mistakes=mistakes(ride, known),
    )


def _ending(ride: Ride) -> Ending:
    kinds = {event.kind for event in ride.events}
    if "collided" in kinds:
        return "collided"
    if "arrived" in kinds:
        return "arrived"
    return "ended" if ride.record.ended is not None else "cut-off"


def _collision(ride: Ride, known: World) -> Peak | None:
    event = next((one for one in ride.events if one.kind == "collided"), None)
    if event is None:
        return None
    motion = known.ride.motion(EGO)
    who = None if event.vehicle is None else name(known, event.vehicle, event.sim_time)
    speed = motion.speed[-1] if motion.speed else 0.0
    return Peak(round(speed, 2), event.sim_time, event.vehicle, who)


def _braking(known: World) -> Peak | None:
    """Return the hardest braking; None if answers would not call anything braking."""
    if not known.episodes(Ego(), ("brake", "slow-down")):
        return None
    found = known.extreme("deceleration", Ego(), "highest", known.begin, known.now)
    return Peak(found.value, round(found.time, 3)) if found.value else None


def _least(known: World, attribute: Attribute, most: float | None) -> Peak | None:
    """Return the lowest value of an attribute towards any vehicle, unless that is too high."""
    span = (known.begin, known.now)
    found = [
        (measure.value, measure.time, vehicle)
        for vehicle in known.vehicles
        for measure in (known.extreme(attribute, Ego(), "lowest", *span, Vehicle(vehicle)),)
        if measure.value is not None
    ]
    if not found or (most is not None and min(found)[0] > most):
        return None
    value, at, vehicle = min(found)
    return Peak(round(value, 3), round(at, 3), vehicle, name(known, vehicle, at))
