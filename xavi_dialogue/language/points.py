"""Points: what an answer says, before it is put into words.

These dataclasses are the vocabulary of `grammars/answer_passenger.rules`: a path such as
`x.because.vehicle` there is an attribute here.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from planner.trace import Component
from xavi_dialogue.explain.query import Tense
from xavi_dialogue.language.morphology import Doing, Quantity, Vehicle


@dataclass(frozen=True, slots=True)
class EffectPoint:
    """One difference that the foil would have made."""

    component: Component
    size: Quantity  # how large; only that of time is given as a number
    more: bool  # the foil has more of it
    opposed: bool  # it speaks against the difference named before it
    unsure: bool  # its range includes none at all
    narrow: bool  # its range is not worth giving
    low: Quantity
    high: Quantity


@dataclass(frozen=True, slots=True)
class CausePoint:
    """One vehicle, and how it made the foil turn out so."""

    vehicle: Vehicle
    probability: float
    chance: Quantity
    past: bool
    how: str | None
    doing: Doing | None  # all that it is expected to do
    before: Doing | None  # a change of lane that comes before it slows
    after: Doing | None  # what it slows for, or does once it has cut in
    slows: bool
    halts: bool
    particulars: bool  # whether speeds and intentions are to be given
    speed_from: Quantity | None
    speed_to: Quantity | None
    necessary: Literal["yes", "no"] | None  # planning again without it changes the decision


@dataclass(frozen=True, slots=True)
class EvidencePoint:
    """What an answer rests on."""

    rollouts: Quantity
    situations: str


@dataclass(frozen=True, slots=True)
class Contrast:
    """Answers to why, why not and what if about us: fact, foil, difference, cause."""

    rule: Literal["WHY", "WHAT_IF", "BRIEF"]
    past: bool
    fact: Doing | None
    foil: Doing
    purpose: str | None  # the component or outcome that speaks for the fact
    outcome: str
    probability: float
    struck: Vehicle | None
    effects: tuple[EffectPoint, ...]
    because: CausePoint | None
    also: tuple[CausePoint, ...]  # causes that do not explain how the foil turns out
    more: bool
    evidence: EvidencePoint


@dataclass(frozen=True, slots=True)
class Supposition:
    """Answers to what if about another vehicle: what we would have done."""

    vehicle: Vehicle
    doing: Doing | None  # what it is supposed to do; None where it is taken away
    removed: bool
    negated: bool
    past: bool
    same: bool  # we would have done the same
    mine: Doing
    effects: tuple[EffectPoint, ...]


@dataclass(frozen=True, slots=True)
class Motive:
    """Answers to why about another vehicle: the goal under which what it does is rational."""

    vehicle: Vehicle
    past: bool
    deed: Doing | None  # what the question says it did
    expected: bool  # that is what its goal requires
    aim: Doing | None  # what its goal requires after that
    onward: bool  # its goal is just to go on, which explains nothing
    probability: float
    chance: Quantity | None
    more: bool


@dataclass(frozen=True, slots=True)
class ActivityPoint:
    """Answers to what, where and how sure."""

    rule: Literal["WHAT", "WHERE", "CONFIDENCE"]
    mine: bool
    vehicle: Vehicle
    tense: Tense
    past: bool
    now: Doing | None  # under way, and known
    next: Doing | None  # planned after it
    forecast: Doing | None  # expected
    probability: float
    chance: Quantity
    motion: bool  # its motion is known
    speed: Quantity | None
    trend: str | None
    arrival: Quantity | None
    outcome: str | None


Content: TypeAlias = Contrast | Supposition | Motive | ActivityPoint
