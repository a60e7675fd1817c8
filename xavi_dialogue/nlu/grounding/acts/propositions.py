"""Propositions: relations, states, comparisons, beliefs: their things and times grounded."""

import dataclasses
from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    Back,
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
    Now,
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
    Vehicles,
    WholeRide,
)
from xavi_dialogue.nlu.grounding.acts import dangers
from xavi_dialogue.nlu.grounding.acts.measuring import (
    just_named,
    measured,
    of_anybody,
    of_ride,
    tally,
    than_us,
)
from xavi_dialogue.nlu.grounding.acts.recasting import of_nobody, something_wrong, within_limit
from xavi_dialogue.nlu.grounding.acts.restating import restated
from xavi_dialogue.nlu.grounding.acts.shared_subject import of_the_same
from xavi_dialogue.nlu.grounding.completion.discussion import (
    affirmed,
    asserted,
    discussed,
    events,
    interval,
    questioned,
)
from xavi_dialogue.nlu.grounding.context import Grounder, Mode, Window
from xavi_dialogue.nlu.grounding.events.afoot import walked
from xavi_dialogue.nlu.grounding.events.generic import come_along, in_order
from xavi_dialogue.nlu.grounding.events.hiding import behind_hider, past_hider, somebody_behind
from xavi_dialogue.nlu.grounding.events.timing import believed_then
from xavi_dialogue.nlu.grounding.events.windows import is_halt, pointed
from xavi_dialogue.nlu.grounding.salience import naming, vehicles_of
from xavi_dialogue.nlu.grounding.things.descriptions import is_such
from xavi_dialogue.nlu.grounding.things.in_way import anybody_in_way
from xavi_dialogue.nlu.grounding.things.pronouns import CLEAR, apart
from xavi_dialogue.nlu.grounding.things.scene import in_sight
from xavi_dialogue.nlu.grounding.things.such import ITSELF, of_kind, pointed_at, says_nothing

NOTHING_SAID: Final = 0.5  # cost of "that" where nothing has been said
UNHEARD_OF: Final = 0.4  # cost of taking for granted what no record tells
_UNHEARD_OF: Final = frozenset(("faulty", "dirty", "awake", "busy"))
#: What is said of events rather than of things.
OF_EVENTS: Final = frozenset(
    ("necessary", "allowed", "worth-it", "wrong", "right", "better", "over", "possible", "normal",
     "comfortable", "uncomfortable", "safe", "dangerous", "close", "late"),
)  # fmt: skip
#: What a vehicle that is seen does anyway, and is not foreseen to do.
_SHOWN: Final = frozenset(
    ("pass", "come", "appear", "approach", "move", "disappear", "see", "cut-in", "pull-out",
     "cross"),
)  # fmt: skip
_ONLY_EVENTS: Final = frozenset(("necessary", "worth-it", "over", "better"))


def proposition(
    spoken: Proposition, mode: Mode, g: Grounder, outer: Window | None = None
) -> Proposition:
    """Ground a proposition."""
    match spoken:
        case Happens(event=Event(actor=Nobody(described=None))):
            return g.proposition(of_nobody(spoken), mode, outer)
        case Happens() if (meant := restated(spoken, mode)) is not None:
            return g.proposition(meant, mode, outer)
        case Happens(event=event):
            others = event.tense == "present" and not isinstance(event.actor, Ego)
            mode = "asked" if others and "first" in event.manner else mode  # it may still come
            return in_order(Happens(g.event(event, mode, outer)), mode)
        case Not(content=content):
            inner: Mode = "denied" if mode == "presupposed" else mode
            return replace(spoken, content=g.proposition(content, inner, outer))
        case Both(contents=contents):
            each: list[Proposition] = []
            for one in contents:  # "did the red one leave, or is it behind us?"
                beside = g.beside(naming(g.context.discourse, tuple(each)))
                each.append(beside.proposition(of_the_same(one, contents, each), mode, outer))
            return replace(spoken, contents=tuple(each))
        case That():
            return _that(g)
        case Caused():
            return _caused(spoken, g, outer)
        case Compares():
            return _compares(spoken, g, outer)
        case Exists():
            return _exists(behind_hider(spoken, g), g, outer)
        case Is():
            if (limited := within_limit(spoken, g)) is not None:
                return g.proposition(limited, mode, outer)
            amiss = something_wrong(spoken, g)
            return amiss if amiss is not None else walked(_is(spoken, g, mode, outer), g)
        case Related("can-see", Ego(), Described(definite=False) as any_) if mode == "asked":
            return g.proposition(Exists(any_, time=spoken.time), mode, outer)
        case Related() if (there := somebody_behind(spoken, g)) is not None:
            return g.proposition(there, mode, outer)
        case Related():
            then = at_moment(spoken.time, spoken.tense, g, outer)
            return anybody_in_way(spoken, g, then) or walked(
                _related(past_hider(come_along(spoken), g), g, outer), g
            )
        case Has():
            return _has(spoken, g, outer)
        case Believed():
            spoken = believed_then(spoken)
            window = at_moment(spoken.time, spoken.tense, g, outer)
            content = g.proposition(spoken.content, "supposed", window)
            content = affirmed(content) if isinstance(spoken.content, That) else content
            while isinstance(content, Believed):  # nobody asks what we believed that we believed
                content = content.content
            match spoken.content, content:  # "it shot past. Did you see it coming?"
                case That(), Happens(event=Event(action, Vehicle() as shown, modal=None)) if (
                    action in _SHOWN
                ):
                    return Related("can-see", Ego(), shown, Now(), "past")
            return replace(spoken, content=content, time=window.term)


