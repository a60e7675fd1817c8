"""Journeys: answers about our way, the moments that stand out on it, and what was decided."""

from typing import Literal

from planner.record.places import JunctionKind, Rule, Turn
from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.facts import Belief, Episode, Look, Measure
from xavi_dialogue.domain.reasons import ChoiceReason
from xavi_dialogue.domain.traffic_lights import Shown


class WayStep(Value, frozen=True):
    """What we do at a junction that we come to."""

    kind: JunctionKind
    turn: Turn
    distance: float  # [m]
    rank: int  # 1: the next junction
    exit: int | None = None  # of a roundabout
    inside: bool = False  # we are on it: the exits still to come are counted
    rule: Rule | None = None  # who goes first there, where that is told
    light: bool = False  # a traffic light is in view there


class Course(Value, frozen=True):
    """Our way ahead: which way we take, how many turns are left, whether we stay on the road."""

    form: Literal["way", "turns", "junctions", "roundabouts", "road", "nearly", "halt"]
    steps: tuple[WayStep, ...]
    holds: bool | None = None  # of a yes or no question
    left: float | None = None  # [m] to the destination
    soon: float | None = None  # [s] to it
    then: bool = False  # it is asked what comes after what was stated


class PeakMoment(Value, frozen=True):
    """The moment of the ride at which something was at its most."""

    of: str  # of `meaning.Peak`
    time: float | None = None  # [s] None: there was nothing of the sort
    deeds: tuple[Episode, ...] = ()  # what we did then, the most telling first
    measure: Measure | None = None  # how much it was
    others: tuple[Look, ...] = ()  # on account of whom


class Decided(Value, frozen=True):
    """What a decision came to."""

    time: float  # [s]
    steps: tuple[MacroAction, ...]
    kept: bool = False  # it was the plan of before
    doing: tuple[Episode, ...] = ()  # how we drove then


class Altered(Value, frozen=True):
    """What was different at one decision from an earlier one."""

    before: Decided
    after: Decided
    appeared: tuple[Look, ...] = ()
    beliefs: tuple[tuple[Belief, Belief], ...] = ()  # that moved, the most first
    did: tuple[Episode, ...] = ()  # what happened between them
    light: Shown | None = None  # that had changed
    sudden: bool = False  # the one was made right after the other
    reason: ChoiceReason | None = None  # for the change, where that is asked


class AbandonedPlan(Value, frozen=True):
    """A decision at which a plan was given up for its risk."""

    time: float  # [s]
    risk: float  # of a collision
    vehicle: int | None = None  # with whom


class Wavered(Value, frozen=True):
    """Why a plan was given up and taken up again and again."""

    plan: MacroAction  # that was given up
    turns: tuple[AbandonedPlan, ...]
    resumed: bool = False  # it was taken up again in the end
    claim: bool = False  # it answers a charge
