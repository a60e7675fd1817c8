"""Journeys: answers about our way, its extreme moments, and the decisions on it."""

from typing import Literal

from planner.record.places import JunctionKind, Rule, Turn
from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.facts import Belief, Episode, Look, Measure
from xavi_dialogue.domain.reasons import ChoiceReason
from xavi_dialogue.domain.terms import Event
from xavi_dialogue.domain.traffic_lights import Shown


class WayStep(Value, frozen=True):
    """Our way through a junction ahead."""

    kind: JunctionKind
    turn: Turn
    distance: float  # [m]
    rank: int  # 1: the next junction
    exit: int | None = None  # of a roundabout
    inside: bool = False  # we are on it: the exits still to come are counted
    rule: Rule | None = None  # who goes first there, if the answer states it
    light: bool = False  # a traffic light is in view there


class Course(Value, frozen=True):
    """Our way ahead: the way we take, the turns that are left, whether we stay on the road."""

    #: "choice": why we take the route; "bound": whether it leads to our destination
    form: Literal[
        "way", "route", "choice", "turns", "junctions", "roundabouts", "road", "nearly", "halt",
        "bound",
    ]  # fmt: skip
    steps: tuple[WayStep, ...]
    holds: bool | None = None  # the reply to a yes or no question
    left: float | None = None  # [m] to the destination
    soon: float | None = None  # [s] to it
    then: bool = False  # the question is what comes after what was stated
    onward: bool = False  # our way goes on beyond the last step, not known how
    arrived: bool = False  # there is no way ahead any more


class LaneFits(Value, frozen=True):
    """The answer whether our lane is the one to be in: whether the plan leaves it."""

    lane: Measure  # which one it is
    change: MacroAction | None = None  # the lane change that the plan has
    turn: WayStep | None = None  # where we turn next


class PeakMoment(Value, frozen=True):
    """The moment of the ride at which something was greatest."""

    of: str  # `meaning.Peak.of`
    time: float | None = None  # [s] None: there was nothing of the sort
    deeds: tuple[Episode, ...] = ()  # what we did then, the most important first
    measure: Measure | None = None  # how much it was
    others: tuple[Look, ...] = ()  # vehicles that caused it
    among: bool = False  # of the deeds asked about alone, not of the whole ride
    kind: Event | None = None  # `meaning.Peak.deed`
    lit: bool = False  # a traffic light caused it, too


class Decided(Value, frozen=True):
    """The result of a decision."""

    time: float  # [s]
    steps: tuple[MacroAction, ...]
    kept: bool = False  # it kept the previous plan
    doing: tuple[Episode, ...] = ()  # how we drove then


class Altered(Value, frozen=True):
    """The differences between a decision and an earlier one."""

    before: Decided
    after: Decided
    appeared: tuple[Look, ...] = ()
    beliefs: tuple[tuple[Belief, Belief], ...] = ()  # that changed, largest change first
    did: tuple[Episode, ...] = ()  # what happened between them
    light: Shown | None = None  # that had changed
    sudden: bool = False  # the one was made right after the other
    reason: ChoiceReason | None = None  # for the change, if the question is why


class AbandonedPlan(Value, frozen=True):
    """A decision at which a plan was given up for its risk."""

    time: float  # [s]
    risk: float  # of a collision
    vehicle: int | None = None  # the other one in the collision


class Wavered(Value, frozen=True):
    """The reason why a plan was repeatedly given up and resumed."""

    plan: MacroAction  # that was given up
    turns: tuple[AbandonedPlan, ...]
    resumed: bool = False  # it was resumed in the end
    claim: bool = False  # it answers a claim that we wavered
