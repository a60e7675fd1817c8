"""Tenses: in which tense something is told, from when it is and what is asked."""

from xavi_dialogue.domain import terms
from xavi_dialogue.domain.terms import At, Between, Event, Next, Now, Time, WholeRide, Within
from xavi_dialogue.nlg.surface.values import Tense

PRESENT = 1.0  # [s] what is so long past still counts as now


def tense_at(time: float, now: float) -> Tense:
    """The tense in which a state at a time of the ride is told."""
    if time > now + PRESENT:
        return "future"
    return "past" if now - time > PRESENT else "present"


def tense_of(tense: terms.Tense, time: Time, now: float) -> Tense:
    """The tense in which a proposition is told: that of the question, corrected by its time."""
    match time:
        case At(at=at):
            return tense_at(at, now)
        case Between(begin=begin, end=end):
            return "future" if begin > now else "past" if now - end > PRESENT else tense
        case Now():
            return "present"
        case Next() | Within():
            return "future"
        case WholeRide():
            return "past" if tense == "present" else tense
    return tense


def moment_of(time: Time) -> float | None:
    """The time of the ride at which things are as they are described."""
    match time:
        case At(at=at):
            return at
        case Between(begin=begin):
            return begin
    return None


def event_tense(event: Event, now: float) -> tuple[Tense, str | None]:
    """The tense and the modal verb in which an event is told."""
    tense = tense_of(event.tense, event.time, now)
    match event.modal:
        case None | "will":
            return ("future" if event.modal else tense), None
        case "would":
            return ("conditional-perfect" if tense in ("past", "perfect") else "conditional"), None
        case "want":
            return tense, None
    return tense, event.modal
