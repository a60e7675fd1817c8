"""Windows: the part of the ride that a time names, by tense and discourse where none was said."""

from dataclasses import replace
from typing import Final

from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import (
    Ago,
    At,
    AtDecision,
    Back,
    Between,
    Destination,
    Ego,
    Event,
    Exit,
    Feature,
    Junction,
    Next,
    Now,
    Rank,
    Relative,
    Road,
    Start,
    Tense,
    Time,
    Unsaid,
    Vehicle,
    WholeRide,
    Within,
)
from xavi_dialogue.nlu.grounding.context import Context, Grounder, Window
from xavi_dialogue.nlu.grounding.kin import like
from xavi_dialogue.nlu.grounding.things.places import Visit, presence, visit_of, visits

SLACK: Final = 2.5  # [s] by which a time that was said may be off
BEFORE: Final = 2.0  # [s] that "before" and "earlier" are ago at least
JUST_NOW: Final = 5.0  # [s] that "just now" reaches back
RECENT: Final = 3.0  # [s] within which what is over still counts as present
SOON: Final = 15.0  # [s] that "soon" and "next" reach ahead
OPENING: Final = 8.0  # [s] that the beginning of the ride lasts
BESIDE: Final = 8.0  # [s] before or after an event
APPROACH: Final = 6.0  # [s] before a junction that belong to it
JUST_BEFORE: Final = 0.2  # [s] before something that are still of it
HARD: Final = 4.0  # [m/s2] from which braking is felt as sudden
TOGETHER: Final = 1.5  # [s] between deeds that belong together
LONGEST: Final = 15.0  # [s] that deeds which belong together last at most
#: Deeds at the middle of which they are thought to happen; others at their beginning.
AT_MIDDLE: Final = frozenset(
    ("pass", "overtake", "cross", "turn", "exit-left", "exit-right", "exit-straight", "head",
     "continue-next-exit", "come", "collide", "nearly-collide", "follow", "stand", "wait"),
)  # fmt: skip
UNFOUND: Final = 0.6  # cost of a time that hangs on what did not happen

Interval = tuple[float, float]


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
            return _between(max(begin, now - JUST_NOW), now, now)
        case Ago(seconds=float() as back, span=True):
            return replace(_between(max(begin, now - back), now, now), whole=True)
        case Ago(seconds=float() as back):
            return _at(now - back, now)
        case AtDecision(number=number, last=last):
            return _decided(number, number if last is None else last, context)
        case Within(seconds=after):
            coming = _coming(context, SOON if after is None else after, said=True)
            return coming if after is None else replace(coming, term=time)
        case Between(begin=first, end=last):
            first, last = min(first, last), max(first, last)
            last = now if first < now < last else last
            return replace(_between(first, last, now), whole=True)
        case Relative():
            return _relative(time, tense, g)
        case Back(relation="before" | "earlier") if tense == "future":
            return _coming(context, SOON, said=False)  # "will you stop before it?"
        case Back(seconds=float() as back):
            told = None if context.stale else focus(context.discourse)
            return _at(min((told or (now,))[0], now) - back, now)
        case Back(relation="earlier"):
            end = max(begin, now - BEFORE)
            return Window(begin, end, Unsaid(), (begin, end), True)
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
            return _coming(context, SOON, said=True)
    return unsaid(tense, context)


def unsaid(tense: Tense, context: Context) -> Window:
    """Take the part of the ride that a tense alone names."""
    now, begin = context.now, context.begin
    match tense:
        case "present":
            return Window(now, now, Now(), (now - RECENT, now))
        case "future":
            return _coming(context, SOON, said=False)
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


def focus(discourse: Discourse) -> Interval | None:
    """Give the episode that "then" and "that" reach back to."""
    return discourse.episode


def _at(at: float, now: float) -> Window:
    search = (at - SLACK, at + SLACK)
    return Window(at, at, At(at), search, True, ahead=at > now + 0.5, prefer="nearest")


def _decided(number: int, last: int, context: Context) -> Window:
    """Take the time of a decision, or from one to another, by their numbers in the record."""
    first, end = (context.world.decided(n) for n in (number, last))
    end = context.now if end is None and last > number else end
    if first is None or end is None:
        return unsaid("past", context)
    return _at(first, context.now) if first == end else _between(first, end, context.now)


def _between(begin: float, end: float, now: float) -> Window:
    return Window(begin, end, Between(begin, end), (begin, end), True, ahead=begin > now)


def _coming(context: Context, seconds: float, said: bool) -> Window:
    now = context.now
    return Window(now, now + seconds, Next(), (now, now + seconds), said, ahead=True)


def _back(relation: str, g: Grounder) -> Window:
    context = g.context
    g.notes.leaned = True
    interval = focus(context.discourse)
    if interval is None or context.stale:
        interval = notable(context) or interval
        if relation == "before":
            return Window(context.begin, context.now, Unsaid(), (context.begin, context.now), True)
    if interval is None:
        return unsaid("past", context)
    whole = relation == "during" and interval == context.discourse.stretch
    return replace(_beside(relation, interval, context), whole=whole)


def notable(context: Context) -> Interval | None:
    """Give the latest thing of note in which we had a part, with what belongs to it."""
    deeds = context.deeds(None, context.begin, context.now)
    ours = [e for e in deeds if e.action in NOTABLE and Ego() in (e.actor, e.object)]
    if not ours:
        return None
    begin, end = _interval(ours[-1], context)
    for episode in reversed(ours[:-1]):
        first, last = _interval(episode, context)
        if last >= begin - TOGETHER and end - first <= LONGEST:
            begin, end = min(begin, first), max(end, last)
    return begin, end


