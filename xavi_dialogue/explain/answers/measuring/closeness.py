"""Closeness: how near a vehicle came, how soon it could have been hit, and what the risk was."""

from typing import Literal

from msgspec.structs import replace

from sim.scene import EGO
from xavi_dialogue.domain.answers import Closeness
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.findings import Assurance
from xavi_dialogue.domain.terms import Described, Ego, Nobody, Thing, Vehicle
from xavi_dialogue.domain.vocabulary import Kind
from xavi_dialogue.explain.answers.expectations.foreseen import collision_chance, simulated
from xavi_dialogue.explain.answers.measuring.hard_braking import braked_hard
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import SHORT, Window
from xavi_dialogue.explain.answers.reference.naming import of_kind
from xavi_dialogue.explain.answers.ride.priority import rule_between
from xavi_dialogue.explain.facts.episodes.waiting import top_holders
from xavi_dialogue.explain.history.thresholds import NEAR, STANDING

How = Literal["safe", "dangerous", "close", "hit", "room", "grounds"]
#: By our rule towards a vehicle: who has to let the other go first.
_YIELDS: dict[str, Literal["we", "they"]] = {"give-way": "we", "priority": "they"}
FADING = 0.3  # [m/s] by which what was longer ago counts as further away
NEARER = 0.5  # [m] minimum by which a vehicle was nearer at another time
ON_FOOT = 30.0  # [m] within which people on foot in front of us matter
URGENT = 10.0  # [s] maximum time to a collision that matters
TIGHT = 1.5  # [s] time to a collision below which it was tight


def closeness(
    asked: Asked, vehicle: int | None, about: Window, how: How, *, past: bool = True
) -> Closeness:
    """Return how close a vehicle came in a stretch of the ride, or the one that came closest.

    Args:
        asked: the act and its setting.
        vehicle: the one asked about; None: the one that came closest.
        about: the stretch of the ride.
        how: what was asked.
        past: whether the question is about the past; else about now and what is to come.
    """
    near = about.widened() if about.instant else about
    seen = near if past else Window(asked.now, asked.now)  # the present tense means now
    fading = 0.0 if seen.said else FADING
    now = asked.now
    risk, planned = (collision_chance(asked, now, vehicle), now)
    if past:
        risk, planned = highest_risk(asked, about, vehicle)
    if not past and vehicle is None and how in ("safe", "dangerous") and risk is not None:
        first = _let_first(asked)  # the nearest vehicle may not matter
        walker = None if first else _on_foot(asked)
        far = None if walker is None else closest_approach(asked, walker, seen)
        return Closeness(walker, far, None, risk, how, about.end, past, giving=first)
    judged = past and how in ("safe", "dangerous")
    tight = _tightest(asked, seen) if judged and vehicle is None else None
    among = _level(asked) if how == "room" and not past else None
    who = vehicle or tight or nearest_vehicle(asked, seen, fading, among)
    if who is None:
        return Closeness(None, None, None, risk, how, about.end, past)
    closest = closest_approach(asked, who, seen)
    soon = shortest_time(asked, who, near)
    found = Closeness(
        who, closest, soon, risk, how, about.end, past, ever=_nearer(asked, closest, who, vehicle),
        planned=None if about.instant else planned,
    )  # fmt: skip
    return replace(found, braked=braked_hard(asked, vehicle, seen) if judged else ())


def with_somebody(asked: Asked, about: Window) -> Window:
    """Return the stretch that "that was close" means: this one if somebody was near, else all."""
    near = about.widened()
    who = nearest_vehicle(asked, near)
    least = None if who is None else closest_approach(asked, who, near).value
    return near if least is not None and least <= NEAR else Window(asked.world.begin, asked.now)


def _nearer(asked: Asked, then: Measure, who: int, vehicle: int | None) -> Measure | None:
    """Return the closest approach so far, if it was nearer; without a name, of any vehicle."""
    ride = Window(asked.world.begin, asked.now)
    apart = vehicle is None and then.value is not None and then.value > NEAR
    other = nearest_vehicle(asked, ride) if apart else None
    ever = closest_approach(asked, who if other is None else other, ride)
    least = ever.value or 0.0
    return ever if then.value is not None and least < then.value - NEARER else None


def highest_risk(
    asked: Asked, about: Window, vehicle: int | None = None
) -> tuple[float | None, float]:
    """Return the highest risk of a collision for the decisions in a stretch, and its time [s]."""
    inside = [t.sim_time for t in asked.ride.traces if about.begin < t.sim_time <= about.end]
    found = ((collision_chance(asked, at, vehicle), at) for at in (about.begin, *inside))
    known = [(risk, at) for risk, at in found if risk is not None]
    return max(known, key=lambda one: one[0], default=(None, about.begin))


def _tightest(asked: Asked, about: Window) -> int | None:
    """Return the vehicle that we could have hit soonest, if that was very soon; else None."""
    times = ((v, shortest_time(asked, v, about)) for v in asked.world.vehicles)
    short = [(m.value, v) for v, m in times if m is not None and m.value is not None]
    least, who = min(short, default=(URGENT, None))
    return who if least < TIGHT else None


