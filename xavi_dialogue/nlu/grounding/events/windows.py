"""Windows: the part of the ride that a time names, by tense and discourse where none was said."""

from dataclasses import replace
from typing import Final

from xavi_dialogue.domain.terms import (
    Ago,
    At,
    AtDecision,
    Back,
    Between,
    Ego,
    Event,
    Next,
    Now,
    Rank,
    Relative,
    Start,
    Tense,
    Time,
    Unsaid,
    WholeRide,
    Within,
)
from xavi_dialogue.nlu.grounding.context import Context, Grounder, Window
from xavi_dialogue.nlu.grounding.events.anchors import relative
from xavi_dialogue.nlu.grounding.events.spans import (
    SLACK,
    SOON,
    asked_then,
    beside,
    between,
    coming,
    focus,
    interval_of,
    notable,
)

BEFORE: Final = 2.0  # [s] that "before" and "earlier" are ago at least
JUST_NOW: Final = 5.0  # [s] that "just now" reaches back
RECENT: Final = 3.0  # [s] within which what is over still counts as present
OPENING: Final = 8.0  # [s] that the beginning of the ride lasts
HARD: Final = 4.0  # [m/s2] from which braking is felt as sudden
HALTS: Final = frozenset(("stop", "stand", "wait"))
#: Deeds at the middle of which they are thought to happen; others at their beginning.
AT_MIDDLE: Final = frozenset(
    ("pass", "overtake", "cross", "turn", "exit-left", "exit-right", "exit-straight", "head",
     "continue-next-exit", "come", "collide", "nearly-collide", "follow", "stand", "wait"),
)  # fmt: skip


def window(time: Time, tense: Tense, g: Grounder) -> Window:
    """Find the part of the ride that a time names."""
    context = g.context
    now, begin = context.now, context.begin
    match time:
        case Now():
            return Window(now, now, Now(), (now - RECENT, now), said=True)
        case Unsaid():
            return unsaid(tense, context)
        case At(at=at):
            return _at(at, now)
        case Ago(seconds=None):
            return between(max(begin, now - JUST_NOW), now, now)
        case Ago(seconds=float() as back, span=True):
            return replace(between(max(begin, now - back), now, now), whole=True)
        case Ago(seconds=float(), span=False) if now == begin:
            return unsaid("past", context)  # the ride has only just begun
        case Ago(seconds=float() as back):
            return _at(now - back, now)
        case AtDecision(number=number, last=last):
            return _decided(number, number if last is None else last, context)
        case Within(seconds=after):
            ahead = coming(context, SOON if after is None else after, said=True)
            return ahead if after is None else replace(ahead, term=time)
        case Between(begin=first, end=last):
            first, last = min(first, last), max(first, last)
            last = now if first < now < last else last
            return replace(between(first, last, now), whole=True)
        case Relative():
            return relative(time, tense, g)
        case Back(relation="before" | "earlier") if tense == "future":
            return coming(context, SOON, said=False)  # "will you stop before it?"
        case Back(seconds=float() as back):
            told = None if context.stale else focus(context.discourse)
            return _at(min((told or (now,))[0], now) - back, now)
        case Back(relation="earlier"):
            end = max(begin, now - BEFORE)
            return Window(begin, end, Unsaid(), (begin, end), True)
        case Back(relation="between"):
            return _in_between(tense, g)
        case Back(relation=relation):
            return _back(relation, g)
        case Rank(rank=rank):
            return Window(begin, now, WholeRide(), (begin, now), said=True, rank=rank)
        case Start():
            end = min(now, begin + OPENING)
            return Window(begin, end, Between(begin, end), (begin, end), True, prefer="first")
        case WholeRide():
            return Window(begin, now, WholeRide(), (begin, now), said=True, whole=True)
        case Next():
            return coming(context, SOON, said=True)
    return unsaid(tense, context)


def unsaid(tense: Tense, context: Context) -> Window:
    """Take the part of the ride that a tense alone names."""
    now, begin = context.now, context.begin
    match tense:
        case "present":
            return Window(now, now, Now(), (now - RECENT, now))
        case "future":
            return coming(context, SOON, said=False)
        case "perfect":
            return Window(begin, now, WholeRide(), (begin, now))
    return Window(begin, now, Unsaid(), (begin, now))


def pointed(time: Time, found: Window) -> Window:
    """Narrow what a deed names as a time to the moment that is meant by it.

    What lies before it, ends as it begins; what lies after it, begins as it ends.
    """
    anchor = time.anchor if isinstance(time, Relative) else None
    spoken = isinstance(anchor, Event) or isinstance(time, Back)
    spoken = spoken and isinstance(found.term, Between) and not found.whole
    if not isinstance(time, Relative | Back) or not spoken or not isinstance(found.term, Between):
        return found
    match time.relation:
        case "before":
            at = found.term.end
        case "after":
            at = found.term.begin
        case "during":
            middle = isinstance(anchor, Event) and anchor.action in AT_MIDDLE
            at = (found.term.begin + found.term.end) / 2.0 if middle else found.term.begin
        case _:
            return found
    return replace(found, begin=at, end=at, term=At(at))


def is_halt(time: Time) -> bool:
    """Tell whether a time is that of our standing still: "while we stood there"."""
    during = isinstance(time, Relative) and time.relation == "during"
    halt = time.anchor if isinstance(time, Relative) and during else None
    return isinstance(halt, Event) and halt.actor == Ego() and halt.action in HALTS


def _at(at: float, now: float) -> Window:
    search = (at - SLACK, at + SLACK)
    return Window(at, at, At(at), search, True, ahead=at > now + 0.5, prefer="nearest")


def _decided(number: int, last: int, context: Context) -> Window:
    """Take the time of a decision, or from one to another, by their numbers in the record."""
    first, end = (context.world.decided(n) for n in (number, last))
    end = context.now if end is None and last > number else end
    if first is None or end is None:
        return unsaid("past", context)
    return _at(first, context.now) if first == end else between(first, end, context.now)


def _back(relation: str, g: Grounder) -> Window:
    context = g.context
    g.notes.leaned = True
    interval = focus(context.discourse)
    if relation == "during" and (then := asked_then(context)) is not None:
        return replace(beside(relation, then, context), whole=False)
    if interval is None or context.stale:
        interval = notable(context) or interval
        if relation == "before":
            return Window(context.begin, context.now, Unsaid(), (context.begin, context.now), True)
    if interval is None:
        return unsaid("past", context)
    whole = relation == "during" and interval == context.discourse.stretch
    return replace(beside(relation, interval, context), whole=whole)


def _in_between(tense: Tense, g: Grounder) -> Window:
    """Take what lies between the two moments that were told last."""
    told = sorted(g.context.discourse.moments[:2])
    g.notes.leaned = True
    if len(told) < 2:
        return unsaid(tense, g.context)
    return replace(between(told[0], told[1], g.context.now), whole=True)


def startling(context: Context) -> Event | None:
    """Give our hard braking of just now, by which passengers are startled."""
    since = context.now - JUST_NOW
    hard = [e for e in context.deeds(Ego(), since, context.now)
            if e.action == "brake" and e.peak is not None and e.peak >= HARD]  # fmt: skip
    if not hard:
        return None
    return Event("brake", Ego(), time=Between(*interval_of(hard[-1], context)), tense="past")
