"""Premises: what a question takes for granted of how we drove, and whether it is so."""

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.reading import vehicle_in
from xavi_dialogue.explain.causes.driving.stated_reasons import Reasons
from xavi_dialogue.explain.causes.vehicles import when
from xavi_dialogue.explain.history.restraints import lasted
from xavi_dialogue.explain.history.ride import chose

SLOWING: tuple[ActionName, ...] = ("slow-down", "brake")
STILL: tuple[ActionName, ...] = ("stop", "stand")
CREEPING = 2.5  # [m/s] above which we have not stopped
BEFORE = 1.0  # [s] before an episode, in which who kept us was the reason for it
OVER = 4.0  # [s] since its end, from which what is asked about as present is denied
MOVED = 0.5  # [s] since its end, from which a standstill is over
BEGUN = 0.3  # [s] after a decision from which what it led to has begun


def is_for(scene: Asked, deed: Episode, whom: frozenset[int]) -> bool:
    """Check whether we did something for one of some road users, or they kept us then."""
    if vehicle_in(deed.object) in whom:
        return True
    end = scene.now if deed.end is None else deed.end
    kept = lasted(scene.ride, deed.begin - BEFORE, end)
    return any(one.vehicle in whom for one in kept)


def is_stopping(scene: Asked, deed: Episode, named: ActionName) -> bool:
    """Check whether we brake for a stop that is asked about and is the decision in force."""
    braking = deed.action in SLOWING and deed.end is None
    return named == "stop" and braking and chose(scene.ride.latest, "stop")


def is_over(scene: Asked, event: Event, deed: Episode) -> bool:
    """Check whether the question takes for present what ended seconds ago."""
    named = scene.span is not None and scene.span.said
    ended = deed.end is not None and deed.end < scene.now - OVER
    return event.tense == "present" and ended and not named


def is_left(scene: Asked, deed: Episode) -> bool:
    """Check whether something that we did is no longer what a question in the present is about.

    A standstill is left behind once we move and do not drive off: we come to the next one.
    """
    if deed.end is None:
        return False
    if deed.end < scene.now - when.RECENT:
        return True
    off = any(e.end is None for e in scene.world.episodes(Ego(), ("go", "speed-up")))
    return deed.action in STILL and deed.end < scene.now - MOVED and not off


def asked_moment(scene: Asked, event: Event, deed: Episode) -> float:
    """Return the moment [s] of what we do or did that counts: now, if it is present and goes on."""
    said = scene.past is not None and scene.past.said
    goes_on = deed.end is None and event.tense == "present" and not said
    return scene.now if goes_on else scene.moment


def is_before(scene: Asked) -> bool:
    """Check whether the question names a past moment: "why not three seconds ago?"."""
    named = scene.past
    return named is not None and named.said and named.end < scene.now - when.RECENT / 2.0


def halted_at(scene: Asked, deed: Episode, reasons: Reasons) -> float | None:
    """Return when [s] we decided to stop while already slowing down; None: we did not."""
    stops = chose(reasons.trace, "stop") and not chose(scene.ride.latest, "continue")
    later = reasons.trace.sim_time > deed.begin + BEGUN
    given_up = any(cause.kind == "given-up" for cause in reasons.causes)
    return reasons.trace.sim_time if stops and later and not given_up else None


def was_given_up(scene: Asked, deed: Episode) -> bool:
    """Check whether a stop that had been decided was given up before we stood."""
    if deed.action in STILL or chose(scene.ride.latest, "stop"):
        return False
    return deed.speed_to is None or deed.speed_to > CREEPING
