"""Measuring: whose a measure is, to whom, of what, and at which moment of the ride."""

import dataclasses
from collections.abc import Callable
from typing import Any, Final

from msgspec.structs import replace

from xavi_dialogue.domain.discourse import Span
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import (
    Ago,
    At,
    Back,
    Between,
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Everyone,
    Exists,
    Feature,
    Is,
    Lane,
    Measured,
    Pronoun,
    Proposition,
    Quantity,
    Related,
    Relative,
    Thing,
    Time,
    Unsaid,
    Vehicle,
    Wanted,
    WholeRide,
)
from xavi_dialogue.domain.vocabulary import Kind
from xavi_dialogue.nlu.grounding.acts.simulations import COUNTED, plain
from xavi_dialogue.nlu.grounding.completion.discussion import interval
from xavi_dialogue.nlu.grounding.context import Grounder, Window
from xavi_dialogue.nlu.grounding.events.windows import pointed
from xavi_dialogue.nlu.grounding.salience import vehicles_of
from xavi_dialogue.nlu.grounding.things.scene import on_foot

#: What has a value at each moment.
MOMENTARY: Final = frozenset(
    ("speed", "limit", "excess", "gap", "headway", "distance", "time-to-collision", "lane",
     "indicator", "brake-lights", "distance-to-go", "time-to-go"),
)  # fmt: skip
#: Kinds by which anybody is meant.
ANYBODY: Final[tuple[Kind, ...]] = ("vehicle", "car")
#: What may be asked of "it" where it is our car.
OURS: Final = frozenset(("speed", "acceleration", "deceleration"))
TURNING: Final = frozenset(("turn", "exit-left", "exit-right"))
MOMENT: Final = 1.0  # [s] ago that a value was "just now", "a second ago"
PRESENT: Final = 0.5  # salience from which a vehicle is the one spoken of
_SPOKEN: Final = ("it", "he", "she", "that", "this", "one")

Timed = Callable[[Time, Any, Grounder, "Window | None"], Window]


def measured(
    spoken: Measured, g: Grounder, timed: Timed, outer: Window | None = None, *,
    extreme: bool = False,
) -> Measured:  # fmt: skip
    """Ground a measure; `extreme`: over all of the time that is said."""
    if spoken.attribute in COUNTED:
        return replace(plain(spoken), time=timed(spoken.time, spoken.tense, g, outer).term)
    spoken = _in_lane(_one_of(_corefer(spoken, g)))
    both = (spoken.thing, spoken.to)
    if extreme and spoken.attribute == "distance" and spoken.to is None:
        both = (spoken.thing, Ego())  # "how close did the cyclist get?"
    past = spoken.tense in ("past", "perfect")
    unsaid = extreme and past and not any(_is_spoken_of(one, g) for one in both)
    kind = _any_kind(both, extreme=unsaid) if Ego() in both else None
    nearest = kind is not None and (extreme or (past and isinstance(spoken.time, WholeRide)))
    if nearest and kind is not None:  # "the closest anyone came to us"
        everyone = extreme and kind in ANYBODY
        spoken = replace(spoken, thing=Ego(), to=None if everyone else Everyone(kind))
    if _is_to_come(spoken, g):
        spoken = replace(spoken, event=None, tense="future")  # "our speed for the turn"
    if spoken.attribute == "speed" and spoken.event == Event("move", tense="present"):
        spoken = replace(spoken, event=None)  # "how much do we drive now?"
    event = spoken.event
    if event is not None:
        event = g.event(event, "presupposed" if event.tense == "past" else "asked", outer)
    if spoken.thing == Pronoun("one") and g.context.discourse.named is not None:
        spoken = replace(spoken, tense="past")  # "at 26 s, was it moving, and how fast?"
    window = timed(spoken.time, spoken.tense, g, outer)
    if event is not None and isinstance(spoken.time, Unsaid) and (when := interval(event)):
        window = dataclasses.replace(g.window(Between(*when), "past"), said=False)
    about = spoken.about
    if about is not None:
        about = g.proposition(about, "supposed", None)
    spoken = spoken if nearest else _to_whom(spoken, g)
    to = None if spoken.to is None else g.thing(spoken.to, window)
    thing = g.thing(spoken.thing, window)
    time = _moment(spoken, window, g, extreme=extreme)
    if isinstance(time, At) and isinstance(spoken.time, Relative | Back | Ago):
        g.notes.span = Span(time.at, time.at, said=True)
    return replace(spoken, thing=thing, to=to, event=event, about=about, time=time)