def startling(context: Context) -> Event | None:
    """Give our hard braking of just now, by which passengers are startled."""
    since = context.now - JUST_NOW
    hard = [e for e in context.deeds(Ego(), since, context.now)
            if e.action == "brake" and e.peak is not None and e.peak >= HARD]  # fmt: skip
    if not hard:
        return None
    return Event("brake", Ego(), time=Between(*_interval(hard[-1], context)), tense="past")


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


def _interval(episode: Episode, context: Context) -> Interval:
    return episode.begin, context.now if episode.end is None else episode.end


def _beside(relation: str, interval: Interval, context: Context, approach: float = 0.0) -> Window:
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


def _relative(time: Relative, tense: Tense, g: Grounder) -> Window:
    context = g.context
    found = _anchored(time, tense, g)
    if found is None:
        return _coming(context, SOON, said=True)
    if not found and time.relation == "before" and isinstance(time.anchor, Junction):
        return _between(max(context.begin, context.now - BESIDE), context.now, context.now)
    if not found:
        g.notes.cost += UNFOUND
        g.notes.presupposed = False
        return unsaid(tense, context)
    rank = time.rank if time.rank is not None else -1
    index = rank - 1 if rank > 0 else max(len(found) + rank, 0)
    approach = APPROACH if isinstance(time.anchor, Junction | Exit) else 0.0
    return _beside(time.relation, found[min(index, len(found) - 1)], context, approach)


def _anchored(time: Relative, tense: Tense, g: Grounder) -> tuple[Interval, ...] | None:
    """Find when the anchor was; () never, None: it is yet to come."""
    whole = unsaid("past", g.context)
    match time.anchor:
        case Event(action="do", actor=Ego()):
            return _of_ours(g)
        case Event(tense="present") if tense != "past" and time.relation in ("before", "until"):
            return None  # "can he come out before we pass?"
        case Event(tense="present" | "perfect") if tense != "past" and time.relation == "after":
            return None  # "which way do we go once he moves?"
        case Event(action="leave", actor=Ego(), object=Feature(kind="light") as light):
            return _anchored(Relative(time.relation, light), tense, g)
        case Event() as event:
            return _of_event(event, tense, g)
        case Road(which="side") | Junction() | Exit() | Feature(kind="line") if tense in (
            "present",
            "future",
        ) and time.relation in (
            "before",
            "until",
        ):  # "how sure are you that it leaves before our entry?"
            return None
        case Junction() as spoken:
            place = g.thing(spoken, unsaid(tense, g.context))
            visit = visit_of(g.context, place) if isinstance(place, Junction) else None
            return _of_visits((visit,) if visit else (), ahead=tense != "past")
        case Exit():
            return _of_visits(visits(g.context, "roundabout"), ahead=tense != "past")
        case Destination():
            return None
        case Road(which="side") | Feature(kind="line"):  # where a junction begins
            return _of_visits(visits(g.context), ahead=tense != "past")
        case Feature(kind="light") as light:
            held = g.context.holds(Event("wait", Ego(), light), *whole.search)
            past = held or g.context.holds(Event("pass", Ego(), light), *whole.search)
            return tuple(_interval(e, g.context) for e in past)
        case Ego() if tense != "past" and time.relation == "after":
            return None  # "once we are off this thing, where do we go?"
        case thing:
            found = g.thing(thing, whole)
            seen = isinstance(found, Vehicle) and found.number in g.context.world.in_view(whole.end)
            if seen and tense != "past" and time.relation == "after":
                return None  # "once the orange car is past"
            present = presence(g.context, found) if isinstance(found, Vehicle) else None
            return () if present is None else (present,)


def _of_ours(g: Grounder) -> tuple[Interval, ...]:
    """Find what "when you did it", "when you committed" goes back to: the last manoeuvre."""
    context = g.context
    spoken = None if context.stale else focus(context.discourse)
    deeds = context.deeds(Ego(), context.begin, context.now)
    moves = [e for e in deeds if e.action in MANOEUVRES]
    if spoken is not None:
        near = [_interval(e, context) for e in moves]
        near = [i for i in near if i[0] <= spoken[1] and i[1] >= spoken[0]]
        ours = any(e.begin == spoken[0] for e in deeds if e.action in NOTABLE)
        if ours or not moves:
            return (spoken,)
        return tuple(near[-1:]) or (_interval(moves[-1], context),)
    found = _interval(moves[-1], context) if moves else notable(context)
    return () if found is None else (found,)


def _of_event(event: Event, tense: Tense, g: Grounder) -> tuple[Interval, ...] | None:
    context = g.context
    inner = window(event.time, event.tense, g)
    grounded = g.event(event, "asked", inner)
    search = inner.search if inner.said else (context.begin, context.now)
    if grounded.action == "see" and isinstance(grounded.object, Vehicle):
        grounded = Event("appear", grounded.object)  # from when on it is seen
        first = context.holds(grounded, *search)
        return tuple(_interval(e, context) for e in first) or ((context.begin, context.begin),)
    episodes = context.holds(grounded, *search) or like(context, grounded, *search)
    if not episodes and (tense == "future" or event.tense in ("future", "present", "perfect")):
        return None
    return tuple(_interval(episode, context) for episode in episodes)


def _of_visits(found: tuple[Visit, ...], ahead: bool) -> tuple[Interval, ...] | None:
    if not found:
        return None if ahead else ()
    return tuple((visit.begin, visit.end) for visit in found)
