"""Points: what an answer says, before it is put into words, and how much of it.

These dataclasses are the vocabulary of `grammars/answer_passenger.rules`: `x.because` is one.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from planner.trace import Component
from xavi_dialogue.explain.query import Tense
from xavi_dialogue.language.context import Told
from xavi_dialogue.language.hindrance import InTheWay
from xavi_dialogue.language.morphology import Doing, Vehicle
from xavi_dialogue.language.quantities import Quantity, Span


@dataclass(frozen=True, slots=True)
class Budget:
    """How much an answer may hold; the first of a row of budgets that keeps it short is used."""

    effects: int
    causes: int
    purpose: bool = True
    particulars: bool = True  # speeds and intentions of a vehicle that held us up
    describe: bool = True  # describe vehicles besides naming them
    more: bool = False  # ranges, chances and evidence
    told: Told = frozenset()  # causes whose particulars need not be repeated


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
    range: Span  # the same, the smaller first


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
    present: bool  # it was in our way at the time
    doubted: bool  # planning again without it changes nothing that matters


@dataclass(frozen=True, slots=True)
class EvidencePoint:
    """What an answer rests on."""

    drives: Quantity  # simulated
    situations: Quantity  # distinct among them


@dataclass(frozen=True, slots=True)
class SuspectPoint:
    """A vehicle that the question takes for the cause, and whether it is."""

    vehicle: Vehicle
    part: Literal["main", "some", "none"]


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
    suspect: SuspectPoint | None = None
    denied: Doing | None = None  # what the question calls it, and was not
    way: int = 0  # in which of the ways it is worded


@dataclass(frozen=True, slots=True)
class Constraint:
    """Answers to why we slowed down, stopped or gave way: who was in our way."""

    deed: Doing
    past: bool
    gave_way: bool  # the question says that we did
    turning: bool  # our plan was to turn
    because: CausePoint | None
    also: tuple[CausePoint, ...]
    cleared: Vehicle | None = None  # in our way, but it made no difference
    denied: Doing | None = None  # what the question calls it, and was not
    suspect: SuspectPoint | None = None
    way: int = 0


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
    foreseen: bool = False  # expected, and not yet done
    waiting: bool = False  # we stand, and this is when we move on
    waits_for: Vehicle | None = None
    between: Span | None = None  # how long until then at least and at most, where worth giving
    least: Quantity | None = None  # it takes longer than this ...
    slow: bool = False  # ... since the way there is slow, and not since it is long


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
    denied: bool = False  # all we know is that we would not have done so
    instead: Doing | None = None  # what we did, where the question calls it otherwise ...
    undone: Doing | None = None  # ... and what it calls it
    way: int = 0


@dataclass(frozen=True, slots=True)
class Motive:
    """Answers to why about another vehicle: the goal under which what it does is rational."""

    vehicle: Vehicle
    past: bool
    deed: Doing | None  # what the question says it did
    expected: bool  # that is what its goal requires
    aim: Doing | None  # what its goal requires after that
    rival: Doing | None  # what another goal would, which is nearly as probable
    unlikely: bool  # the goal is less probable than not
    onward: bool  # its goal is just to go on, which explains nothing
    probability: float
    chance: Quantity | None
    more: bool
    held: InTheWay | None = None
    waits: bool = False  # it stands, and what is asked about is going on
    ahead: bool = False  # what is asked about is yet to come
    going: bool = False  # or is going on
    suspect: SuspectPoint | None = None
    withheld: Doing | None = None  # what it did not do, and is asked about
    after: Quantity | None = None  # when it did that all the same, before the contrary
    yet: bool = False  # it may yet do it
    could: bool = False  # it is asked whether it could have
    way: int = 0


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
    gone: Quantity | None = None  # when it was seen last, where it is out of view
    held: InTheWay | None = None
    instant: bool = False  # what goes on at a time that the question speaks of
    planned: bool = False  # that time is yet to come
    done_at: Quantity | None = None  # when we did what is told
    way: int = 0


@dataclass(frozen=True, slots=True)
class GroundsPoint:
    """Answers to how we knew what another vehicle would do."""

    vehicle: Vehicle
    past: bool
    doing: Doing
    chance: Quantity
    brief: bool  # without how it grew
    doubted: bool  # it was not more probable than not
    fell: bool  # it was, and is no longer
    at: Quantity  # when the chance was that
    latest: Quantity  # the chance by the latest decision ...
    current: bool  # ... which is of now
    start: Quantity | None  # decisions between which the belief grew most, if at different times
    end: Quantity | None  # None: it never grew
    before: Quantity
    after: Quantity
    deed: Doing | None  # what it was doing between them, other than to change its speed
    speed_from: Quantity | None  # where its speed changed
    speed_to: Quantity | None
    rival: Doing | None
    times: Quantity | None  # by how many times its path fits that better than the rival
    unfit: bool  # its path does not fit the rival at all
    gone: Quantity | None


@dataclass(frozen=True, slots=True)
class StepPoint:
    """One action still to come."""

    doing: Doing
    ahead: Quantity | None  # how long until then, from 1 s


@dataclass(frozen=True, slots=True)
class Plan:
    """Answers to how we will go about it."""

    steps: tuple[StepPoint, ...]
    arrival: Quantity | None


@dataclass(frozen=True, slots=True)
class Method:
    """Answers to how we decided: what was compared, and the best of the rest."""

    past: bool
    fact: Doing
    options: Doing  # all of them, to be listed
    single: bool  # there was but one
    brief: bool  # without the list
    lost: bool  # none of them leads to our destination
    drives: Quantity
    situations: Quantity
    contrast: Contrast | None


@dataclass(frozen=True, slots=True)
class Sureness:
    """Answers to how sure we are of our plan, or that a choice was better."""

    choice: bool
    past: bool
    fact: Doing
    foil: Doing | None
    share: float
    chance: Quantity
    low: float
    least: Quantity  # the chance is at least this
    loose: bool  # that is markedly less than the chance
    all: bool
    none: bool
    late: Quantity | None  # times that it took longer than we looked ahead
    good: Quantity
    situations: Quantity
    brief: bool = False  # without what that makes the chance


@dataclass(frozen=True, slots=True)
class Evasion:
    """Answers to how something could have been avoided."""

    mishap: str
    possible: bool
    at: Quantity  # when there was the choice
    moment: Quantity  # when it happened
    foil: Doing | None
    named: bool  # the foil is worth naming where it did not help
    risk: Quantity
    other: Quantity
    helps: bool  # the alternative would seldom have had it
    unforeseen: bool  # it was improbable under what was chosen
    outcome: str
    options: Quantity
    effects: tuple[EffectPoint, ...]


@dataclass(frozen=True, slots=True)
class Factor:
    """Answers to what mattered most."""

    because: CausePoint | None
    delay: Quantity | None  # that was expected of it
    crash: Quantity | None  # the chance of a collision with it
    contrast: Contrast | None


@dataclass(frozen=True, slots=True)
class Unmoved:
    """Nothing that was looked at would have changed a decision."""

    foil: Doing
    past: bool
    contrast: Contrast
    brief: bool = False  # without it


Content: TypeAlias = (
    Contrast
    | Constraint
    | Supposition
    | Motive
    | ActivityPoint
    | Time
    | GroundsPoint
    | Plan
    | Method
    | Sureness
    | Evasion
    | Factor
    | Unmoved
)
