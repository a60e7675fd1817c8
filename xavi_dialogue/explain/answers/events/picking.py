"""Picking: which of several vehicles is meant, by what sets it apart from the others."""

from collections.abc import Callable

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Verdict
from xavi_dialogue.domain.facts import Episode, Look
from xavi_dialogue.domain.terms import (
    Described,
    Event,
    Everyone,
    Happens,
    Nobody,
    Proposition,
    Related,
    Thing,
    Vehicle,
    Vehicles,
    Wanted,
)
from xavi_dialogue.domain.vocabulary import ActionName, Relation
from xavi_dialogue.explain.answers.expectations.forecast import forecast
from xavi_dialogue.explain.answers.expectations.foreseen import chance
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, expected
from xavi_dialogue.explain.answers.reference.naming import ANY, look_of, somebodies

#: Where a road user may be from another, and what it does there for a while.
PLACES = frozenset[Relation](("beside", "behind", "ahead-of", "left-of", "right-of", "near"))
LASTING = frozenset[ActionName](("wait", "stand", "stop", "brake", "go", "move", "follow"))
LIKELY = 0.5  # minimum probability of what one of several vehicles is going to do
STEADY = 0.3  # [m/s2] below which a speed counts as constant
LATELY = 10.0  # [s] for which a vehicle that was lost from view may still be near


def extreme_of(thing: Thing, seen: tuple[Look, ...]) -> tuple[Look, ...]:
    """Return the nearest, fastest or biggest of several, if the description asks for that."""
    wanted = thing.extreme if isinstance(thing, Described) else None
    if wanted is None or not seen:
        return seen
    keys: dict[str, Callable[[Look], float]] = {
        "nearest": lambda look: look.distance,
        "farthest": lambda look: -look.distance,
        "fastest": lambda look: -look.speed,
        "slowest": lambda look: look.speed,
        "biggest": lambda look: -look.length,
    }
    return (min(seen, key=keys[wanted]),)


def lately_lost(asked: Asked, look: Look) -> bool:
    """Check whether a vehicle is hidden, or was lost from view a short while ago."""
    if look.in_view or look.seen is None:
        return False
    shown = asked.world.measure("visibility", Vehicle(look.vehicle), asked.now)
    return shown.word == "hidden" or look.seen >= asked.now - LATELY


def owed_by_other(such: Proposition) -> Happens | None:
    """Read "who has right of way over vehicle 2" as "who does it give way to"; else None."""
    match such:
        case Related("has-priority-over", Wanted() | Described(), Vehicle() as by):
            pass
        case Related("must-yield-to", Vehicle() as by, Wanted() | Described()):
            pass
        case _:
            return None
    return Happens(Event("give-way", by, Wanted(), time=such.time, tense=such.tense))


def likeliest(asked: Asked, event: Event) -> Finding:
    """Check whether any of several vehicles will do something; the likeliest of them counts.

    Of several that were named together, answers tell what each is going to do.
    """
    actor = event.actor
    if isinstance(actor, Nobody):  # "will anybody let us in?"
        of = actor.described
        actor = Everyone("vehicle" if of is None or of.kind in ANY else of.kind)
    each = forecast(asked, map(Vehicle, actor.numbers)) if isinstance(actor, Vehicles) else None
    if each is not None:
        return Finding(None, answer=each)
    found = [
        (share, v)
        for v in somebodies(asked, actor, asked.now)
        if isinstance(v, Vehicle)
        and (share := chance(asked, replace(event, actor=v), asked.now)) is not None
    ]
    if not found:
        told = forecast(asked, somebodies(asked, actor, asked.now))
        return expected(None) if told is None else Finding(None, answer=told)
    share, who = max(found, key=lambda one: one[0])
    if share < LIKELY:
        return expected(share)
    likely = Verdict(Happens(replace(event, actor=who)), None, probability=share)
    return Finding(None, probability=share, answer=likely)


def is_to_come(such: Proposition) -> bool:
    """Check whether a proposition is about what somebody is going to do, not about the rule."""
    return isinstance(such, Happens) and such.event.tense == "future" and such.event.modal is None


def in_line(such: Related, seen: tuple[Look, ...], asked: Asked, at: float) -> tuple[Look, ...]:
    """Return the vehicles in front of or behind another one that are not in other lanes."""
    of = look_of(asked, such.to, at)
    straight = such.relation in ("ahead-of", "behind")
    if not straight or of is None or of.bearing.startswith("crossing"):
        return tuple(sorted(seen, key=lambda look: look.distance))
    near = sorted(seen, key=lambda look: abs(look.ahead - of.ahead))
    road = asked.world.road(at)
    places = {} if road is None else road.places
    here = places.get(of.vehicle)
    beside = [
        v for v, there in places.items()
        if here is not None and there.edge == here.edge and there.lane != here.lane
    ]  # fmt: skip
    return tuple(look for look in near if look.vehicle not in beside)


def is_placed(asked: Asked, event: Event, episode: Episode) -> bool:
    """Check whether what goes on now goes on where the event says: "who waits beside us?"."""
    place = event.where
    if place is None or place.relation not in PLACES or event.action not in LASTING:
        return True
    if event.tense != "present" or asked.past is not None:
        return True
    return bool(asked.world.relation(place.relation, episode.actor, place.to, asked.now))


def spent(asked: Asked, episode: Episode, at: float) -> bool:
    """Check whether a change of speed is over, although the record has not yet ended it."""
    if episode.action not in ("speed-up", "slow-down", "brake"):
        return False
    rate = asked.world.measure("acceleration", episode.actor, at).value
    return rate is not None and abs(rate) < STEADY
