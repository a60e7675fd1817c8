"""Timing: when what is asked about was, where a question says it elsewhere or not at all."""

from typing import Any

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Changed, Doing, HowSure, Listing, Question, Why
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    At,
    AtDecision,
    Back,
    Believed,
    Between,
    Ego,
    Event,
    Happens,
    Next,
    Now,
    Proposition,
    Rank,
    Relative,
    Start,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.nlu.grounding.completion.discussion import last_deed
from xavi_dialogue.nlu.grounding.context import Grounder, Window
from xavi_dialogue.nlu.grounding.events.spans import notable
from xavi_dialogue.nlu.grounding.events.windows import pointed, startling


def over(time: Any, g: Grounder) -> Window:
    """Find the stretch that is asked about: all of the ride, where none is said."""
    if isinstance(time, Unsaid):
        window = g.window(Unsaid(), "perfect")
    else:
        window = g.window(time, "past")
    g.notes.spans(window.span)
    return window


def foreseen(spoken: HowSure) -> HowSure:
    """Take the time of what is to come for that of the belief: "... at 12 s"."""
    event = spoken.of.event if isinstance(spoken.of, Happens) else None
    if event is None or event.tense != "present":
        return spoken
    told = isinstance(event.time, Relative) and event.time.relation == "during"
    if spoken.time not in (Unsaid(), event.time):
        return spoken
    if not told and not isinstance(event.time, At | AtDecision | Back):
        return spoken
    to_come = replace(event, time=Unsaid(), tense="future")
    return replace(spoken, of=Happens(to_come), time=event.time)


def coming(of: Proposition | None, window: Window, g: Grounder) -> Proposition | None:
    """Take what is expected of somebody as it was to come at the time that is said."""
    g.notes.span = window.span
    match of:
        case Happens(event=Event(modal="will", time=At()) as event) if event.actor != Ego():
            return Happens(replace(event, time=Now(), tense="present", modal="would"))
    return of


def believed_then(spoken: Believed) -> Believed:
    """Take "your log says you rated it so at 13 s" for what was believed then."""
    while isinstance(spoken.content, Believed):
        spoken = spoken.content
    event = spoken.content.event if isinstance(spoken.content, Happens) else None
    if event is None or event.tense != "present" or not isinstance(spoken.time, Unsaid):
        return spoken
    if not isinstance(event.time, At | AtDecision):
        return spoken
    to_come = replace(event, time=Unsaid(), tense="future")
    return replace(spoken, content=Happens(to_come), time=event.time, tense="past")


def believed_last(g: Grounder) -> Proposition | None:
    """Give what was just said to have been believed of another vehicle: "that estimate"."""
    told = g.context.discourse.propositions
    found = next((one for one in told if isinstance(one, Believed)), None)
    asked = isinstance(g.context.discourse.question, HowSure)
    if asked or found is None or first(found.content, Vehicle) is None:
        return None
    g.notes.leaned = True
    return found.content


def of_deed(spoken: Listing) -> Listing:
    """Take the time of the deeds that are listed for that of the list, which has none."""
    deed = spoken.event
    if deed is None or isinstance(deed.time, Unsaid) or not isinstance(spoken.time, Unsaid):
        return spoken
    return replace(spoken, time=deed.time, event=replace(deed, time=Unsaid()))


def seen_then(spoken: Listing, g: Grounder) -> Listing:
    """Ask for what is believed as of now of somebody who was not in view when that was done."""
    about = spoken.about
    if spoken.of != "beliefs" or about is None or spoken.time != Back():
        return spoken
    if g.context.discourse.episode is None or g.context.stale:  # as we last set about something
        spoken = replace(spoken, time=Relative("during", Event("do")))
    then = pointed(spoken.time, g.window(spoken.time, "past"))
    known = g.thing(about, then)
    if isinstance(known, Vehicle) and known.number not in g.context.world.in_view(then.end):
        return replace(spoken, about=known, time=Unsaid())
    return spoken


def changed(spoken: Changed, g: Grounder) -> Changed:
    """Ground what changed: since the last two times that were asked about, where none is said."""
    if not isinstance(spoken.time, Unsaid):
        return replace(spoken, time=over(spoken.time, g).term)
    named = g.context.discourse.named
    if named is not None:  # "at 13 seconds you were turning. What changed?"
        return replace(spoken, time=Between(named[0], g.context.now))
    times = sorted(g.context.discourse.times[:2])
    if len(times) < 2:
        return spoken
    g.notes.leaned = True
    return replace(spoken, time=Between(times[0], times[1]))


def of_doing(spoken: Doing, g: Grounder) -> Question:
    """Find what is meant by "what was that?", "after this" and the first or last deed."""
    match spoken:
        case Doing(actor=None, tense="past", time=Unsaid() | Back(relation="during" | "after")):
            if (braking := startling(g.context)) is not None:
                return Why(Happens(braking))
            found = notable(g.context)
            return spoken if found is None else replace(spoken, time=Between(*found))
        case Doing(actor=Ego(), tense="future", time=Back(relation="after")):
            return replace(spoken, time=Next())  # "after this, what will you do?"
        case Doing(actor=Ego(), tense="past", time=Rank(rank=-1)):
            deed = last_deed(g.context)
            return spoken if deed is None else replace(spoken, time=deed.time)
        case Doing(actor=Ego(), tense="past", time=Rank(rank=1)):
            return replace(spoken, time=Start())
    return spoken
