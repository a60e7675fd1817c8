"""Plausibility: the cost of an act that says of a thing what cannot be said of its kind."""

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
    WhatIf,
    When,
    Whether,
    Which,
    Why,
)
from xavi_dialogue.domain.rewriting import first
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
    Has,
    Is,
    Junction,
    Lane,
    Measured,
    Nobody,
    Not,
    Passenger,
    Pronoun,
    Quantity,
    Record,
    Related,
    Relative,
    Road,
    Unknown,
    Unsaid,
    Vehicle,
    Wanted,
)

PLAIN = 0.0
SLIGHT = 0.15
DOUBTFUL = 0.4
ODD = 0.8
_PLACES = (Junction, Exit, Lane, Road, Feature, Destination, Record)
_FIXED = (Junction, Exit, Road, Record)
_ROAD_USERS = (Ego, Vehicle, Described, Pronoun)
_OF_LIGHTS = frozenset({"indicator", "brake-lights", "size", "colour", "kind", "name"})
#: What is done at one moment, which nobody tells where a moment is asked for.
_AT_ONCE = frozenset({"turn", "exit-left", "exit-right", "go", "stop", "pull-out"})
#: Actions without an object: "who is that car coming" does not ask to whom it comes.
_ALONE = frozenset({"come", "go", "do", "move", "stand", "turn", "continue"})
_SIDELESS = frozenset(
    ("wait", "brake", "let-go", "stop", "slow-down", "speed-up", "give-way", "collide", "arrive")
)
_OF_VEHICLES = frozenset(
    ("brake", "slow-down", "speed-up", "overtake", "wait", "give-way", "reverse", "keep-lane")
)
_PAST_VEHICLES = frozenset(("cut-in", "overtake", "follow", "let-go"))
_APPROACHES = frozenset({"come", "approach", "appear", "happen", "go", "do", "head"})


@lru_cache(maxsize=4096)
def oddity(act: Act) -> float:
    """Return the cost of what an act says, in addition to the cost of its words."""
    return _top(act) + _inside(act) + ODD * _is_told_when(act)


def _is_told_when(act: Act) -> bool:
    """Say whether a moment is asked for that is told: "when it turned green as we set off"."""
    match act:
        case Ask(
            question=When(of=Happens(event=Event(time=Relative("during", Event(action=action)))))
        ) if action in _AT_ONCE:
            return True
    return False


def _top(act: Act) -> float:
    """Return the cost of an act as a whole."""
    match act:
        case Elliptic(time=Relative(anchor=Event(tense="future"))):
            return SLIGHT  # "when we will arrive?" asks when
        case Claim(that=Caused(cause=cause, effect=None)) if isinstance(cause, (*_PLACES, Ego)):
            return ODD
        case Claim(
            that=Caused(
                cause=Described(definite=False) | Pronoun(form="it" | "that" | "this"), effect=None
            )
        ):
            return ODD
        case Ask(
            question=Why(of=Exists(thing=Feature()) | Caused(cause=Nobody()))
            | Why(of=Is(thing=Nobody()))
        ):
            return ODD  # "why are we braking, there is room" rather states that
        case Ask(question=Identify(thing=thing)) if thing == Described():
            return DOUBTFUL  # "how's the traffic" rather asks how busy it is
        case Ask(question=Identify(thing=Ego() | Pronoun(form="he" | "she")) | Summarise(Ego())):
            return DOUBTFUL  # "what is he up to now" rather asks what he does
        case Ask(
            question=Which(such=Happens(event=Event(action, actor, Wanted(), modal=None)))
        ) if action in _ALONE and not isinstance(actor, Wanted):
            return DOUBTFUL
        case Ask(question=HowMany(of=Ego() | Passenger())):
            return ODD
        case Ask(
            question=HowMany(
                of=Described(
                    doing=Event(
                        time=Relative(relation="until") | Relative(anchor=Event(action="arrive"))
                    )
                )
            )
        ):
            return ODD  # "how many turns until we are there" counts events, not things
        case Claim(that=Related(thing=Pronoun("who")) | Happens(event=Event(actor=Pronoun("who")))):
            return 2.0 * ODD  # "who" asks, and states nothing
        case Ask(
            question=Which(thing=Feature() | Junction(), such=Has(attribute="occupant"))
            | Which(such=Related(relation="same-as", to=Junction()))
            | Which(such=Not(content=Related(relation="same-as")))
        ):
            return ODD  # places carry nobody, and nobody is a place
        case Ask(question=Which(thing=Wanted(), such=such, among=())) if (
            such is not None and first(such, Wanted) is None
        ):
            return ODD  # nothing in it is asked for
        case Ask(question=Whether(that=Related(thing=Nobody()) | Is(thing=Nobody()), tag=False)):
            return SLIGHT  # "there is nobody in front" rather states that
        case Claim(that=Not(content=Happens(event=Event("do", Passenger(), None)))):
            return ODD  # "I do not", without anything that is stated
        case Request(event=Event(action="do", object=None) | Event(actor=Described())):
            return ODD
        case Elliptic(thing=Ego() | Passenger(), event=None, time=Unsaid(), form="same" | "why"):
            return DOUBTFUL
    return PLAIN


