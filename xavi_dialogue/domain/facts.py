"""Facts: what the record shows, as values that answers are made of.

Times are simulation seconds. Things are grounded: `Ego`, `Vehicle`, and places.
"""

from typing import Literal, TypeAlias

from planner.record.trace import Action as MacroAction
from planner.record.trace import HoldUp, Outcome
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.terms import Ego, Feature, Junction, Thing, Vehicle
from xavi_dialogue.domain.traffic_lights import Crossed, Foreseen, Shown
from xavi_dialogue.domain.vocabulary import ActionName, Attribute, Bearing, Kind, Side

Somebody: TypeAlias = Ego | Vehicle

#: Why a fact is not known.
Gap: TypeAlias = Literal[
    "before-record",  # earlier than the ride
    "in-future",  # not known yet
    "gap-in-record",  # lost on its way
    "out-of-view",  # the vehicle was not in view then
    "hidden",  # behind another vehicle
    "out-of-sight",  # behind a building: nobody can be seen there
    "not-sensed",  # the car has no such sense: weather, drivers' faces, horns
    "not-recorded",  # it exists but no record keeps it
    "no-way",  # no road leads to the destination from where the car is going
    "not-applicable",  # it has no value: time to collision of vehicles that part
    "others-thoughts",  # what other drivers think or know
    "unknown-plans",  # what the passengers have to be there for
]


class Look(Value, frozen=True):
    """A vehicle as it is seen at a time: enough to describe it truly."""

    vehicle: int
    time: float  # [s]
    kind: Kind
    colour: str | None
    length: float  # [m]
    bearing: Bearing  # where it is from us at that time
    distance: float  # [m] between the bodies
    ahead: float  # [m] of its centre in our frame; negative: behind
    left: float  # [m] likewise; negative: to the right
    speed: float  # [m/s]
    oncoming: bool = False
    alone: bool = False  # no other vehicle in view has its kind and colour
    in_view: bool = True
    seen: float | None = None  # [s] when it was seen last, where it is not in view


class Episode(Value, frozen=True):
    """A stretch of the ride in which somebody did one thing, or a traffic light showed one."""

    actor: Somebody | Feature
    action: ActionName
    begin: float  # [s]
    end: float | None = None  # [s] None while it goes on
    object: Thing | None = None  # whom or what it concerns
    side: Side | None = None
    speed_from: float | None = None  # [m/s]
    speed_to: float | None = None  # [m/s]
    peak: float | None = None  # [m/s2] highest deceleration, positive
    place: Junction | None = None
    exit: int | None = None  # of a roundabout, counted from where it was entered
    how: HoldUp | None = None  # of waiting, slowing, giving way: what held the actor up
    standing: bool = False  # it came to a standstill in it
    sure: bool = True  # False: read off positions and likely, not recorded


class Measure(Value, frozen=True):
    """One attribute of one thing at a time or over an interval."""

    attribute: Attribute
    thing: Thing
    time: float  # [s] of the value; of an extreme, when it was reached
    value: float | None = None  # in the unit of the attribute
    word: str | None = None  # of attributes that have words: a colour, a kind, a bearing
    to: Thing | None = None
    until: float | None = None  # [s] end of the interval, where there is one
    low: float | None = None
    high: float | None = None
    extreme: Literal["highest", "lowest", "mean", "total"] | None = None
    reference: float | None = None  # beside a speed: the limit where the thing is
    at_least: bool = False  # the value is a bound from below
    lights: tuple[str, ...] = ()  # of indicator and brake lights: what is shown
    side: Side | None = None  # of an exit, a turn, a lane
    count: int | None = None  # lanes there; exits of the roundabout
    rule: str | None = None  # of right of way: priority, give-way, equal, depends
    gap: Gap | None = None  # why there is no value


class Expectation(Value, frozen=True):
    """What the car believed that a vehicle would do."""

    actions: tuple[ActionName, ...]
    probability: float
    place: str | None = None  # edge


class Belief(Value, frozen=True):
    """What the car believed of a vehicle at a decision, likeliest first."""

    vehicle: int
    time: float  # [s] of the decision
    expectations: tuple[Expectation, ...]


class OptionValue(Value, frozen=True):
    """A first action that a decision weighed, with what was expected of it."""

    action: MacroAction
    chosen: bool
    outcome: Outcome
    probability: float  # of that outcome, as far as the rollouts are to be trusted
    time: float | None  # [s] expected until the goal, where it gets there
    delta: float | None  # [s] by which it takes longer than what was chosen
    value: float | None  # mean reward
    collision: float = 0.0  # probability of one
    collided_with: int | None = None
    exceeds: float | None = None  # [s] by which it takes longer at least, where its end is not seen
    close: bool = False  # all in all, as good as what was chosen, as far as can be told


class Relating(Value, frozen=True):
    """A relation as it was at a time."""

    relation: str
    thing: Thing
    to: Thing
    time: float  # [s]
    holds: bool


Fact: TypeAlias = (
    Episode | Measure | Belief | Look | OptionValue | Relating | Shown | Crossed | Foreseen
)
