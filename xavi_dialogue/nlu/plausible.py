"""Plausibility: what an act costs that says of a thing what cannot be said of its kind."""

from functools import lru_cache
from typing import Any

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    Claim,
    Elliptic,
    HowDecide,
    HowMany,
    HowMuch,
    Identify,
    Request,
    Summarise,
    Which,
)
from xavi_dialogue.domain.terms import (
    Caused,
    Compares,
    Described,
    Destination,
    Ego,
    Event,
    Exists,
    Exit,
    Feature,
    Happens,
    Is,
    Junction,
    Lane,
    Measured,
    Passenger,
    Pronoun,
    Quantity,
    Record,
    Related,
    Road,
    Unknown,
    Unsaid,
    Vehicle,
    Wanted,
)

PLAIN = 0.0
DOUBTFUL = 0.4
ODD = 0.8
_PLACES = (Junction, Exit, Lane, Road, Feature, Destination, Record)
_FIXED = (Junction, Exit, Road, Record)
_ROAD_USERS = (Ego, Vehicle, Described, Pronoun)
_OF_LIGHTS = frozenset({"indicator", "brake-lights", "size", "colour", "kind", "name"})
#: What is not done to anybody: "who is that car coming" is no question for whom it comes to.
_ALONE = frozenset({"come", "go", "do", "move", "stand", "turn", "continue"})
_APPROACHES = frozenset({"come", "approach", "appear", "happen", "go", "do", "head"})


@lru_cache(maxsize=4096)
def oddity(act: Act) -> float:
    """Say what an act costs for what it says, beside what its words cost."""
    return _top(act) + _inside(act)


def _top(act: Act) -> float:
    """Judge what stands on its own."""
    match act:
        case Claim(that=Caused(cause=cause, effect=None)) if isinstance(cause, (*_PLACES, Ego)):
            return ODD
        case Claim(that=Caused(cause=Described(definite=False), effect=None)):
            return ODD
        case Ask(question=Identify(thing=Pronoun(form="he" | "she"))):
            return DOUBTFUL  # "what is he up to now" rather asks what he does
        case Ask(
            question=Which(such=Happens(event=Event(action, actor, Wanted(), modal=None)))
        ) if action in _ALONE and not isinstance(actor, Wanted):
            return DOUBTFUL
        case Ask(question=Summarise(about=Ego())):
            return DOUBTFUL
        case Request(event=Event(action="do", object=None)):
            return ODD
        case Elliptic(thing=Ego() | Passenger(), event=None, time=Unsaid(), form="same"):
            return DOUBTFUL
    return PLAIN


def _inside(value: Any) -> float:
    """Add up what a term and the terms in it cost."""
    cost = _own(value)
    for name in getattr(value, "__struct_fields__", ()):
        inner = getattr(value, name)
        if isinstance(inner, tuple):
            cost += sum(_inside(one) for one in inner if hasattr(one, "__struct_fields__"))
        elif hasattr(inner, "__struct_fields__"):
            cost += _inside(inner)
    return cost


def _own(value: Any) -> float:
    match value:
        case Related():
            return _related(value)
        case Event():
            return _event(value)
        case Compares(left=Measured(attribute=attribute), comparator="same", right=right):
            named = attribute in _OF_LIGHTS or not isinstance(right, Quantity)
            return DOUBTFUL if named else PLAIN
        case Measured(thing=Unknown()):
            return DOUBTFUL
        case HowMany(of=Event(action="do", object=None)):
            return DOUBTFUL
        case HowMany(of=Pronoun() | Unknown() | Feature(kind="space" | "way")):
            return ODD
        case HowDecide(of=Caused()):
            return ODD
        case HowMuch(
            of=Measured(attribute="size" | "count", thing=Unknown() | Feature() | Pronoun())
        ):
            return ODD
        case HowMuch(of=Measured(attribute="count", thing=Ego())):
            return ODD
        case Exists(thing=Feature(kind="way")) | Identify(thing=Feature(kind="way")):
            return ODD
        case Is(state="right", thing=Ego() | Described(), event=event) if event is not None:
            return DOUBTFUL
    return PLAIN


def _related(value: Related) -> float:
    thing, to = value.thing, value.to
    if value.relation == "same-as":
        if thing == to:
            return ODD
        if isinstance(thing, _ROAD_USERS) and isinstance(to, (*_PLACES, Unknown)):
            return ODD
        return PLAIN
    if thing == to:
        return ODD
    if value.relation == "with" and isinstance(to, (Pronoun, Wanted)):
        return DOUBTFUL
    if isinstance(to, Unknown) or isinstance(thing, Unknown):
        return DOUBTFUL
    return PLAIN


def _event(value: Event) -> float:
    cost = PLAIN
    if isinstance(value.actor, _FIXED) and value.action not in _APPROACHES:
        cost += ODD
    if value.action == "do" and isinstance(value.object, Unknown):
        cost += DOUBTFUL
    if value.action == "do" and isinstance(value.object, Passenger):
        cost += ODD
    if isinstance(value.actor, Unknown):
        cost += DOUBTFUL
    if value.actor == value.object and not isinstance(value.actor, Pronoun):
        cost += DOUBTFUL
    return cost