def than_us(spoken: Compares) -> Measured | Quantity | None:
    """Give what a measure is compared with: "is the left lane faster?" is than we are."""
    of = spoken.left
    lane = isinstance(of.thing, Lane) and of.thing.which != "own" and of.attribute == "speed"
    if lane and spoken.right is None and spoken.comparator in ("more", "less"):
        return replace(of, thing=Ego())
    return spoken.right


def _in_lane(spoken: Measured) -> Measured:
    """Take the speed of another lane for that of the vehicles in it."""
    lane = spoken.thing
    if spoken.attribute != "speed" or not isinstance(lane, Lane) or lane.which == "own":
        return spoken
    there = Described(such=Related("on", Wanted(), lane), plural=True)
    return replace(spoken, thing=there)


def _one_of(spoken: Measured) -> Measured:
    """Take those of whom one is named for the ones it is chosen from: "the nearest of them"."""
    one = spoken.thing
    if not isinstance(one, Described) or spoken.to not in (Pronoun("they"), Pronoun("them-all")):
        return spoken
    if one.extreme is None and one.rank is None:
        return spoken
    return replace(spoken, thing=replace(one, among=spoken.to), to=None)


def _is_to_come(spoken: Measured, g: Grounder) -> bool:
    """Tell whether our speed in a turn is asked that we have not come to yet."""
    event = spoken.event
    if event is None or event.action not in TURNING or spoken.attribute != "speed":
        return False
    ours = isinstance(event.actor, Ego) and spoken.tense != "past" and event.time == Unsaid()
    now = g.context.now
    return ours and not g.context.holds(replace(event, tense="present"), now, now)


def _any_kind(things: tuple[Thing | None, ...], *, extreme: bool) -> Kind | None:
    """Tell of which kind any road user is meant; None: a particular one.

    Where the closest is asked for, it is meant of those on foot or on bicycles, too, of whom a
    passenger does not know which one it was: "how close did the cyclist get?".
    """
    for thing in things:
        if not isinstance(thing, Described):
            continue
        known = thing.definite and not (extreme and thing.kind not in ANYBODY)
        plain = Described(
            thing.kind, other=thing.other, plural=thing.plural, definite=thing.definite
        )
        return None if known or thing != plain else thing.kind
    return None


def _is_spoken_of(thing: Thing | None, g: Grounder) -> bool:
    """Tell whether somebody of that kind was just spoken of."""
    if not isinstance(thing, Described):
        return False
    spoken = (v for v, s in vehicles_of(g.context.discourse.mentions) if s >= PRESENT)
    looks = (g.context.look(vehicle, g.context.now) for vehicle in spoken)
    return any(look is not None and look.kind == thing.kind for look in looks)


def whichever(thing: Thing, such: Proposition | None) -> Thing:
    """Take "which cars came within 2 metres?" for all that were ever seen, not those in view."""
    match such:
        case Compares(left=Measured(attribute="distance", time=WholeRide()), right=Quantity()):
            kind = _any_kind((thing,), extreme=True) or (
                thing.kind if isinstance(thing, Described) and thing.kind in ANYBODY else None
            )
            return thing if kind is None else Wanted(kind)
    return thing


def of_anybody(of: Measured, other: Proposition | Measured | Quantity | None) -> Measured:
    """Take "was anyone faster than us?" of all road users, at any time in the past."""
    ours = isinstance(other, Measured) and isinstance(other.thing, Ego)
    kind = _any_kind((of.thing,), extreme=False)
    if of.attribute != "speed" or not ours or kind is None:
        return of
    past = isinstance(of.time, Unsaid) and of.tense in ("past", "perfect")
    return replace(of, thing=Everyone(kind), time=WholeRide() if past else of.time)


def tally(of: Measured, g: Grounder) -> Measured:
    """Ground how many there were, or how often something was done."""
    if of.event is not None:
        whole = WholeRide() if isinstance(of.event.time, Unsaid) else of.event.time
        return replace(of, event=g.event(replace(of.event, time=whole), "asked"))
    found = g.thing(of.thing, g.window(Unsaid(), "perfect"))
    return replace(of, thing=found, about=Exists(of.thing))


