"""Comfort: how hard the ride was over a stretch of it, or in one manoeuvre."""

from xavi_dialogue.domain.answers import Comfort, NotRecorded
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Event, Unsaid
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked, Unanswered
from xavi_dialogue.explain.answers.reference.moments import Window, was_said, window
from xavi_dialogue.explain.answers.reference.occasions import overlaps, taken_place

JOINED = 1.0  # [s] maximum time between slowing down and the stop that it led to
HARD = 4.0  # [m/s2] minimum deceleration that passengers call hard
BRAKING: tuple[ActionName, ...] = ("brake", "slow-down", "stop", "give-way")


def comfort(asked: Asked, event: Event | None, about: Window) -> Comfort:
    """Return how hard it was: the peak deceleration with its time, and the jerk if it is known.

    Raises:
        Unanswered: the event did not happen, or the record has no motion there.
    """
    episode = None if event is None else taken_place(asked, event)
    return comfort_of(asked, about if episode is None else stretch(asked, episode), episode)


def comfort_of(asked: Asked, about: Window, episode: Episode | None = None) -> Comfort:
    """Return how hard a stretch of the ride was.

    Raises:
        Unanswered: the record has no motion there.
    """
    near = about.widened() if about.instant else about
    begin, end = max(near.begin, asked.world.begin), min(near.end, asked.now)
    peak = asked.world.extreme("deceleration", Ego(), "highest", begin, end)
    if peak.gap is not None:
        raise Unanswered(NotRecorded(peak.gap, Ego(), begin, end, "comfort"))
    jerk = asked.world.extreme("jerk", Ego(), "highest", begin, end)
    hard = peak.value is not None and peak.value >= HARD
    found = episode if episode is not None else _braking(asked, peak.time)
    return Comfort(peak, jerk if jerk.gap is None else None, found, hard)


def stretch(asked: Asked, episode: Episode) -> Window:
    """Return the stretch of the ride that an episode covers."""
    return Window(episode.begin, asked.now if episode.end is None else episode.end)


def with_slowing(asked: Asked, episode: Episode, about: Window) -> Window:
    """Add to a stop the slowing down that led to it."""
    if episode.action not in ("stop", "stand", "wait"):
        return about
    slowing = asked.world.episodes(actor=Ego(), actions=("brake", "slow-down"))
    led = [e.begin for e in slowing if e.begin <= episode.begin <= (e.end or asked.now) + JOINED]
    return Window(min([about.begin, *led]), about.end)


def asked_stretch(asked: Asked, event: Event | None) -> Window:
    """Return the stretch that a question about comfort covers; by default the whole ride."""
    if event is not None:
        return window(asked, event.time, event.tense)
    about = window(asked)
    if about.instant and not was_said(asked, Unsaid()):
        return Window(asked.world.begin, asked.now)
    return about


def _braking(asked: Asked, at: float) -> Episode | None:
    """Return our braking at a time [s]."""
    found = asked.world.episodes(actor=Ego(), actions=BRAKING)
    here = [e for e in found if overlaps(asked, e, Window(at, at))]
    return here[-1] if here else None
