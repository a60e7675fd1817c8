"""Kept: whom we gave way to where no other reason is known, and how hard we braked."""

from dataclasses import replace

from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.reading import manner_of, vehicle_in
from xavi_dialogue.explain.causes.driving.driving import Reasons

SLOWING = ("slow-down", "brake", "stop", "stand")
#: Kinds of reasons that say nothing of who kept us from going.
UNKNOWN = frozenset(("limit", "plan", "starting", "turn", "picking-up"))


def peak(scene: Asked, event: Event, deed: Episode) -> float | None:
    """Tell how hard [m/s2] we braked, where it is asked why so hard, or so suddenly."""
    if manner_of(event, "hard", "suddenly") is None or deed.action not in SLOWING:
        return None
    end = scene.now if deed.end is None else deed.end
    return scene.world.extreme("deceleration", Ego(), "highest", deed.begin, end).value


def with_yielding(scene: Asked, found: Reasons, begin: float, end: float) -> Reasons:
    """Name whom we gave way to then, where nothing else is known to have kept us."""
    if any(c.kind not in UNKNOWN for c in found.causes):
        return found
    gave = [
        number
        for episode in scene.world.episodes(Ego(), ("give-way",), begin, end)
        if (number := vehicle_in(episode.object)) is not None and number not in found.cleared
    ]
    if not gave:
        return found
    cause = MotionCause("right-of-way", vehicle=gave[-1])
    return replace(found, causes=(cause,))
