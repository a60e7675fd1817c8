"""Answers: one type for each kind of answer. No text; `nlg` puts them into words.

Each type stands once in the table of explainers that computes it and once in the table of the
realiser that words it. Nothing looks at which optional fields are set to tell what it is.
"""

from typing import Literal, TypeAlias

from planner.trace import Action as MacroAction
from planner.trace import Component, HoldUp, Outcome
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.facts import (
    Belief,
    Episode,
    Fact,
    Gap,
    Look,
    Measure,
    OptionValue,
    Somebody,
)
from xavi_dialogue.domain.meaning import Feel, Request
from xavi_dialogue.domain.terms import Event, Proposition, Thing
from xavi_dialogue.domain.vocabulary import ActionName

# --- parts --------------------------------------------------------------------------------------


class Evidence(Value, frozen=True):
    """What an answer rests on."""

    method: Literal["record", "tree", "rollouts"] = "record"
    rollouts: int = 0
    distinct_samples: int = 0
    traces: tuple[str, ...] = ()  # trace ids


class OutcomeEstimate(Value, frozen=True):
    """The likeliest outcome of a plan."""

    name: Outcome
    probability: float
    collided_with: int | None = None


class Effect(Value, frozen=True):
    """How a component would differ: foil minus fact, in natural units."""

    component: Component
    unit: str
    delta: float
    low: float  # weighted 5 % point over distinct samples
    high: float  # weighted 95 % point
    n: int
    n_distinct: int


class Mechanism(Value, frozen=True):
    """How a vehicle held the ego up in the rollouts of the foil, or under the plan."""

    how: HoldUp | Literal["collision"]
    speed_from: float | None  # [m/s] its speed when the hold-up began
    speed_to: float | None  # [m/s] its lowest speed within it
    delay: float | None  # [s] mean duration of the hold-up
    share: float  # weight of the rollouts in which it occurred
    present: bool = False  # it was going on when the decision was taken


class Cause(Value, frozen=True):
    """A vehicle because of which something came about, or would have."""

    vehicle: int
    actions: tuple[MacroAction, ...]  # what it was expected to do
    probability: float  # that it does so
    mechanism: Mechanism | None = None
    influence: float | None = None  # [bit] mutual information with the choice of actions
    decision_changes: bool | None = None  # planning again without it; None: not tried
    necessary: bool | None = None


class Contrast(Value, frozen=True):
    """A fact and a foil compared: the heart of causal answers about our own choice."""

    fact: tuple[MacroAction, ...]
    foil: tuple[MacroAction, ...]
    outcome: OutcomeEstimate | None  # of the foil
    effects: tuple[Effect, ...]  # largest first
    causes: tuple[Cause, ...]  # most important first
    evidence: Evidence
    decided: float  # [s] time of the decision
    fact_outcome: OutcomeEstimate | None = None


# --- reasons ------------------------------------------------------------------------------------


class ChoiceReason(Value, frozen=True):
    """Why the ego chose an action, or not another."""

    form: Literal["why", "why-not", "necessary", "worth-it"]
    deed: Episode | None  # what was done; None where it is only planned
    contrast: Contrast
    suspect: int | None = None  # a vehicle that the question takes for the cause ...
    suspected: Literal["main", "part", "none"] | None = None  # ... and whether it is
    past: bool = True


class MotionCause(Value, frozen=True):
    """One reason for how the ego drives: who or what is in the way or ahead."""

    kind: Literal[
        "leader",  # somebody in front drives so, or stands
        "right-of-way",  # somebody goes first
        "cut-in",
        "blocked",
        "turn",  # a turn or bend to be taken at this speed
        "limit",  # the speed limit
        "give-way-line",  # a line at which one must be ready to stop
        "hidden",  # what cannot be seen
        "destination",
        "lane-end",
        "plan",  # the plan calls for it, no reason beyond
        "starting",  # we have only just set off
        "light",
    ]
    vehicle: int | None = None
    actions: tuple[MacroAction, ...] = ()  # what it was expected to do ...
    probability: float | None = None  # ... and how surely
    speed: float | None = None  # [m/s] of that vehicle then
    did: Episode | None = None  # what it did in fact since
    necessary: bool | None = None  # without it we would not have done so; None: not tried
    value: float | None = None  # the limit [m/s], the turn's speed, the distance [m]


