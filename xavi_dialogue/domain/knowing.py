"""Knowing: answers about how something is known, decided, and could be changed."""

from typing import Literal

from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.evidence import Contrast, Evidence
from xavi_dialogue.domain.facts import Episode, OptionValue
from xavi_dialogue.domain.vocabulary import ActionName


class Grounds(Value, frozen=True):
    """How we came to believe something of another vehicle: how the belief grew, and why."""

    vehicle: int
    actions: tuple[ActionName, ...]  # what is believed of it
    seen: bool  # it has been seen to do so
    history: tuple[tuple[float, float], ...]  # time [s] and probability, oldest first
    since: float | None = None  # [s] from when on it was more probable than not
    start: float | None = None  # [s] the decisions between which it grew most ...
    end: float | None = None
    before: float | None = None  # ... and how probable it was at either
    after: float | None = None
    deed: Episode | None = None  # what the vehicle was doing between them that it had not before
    rival: tuple[MacroAction, ...] = ()  # what goes with the likeliest goal that it excludes
    fit: float | None = None  # how many times better its path fits the goal believed than that
    light: Literal["left", "right"] | None = None  # an indicator that speaks for it


class Certainty(Value, frozen=True):
    """How sure we are of a plan, or that a choice was better than what it is compared with.

    Whether the choice was better on the whole is the verdict of its contrast.
    """

    about: Literal["plan", "choice"]
    #: Probability that the plan goes well, or that the choice does better; None where only one
    #: situation came of all guesses, or too few were tried both ways: these show no chance.
    share: float | None
    low: float | None  # that probability is at least this, at 95 %
    good: int  # situations in which it does
    situations: int  # that were tried, of a choice both ways
    decided: float  # [s]
    evidence: Evidence
    contrast: Contrast | None = None
    others: int = 0  # vehicles whose conduct was guessed
    #: Probability, as foreseen, of the situations that were tried, and of those in which it does.
    covered: float | None = None
    proven: float | None = None


class Method(Value, frozen=True):
    """How the car decided, or decides."""

    decided: float | None  # [s] None: in general
    options: tuple[OptionValue, ...] = ()
    evidence: Evidence = Evidence()
    vehicles: int = 0  # whose behaviour was foreseen
    tried: int = 0  # options that were simulated; of some there may be too little to list them
    risk_now: float | None = None  # of a collision by now, where that is not of this decision


class DecisiveFactor(Value, frozen=True):
    """What a decision hangs on: what would have changed it, or what mattered most."""

    kind: Literal["conduct", "removal", "factor", "none"]
    contrast: Contrast | None
    vehicle: int | None = None
    actions: tuple[MacroAction, ...] = ()
    probability: float | None = None
    most: bool = False
    deed: ActionName | None = None  # a way of driving that it is about, and no choice


class Avoidance(Value, frozen=True):
    """Whether something could have been avoided, by which of the options known."""

    mishap: ActionName
    possible: bool
    happened: bool
    risk: float  # probability of it under what was chosen, as seen at that decision
    other: float  # and under the alternative; where impossible, the lowest there is
    decisions: int  # that were looked at
    options: int
    contrast: Contrast | None = None  # with the alternative as foil
    impact: Episode | None = None  # the collision, where there was one
