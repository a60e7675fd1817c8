"""Points: what an answer says, before it is put into words, and how much of it.

These dataclasses are the vocabulary of `grammars/answer_passenger.rules`: a path such as
`x.because.vehicle` there is an attribute here.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from planner.trace import Component
from xavi_dialogue.explain.query import Tense
from xavi_dialogue.language.morphology import EGO, Doing, Quantity, Vehicle

LANE_CHANGES = ("change-left", "change-right", "overtake")


@dataclass(frozen=True, slots=True)
class Budget:
    """How much an answer may hold; the first of a row of budgets that keeps it short is used."""

    effects: int
    causes: int
    purpose: bool = True
    particulars: bool = True  # speeds and intentions of a vehicle that held us up
    describe: bool = True  # describe vehicles besides naming them
    more: bool = False  # ranges, chances and evidence


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

    drives: Quantity  # simulated
    situations: Quantity  # distinct among them


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
    evidence: EvidencePoint | None


@dataclass(frozen=True, slots=True)
class Constraint:
    """Answers to why we slowed down, stopped or gave way: who was in our way."""

    deed: Doing
    past: bool
    gave_way: bool  # the question says that we did
    turning: bool  # our plan was to turn
    because: CausePoint | None
    also: tuple[CausePoint, ...]


@dataclass(frozen=True, slots=True)
class Time:
    """Answers to when."""

    subject: Vehicle | None  # None: us
    deed: Doing | None
    past: bool
    at: Quantity | None  # time of the ride
    ago: Quantity | None  # how long since then, from 1 s
    ahead: Quantity | None  # how long until then, from 1 s
    arrival: Quantity | None  # how long until we are there
    arrived: bool


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
    chance: Quantity | None  # of what is supposed
    more: bool


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
    rival: Doing | None  # expected almost as probably
    halted: bool  # it stands still
    probability: float | None  # of the forecast or outcome
    chance: Quantity | None
    motion: bool  # its motion is known
    speed: Quantity | None
    trend: str | None
    arrival: Quantity | None
    arrived: bool
    outcome: str | None


Content: TypeAlias = Contrast | Constraint | Supposition | Motive | ActivityPoint | Time


def vehicle_of(actor: str) -> int | None:
    """The number in "vehicle:N"; None for the ego and for descriptions."""
    _, _, number = actor.partition(":")
    return int(number) if number.isdecimal() and int(number) != EGO else None


def plain(actions: Iterable[str]) -> tuple[str, ...]:
    """The actions without repetition, and without going on as an afterthought."""
    kept: list[str] = []
    for action in actions:
        if not kept or kept[-1] != action:
            kept.append(action)
    while len(kept) > 1 and kept[-1] == "continue":
        kept.pop()
    return tuple(kept)


def doing(actor: int, actions: Iterable[str], tense: Tense, in_lane: bool = False) -> Doing | None:
    """The actions as a phrase to be, or None where there is none."""
    kept = plain(actions)
    return Doing(actor, kept, tense, in_lane) if kept else None