class MotionReason(Value, frozen=True):
    """Why the ego drove as it did: slowed, braked, stood, waited, gave way, drove slowly."""

    deed: Episode
    causes: tuple[MotionCause, ...]  # most important first; () none is known
    premise: bool = True  # False: the question called it otherwise ("stop" for slowing down)
    asked: ActionName | None = None  # what the question called it
    suspect: int | None = None
    suspected: Literal["main", "part", "none"] | None = None
    evidence: Evidence = Evidence()


class OtherReason(Value, frozen=True):
    """Why another vehicle does or did something, as far as can be seen or was inferred."""

    vehicle: int
    deed: Episode | None
    asked: Event | None = None  # what was asked, where it did otherwise
    causes: tuple[MotionCause, ...] = ()
    goal: Belief | None = None  # where it was thought to be going
    evidence: Evidence = Evidence()


# --- counterfactuals ----------------------------------------------------------------------------


class SupposedOfUs(Value, frozen=True):
    """What would have come of another action of the ego."""

    contrast: Contrast
    done: bool = False  # it is just what was done
    past: bool = True


class SupposedOfOther(Value, frozen=True):
    """What the ego would have done had another vehicle done otherwise, or not been there."""

    vehicle: int
    supposed: Event | None  # None: it were not there
    prior: float | None  # probability of what is supposed, as it was believed
    plan: tuple[MacroAction, ...]  # as things were
    then: tuple[MacroAction, ...]  # as it would have been
    same: bool
    contrast: Contrast | None = None  # of `then` (foil) against `plan` (fact)
    past: bool = True
    asked: Event | None = None  # "would you still have braked": the deed asked about ...
    still: bool | None = None  # ... and whether it would have come about; None: not known


# --- facts --------------------------------------------------------------------------------------


class Measures(Value, frozen=True):
    """Values that were asked for; each may say why it has none."""

    measures: tuple[Measure, ...]


class Verdict(Value, frozen=True):
    """Whether something holds or held: the answer to a yes or no question, or to a claim."""

    that: Proposition  # grounded
    holds: bool | None  # None: cannot be told
    facts: tuple[Fact, ...] = ()  # what is or was so instead, or what bears it out
    gap: Gap | None = None  # why it cannot be told
    claim: bool = False  # it answers a claim
    challenge: bool = False  # ... that disputes what the car said
    believed: tuple[Belief, ...] = ()  # prediction beside fact: what was expected then
    mistaken: bool = False  # the car was wrong, and owns up to it
    probability: float | None = None  # of what is still to come


class Identified(Value, frozen=True):
    """Who or what it is."""

    looks: tuple[Look, ...]
    such: Proposition | None = None  # the condition that was asked for
    facts: tuple[Fact, ...] = ()  # what each is doing
    none: bool = False  # there is nobody of whom it holds


class Counted(Value, frozen=True):
    """How many there are or were."""

    of: Thing | Event
    count: int
    facts: tuple[Fact, ...] = ()
    at_least: bool = False  # the record has gaps
    since: float | None = None  # [s] over which interval
    until: float | None = None


class Happenings(Value, frozen=True):
    """What happened: an account of episodes in order of time."""

    form: Literal["list", "summary", "when", "how-long", "doing", "first", "last"]
    episodes: tuple[Episode, ...]
    actor: Thing | None = None  # None: everybody
    since: float | None = None  # [s]
    until: float | None = None  # [s]
    measures: tuple[Measure, ...] = ()  # beside them: duration of the ride, distance, speed
    looks: tuple[Look, ...] = ()  # of the vehicles concerned, at the time of the first episode
    asked: Event | None = None


class Activity(Value, frozen=True):
    """What somebody is doing now or at a moment, and is expected to do."""

    actor: Somebody
    time: float  # [s]
    doing: tuple[Episode, ...]  # under way at that time
    speed: float | None
    trend: Literal["slowing", "steady", "speeding-up", "standing"] | None
    look: Look | None = None
    belief: Belief | None = None
    cause: MotionCause | None = None  # why it stands or slows, where that can be seen


class PlanAhead(Value, frozen=True):
    """What the ego is going to do."""

    steps: tuple[tuple[MacroAction, float], ...]  # with when [s] it is expected to begin
    measures: tuple[Measure, ...] = ()  # next junction, exit, time to go
    arrived: bool = False


class Located(Value, frozen=True):
    """Where somebody or something is or was."""

    thing: Thing
    looks: tuple[Look, ...]
    measures: tuple[Measure, ...] = ()
    gap: Gap | None = None


class Bound(Value, frozen=True):
    """Where somebody is going."""

    actor: Somebody
    belief: Belief | None = None  # of another vehicle
    went: Episode | None = None  # where it has gone in fact
    measures: tuple[Measure, ...] = ()  # of ours: destination, turns


