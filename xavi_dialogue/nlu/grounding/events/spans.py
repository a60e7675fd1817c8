"""Spans: stretches of the ride beside, before and after what was spoken of, and what is of note."""

from typing import Final

from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Between, Ego, Event, Has, Is, Measured, Next, Related
from xavi_dialogue.nlu.grounding.context import Context, Window

SOON: Final = 15.0  # [s] that "soon" and "next" reach ahead
PAST_BY: Final = 1.5  # [s] after which a moment that was spoken of as present is past ...
SPOKEN: Final = 20.0  # ... and up to which it is "that time"
SLACK: Final = 2.5  # [s] by which a time that was said may be off
BESIDE: Final = 8.0  # [s] before or after an event
JUST_BEFORE: Final = 0.2  # [s] before something that are still of it
TOGETHER: Final = 1.5  # [s] between deeds that belong together
LONGEST: Final = 15.0  # [s] that deeds which belong together last at most
#: What we set about on purpose.
MANOEUVRES: Final = frozenset(
    ("change-left", "change-right", "exit-left", "exit-right", "exit-straight", "enter"),
)
#: What people call something that happened.
NOTABLE: Final = frozenset(
    (
        *("brake", "stop", "wait", "give-way", "swerve", "cut-in", "collide", "nearly-collide"),
        *("change-left", "change-right", "exit-left", "exit-right", "turn", "overtake", "merge"),
        *("stand", "slow-down", "let-go", "pull-out", "avoid", "enter", "leave", "change-lane"),
        *("exit-straight", "continue-next-exit", "u-turn"),
    )
)

Interval = tuple[float, float]


def focus(discourse: Discourse) -> Interval | None:
    """Give the episode that "then" and "that" reach back to."""
    return discourse.episode


def asked_then(context: Context) -> Interval | None:
    """Give the moment of the last question, if it was of the present that is past by now."""
    asked, question = context.discourse.asked_at, context.discourse.question
    if asked is None or not PAST_BY < context.now - asked <= SPOKEN:
        return None
    of = first(question, (Event, Measured, Is, Related, Has))
    return (asked, asked) if getattr(of, "tense", None) == "present" else None


def between(begin: float, end: float, now: float) -> Window:
    """Take all of an interval."""
    return Window(begin, end, Between(begin, end), (begin, end), True, ahead=begin > now)


def coming(context: Context, seconds: float, said: bool) -> Window:
    """Take the next seconds."""
    now = context.now
    return Window(now, now + seconds, Next(), (now, now + seconds), said, ahead=True)


def notable(context: Context) -> Interval | None:
    """Give the latest thing of note in which we had a part, with what belongs to it."""
    deeds = context.deeds(None, context.begin, context.now)
    ours = [e for e in deeds if e.action in NOTABLE and Ego() in (e.actor, e.object)]
    if not ours:
        return None
    begin, end = interval_of(ours[-1], context)
    for episode in reversed(ours[:-1]):
        first, last = interval_of(episode, context)
        if last >= begin - TOGETHER and end - first <= LONGEST:
            begin, end = min(begin, first), max(end, last)
    return begin, end


def interval_of(episode: Episode, context: Context) -> Interval:
    """Give when an episode was; one that goes on lasts until now."""
    return episode.begin, context.now if episode.end is None else episode.end


def beside(relation: str, interval: Interval, context: Context, approach: float = 0.0) -> Window:
    """Take what lies before, in or after an interval."""
    (first, last), now, begin = interval, context.now, context.begin
    match relation:
        case "before":
            start = max(begin, first - BESIDE)
            end = max(begin, first - JUST_BEFORE)
            return Window(start, end, Between(start, end), (begin, end - 0.05), True)
        case "after":
            end = min(now, last + BESIDE)
            start = min(last, end)
            between = Between(start, end)
            return Window(start, end, between, (start + 0.05, now), True, prefer="first")
        case "until":
            return Window(begin, first, Between(begin, first), (begin, first), True)
        case "since":
            return Window(last, now, Between(last, now), (last, now), True)
    search = (first - max(approach, SLACK), last + SLACK)
    return Window(first, last, Between(first, last), search, True)