def _corefer(spoken: Measured, g: Grounder) -> Measured:
    """Let "how fast is it going?" be of us, where we are spoken of."""
    alone = spoken.thing == Pronoun("it") and spoken.to is None and spoken.tense == "present"
    if spoken.attribute == "distance" and alone:
        return spoken if spoken_of(g) else replace(spoken, attribute="distance-to-go", thing=Ego())
    unsaid = spoken.thing == Pronoun("one") and not _speaks_of_others(g)
    ours = spoken.attribute == "speed" and spoken.tense == "present" and _is_here(spoken.thing, g)
    ours |= _is_vague(spoken.thing, g) and spoken.attribute in OURS and _speaks_of_us(g)
    if unsaid or ours:
        return replace(spoken, thing=Ego())
    return spoken


def _to_whom(spoken: Measured, g: Grounder) -> Measured:
    """Take a distance that is said to nothing for that to the vehicle just spoken of."""
    alone = isinstance(spoken.thing, Ego) and spoken.to is None and spoken.event is None
    if spoken.attribute != "distance" or not alone:
        return spoken
    near = [v for v, salience in vehicles_of(g.context.discourse.mentions) if salience >= PRESENT]
    if not near:
        return spoken
    g.notes.leaned = True
    return replace(spoken, to=Vehicle(near[0]))


def just_named(g: Grounder) -> Vehicle | None:
    """Give the vehicle that was named last in this utterance."""
    fresh = (v for v, salience in vehicles_of(g.context.discourse.mentions) if salience > 1.0)
    return next((Vehicle(v) for v in fresh), None)


def spoken_of(g: Grounder) -> bool:
    """Tell whether another vehicle was just spoken of."""
    return any(salience >= PRESENT for _, salience in vehicles_of(g.context.discourse.mentions))


def of_ride(spoken: Is, g: Grounder) -> Is:
    """Take "it" in "it is far" for the destination, in "is it clear?" for our way.

    "This is fast" is said of our car.
    """
    if spoken.state == "free" and spoken.thing == Pronoun("it"):
        asked = g.context.discourse.question, g.context.discourse.propositions[:1]
        return replace(spoken, thing=first(asked, Lane) or Feature("way"))
    if spoken_of(g):
        return spoken
    if spoken.state == "far" and spoken.thing == Pronoun("it"):
        return replace(spoken, thing=Destination())
    if spoken.state in ("fast", "slow") and spoken.thing in (Pronoun("this"), Pronoun("that")):
        return replace(spoken, thing=Ego())
    return spoken


def _speaks_of_others(g: Grounder) -> bool:
    """Tell whether another vehicle was what the question before was about."""
    asked = g.context.discourse.question
    return first(asked, Vehicle) is not None and not isinstance(getattr(asked, "of", None), Event)


def _speaks_of_us(g: Grounder) -> bool:
    """Tell whether it is our own driving that was just spoken of, and no other vehicle."""
    discourse = g.context.discourse
    if spoken_of(g):
        return False
    return first((discourse.question, discourse.propositions[:1]), Ego) is not None


def _is_here(thing: Thing | None, g: Grounder) -> bool:
    """Tell whether "this" is our car: nobody in view was just spoken of."""
    spoken = (v for v, s in vehicles_of(g.context.discourse.mentions) if s >= PRESENT)
    return thing == Pronoun("this") and not set(spoken) & set(g.context.in_view(g.context.now))


def _is_vague(thing: Thing | None, g: Grounder) -> bool:
    """Tell whether a pronoun may be our car: "he" is not where somebody crosses our way."""
    if not isinstance(thing, Pronoun) or thing.form not in _SPOKEN:
        return False
    return thing.form not in ("he", "she") or not on_foot(g.context, g.context.now)


def _moment(spoken: Measured, window: Window, g: Grounder, *, extreme: bool) -> Time:
    """Tell the moment of a value: "when you began to turn", "before you braked".

    A deed that did not take place stays in the term, for the explainer to say so.
    """
    time, found = spoken.time, window.term
    deed = time.anchor if isinstance(time, Relative) else None
    if isinstance(deed, Event) and not isinstance(found, Between):
        return found if window.ahead else replace(time, anchor=g.event(deed, "asked"))
    if spoken.attribute not in MOMENTARY or extreme:
        return found
    if time == Ago(None):
        return At(max(g.context.now - MOMENT, g.context.begin))
    return pointed(time, window).term