def was_assured(asked: Asked, vehicle: int | None, at: float) -> Closeness:
    """Return on what the risk of a collision rested at an earlier time [s]."""
    situations, struck = simulated(asked, at, vehicle)
    risk = collision_chance(asked, at, vehicle)
    grounds = Assurance(situations, struck, decided=at)
    return Closeness(vehicle, None, None, risk, "grounds", at, grounds=grounds)


def assured(asked: Asked, vehicle: int | None) -> Closeness:
    """Return why no collision is expected: what is expected of a vehicle, and what was simulated.

    Args:
        asked: the act and its setting.
        vehicle: the one asked about; None: anybody.
    """
    now = asked.now
    found = closeness(asked, vehicle, Window(now, now), "grounds", past=False)
    situations, struck = simulated(asked, now, vehicle)
    if vehicle is None:
        return replace(found, grounds=Assurance(situations, struck))
    met = rule_between(asked, vehicle, Window(now, now))
    speed = asked.world.measure("speed", Vehicle(vehicle), now).value
    seen = asked.world.states.offset(EGO, vehicle, now)
    reasons = Assurance(
        situations, struck, asked.world.belief(vehicle, now),
        stands=speed is not None and speed < STANDING,
        yields=None if met is None else _YIELDS.get(met[1]),
        behind=seen is not None and seen.same_way and seen.ahead + seen.clear < 0.0,
    )  # fmt: skip
    return replace(found, grounds=reasons)


def closest_approach(asked: Asked, vehicle: int, about: Window) -> Measure:
    """Return the smallest distance between a vehicle and us in a stretch of the ride."""
    world = asked.world
    begin, end = max(about.begin, world.begin), min(about.end, asked.now)
    if end - begin <= SHORT / 10.0:
        return world.measure("distance", Ego(), end, Vehicle(vehicle))
    return world.extreme("distance", Ego(), "lowest", begin, end, Vehicle(vehicle))


def shortest_time(asked: Asked, vehicle: int, about: Window) -> Measure | None:
    """Return the shortest time to a collision in a stretch of the ride, if it was ever short."""
    begin, end = max(about.begin, asked.world.begin), min(about.end, asked.now)
    found = asked.world.extreme("time-to-collision", Ego(), "lowest", begin, end, Vehicle(vehicle))
    short = found.value is not None and found.value <= URGENT
    return found if short else None


def _let_first(asked: Asked) -> tuple[int, ...]:
    """Return the vehicles that we are about to let go first."""
    trace = asked.world.states.trace(asked.now)
    held = () if trace is None else top_holders(asked.world.states, trace, EGO)
    return tuple(vehicle for vehicle, how in held if how == "right-of-way")


def _level(asked: Asked) -> tuple[int, ...] | None:
    """Return the vehicles in view that are not behind us yet; None if there are none."""
    looks = (asked.world.look(vehicle, asked.now) for vehicle in asked.world.in_view(asked.now))
    found = (look.vehicle for look in looks if look is not None and look.ahead > -look.length)
    return tuple(found) or None


def _on_foot(asked: Asked) -> int | None:
    """Return the nearest person on foot in front of us; None if nobody is near."""
    looks = (asked.world.look(vehicle, asked.now) for vehicle in asked.world.vehicles)
    ahead = [
        (look.distance, look.vehicle)
        for look in looks
        if look is not None and look.in_view and look.kind == "pedestrian" and look.ahead > 0.0
    ]
    return next((who for far, who in sorted(ahead) if far <= ON_FOOT), None)


def approaches(asked: Asked, kind: Kind, about: Window) -> tuple[Measure, ...]:
    """List how close each road user of a kind came in a stretch of the ride, closest first."""
    whole = Window(asked.world.begin, asked.now) if about.instant else about
    each = of_kind(asked, asked.world.vehicles, kind, asked.now)
    found = (closest_approach(asked, vehicle, whole) for vehicle in each)
    return tuple(sorted((m for m in found if m.value is not None), key=lambda m: m.value or 0.0))


def nearest_vehicle(
    asked: Asked, about: Window, fading: float = 0.0, among: tuple[int, ...] | None = None
) -> int | None:
    """Return the vehicle that came closest to us in a stretch of the ride.

    Args:
        asked: the act and its setting.
        about: the stretch of the ride.
        fading: [m/s] by which what was longer ago counts as further away.
        among: the vehicles to choose from; None: all.
    """
    vehicles = asked.world.vehicles if among is None else among
    found = ((v, closest_approach(asked, v, about)) for v in vehicles)
    ranked = [(m.value + fading * (about.end - m.time), v) for v, m in found if m.value is not None]
    return min(ranked, default=(0.0, None))[1]


def nearest_such(asked: Asked, thing: Thing | None, about: Window) -> int | None:
    """Return who came closest of those of a kind of whom none is named: "any pedestrian"."""
    if not isinstance(thing, Nobody) or not isinstance(thing.described, Described):
        return None
    such = of_kind(asked, asked.world.vehicles, thing.described.kind, about.end)
    return nearest_vehicle(asked, about, among=such)
