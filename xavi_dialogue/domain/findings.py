"""Findings: answers about what was, is and is expected."""

from typing import Literal

from planner.record.trace import Action as MacroAction
from planner.record.trace import Outcome
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.evidence import Contrast, Evidence, Weighing
from xavi_dialogue.domain.facts import (
    Belief,
    Episode,
    Expectation,
    Fact,
    Gap,
    Look,
    Measure,
    OptionValue,
    Somebody,
)
from xavi_dialogue.domain.reasons import MotionCause
from xavi_dialogue.domain.terms import Event, Proposition, Thing


class Measures(Value, frozen=True):
    """Measures that were asked for; one without a value says why."""

    measures: tuple[Measure, ...]


class Verdict(Value, frozen=True):
    """The answer to a yes or no question, or to a claim: whether something holds or held."""

    that: Proposition  # grounded
    holds: bool | None  # None: cannot be known
    facts: tuple[Fact, ...] = ()  # that hold instead, or that support it
    gap: Gap | None = None  # why it cannot be known
    claim: bool = False  # it answers a claim
    challenge: bool = False  # ... that disputes what the car said
    believed: tuple[Belief, ...] = ()  # what was expected then, to be stated with the facts
    mistaken: bool = False  # the car was wrong, and says so
    probability: float | None = None  # of a future event
    either: bool = False  # the one of several alternatives that holds: no "yes" before it


class Identified(Value, frozen=True):
    """The vehicles for which a condition holds, or that a question asks to identify."""

    looks: tuple[Look, ...]
    such: Proposition | None = None  # the condition
    facts: tuple[Fact, ...] = ()  # what each is doing
    none: bool = False  # it holds for nobody


class Counted(Value, frozen=True):
    """The number of things there are or were, or of times something happened."""

    of: Thing | Event
    count: int
    facts: tuple[Fact, ...] = ()
    at_least: bool = False  # the record has gaps
    since: float | None = None  # [s] the interval
    until: float | None = None
    such: Thing | None = None  # the description that they fit
    said: bool | None = None  # whether it is the number that the passenger named
    times: tuple[float, ...] = ()  # [s] when each of the times began, if they were counted


class Happenings(Value, frozen=True):
    """An account of what happened: episodes in order of time."""

    form: Literal["list", "summary", "when", "how-long", "doing", "first", "last"]
    episodes: tuple[Episode, ...]
    actor: Thing | None = None  # None: everybody
    since: float | None = None  # [s]
    until: float | None = None  # [s]
    measures: tuple[Measure, ...] = ()  # stated too: duration of the ride, distance, speed
    looks: tuple[Look, ...] = ()  # of the vehicles involved, at the time of the first episode
    asked: Event | None = None


class Lasted(Value, frozen=True):
    """The time for which a state lasted or has lasted."""

    that: Proposition  # grounded
    begin: float  # [s]
    end: float | None = None  # [s] None while it goes on
    now: float = 0.0  # [s]
    at_least: bool = False  # it held already when the record begins
    held: float | None = None  # [s] time since when we had slowed down or waited before it


class Staying(Value, frozen=True):
    """The time for which our car plans to stay behind another vehicle."""

    behind: Thing
    until: MacroAction | None = None  # what the car does then; None: nothing is planned
    at: float | None = None  # [s] when it begins that
    off: float | None = None  # probability that the other one turns off
    left: Measure | None = None  # rest of the ride, or duration of the standstill


class Activity(Value, frozen=True):
    """The conduct of somebody at a moment, and what they are expected to do."""

    actor: Somebody
    time: float  # [s]
    doing: tuple[Episode, ...]  # under way at that time
    speed: float | None
    trend: Literal["slowing", "steady", "speeding-up", "standing"] | None
    look: Look | None = None
    belief: Belief | None = None
    cause: MotionCause | None = None  # why it stands or slows, if that can be seen


class PlanAhead(Value, frozen=True):
    """The plan of the ego from now on."""

    steps: tuple[tuple[MacroAction, float], ...]  # each with its expected begin [s]
    measures: tuple[Measure, ...] = ()  # next junction, exit, time to go
    arrived: bool = False
    begun: MacroAction | None = None  # a turn or lane change that is under way


