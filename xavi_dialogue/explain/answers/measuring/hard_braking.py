"""Hard braking: ours, and that of vehicles near us that had right of way over us."""

from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.ride.comfort import HARD
from xavi_dialogue.explain.answers.ride.delays import for_whom
from xavi_dialogue.explain.answers.ride.priority import rule_between
from xavi_dialogue.explain.history.thresholds import MOVING, NEAR

AFTER = 2.0  # [s] after braking in which the vehicle may still come near


def braked_hard(asked: Asked, vehicle: int | None, about: Window) -> tuple[Episode, ...]:
    """List hard braking in a stretch of the ride: ours, or of vehicles with right of way over us.

    Args:
        asked: the act and its setting.
        vehicle: the one asked about; None: anybody.
        about: the stretch of the ride.
    """
    begin, end = max(about.begin, asked.world.begin), min(about.end, asked.now)
    hard = [
        for_whom(asked, e)
        for e in asked.world.episodes(None, ("brake",), begin, end)
        if (e.peak or 0.0) >= HARD and (isinstance(e.actor, Ego) or _had_to(asked, e))
    ]
    return tuple(e for e in hard if vehicle is None or Vehicle(vehicle) in (e.actor, e.object))


def _had_to(asked: Asked, braking: Episode) -> bool:
    """Check whether a vehicle near us brakes that has right of way over us, while we drive."""
    if not isinstance(braking.actor, Vehicle):
        return False
    end = asked.now if braking.end is None else braking.end
    about = Window(braking.begin, end)
    rule = rule_between(asked, braking.actor.number, about)
    if rule is None or rule[1] != "give-way":
        return False
    ours = asked.ride.motion(EGO)
    if max((ours.speed[k] for k in ours.within(about.begin, about.end)), default=0.0) < MOVING:
        return False
    last = min(end + AFTER, asked.now)
    near = asked.world.extreme("distance", Ego(), "lowest", about.begin, last, braking.actor)
    return near.value is not None and near.value <= NEAR


def hardest(asked: Asked, episode: Episode, about: Window) -> Measure:
    """Return how hard somebody braked in an episode, and when it was hardest if that is known."""
    end = min(about.end, asked.now)
    found = asked.world.extreme("deceleration", episode.actor, "highest", about.begin, end, None)
    at = about.begin if found.gap is not None else found.time
    return Measure("deceleration", episode.actor, at, value=episode.peak, until=about.end,
                   extreme="highest")  # fmt: skip