def _inside(value: Any) -> float:
    """Add up the costs of a term and of all terms in it."""
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
        case Is(state="fast", thing=thing) if thing == Described(definite=False):
            return DOUBTFUL  # "is anything coming up behind us fast?" asks who comes
        case HowMuch(of=Measured(attribute="size", thing=Ego())):
            return SLIGHT  # "how long do you think?"
        case Measured(thing=Unknown()) | Described(of=Unknown()):
            return DOUBTFUL
        case Described(such=Caused(cause=Wanted())):
            return ODD  # "a blue car what was the point of that"
        case Described(
            such=Not(content=Happens(event=Event(action="do" | "stand", actor=Passenger())))
        ):
            return ODD  # "a huge one I do not, like"
        case HowMany(of=Event(action="do", object=None)):
            return DOUBTFUL
        case Why(suspect=Pronoun(form="it" | "this")):
            return DOUBTFUL
        case WhatIf(supposed=Is(state="visible", thing=Ego())):
            return ODD  # "had you seen", without anything that is supposed
        case HowMany(of=Pronoun() | Unknown() | Feature(kind="space" | "way")):
            return ODD
        case HowDecide(of=Caused()):
            return ODD
        case Why(of=Not(content=Is(state="allowed", thing=Ego(), event=None))):
            return DOUBTFUL  # "why are we breaking"
        case HowMuch(
            of=Measured(attribute="size" | "count", thing=Unknown() | Feature() | Pronoun())
        ):
            return ODD
        case HowMuch(of=Measured(attribute="count", thing=Ego())):
            return ODD
        case Exists(thing=Feature(kind="way")) | Identify(thing=Feature(kind="way")):
            return ODD
        case Is(state="sure", thing=Described(number=int())):
            return ODD  # "pretty sure its 50 here"
        case Is(state="right", thing=Ego() | Described(), event=event) if event is not None:
            return DOUBTFUL
    return PLAIN


def _related(value: Related) -> float:
    thing, to = value.thing, value.to
    if value.relation == "same-as":
        if thing == to or (_is_vague(thing) and _is_vague(to)):
            return ODD
        if isinstance(thing, Ego) and isinstance(to, Described) and to.bearing is not None:
            return ODD
        if isinstance(thing, Unknown):
            return ODD
        if isinstance(thing, _ROAD_USERS) and isinstance(to, (*_PLACES, Unknown)):
            return ODD
        return PLAIN
    if thing == to:
        return ODD
    if value.relation == "on" and isinstance(to, (*_ROAD_USERS, Wanted)):
        return ODD
    if value.relation == "with" and isinstance(to, (Pronoun, Wanted)):
        return DOUBTFUL
    if isinstance(thing, Unknown):
        return ODD
    if isinstance(to, Unknown):
        return DOUBTFUL
    return PLAIN


def _is_vague(thing: object) -> bool:
    """Check whether a thing is a pronoun that may stand for anything."""
    return isinstance(thing, Pronoun) and thing.form in ("it", "that", "this")


def _is_ground(thing: object) -> bool:
    return isinstance(thing, Feature) and thing.kind in ("building", "crossing")


def _event(value: Event) -> float:
    cost = PLAIN
    fixed = isinstance(value.actor, _FIXED) or _is_ground(value.actor)
    if fixed and value.action not in _APPROACHES:
        cost += ODD
    if isinstance(value.actor, Feature) and value.action in _OF_VEHICLES:
        cost += ODD  # "the light is slowing down"
    if isinstance(value.object, Feature) and value.action in _PAST_VEHICLES:
        cost += ODD  # "we cut in ahead of the space"
    if value.action == "do" and isinstance(value.object, Unknown):
        cost += DOUBTFUL
    before_us = value.action == "cross" and (value.object == Ego() or value.where is not None)
    if (value.action in _SIDELESS or before_us) and value.side is not None:
        cost += ODD  # "they have to wait right?"
    if value.action == "do" and isinstance(value.object, Passenger):
        cost += ODD
    if isinstance(value.actor, Unknown):
        cost += DOUBTFUL
    if value.actor == value.object and not isinstance(value.actor, Pronoun):
        cost += DOUBTFUL
    return cost