class Located(Value, frozen=True):
    """The place where somebody or something is or was."""

    thing: Thing
    looks: tuple[Look, ...]
    measures: tuple[Measure, ...] = ()
    gap: Gap | None = None


class Bound(Value, frozen=True):
    """The way that somebody is going."""

    actor: Somebody
    belief: Belief | None = None  # about another vehicle
    went: Episode | None = None  # where it actually went
    look: Look | None = None  # where it is now, or was last seen
    measures: tuple[Measure, ...] = ()  # of the ego: destination, turns
    unconsidered: Event | None = None  # the question is about it, but the belief does not cover it
    signal: Episode | None = None  # the side to which it indicates


class Forecast(Value, frozen=True):
    """What several others are going to do, by what is believed of each."""

    beliefs: tuple[Belief, ...]  # of those with an expectation, nearest first


class Beliefs(Value, frozen=True):
    """The car's belief about a vehicle, how it changed, and what the vehicle did in the end."""

    vehicle: int
    of: Event | None  # the conduct that was asked about; None: all
    history: tuple[Belief, ...]  # oldest first, where it changed
    probability: float | None = None  # of `of` at the time asked about
    time: float | None = None  # [s] that time
    why: Episode | None = None  # what the vehicle did while the belief changed most
    turning: tuple[float, float] | None = None  # [s] interval in which it changed most
    came: Episode | None = None  # what the vehicle actually did
    since: float | None = None  # [s] since when it was believed more likely than not
    changed: bool = False  # the question is how the belief changed
    besides: tuple[Expectation, ...] = ()  # what else was likely at that time
    knew: bool = False  # the question is whether we knew it; `since`: held without a break
    before: float | None = None  # the probability before that
    denied: bool = False  # `probability` is that of the conduct not coming


class Options(Value, frozen=True):
    """The options of a decision, and how each was valued."""

    options: tuple[OptionValue, ...]  # best first, the chosen one marked
    decided: float  # [s]
    evidence: Evidence
    besides: bool = False  # name only the options that were not chosen
    risk: bool = False  # name only the vehicle that the first option would have collided with
    hits: int = 0  # rollouts of it that ended in a collision
    drives: int = 0  # number of rollouts of it
    earlier: bool = False  # of a decision before the latest one
    rival: Weighing | None = None  # only the next best; how the chosen one compares with it
    named: bool = False  # the rival is the one asked about instead of the next best
    closest: bool = False  # of all decisions, it is the one with the rival nearest in value
    counted: bool = False  # the question is how many there are


class Simulations(Value, frozen=True):
    """The simulations of a decision, by how they ended."""

    decided: float  # [s]
    runs: int  # rollouts, of the option if one is named
    ends: tuple[tuple[Outcome, int], ...]  # of these, without those that are none
    evidence: Evidence
    asked: Outcome | None = None  # only how many ended so
    of: MacroAction | None = None  # the option that they began with; None: any
    struck: tuple[tuple[int, int], ...] = ()  # by vehicle: runs that collided with it, most first
    options: int = 0  # number of first actions that they tried
    apart: bool = False  # an end was asked about that is not counted


class Compared(Value, frozen=True):
    """A comparison of two things or options by a measure."""

    by: str
    first: Thing | Proposition
    second: Thing | Proposition
    better: Literal["first", "second", "same", "unknown"]
    measures: tuple[Measure, ...] = ()
    contrast: Contrast | None = None


class Priority(Value, frozen=True):
    """The right of way of the ego and others, and who went first."""

    time: float  # [s]
    #: For the ego; "we-change", "it-changes": the one that changes lanes must leave the other room.
    rule: Literal["priority", "give-way", "equal", "depends", "none", "we-change", "it-changes"]
    vehicle: int | None = None
    first: Somebody | None = None  # who actually went first
    waited: Episode | None = None
    blame: bool = False  # the question is about fault or law
    conflict: bool | None = None  # somebody had to brake or swerve
    limit: Measure | None = None  # our speed and the limit, if the question is about law
    deeds: tuple[Episode, ...] = ()  # what those involved did then: cut in, braked, waited
    legal: bool = False  # the question is about law
    stood: bool = False  # the vehicle was standing when we went
    others: tuple[int, ...] = ()  # vehicles for which the same is true
    holds: bool | None = None  # the reply to a yes or no question, or to a claim
    claim: bool = False  # it answers a claim
    ring: bool = False  # at a roundabout, with no vehicle named
    light: bool = False  # a red light holds us at that junction
    green: bool = False  # a light there stops all others for us, with no vehicle named
    walkers: bool = False  # at a crossing for people on foot, with no vehicle named
    grounds: bool = False  # the question is how we know it
    after: tuple[int, ...] = ()  # vehicles that must let us go first, if others go before us
    #: Why they go first: they come from the right; we turn across their way; they go straight on
    #: beside us; they are on foot; their road has priority over ours.
    why: Literal["right", "across", "beside", "on-foot", "road"] | None = None
    apart: tuple[int, ...] = ()  # vehicles named too whose way does not meet ours
    number: bool = False  # the question is how many go first


