"""Propositions: relations, states, comparisons, beliefs: their things and times grounded."""

import dataclasses
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import (
    Believed,
    Between,
    Both,
    Caused,
    Compares,
    Described,
    Ego,
    Event,
    Exists,
    Happens,
    Has,
    Is,
    Junction,
    Lane,
    Measured,
    Nobody,
    Not,
    Pronoun,
    Proposition,
    Quantity,
    Related,
    Road,
    Tense,
    That,
    Thing,
    Time,
    Unsaid,
    Vehicle,
    WholeRide,
)
from xavi_dialogue.nlu.grounding.acts.generic import come_along, in_order
from xavi_dialogue.nlu.grounding.acts.measuring import measured
from xavi_dialogue.nlu.grounding.acts.recasting import of_nobody, something_wrong, within_limit
from xavi_dialogue.nlu.grounding.acts.windows import is_stale
from xavi_dialogue.nlu.grounding.completion.discussion import (
    affirmed,
    asserted,
    discussed,
    events,
    interval,
    questioned,
)
from xavi_dialogue.nlu.grounding.context import Grounder, Mode, Window
from xavi_dialogue.nlu.grounding.rewriting import first
from xavi_dialogue.nlu.grounding.salience import vehicles_of
from xavi_dialogue.nlu.grounding.things.pronouns import apart

NOTHING_SAID: Final = 0.5  # cost of "that" where nothing has been said
UNHEARD_OF: Final = 0.4  # cost of taking for granted what no record tells
_UNHEARD_OF: Final = frozenset(("faulty", "dirty", "awake", "busy"))
#: What is said of events rather than of things.
OF_EVENTS: Final = frozenset(
    ("necessary", "allowed", "worth-it", "wrong", "right", "better", "over", "possible", "normal",
     "comfortable", "uncomfortable", "safe", "dangerous", "close", "late"),
)  # fmt: skip
_ONLY_EVENTS: Final = frozenset(("necessary", "worth-it", "over", "better"))


def proposition(
    spoken: Proposition, mode: Mode, g: Grounder, outer: Window | None = None
) -> Proposition:
    """Ground a proposition."""
    match spoken:
        case Happens(event=Event(actor=Nobody(described=None))):
            return g.proposition(of_nobody(spoken), mode, outer)
        case Happens(event=event):
            return in_order(Happens(g.event(event, mode, outer)), mode)
        case Not(content=content):
            inner: Mode = "denied" if mode == "presupposed" else mode
            return Not(g.proposition(content, inner, outer))
        case Both(contents=contents):
            each = tuple(g.proposition(one, mode, outer) for one in contents)
            return replace(spoken, contents=each)
        case That():
            return _that(g)
        case Caused():
            return _caused(spoken, g, outer)
        case Compares():
            return _compares(spoken, g, outer)
        case Exists():
            return _exists(spoken, g, outer)
        case Is():
            limited = within_limit(spoken, g)
            if limited is not None:
                return g.proposition(limited, mode, outer)
            return _is(something_wrong(spoken, g) or spoken, g, mode, outer)
        case Related():
            spoken = come_along(spoken)
            window = timed(spoken.time, spoken.tense, g, outer)
            thing = g.thing(spoken.thing, window)
            place = _place(spoken, g)
            to = apart(place, thing, g).thing(place, window)
            return replace(spoken, thing=thing, to=to, time=window.term)
        case Has():
            window = timed(spoken.time, spoken.tense, g, outer)
            return replace(spoken, thing=g.thing(spoken.thing, window), time=window.term)
        case Believed():
            window = timed(spoken.time, spoken.tense, g, outer)
            content = g.proposition(spoken.content, "supposed", window)
            if isinstance(spoken.content, That):  # what came true or not, as it was foreseen
                content = affirmed(content)
            return replace(spoken, content=content, time=window.term)


def _place(spoken: Related, g: Grounder) -> Thing:
    """Take "it" in "how long have we been in it" for the place just spoken of."""
    if spoken.relation != "on" or not isinstance(spoken.to, Pronoun):
        return spoken.to
    return first(g.context.discourse.question, (Junction, Lane, Road)) or spoken.to


def timed(time: Time, tense: Tense, g: Grounder, outer: Window | None) -> Window:
    """Find the window of a state; where none is said, the episode in focus."""
    if outer is not None and isinstance(time, Unsaid):
        return outer
    window = g.window(time, tense)
    focus = g.context.discourse.episode
    if focus is not None and is_stale(g.context):
        focus = None
    if isinstance(time, Unsaid) and tense == "past" and focus is not None:
        window = inferred(focus, g)
    open_ended = isinstance(time, Unsaid) and tense in ("past", "perfect") and focus is None
    if outer is None and not open_ended:
        g.notes.spans(window.span)
    return window


