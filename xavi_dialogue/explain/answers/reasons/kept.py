"""Kept: to whom we gave way, how that goes on, how our slowing began, and how hard we braked."""

from dataclasses import replace

from msgspec import structs

from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.reading import manner_of, vehicle_in
from xavi_dialogue.explain.causes.driving.passed import has_passed
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons
from xavi_dialogue.explain.history.nearing import speed_at
from xavi_dialogue.explain.history.restraints import restraint_at

HALTING = 1.0  # [m/s]
PAUSE = 3.0  # [s] maximum time between slowings that belong together
BEGUN = 2.0  # [s] of a slowing that are its beginning
JUST = 0.5  # [s] before now that still are now
STILL = ("stop", "stand")
SLOWING = ("slow-down", "brake", "stop", "stand")
#: Kinds of reasons that do not say who kept us from going.
UNKNOWN = frozenset(("limit", "plan", "starting", "turn", "picking-up"))


def peak(scene: Asked, event: Event, deed: Episode) -> float | None:
    """Return how hard [m/s2] we braked, if the question is why so hard or so suddenly."""
    if manner_of(event, "hard", "suddenly") is None or deed.action not in SLOWING:
        return None
    end = scene.now if deed.end is None else deed.end
    return scene.world.extreme("deceleration", Ego(), "highest", deed.begin, end).value


def with_yielding(scene: Asked, found: Reasons, begin: float, end: float) -> Reasons:
    """Add to whom we gave way then, if nothing else is known to have kept us.

    Up to now, that is nobody who has passed already.
    """
    if any(c.kind not in UNKNOWN for c in found.causes):
        return found
    here = end >= scene.now - JUST
    now = restraint_at(scene.ride, end) if here else None
    if now is not None and now.by == "nothing":
        return found
    gave = [
        number
        for episode in scene.world.episodes(Ego(), ("give-way",), begin, end)
        if (number := vehicle_in(episode.object)) is not None and number not in found.cleared
        if not here or not has_passed(scene.ride, number, end)
    ]
    if not gave:
        return found
    cause = MotionCause("right-of-way", vehicle=gave[-1])
    return replace(found, causes=(cause,))


def yielding_first(deed: Episode, found: Reasons) -> Reasons:
    """Put right of way before all else that kept us, where it is asked why we gave way."""
    if deed.action != "give-way":
        return found
    ordered = sorted(found.causes, key=lambda cause: cause.kind != "right-of-way")
    return replace(found, causes=tuple(ordered))


def without_passed(scene: Asked, event: Event, found: Reasons) -> Reasons:
    """Leave out who has passed by now, of those that a question in the present is about."""
    said = scene.past is not None and scene.past.said
    if event.tense != "present" or said:
        return found
    left = tuple(
        cause
        for cause in found.causes
        if cause.kind != "right-of-way" or not has_passed(scene.ride, cause.vehicle, scene.now)
    )
    return replace(found, causes=left) if left else found


def going_on(scene: Asked, deed: Episode, rows: tuple[tuple[ActionName, ...], ...]) -> Episode:
    """Replace giving way that is over by the slowing or standing that still goes on."""
    if deed.action != "give-way" or deed.end is None or scene.past is not None:
        return deed
    kinds = tuple(kind for row in rows for kind in row)
    now = (e for e in scene.world.episodes(Ego(), kinds) if e.action in kinds and e.end is None)
    return max((e for e in now if e.action != "give-way"), key=lambda e: e.begin, default=deed)


def beginning(scene: Asked, event: Event, deed: Episode) -> Episode:
    """Return how our slowing began, where it is asked why we slowed so early.

    Slowings with hardly a pause between them belong together.
    """
    asked = manner_of(event, "early", "first") is not None and event.tense == "past"
    if not asked or deed.action not in ("slow-down", "brake"):
        return deed
    every = scene.world.episodes(Ego(), ("slow-down", "brake"))
    for one in sorted(every, key=lambda e: -e.begin):
        if one.end is not None and one.begin < deed.begin <= one.end + PAUSE:
            deed = one
    until = min(scene.now if deed.end is None else deed.end, deed.begin + BEGUN)
    return structs.replace(deed, end=until)


def coming_to(scene: Asked, deed: Episode, rows: tuple[tuple[ActionName, ...], ...]) -> Episode:
    """Replace a standstill that is long over by the one that we are just coming to."""
    said = scene.past is not None and scene.past.said
    if said or deed.action not in STILL or deed.end is None:
        return deed
    kinds = tuple(kind for row in rows for kind in row)
    speed = speed_at(scene.ride, scene.now)
    halting = speed is not None and speed < HALTING
    now = [e for e in scene.world.episodes(Ego(), kinds) if e.end is None and e.begin > deed.end]
    return now[-1] if now and halting else deed
