"""Focus: the part of the ride that a turn was about, for "that", "then" and "that stretch"."""

from typing import Final

from xavi_dialogue.dialogue.state.turn import Part, Turn
from xavi_dialogue.domain.answers import (
    Answer,
    Beliefs,
    Bound,
    ChoiceReason,
    Happenings,
    Identified,
    Method,
    MotionReason,
    OtherReason,
    Priority,
    Refusal,
    SupposedOfUs,
)
from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.facts import Episode, Measure
from xavi_dialogue.domain.meaning import (
    Ask,
    Changed,
    Doing,
    HowMuch,
    Listing,
    Peak,
    Summarise,
    When,
)
from xavi_dialogue.domain.rewriting import parts
from xavi_dialogue.domain.terms import Between, Ego, Event, Measured
from xavi_dialogue.domain.traffic_lights import Shown

SAME: Final = 0.5  # [s] within which a time is now
LONG: Final = 60.0  # [s] longest episode that "that" or "then" may mean


def episode_of(turn: Turn) -> tuple[float, float] | None:
    """Return the part of the ride [s] that was discussed last, for "that" and "then"."""
    now = turn.reply.sim_time
    if (named := stretch_named(turn)) is not None:
        return named
    for part in reversed(turn.parts):
        found = _of_deed(part) or _told(part.result, now) or _asked(part)
        if found is not None and found[1] - found[0] <= LONG:
            return found
    return None


def moments_told(turn: Turn) -> tuple[float, ...]:
    """Return the moments [s] that were told on the question when something was, latest first."""
    found: list[float] = []
    for part in turn.parts:
        asked = None if part.act is None else part.act.act
        if isinstance(asked, Ask) and isinstance(asked.question, When):
            told = [one.begin for one in parts(part.result, Episode)]
            found += told[-1:] or [one.begin for one in parts(part.result, Shown)][-1:]
    return tuple(reversed(found))


def stretch_named(turn: Turn) -> tuple[float, float] | None:
    """Return the part of the ride [s] of which the last account or list was asked by name."""
    named = next((span for p in reversed(turn.parts) if (span := _named_part(p))), None)
    return None if named is None or named.end - named.begin > LONG else (named.begin, named.end)


def _named_part(part: Part) -> Span | None:
    """Return the part of the ride of which an account or a list was asked, if it was named."""
    asked = None if part.act is None else part.act
    if asked is None or asked.listed is not None:
        listed = None if asked is None else asked.listed
        return None if listed is None or listed.whole or not listed.said else listed
    match asked.act:
        case Ask(question=Doing() | Summarise() | Listing() | Peak() | Changed()):
            span = asked.span
            long = span is not None and span.said and span.begin < span.end
            return span if long and span is not None and not (span.whole or span.ahead) else None
    return None


def _of_deed(part: Part) -> tuple[float, float] | None:
    """Return when a deed was of which a measure was asked: what it cost reaches on until now."""
    act = None if part.act is None else part.act.act
    match act:
        case Ask(question=HowMuch(of=Measured(event=Event(time=Between())))):
            return _asked(part)
    return None


def _told(result: Answer | Refusal, now: float) -> tuple[float, float] | None:
    match result:
        case ChoiceReason(deed=Episode() as deed) | MotionReason(deed=deed):
            return _stretch(deed, now)
        case OtherReason(deed=Episode() as deed) | Bound(went=Episode() as deed):
            return _stretch(deed, now)
        case ChoiceReason(contrast=contrast) | SupposedOfUs(contrast=contrast):
            return contrast.decided, contrast.decided
        case Method(decided=float() as decided):
            return decided, decided
        case Happenings(form="list" | "summary") | Identified(such=None):
            return None  # who somebody is tells what he does, but not as the topic
        case Priority(first=Ego(), time=time) if time > now - SAME:
            return None  # who went first is of a deed, and told while it goes on
        case Priority(time=time) | Beliefs(time=float() as time):
            return time, time
    deeds = tuple(parts(result, Episode))
    if deeds:
        return _stretch(deeds[-1], now)
    measures = [m for m in parts(result, Measure) if m.gap is None and m.time < now]
    return (measures[0].time, measures[0].until or measures[0].time) if measures else None


def _asked(part: Part) -> tuple[float, float] | None:
    span = None if part.act is None else part.act.span
    return None if span is None or span.ahead or span.whole else (span.begin, span.end)


def _stretch(deed: Episode, now: float) -> tuple[float, float]:
    return deed.begin, now if deed.end is None else deed.end