class Unblocking(Value, frozen=True):
    """The vehicle that must move first so that we can go: the head of our queue."""

    time: float  # [s]
    head: int
    going: bool = False  # it has set off
    waits: tuple[int, ...] = ()  # vehicles that it was expected to let go first


class Comfort(Value, frozen=True):
    """The comfort of the ride over an interval."""

    peak: Measure  # deceleration
    jerk: Measure | None = None
    episode: Episode | None = None
    hard: bool = False
    deed: bool = False  # of one deed of ours and not of the ride


class Closeness(Value, frozen=True):
    """The answer whether it was safe or dangerous: how close a vehicle came."""

    vehicle: int | None
    closest: Measure | None  # smallest distance
    ttc: Measure | None = None  # shortest time to collision
    risk: float | None = None  # of a collision under the plan, as foreseen; the highest
    asked: Literal["safe", "dangerous", "close", "hit", "room", "grounds"] = "safe"
    time: float = 0.0
    past: bool = True
    ever: Measure | None = None  # smallest distance so far, if smaller than `closest`
    braked: tuple[Episode, ...] = ()  # hard braking: ours, or of those with right of way over us
    foreseen: bool = False  # how close it is going to come by plan and expectation
    grounds: "Assurance | None" = None  # why no collision is expected, if the question is that
    giving: tuple[int, ...] = ()  # vehicles that we are about to let go first, in the present
    degree: bool = False  # the question is how risky it is, not whether
    planned: float | None = None  # [s] the decision of that risk, if it is one of several


class Assurance(Value, frozen=True):
    """Why no collision is expected with a vehicle, or with anybody."""

    situations: int = 0  # number simulated under the plan
    struck: int = 0  # number of those in which we collide
    belief: Belief | None = None  # about the vehicle
    stands: bool = False
    yields: Literal["we", "they"] | None = None  # who must let the other one go first
    behind: bool = False  # it drives behind us
    decided: float | None = None  # [s] the decision whose risk it is; None: that of now


class Slowing(Value, frozen=True):
    """The answer whether we are expected to stop or slow down for somebody."""

    others: tuple[int, ...]  # the vehicles asked about, or those of them that hold us up
    stops: bool  # we come to a standstill
    held: float  # share of the rollouts in which they hold us up
    slows: bool = False  # the question is whether we slow down, not whether we stop
    slow: float | None = None  # [m/s] lowest speed; None: we do not slow down
    time: float | None = None  # [s] when we stand, or begin to slow down
    share: float | None = None  # of the rollouts in which we come to a standstill
    order: Literal["we", "they", "nobody"] | None = None  # who comes first where our ways meet
    yields: bool = False  # there are some to whom we must give way at the next junction


class PullingUp(Value, frozen=True):
    """The answer whether somebody stops in time: "will he manage to stop?", "can you?"."""

    vehicle: int  # the other one
    how: Literal["stands", "brakes", "owes", "goes-first", "able", "unable", "apart"]
    ours: bool = False  # the question is whether we stop, behind the vehicle
    behind: bool = False  # it comes up behind us
    braking: Episode | None = None  # that is under way
    distance: Measure | None = None  # between the bodies, now
    speed: Measure | None = None  # of the one that is to stop
    needed: float | None = None  # [m] to brake hard to the speed of the one in front
    risk: float | None = None  # of a collision under the plan
    chance: float | None = None  # that it lets us go first
