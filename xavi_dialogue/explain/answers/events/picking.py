"""Picking: which of several vehicles is meant, by how it is set apart from the others."""

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
    Wanted,
)
from xavi_dialogue.explain.answers.expectations.foreseen import chance
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.findings import Finding, expected
from xavi_dialogue.explain.answers.reference.naming import ANY, look_of, somebodies

LIKELY = 0.5  # probability from which one of several counts as going to do something
STEADY = 0.3  # [m/s2] below which a speed is held
LATELY = 10.0  # [s] for which one that was lost from view may still be around


def extreme_of(thing: Thing, seen: tuple[Look, ...]) -> tuple[Look, ...]:
    """Keep the nearest, fastest, biggest of them, where the description wants one."""
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
    """Tell whether a vehicle is hidden, or was lost a short while ago."""
    if look.in_view or look.seen is None:
        return False
    shown = asked.world.measure("visibility", Vehicle(look.vehicle), asked.now)
    return shown.word == "hidden" or look.seen >= asked.now - LATELY


def owed_by_other(such: Proposition) -> Happens | None:
    """Take "who has right of way over vehicle 2" for whom it gives way to; None: else."""
    match such:
        case Related("has-priority-over", Wanted() | Described(), Vehicle() as by):
            pass
        case Related("must-yield-to", Vehicle() as by, Wanted() | Described()):
            pass
        case _:
            return None
    return Happens(Event("give-way", by, Wanted(), time=such.time, tense=such.tense))


def likeliest(asked: Asked, event: Event) -> Finding:
    """Tell what is to come of any of several vehicles: the likeliest of them counts."""
    actor = event.actor
    if isinstance(actor, Nobody):  # "will anybody let us in?"
        of = actor.described
        actor = Everyone("vehicle" if of is None or of.kind in ANY else of.kind)
    found = [
        (share, v)
        for v in somebodies(asked, actor, asked.now)
        if isinstance(v, Vehicle)
        and (share := chance(asked, replace(event, actor=v), asked.now)) is not None
    ]
    if not found:
        return expected(None)
    share, who = max(found, key=lambda one: one[0])
    if share < LIKELY:
        return expected(share)
    told = Verdict(Happens(replace(event, actor=who)), None, probability=share)
    return Finding(None, probability=share, answer=told)


def is_to_come(such: Proposition) -> bool:
    """Tell whether it is asked what somebody is going to do, not what the rule is."""
    return isinstance(such, Happens) and such.event.tense == "future" and such.event.modal is None


def in_line(such: Related, seen: tuple[Look, ...], asked: Asked, at: float) -> tuple[Look, ...]:
    """Choose of those in front of or behind another vehicle who is in its lane."""
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


def spent(asked: Asked, episode: Episode, at: float) -> bool:
    """Tell whether a change of speed is over, though the record has not yet closed it."""
    if episode.action not in ("speed-up", "slow-down", "brake"):
        return False
    rate = asked.world.measure("acceleration", episode.actor, at).value
    return rate is not None and abs(rate) < STEADY
