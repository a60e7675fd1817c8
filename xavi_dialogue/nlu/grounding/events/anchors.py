"""Anchors: the part of the ride that a time names by what happened, or by a place."""

from dataclasses import replace
from typing import Final

from msgspec.structs import replace as with_fields

from xavi_dialogue.domain.terms import (
    Destination,
    Ego,
    Event,
    Exit,
    Feature,
    Junction,
    Pronoun,
    Rank,
    Relative,
    Road,
    Tense,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.context import Grounder, Window
from xavi_dialogue.nlu.grounding.events.spans import (
    BESIDE,
    MANOEUVRES,
    NOTABLE,
    SOON,
    Interval,
    beside,
    between,
    coming,
    focus,
    interval_of,
    notable,
)
from xavi_dialogue.nlu.grounding.kin import like
from xavi_dialogue.nlu.grounding.things.places import Visit, presence, visit_of, visits

APPROACH: Final = 6.0  # [s] before a junction that belong to it
UNFOUND: Final = 0.6  # cost of a time that hangs on what did not happen


def relative(time: Relative, tense: Tense, g: Grounder) -> Window:
    """Find the part of the ride that a deed or a place names."""
    context = g.context
    found = _anchored(time, tense, g)
    if found is None:
        return coming(context, SOON, said=True)
    if not found and time.relation == "before" and isinstance(time.anchor, Junction):
        return between(max(context.begin, context.now - BESIDE), context.now, context.now)
    if not found:
        g.notes.cost += UNFOUND
        g.notes.presupposed = False
        return g.window(Unsaid(), tense)
    rank = _rank(time)
    if rank is None and isinstance(time.anchor, Event) and not context.stale:
        found = _spoken_of(found, g)
    rank = -1 if rank is None else rank
    index = rank - 1 if rank > 0 else max(len(found) + rank, 0)
    approach = APPROACH if isinstance(time.anchor, Junction | Exit) else 0.0
    there = beside(time.relation, found[min(index, len(found) - 1)], context, approach)
    return replace(there, whole=time.relation == "during" and points(time.anchor))


def points(anchor: object) -> bool:
    """Tell whether a deed is pointed at as a stretch of time: "during that stop"."""
    return isinstance(anchor, Event) and anchor.actor in (Pronoun("that"), Pronoun("this"))


def _rank(time: Relative) -> int | None:
    """Give which of several times is named: "when we stopped the first time"."""
    anchor = time.anchor
    if time.rank is None and isinstance(anchor, Event) and isinstance(anchor.time, Rank):
        return anchor.time.rank
    return time.rank


def _anchored(time: Relative, tense: Tense, g: Grounder) -> tuple[Interval, ...] | None:
    """Find when the anchor was; () never, None: it is yet to come."""
    whole = g.window(Unsaid(), "past")
    match time.anchor:
        case Event(action="do", actor=Ego()):
            return _of_ours(g)
        case Event(tense="present") if tense != "past" and time.relation in ("before", "until"):
            return None  # "can he come out before we pass?"
        case Event(tense="present" | "perfect") if tense != "past" and time.relation == "after":
            return None  # "which way do we go once he moves?"
        case Event(action="leave", actor=Ego(), object=Feature(kind="light") as light):
            return _anchored(Relative(time.relation, light), tense, g)
        case Event() as event if points(event):
            return _of_event(with_fields(event, actor=Ego(), tense="past"), "past", g)
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
            place = g.thing(spoken, g.window(Unsaid(), tense))
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
            return tuple(interval_of(e, g.context) for e in past)
        case Ego() if tense != "past" and time.relation == "after":
            return None  # "once we are off this thing, where do we go?"
        case thing:
            found = g.thing(thing, whole)
            seen = isinstance(found, Vehicle) and found.number in g.context.world.in_view(whole.end)
            if seen and tense != "past" and time.relation == "after":
                return None  # "once the orange car is past"
            present = presence(g.context, found) if isinstance(found, Vehicle) else None
            return () if present is None else (present,)


def _spoken_of(found: tuple[Interval, ...], g: Grounder) -> tuple[Interval, ...]:
    """Keep those of several deeds that were spoken of; all if none were."""
    spoken = focus(g.context.discourse)
    if spoken is None:
        return found
    return tuple(i for i in found if i[0] <= spoken[1] and i[1] >= spoken[0]) or found


def _of_ours(g: Grounder) -> tuple[Interval, ...]:
    """Find what "when you did it", "when you committed" goes back to: the last manoeuvre."""
    context = g.context
    spoken = None if context.stale else focus(context.discourse)
    deeds = context.deeds(Ego(), context.begin, context.now)
    moves = [e for e in deeds if e.action in MANOEUVRES]
    if spoken is not None:
        near = [interval_of(e, context) for e in moves]
        near = [i for i in near if i[0] <= spoken[1] and i[1] >= spoken[0]]
        ours = any(e.begin == spoken[0] for e in deeds if e.action in NOTABLE)
        if ours or not moves:
            return (spoken,)
        return tuple(near[-1:]) or (interval_of(moves[-1], context),)
    found = interval_of(moves[-1], context) if moves else notable(context)
    return () if found is None else (found,)


def _of_event(event: Event, tense: Tense, g: Grounder) -> tuple[Interval, ...] | None:
    context = g.context
    inner = g.window(event.time, event.tense)
    grounded = g.event(event, "asked", inner)
    search = inner.search if inner.said else (context.begin, context.now)
    if grounded.action == "see" and isinstance(grounded.object, Vehicle):
        grounded = Event("appear", grounded.object)  # from when on it is seen
        first = context.holds(grounded, *search)
        return tuple(interval_of(e, context) for e in first) or ((context.begin, context.begin),)
    episodes = context.holds(grounded, *search) or like(context, grounded, *search)
    if not episodes and (tense == "future" or event.tense in ("future", "present", "perfect")):
        return None
    return tuple(interval_of(episode, context) for episode in episodes)


def _of_visits(found: tuple[Visit, ...], ahead: bool) -> tuple[Interval, ...] | None:
    if not found:
        return None if ahead else ()
    return tuple((visit.begin, visit.end) for visit in found)