def _related(spoken: Related, g: Grounder, outer: Window | None) -> Related:
    """Ground where one thing is beside another."""
    if spoken.relation == "same-as" and isinstance(spoken.time, Back):
        spoken = replace(spoken, time=Unsaid())  # "the same car as before"
    found = timed if is_halt(spoken.time) else at_moment  # all the while that we stood there
    window = found(spoken.time, spoken.tense, g, outer)
    thing = pointed_at(spoken, g) or g.thing(spoken.thing, window)
    place = _place(spoken, g)
    same = spoken.relation == "same-as" and is_such(thing, place, g, window)
    to = thing if same else apart(place, thing, g).thing(place, window)
    if says_nothing(spoken, same):
        g.notes.cost += ITSELF
    return replace(spoken, thing=thing, to=to, time=window.term)


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
    discourse = g.context.discourse
    focus = discourse.named or discourse.episode
    if focus is not None and g.context.stale:
        focus = None
    if isinstance(time, Unsaid) and tense == "past" and focus is not None:
        window = inferred(focus, g)
        window = dataclasses.replace(window, said=focus == discourse.named)
    open_ended = isinstance(time, Unsaid) and tense in ("past", "perfect") and focus is None
    if outer is None and not open_ended:
        g.notes.spans(window.span)
    return window


def at_moment(time: Time, tense: Tense, g: Grounder, outer: Window | None) -> Window:
    """Find the window of a state; where a deed names it, the moment that is meant."""
    found = timed(time, tense, g, outer)
    window = pointed(time, found)
    if window is not found and outer is None:
        g.notes.span = window.span
    return window


def _compares(spoken: Compares, g: Grounder, outer: Window | None) -> Compares:
    of, right = spoken.left, than_us(spoken)
    if of.attribute == "count":
        return replace(spoken, left=tally(of, g))
    if isinstance(right, Quantity) and right.unit == "count" and of.attribute in _PACES:
        right = Quantity(round(right.value / 3.6, 6), "m/s")  # nobody says "km/h"
    near = isinstance(right, Quantity) and of.attribute in _APART and outer is None
    if near and isinstance(of.time, Unsaid) and of.tense in ("past", "perfect"):
        of = replace(of, time=WholeRide())  # "did he come within 5 metres?"
    left = measured(of_anybody(of, right), g, timed, outer)
    match left.thing:
        case Vehicles(numbers=(one, two)) if spoken.comparator == "same":  # "are both as fast?"
            other = replace(left, thing=Vehicle(two))
            return replace(spoken, left=replace(left, thing=Vehicle(one)), right=other)
    if isinstance(right, Measured):  # where it is of the same thing, at another time
        other = replace(right, thing=left.thing) if right.thing == of.thing else right
        right = measured(other, apart(right.thing, left.thing, g), timed, outer)
    return replace(spoken, left=left, right=right)