class Beliefs(Value, frozen=True):
    """What was believed of a vehicle, how it moved, and what came of it."""

    vehicle: int
    of: Event | None  # the conduct that was asked about; None: all
    history: tuple[Belief, ...]  # oldest first, where it moved
    probability: float | None = None  # of `of` at the time asked about
    time: float | None = None  # [s] that time
    why: Episode | None = None  # what the vehicle did while it moved most
    turning: tuple[float, float] | None = None  # [s] between which it moved most
    came: Episode | None = None  # what it did in fact


class Options(Value, frozen=True):
    """What could have been done, and how each was valued."""

    options: tuple[OptionValue, ...]  # best first, the chosen one marked
    decided: float  # [s]
    evidence: Evidence
    besides: bool = False  # only what else


class Compared(Value, frozen=True):
    """Two things or options compared by a measure."""

    by: str
    first: Thing | Proposition
    second: Thing | Proposition
    better: Literal["first", "second", "same", "unknown"]
    measures: tuple[Measure, ...] = ()
    contrast: Contrast | None = None


class Priority(Value, frozen=True):
    """Who has or had right of way, and who went first."""

    time: float  # [s]
    rule: Literal["priority", "give-way", "equal", "depends", "none"]  # for us
    vehicle: int | None = None
    first: Somebody | None = None  # who went first in fact
    waited: Episode | None = None
    blame: bool = False  # asked as a question of fault or law
    conflict: bool | None = None  # somebody had to brake or swerve
    limit: Measure | None = None  # our speed against the limit, where law was asked


class Comfort(Value, frozen=True):
    """How hard the ride was over an interval."""

    peak: Measure  # deceleration
    jerk: Measure | None = None
    episode: Episode | None = None
    hard: bool = False


class Closeness(Value, frozen=True):
    """How close a vehicle came: the answer to whether it was safe or dangerous."""

    vehicle: int | None
    closest: Measure | None  # distance at the closest
    ttc: Measure | None = None  # shortest time to collision
    risk: float | None = None  # of a collision under the plan, as foreseen
    asked: Literal["safe", "dangerous", "close", "hit"] = "safe"
    time: float = 0.0
    past: bool = True


# --- how we know and decide -----------------------------------------------------------------------


class Grounds(Value, frozen=True):
    """How we came to believe something of another vehicle: how the belief grew, and why."""

    vehicle: int
    actions: tuple[MacroAction, ...]  # what is believed of it
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


class Certainty(Value, frozen=True):
    """How sure we are of a plan, or that a choice was better than the best alternative."""

    about: Literal["plan", "choice"]
    share: float  # probability that the plan goes well, or that the choice does better
    low: float  # that probability is at least this, at 95 %
    good: int  # situations in which it does
    situations: int  # that were tried
    decided: float  # [s]
    evidence: Evidence
    contrast: Contrast | None = None


class Method(Value, frozen=True):
    """How the car decided, or decides."""

    decided: float | None  # [s] None: in general
    options: tuple[OptionValue, ...] = ()
    evidence: Evidence = Evidence()
    vehicles: int = 0  # whose behaviour was foreseen


class Pivot(Value, frozen=True):
    """What a decision hangs on: what would have changed it, or what mattered most."""

    kind: Literal["conduct", "removal", "factor", "none"]
    contrast: Contrast | None
    vehicle: int | None = None
    actions: tuple[MacroAction, ...] = ()
    probability: float | None = None
    most: bool = False


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


# --- talk ---------------------------------------------------------------------------------------


class Comforting(Value, frozen=True):
    """The reply to a feeling: a human sentence, and a fact that bears on it."""

    feel: Feel
    fact: "Answer | None" = None


class Declined(Value, frozen=True):
    """The reply to a request to drive otherwise: what the car is going to do anyway."""

    request: Request
    able: bool = True  # False: no car of this kind can do that at all
    ahead: PlanAhead | None = None
    doing: Activity | None = None
    already: bool = False  # it is just what the car is doing
    cannot: str | None = None  # code of the reason why the plan cannot have it, if it cannot


class Sociable(Value, frozen=True):
    """The reply to a social move."""

    kind: str  # of `meaning.Social`


class Helpful(Value, frozen=True):
    """What can be asked."""


class Again(Value, frozen=True):
    """The last answer once more: as it was, in other words, shorter or at length."""

    how: Literal["repeat", "simpler", "shorter", "longer"]
    answer: "Answer | Refusal | None"


