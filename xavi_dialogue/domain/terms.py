"""Terms: things, times, events and propositions that questions and claims are built from.

A term is as spoken, or grounded. Grounding replaces what depends on scene, record or discourse.
Of things, only `Ego`, `Vehicle`, `Vehicles`, `Nobody` and places remain; of times, only `At`,
`Between`, `Now`, `Next`, `WholeRide`, and `Unsaid` if the explainer has to decide.
"""

from typing import Final, Literal, TypeAlias

from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.times import (
    Ago,
    At,
    AtDecision,
    Back,
    Between,
    Next,
    Now,
    Rank,
    Start,
    Unsaid,
    WholeRide,
    Within,
)
from xavi_dialogue.domain.vocabulary import (
    ActionName,
    Attribute,
    Bearing,
    Comparator,
    Extreme,
    Kind,
    Manner,
    Relation,
    Side,
    State,
)

__all__ = [
    "SOMEBODY_ELSE", "Ago", "At", "AtDecision", "Back", "Believed", "Between", "Both", "Caused",
    "Compares", "Described", "Destination", "Ego", "Event", "Everyone", "Exists", "Exit",
    "Extremes", "Feature", "Happens", "Has", "Is", "Junction", "Lane", "Measured", "Next",
    "Nobody", "Not", "Now", "Passenger", "Pronoun", "Proposition", "Quantity", "Rank", "Record",
    "Related", "Relative", "Road", "Start", "Tense", "That", "Thing", "Time", "Together",
    "Unknown", "Unsaid", "Vehicle", "Vehicles", "Wanted", "WholeRide", "Within",
]  # fmt: skip


class Ego(Value, frozen=True):
    """Our own car: "you", "we", "us", or "the car" if that can mean no other."""


class Vehicle(Value, frozen=True):
    """Another vehicle by its number on the screen."""

    number: int


class Vehicles(Value, frozen=True):
    """Several vehicles, grounded, in the order in which they are to be named."""

    numbers: tuple[int, ...]


class Together(Value, frozen=True):
    """Several things that are named one by one: "the lorry and the grey car"."""

    members: tuple["Thing", ...]


class Nobody(Value, frozen=True):
    """No vehicle: "nobody", "no one", or a description that fits none (grounded)."""

    described: "Described | None" = None


class Described(Value, frozen=True):
    """One or several road users by description: "the two red cars on our left that waited"."""

    kind: Kind = "vehicle"
    colour: str | None = None
    size: Literal["big", "small"] | None = None
    bearing: Bearing | None = None  # where it is
    origin: Bearing | None = None  # where it comes or came from
    of: "Thing | None" = None  # the bearing is relative to this; None: to us
    among: "Thing | None" = None  # these or some of them: "how many of them"
    doing: "Event | None" = None  # relative clause: "that cut in", "which we waited for"
    such: "Proposition | None" = None  # any other relative clause: "that you cannot see"
    plural: bool = False
    number: int | None = None  # how many: "the two cars"
    rank: int | None = None  # "the first" 1, "the second" 2, "the last" -1
    extreme: Literal["nearest", "farthest", "fastest", "slowest", "biggest"] | None = None
    other: bool = False  # "the other one", "another car": not the one spoken of
    definite: bool = True  # False: "a car", "any car", "somebody"


SOMEBODY_ELSE: Final = Described(other=True, definite=False)  # "anybody else", "another one"


class Pronoun(Value, frozen=True):
    """A word for a thing that was mentioned or is pointed at."""

    form: Literal["it", "he", "she", "they", "that", "this", "one", "who", "them-all"]


class Wanted(Value, frozen=True):
    """The thing that the question asks for: "which car", "who", "what"."""

    kind: Kind = "vehicle"


class Everyone(Value, frozen=True):
    """All road users, or all of a kind: "everybody", "all cars", "the others"."""

    kind: Kind = "vehicle"


class Destination(Value, frozen=True):
    """The passenger's destination."""


class Junction(Value, frozen=True):
    """A junction or roundabout; `rank` counts from here: 1 the next or this, -1 the last one."""

    form: Literal["junction", "roundabout"] = "junction"
    rank: int | None = None  # None: the one in question
    time: float | None = None  # [s] grounded: when we are or were there
    turning: bool = False  # where we turn off: "our turning"


class Exit(Value, frozen=True):
    """An exit of a roundabout or road: by count, by side, or the one in question."""

    rank: int | None = None
    side: Side | None = None


class Lane(Value, frozen=True):
    """A lane of our road."""

    which: Literal["own", "left", "right", "other", "rightmost", "leftmost", "any"] = "own"
    of: "Thing | None" = None  # whose lane; None: ours


class Road(Value, frozen=True):
    """A road: ours, a side road, the one that is right or wrong for our destination."""

    which: Literal["own", "side", "main", "left", "right", "fitting", "wrong", "any"] = "own"