_NEAR: Final = frozenset(("roomy", "close"))  # of whom is named in the same breath
_PACES: Final = frozenset(("speed", "limit", "excess"))


def _exists(spoken: Exists, g: Grounder, outer: Window | None) -> Exists:
    window, thing = at_moment(spoken.time, spoken.tense, g, outer), spoken.thing
    if isinstance(thing, Described) and not thing.definite:
        thing = replace(thing, plural=True)
        doing, after = thing.doing, getattr(getattr(thing.doing, "time", None), "anchor", None)
        if doing is not None and isinstance(after, Described | Pronoun | Vehicle):
            g = g.beside(naming(g.context.discourse, g.thing(after, window)))
            thing = replace(thing, other=True, doing=replace(doing, time=Unsaid()))
    found = in_sight(g.thing(thing, window), thing, window.term, g.context)
    return replace(spoken, thing=found, time=window.term)


def _is(spoken: Is, g: Grounder, mode: Mode, outer: Window | None) -> Is:
    spoken = _of_event(dangers.threatened(spoken, g), g)
    spoken = of_ride(spoken, g)
    if spoken.thing is None and spoken.event is None and spoken.state in _NEAR:
        spoken = replace(spoken, thing=just_named(g))
    if spoken.state == "busy" and isinstance(spoken.thing, Pronoun):
        spoken = replace(spoken, thing=Road())  # "how busy is it?"
    event = spoken.event
    if mode == "presupposed" and spoken.state in _UNHEARD_OF:
        g.notes.presupposed = False
        g.notes.cost += UNHEARD_OF
    window = outer
    if event is not None:
        event = g.event(event, dangers.mode_of(event, spoken), outer)
        when = interval(event)
        if when is not None and isinstance(spoken.time, Unsaid):
            window = inferred(when, g)
    if window is None and spoken.state == "close" and isinstance(spoken.thing, Described):
        past = spoken.tense != "present" and isinstance(spoken.time, Unsaid)
        spoken = replace(spoken, time=WholeRide()) if past else spoken  # "was that car close?"
    if window is None or not isinstance(spoken.time, Unsaid):
        window = at_moment(spoken.time, spoken.tense, g, outer)
    thing = None if spoken.thing is None else g.thing(spoken.thing, window)
    return replace(spoken, thing=thing, event=event, time=window.term)


def _has(spoken: Has, g: Grounder, outer: Window | None) -> Has:
    window = at_moment(spoken.time, spoken.tense, g, outer)
    thing = of_kind(spoken, g) or g.thing(spoken.thing, window)
    return replace(spoken, thing=thing, time=window.term)


def _of_event(spoken: Is, g: Grounder) -> Is:
    """Take "it" for the event under discussion where the state is one of events."""
    vague = spoken.thing is None or (
        isinstance(spoken.thing, Pronoun) and spoken.thing.form in ("it", "that", "this")
    )
    if spoken.event is not None or not vague or spoken.state not in OF_EVENTS:
        return spoken
    told = next(iter(g.context.discourse.propositions), None)
    if spoken.state in ("wrong", "right") and isinstance(told, Believed):
        whom, event = first(told, Vehicle), first(told, Event)
        if whom is not None and event is not None and event.actor == whom:
            g.notes.leaned = True  # "you expected it to turn. Was that wrong?"
            return replace(spoken, thing=whom, time=told.time)
    near = next((v for v, s in vehicles_of(g.context.discourse.mentions) if s >= CLEAR), None)
    if spoken.state == "close" and spoken.tense == "present" and near is not None:
        g.notes.leaned = True
        return replace(spoken, thing=Vehicle(near))  # "that's tight, isn't it?"
    if isinstance(spoken.time, WholeRide) or dangers.is_of_undone(spoken, g):
        return replace(spoken, thing=None)  # "would you do anything differently?"
    if spoken.state in dangers.PERILS and spoken.tense == "past":
        known = dangers.fresh_event(g)
    elif spoken.state in _ONLY_EVENTS or spoken.tense == "past":
        known = discussed(g.context, real=spoken.tense == "past")
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
    if (known := asserted(g.context)) is None:
        g.notes.cost += NOTHING_SAID
        return That()
    g.notes.leaned = True
    if (event := first(known, Event)) is not None and (when := interval(event)):
        g.notes.spans(inferred(when, g).span)
    return known
