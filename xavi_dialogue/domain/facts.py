"""Facts: what the record shows, as values that answers consist of.

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
    "gap-in-record",  # reports were lost
    "out-of-view",  # the vehicle was not in view then
    "hidden",  # behind another vehicle
    "out-of-sight",  # behind a building: nobody can be seen there
    "not-sensed",  # the car has no such sense: weather, drivers' faces, horns
    "not-recorded",  # it exists but is not recorded
    "no-deeds",  # the record shows plans, and not what was carried out
    "no-way",  # no road leads to the destination from where the car is going
    "not-applicable",  # it has no value: time to collision of vehicles that move apart
    "others-thoughts",  # what other drivers think or know
    "unknown-plans",  # what the passengers have to do at the destination
]


class Look(Value, frozen=True):
    """A vehicle as it is seen at one time: all that its description needs."""

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
    seen: float | None = None  # [s] when it was last seen, if it is not in view


class Episode(Value, frozen=True):
    """A stretch of the ride in which somebody did one thing, or a light showed one colour."""

    actor: Somebody | Feature
    action: ActionName
    begin: float  # [s]
    end: float | None = None  # [s] None while it goes on
    object: Thing | None = None  # the thing or road user that it concerns
    side: Side | None = None
    speed_from: float | None = None  # [m/s]
    speed_to: float | None = None  # [m/s]
    peak: float | None = None  # [m/s2] highest deceleration, positive
    place: Junction | None = None
    exit: int | None = None  # of a roundabout, counted from where it was entered
    how: HoldUp | None = None  # kind of hold-up, of waiting, slowing and giving way
    standing: bool = False  # the actor came to a standstill in it
    sure: bool = True  # False: inferred from positions, not recorded


class Measure(Value, frozen=True):
    """One attribute of one thing at a time or over an interval."""

    attribute: Attribute
    thing: Thing
    time: float  # [s] of the value; of an extreme, when it was reached
    value: float | None = None  # in the unit of the attribute
    word: str | None = None  # value of attributes that have words: a colour, a kind, a bearing
    to: Thing | None = None
    until: float | None = None  # [s] end of the interval, if there is one
    low: float | None = None
    high: float | None = None
    extreme: Literal["highest", "lowest", "mean", "total"] | None = None
    reference: float | None = None  # of a speed: the limit where the thing is
    at_least: bool = False  # the value is a lower bound
    lights: tuple[str, ...] = ()  # of indicator and brake lights: those that are on
    side: Side | None = None  # of an exit, a turn, a lane
    count: int | None = None  # number of lanes there, or of exits of the roundabout
    rule: str | None = None  # of right of way: priority, give-way, equal, depends
    gap: Gap | None = None  # why there is no value


class Expectation(Value, frozen=True):
    """Something that the car expected a vehicle to do."""

    actions: tuple[ActionName, ...]
    probability: float
    place: str | None = None  # edge


class Belief(Value, frozen=True):
    """The car's expectations of a vehicle at a decision, likeliest first."""

    vehicle: int
    time: float  # [s] of the decision
    expectations: tuple[Expectation, ...]


class OptionValue(Value, frozen=True):
    """A first action that a decision considered, with its expected outcome."""

    action: MacroAction
    chosen: bool
    outcome: Outcome
    probability: float  # of that outcome, calibrated
    time: float | None  # [s] expected until the goal; None: it does not get there
    delta: float | None  # [s] by which it takes longer than the chosen action
    value: float | None  # mean reward
    collision: float = 0.0  # probability of a collision
    collided_with: int | None = None
    exceeds: float | None = None  # [s] minimum by which it takes longer, if that is all we know
    close: bool = False  # as good as the chosen action, within the error of the comparison


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