def _compares(spoken: Compares, g: Grounder, outer: Window | None) -> Compares:
    right = spoken.right
    of = spoken.left
    near = isinstance(right, Quantity) and of.attribute in _APART and outer is None
    if near and isinstance(of.time, Unsaid) and of.tense in ("past", "perfect"):
        of = replace(of, time=WholeRide())  # "did he come within 5 metres?"
    left = measured(of, g, timed, outer)
    if isinstance(right, Measured):
        right = measured(right, apart(right.thing, left.thing, g), timed, outer)
    return replace(spoken, left=left, right=right)


def _exists(spoken: Exists, g: Grounder, outer: Window | None) -> Exists:
    window = timed(spoken.time, spoken.tense, g, outer)
    thing = spoken.thing
    if isinstance(thing, Described) and not thing.definite:
        thing = replace(thing, plural=True)
    return replace(spoken, thing=g.thing(thing, window), time=window.term)


def _is(spoken: Is, g: Grounder, mode: Mode, outer: Window | None) -> Is:
    spoken = _of_event(spoken, g)
    event = spoken.event
    if mode == "presupposed" and spoken.state in _UNHEARD_OF:
        g.notes.presupposed = False
        g.notes.cost += UNHEARD_OF
    window = outer
    if event is not None:
        event = g.event(event, "presupposed" if event.tense == "past" else "asked", outer)
        when = interval(event)
        if when is not None and isinstance(spoken.time, Unsaid):
            window = inferred(when, g)
    if window is None or not isinstance(spoken.time, Unsaid):
        window = timed(spoken.time, spoken.tense, g, outer)
    thing = None if spoken.thing is None else g.thing(spoken.thing, window)
    return replace(spoken, thing=thing, event=event, time=window.term)


def _of_event(spoken: Is, g: Grounder) -> Is:
    """Take "it" for the event under discussion where the state is one of events."""
    vague = spoken.thing is None or (
        isinstance(spoken.thing, Pronoun) and spoken.thing.form in ("it", "that", "this")
    )
    if spoken.event is not None or not vague or spoken.state not in OF_EVENTS:
        return spoken
    if spoken.state in _ONLY_EVENTS or spoken.tense == "past":
        known = discussed(g.context)
    else:
        known = next(events(g.context.discourse), None)
    if known is not None:
        g.notes.leaned = True
        return replace(spoken, thing=None, event=known)
    return spoken if vehicles_of(g.context.discourse.mentions) else replace(spoken, thing=None)


def inferred(interval: tuple[float, float], g: Grounder) -> Window:
    """Give the window of an episode that nobody named."""
    return dataclasses.replace(g.window(Between(*interval), "past"), said=False)


def _caused(spoken: Caused, g: Grounder, outer: Window | None) -> Caused:
    effect = spoken.effect
    if effect is None or isinstance(effect, That):
        effect = questioned(g.context)
        g.notes.leaned = True
    else:
        effect = g.proposition(effect, "presupposed", outer)
    event = discussed(g.context) if effect is None else first(effect, Event)
    window = outer or g.window(Unsaid(), "past")
    if event is not None and (when := interval(event)):
        window = inferred(when, g)
        g.notes.spans(window.span)
    cause = spoken.cause
    if isinstance(cause, _PROPOSITIONS):
        return replace(spoken, cause=g.proposition(cause, "asked", outer), effect=effect)
    return replace(spoken, cause=suspect(cause, event, g, window), effect=effect)


_APART: Final = frozenset(("distance", "gap", "headway", "time-to-collision"))
_PROPOSITIONS: Final = (
    Happens, Related, Is, Has, Compares, Exists, Caused, Believed, Not, Both, That,
)  # fmt: skip


def suspect(thing: Thing, event: Event | None, g: Grounder, window: Window) -> Thing:
    """Ground who is taken for the cause: rather somebody who has to do with the event."""
    if event is None or not isinstance(event.actor, Ego):
        return g.thing(thing, window)
    deeds = g.context.deeds(Ego(), *window.search)

    def fits(vehicle: int) -> Episode | None:
        return next((e for e in deeds if e.object == Vehicle(vehicle)), None)

    return g.thing(thing, window, fits)


def _that(g: Grounder) -> Proposition:
    known = asserted(g.context)
    if known is None:
        g.notes.cost += NOTHING_SAID
        return That()
    g.notes.leaned = True
    event = first(known, Event)
    if event is not None and (when := interval(event)):
        g.notes.spans(inferred(when, g).span)
    return known