class Acknowledged(Value, frozen=True):
    """The reply to "never mind", "yes", "no" and the like, where nothing is open."""

    kind: Literal["cancelled", "yes", "no", "nothing-open", "noted"]


# --- refusals -----------------------------------------------------------------------------------

Reason: TypeAlias = Literal[
    "not-understood",
    "ambiguous",
    "out-of-scope",
    "not-an-action",
    "unknown-vehicle",
    "did-not-happen",
    "not-applicable",
    "no-influence",
    "too-little-evidence",
    "effect-too-small",
    "outside-record",
    "trace-gap",
    "planner-unavailable",
    "timed-out",
    "busy",
    "planner-failed",
]


class NotUnderstood(Value, frozen=True):
    """Nothing, or not enough, was understood."""

    words: tuple[str, ...] = ()  # that have no part in any reading
    about: tuple[str, ...] = ()  # what was understood, as glosses


class WhichOne(Value, frozen=True):
    """Several readings or several vehicles: which one is meant (a clarification)."""

    readings: tuple[Proposition | Thing, ...]
    looks: tuple[Look, ...] = ()  # where vehicles are to be told apart
    between: Literal["vehicles", "meanings", "times"] = "vehicles"


class NoSuchVehicle(Value, frozen=True):
    """What is spoken of cannot be found: no such number, or nobody of that description."""

    thing: Thing
    time: float  # [s]
    known: tuple[Look, ...] = ()  # who could be meant instead
    misdescribed: Look | None = None  # the one that fits but for its colour or kind


class DidNotHappen(Value, frozen=True):
    """The question takes for granted what did not happen; says what did."""

    asked: Event
    instead: tuple[Episode, ...] = ()
    planned: float | None = None  # [s] it is yet to come
    elsewhen: float | None = None  # [s] it happened at another time than the one named
    answer: "Answer | None" = None  # to the question about what happened instead


class NotApplicable(Value, frozen=True):
    """The road or the situation did not permit the foil."""

    asked: tuple[MacroAction, ...]
    reason: str  # as the trace has it
    time: float | None = None  # [s] of the decision


class TooLittle(Value, frozen=True):
    """There is too little evidence, or too small an effect, to speak of."""

    reason: Literal["too-little-evidence", "effect-too-small", "no-influence"]
    asked: tuple[MacroAction, ...] = ()
    chosen: tuple[MacroAction, ...] = ()
    distinct: int = 0
    needed: int = 0
    delta: float | None = None  # [s]


class NotRecorded(Value, frozen=True):
    """The record does not hold it, and why."""

    gap: Gap
    thing: Thing | None = None
    since: float | None = None  # [s]
    until: float | None = None  # [s]
    about: str | None = None  # the attribute or topic


class CannotSay(Value, frozen=True):
    """It is beyond what this car speaks of: advice, opinions, the world, other drivers' minds."""

    topic: str
    words: str = ""
    reason: Literal["out-of-scope", "not-an-action"] = "out-of-scope"


class Unavailable(Value, frozen=True):
    """The machinery behind the answer failed."""

    reason: Literal["planner-unavailable", "timed-out", "busy", "planner-failed"]


Refusal: TypeAlias = (
    NotUnderstood
    | WhichOne
    | NoSuchVehicle
    | DidNotHappen
    | NotApplicable
    | TooLittle
    | NotRecorded
    | CannotSay
    | Unavailable
)
Answer: TypeAlias = (
    ChoiceReason
    | MotionReason
    | OtherReason
    | SupposedOfUs
    | SupposedOfOther
    | Measures
    | Verdict
    | Identified
    | Counted
    | Happenings
    | Activity
    | PlanAhead
    | Located
    | Bound
    | Beliefs
    | Options
    | Compared
    | Priority
    | Comfort
    | Closeness
    | Grounds
    | Certainty
    | Method
    | Pivot
    | Avoidance
    | Comforting
    | Declined
    | Sociable
    | Helpful
    | Again
    | Acknowledged
)


class NeedRollout(Value, frozen=True):
    """The record lacks a plan: the shell has the planner plan again and asks once more.

    See planner.trace.WhatIf. What is supposed of another vehicle is left out where it is not set.
    """

    trace_id: str
    actions: tuple[MacroAction, ...] = ()  # forced for the ego, in order
    removed: int | None = None  # a vehicle to plan without
    rollouts: int = 40
    vehicle: int | None = None  # another vehicle that acts as supposed:
    goal: str | None = None  # where it goes: kind of a goal, or its edge
    vehicle_actions: tuple[MacroAction, ...] = ()  # what it does first