class Feature(Value, frozen=True):
    """A thing on a road other than a lane; colour, rank and owner apply to lights."""

    kind: Literal[
        "light", "sign", "crossing", "curb", "parking", "building", "line", "bend", "queue",
        "space", "way", "obstacle", "headlight", "blind",
    ]  # fmt: skip
    colour: str | None = None  # that the description names: "the red light"
    rank: int | None = None  # 1 the next one, 2 the one behind it, -1 the last one
    of: "Thing | None" = None  # who faces it; None: we
    time: float | None = None  # [s] grounded: the time that is meant


class Passenger(Value, frozen=True):
    """The passenger who speaks: "me", "I"."""


class Record(Value, frozen=True):
    """The ride, its log, the record or the screen."""


class Unknown(Value, frozen=True):
    """A thing that is named by words without a known meaning."""

    words: str


Thing: TypeAlias = (
    Ego
    | Vehicle
    | Vehicles
    | Together
    | Nobody
    | Described
    | Pronoun
    | Wanted
    | Everyone
    | Destination
    | Junction
    | Exit
    | Lane
    | Road
    | Feature
    | Passenger
    | Record
    | Unknown
)


class Relative(Value, frozen=True):
    """A time relative to an event or thing: "when we turned", "before the roundabout"."""

    relation: Literal["during", "before", "after", "until", "since"]
    anchor: "Event | Thing"
    rank: int | None = None  # 1 the first time, 2 the second, -1 the last


Time: TypeAlias = (
    Now
    | Unsaid
    | At
    | AtDecision
    | Ago
    | Within
    | Between
    | Relative
    | Back
    | Rank
    | Start
    | WholeRide
    | Next
)
Tense: TypeAlias = Literal["past", "present", "future", "perfect"]


class Event(Value, frozen=True):
    """An action of somebody."""

    action: ActionName
    actor: Thing = Ego()
    object: Thing | None = None
    side: Side | None = None
    manner: tuple[Manner, ...] = ()
    time: Time = Unsaid()
    tense: Tense = "past"
    modal: Literal["will", "would", "can", "could", "should", "must", "might", "want"] | None = None
    then: "Event | None" = None  # done next: "change left and then turn right"
    where: "Related | None" = None  # the place where it is done: "wait behind the lorry"
    speeds: "tuple[Quantity, Quantity] | None" = None  # "you slowed from 50 to 15"


class Measured(Value, frozen=True):
    """An attribute of a thing at a time: "our speed", "his distance to us at 0:12"."""

    attribute: Attribute
    thing: Thing = Ego()
    to: Thing | None = None  # the other thing of gap, distance, time to collision, ...
    event: Event | None = None  # of duration, delay, deceleration: of this event
    about: "Proposition | None" = None  # of probability: of this
    time: Time = Unsaid()
    tense: Tense = "present"


class Quantity(Value, frozen=True):
    """A number with its unit, converted to SI."""

    value: float
    unit: Literal["m/s", "m", "s", "%", "m/s2", "count"] = "count"


class Happens(Value, frozen=True):
    """That an event happens, happened or will happen."""

    event: Event


class Related(Value, frozen=True):
    """That two things stand in a relation at a time."""

    relation: Relation
    thing: Thing
    to: Thing = Ego()
    time: Time = Unsaid()
    tense: Tense = "present"


class Is(Value, frozen=True):
    """That a thing or an event is in a state: "is that safe", "the left lane is free"."""

    state: State
    thing: Thing | None = None
    event: Event | None = None
    too: bool = False  # "too close"
    time: Time = Unsaid()
    tense: Tense = "present"


class Has(Value, frozen=True):
    """That an attribute has a value in words: "is it blue", "is he indicating left"."""

    attribute: Attribute
    value: str
    thing: Thing = Ego()
    time: Time = Unsaid()
    tense: Tense = "present"


class Compares(Value, frozen=True):
    """That a measure is more, less or the same as another, or as a number."""

    left: Measured
    comparator: Comparator
    right: "Measured | Quantity | None" = None  # None: with what is usual or allowed
    by: Quantity | None = None


class Exists(Value, frozen=True):
    """That there is such a thing: "is anybody behind us", "there is nobody in front"."""

    thing: Thing
    time: Time = Unsaid()
    tense: Tense = "present"


class Caused(Value, frozen=True):
    """That a thing or a fact is why an event came about: "is it the truck?", "because of him"."""

    cause: "Thing | Proposition"
    effect: "Proposition | None" = None  # None: what is under discussion


class Believed(Value, frozen=True):
    """That the car believed, expected, knew or saw something."""

    content: "Proposition"
    time: Time = Unsaid()
    tense: Tense = "past"


class Not(Value, frozen=True):
    """The negation of a proposition."""

    content: "Proposition"
    lexical: bool = False  # it is part of the word's meaning: "blocked" for not free


class Both(Value, frozen=True):
    """Several propositions that all hold ("and"), or one of which holds ("or")."""

    contents: tuple["Proposition", ...]
    join: Literal["and", "or"] = "and"


class That(Value, frozen=True):
    """A word for a proposition that was mentioned: "that", "so", "it" for a fact."""


Proposition: TypeAlias = (
    Happens | Related | Is | Has | Compares | Exists | Caused | Believed | Not | Both | That
)
Extremes: TypeAlias = Extreme
