"""Moments: which instant or stretch of the ride a term is about.

The time within the term comes first, then the span of the act, then the tense.
"""

from dataclasses import dataclass

from xavi_dialogue.domain.terms import (
    Ago,
    At,
    Between,
    Next,
    Now,
    Start,
    Time,
    Unsaid,
    WholeRide,
    Within,
)
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.causes.vehicles.when import LEEWAY

UNSAID = Unsaid()
RECENT = 6.0  # [s] before now to which an indefinite "ago" reaches back
SHORT = 1.5  # [s] up to which a stretch counts as an instant


@dataclass(frozen=True, slots=True)
class Window:
    """A stretch of the ride so far."""

    begin: float  # [s]
    end: float  # [s]
    said: bool = False  # the passenger named it

    @property
    def instant(self) -> bool:
        """Whether it is one moment rather than a stretch."""
        return self.end - self.begin <= SHORT

    @property
    def middle(self) -> float:
        """The middle [s]."""
        return (self.begin + self.end) / 2.0

    def widened(self, by: float = LEEWAY) -> "Window":
        """Return the stretch with a margin on both sides."""
        return Window(self.begin - by, self.end + by, self.said)


def window(asked: Asked, time: Time = UNSAID, tense: str = "past") -> Window:
    """Return the stretch that a term is about; if nothing says so, the ride so far or now."""
    named = _named(asked, time)
    if named is not None:
        return named
    past = asked.past
    if past is not None:
        return Window(past.begin, min(past.end, asked.now), past.said)
    if tense in ("present", "future"):
        return Window(asked.now, asked.now)
    return Window(asked.world.begin, asked.now)


def instant(asked: Asked, time: Time = UNSAID, tense: str = "present") -> float:
    """Return the moment [s] that a term is about: now, unless something says another."""
    named = _named(asked, time)
    if named is None and asked.past is None:
        return asked.now
    found = named if named is not None else window(asked, time, tense)
    return asked.now if _whole(asked, found) else found.middle


def is_past(asked: Asked, time: Time, tense: str) -> bool:
    """Check whether a term is about the past and not about now."""
    named = _named(asked, time)
    found = named if named is not None else (None if asked.past is None else window(asked))
    if found is not None and found.end < asked.now - SHORT:
        return True
    return tense in ("past", "perfect")


def is_ahead(asked: Asked, time: Time, tense: str) -> bool:
    """Check whether a term is about what is still to come."""
    if isinstance(time, Next | Within):
        return True
    if isinstance(time, At | Between) or asked.past is not None:
        return False
    return tense == "future" or (asked.span is not None and asked.span.ahead)


def was_said(asked: Asked, time: Time) -> bool:
    """Check whether the passenger named the time."""
    found = _named(asked, time)
    return found is not None or (asked.past is not None and asked.past.said)


def _whole(asked: Asked, found: Window) -> bool:
    return found.begin <= asked.world.begin and found.end >= asked.now - SHORT


def _named(asked: Asked, time: Time) -> Window | None:
    match time:
        case At(at=at):
            return Window(at, at, True)
        case Between(begin=begin, end=end):
            return Window(begin, min(end, asked.now), True)
        case Now():
            return Window(asked.now, asked.now, True)
        case WholeRide():
            return Window(asked.world.begin, asked.now, True)
        case Start():
            return Window(asked.world.begin, asked.world.begin + LEEWAY, True)
        case Ago(seconds=seconds):
            at = asked.now - (RECENT / 2.0 if seconds is None else seconds)
            return Window(max(at, asked.world.begin), max(at, asked.world.begin), True)
    return None
