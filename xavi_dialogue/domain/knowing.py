"""Knowing: answers about how something is known, decided, and could be changed."""

from typing import Literal

from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.evidence import Contrast, Evidence
from xavi_dialogue.domain.facts import Episode, OptionValue
from xavi_dialogue.domain.vocabulary import ActionName


class Grounds(Value, frozen=True):
    """The growth of a belief about another vehicle, and the reasons for it."""

    vehicle: int
    actions: tuple[ActionName, ...]  # what it is believed to do
    seen: bool  # it has been seen to do so
    history: tuple[tuple[float, float], ...]  # time [s] and probability, oldest first
    since: float | None = None  # [s] since when it was more probable than not
    start: float | None = None  # [s] the decisions between which it grew most ...
    end: float | None = None
    before: float | None = None  # ... and how probable it was at either
    after: float | None = None
    deed: Episode | None = None  # what the vehicle newly did between them
    rival: tuple[MacroAction, ...] = ()  # actions of the likeliest goal that the belief excludes
    fit: float | None = None  # how many times better its path fits the believed goal than that one
    light: Literal["left", "right"] | None = None  # an indicator that supports the belief


class Certainty(Value, frozen=True):
    """The certainty of a plan, or of a choice being better than its alternative.

    The verdict of the contrast states whether the choice was better on the whole.
    """

    about: Literal["plan", "choice"]
    #: Probability that the plan goes well, or that the choice does better; None if all samples
    #: were one situation, or too few were simulated both ways: these allow no estimate.
    share: float | None
    low: float | None  # lower bound of that probability, at 95 %
    good: int  # situations in which it does
    situations: int  # that were simulated, of a choice both ways
    decided: float  # [s]
    evidence: Evidence
    contrast: Contrast | None = None
    others: int = 0  # vehicles whose conduct was sampled
    #: Prior probability of the situations that were simulated, and of those in which it does.
    covered: float | None = None
    proven: float | None = None


class Method(Value, frozen=True):
    """The way in which the car made a decision, or makes decisions."""

    decided: float | None  # [s] None: in general
    options: tuple[OptionValue, ...] = ()
    evidence: Evidence = Evidence()
    vehicles: int = 0  # whose behaviour was predicted
    tried: int = 0  # options that were simulated; some may have too few rollouts to be listed
    risk_now: float | None = None  # of a collision as estimated now, if not by this decision


class DecisiveFactor(Value, frozen=True):
    """The factor that a decision depends on: it would have changed it, or mattered most."""

    kind: Literal["conduct", "removal", "factor", "none"]
    contrast: Contrast | None
    vehicle: int | None = None
    actions: tuple[MacroAction, ...] = ()
    probability: float | None = None
    most: bool = False
    deed: ActionName | None = None  # set if it is about a way of driving, not a choice


class Avoidance(Value, frozen=True):
    """The answer whether something could have been avoided, and by which known option."""

    mishap: ActionName
    possible: bool
    happened: bool
    risk: float  # its probability under the chosen option, as estimated at that decision
    other: float  # and under the alternative; if it was not avoidable, the lowest of all options
    decisions: int  # that were considered
    options: int
    contrast: Contrast | None = None  # with the alternative as foil
    impact: Episode | None = None  # the collision, where there was one
