"""Answers: one type for each kind of answer; `nlg` puts them into words."""

from typing import Literal, TypeAlias

import msgspec

from planner.record.light_record import LightSupposed
from planner.record.trace import Action as MacroAction
from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.evidence import (
    Aim,
    Cause,
    Contrast,
    Effect,
    Evidence,
    Mechanism,
    OutcomeEstimate,
    Share,
    Term,
    Weighing,
)
from xavi_dialogue.domain.facts import Episode, Gap, Look, Measure
from xavi_dialogue.domain.findings import (
    Activity,
    Beliefs,
    Bound,
    Closeness,
    Comfort,
    Compared,
    Counted,
    Forecast,
    Happenings,
    Identified,
    Lasted,
    Located,
    Measures,
    Options,
    PlanAhead,
    Priority,
    PullingUp,
    Simulations,
    Slowing,
    Staying,
    Unblocking,
    Verdict,
)
from xavi_dialogue.domain.hidden_areas import HiddenAnswer
from xavi_dialogue.domain.journeys import Altered, Course, Decided, LaneFits, PeakMoment, Wavered
from xavi_dialogue.domain.knowing import Avoidance, Certainty, DecisiveFactor, Grounds, Method
from xavi_dialogue.domain.meaning import Act, Feel, Question, Request
from xavi_dialogue.domain.reasons import (
    ChoiceReason,
    CrossingVehicle,
    GoReason,
    MotionCause,
    MotionReason,
    NobodyElse,
    OtherReason,
    OwnSignal,
    PlaceReason,
    Reaction,
    SignalReason,
    SupposedOfOther,
    SupposedOfUs,
    Unslowed,
)
from xavi_dialogue.domain.terms import Event, Proposition, Thing
from xavi_dialogue.domain.traffic_lights import LightAnswer

__all__ = [
    "Acknowledged", "Activity", "Again", "Aim", "Altered", "Answer", "Avoidance", "Beliefs",
    "Bound", "CannotSay", "Cause", "Certainty", "ChoiceReason", "Closeness", "Comfort",
    "Comforting", "Compared", "Contrast", "Counted", "Course", "CrossingVehicle", "Decided",
    "DecisiveFactor", "Declined", "DidNotHappen", "Effect", "Evidence", "Forecast", "GoReason",
    "Grounds", "Happenings", "Helpful", "Identified", "Judged", "LaneFits", "Lasted", "Located",
    "Measures", "Mechanism", "Method", "MotionCause", "MotionReason", "NeedRollout",
    "NoSuchVehicle", "NobodyElse", "NotApplicable", "NotRecorded", "NotUnderstood", "NothingToAsk",
    "Options", "OtherReason", "OutcomeEstimate", "OwnSignal", "PeakMoment", "PlaceReason",
    "PlanAhead", "Posed", "Priority", "PullingUp", "Reaction", "Reason", "Refusal", "Share",
    "SignalReason", "Simulations", "Slowing", "Sociable", "Staying", "SupposedOfOther",
    "SupposedOfUs", "TakenAs", "Term", "TooLittle", "Unavailable", "Unblocking", "Unfamiliar",
    "Unslowed", "Verdict", "Wavered", "Weighing", "WhichOne",
]  # fmt: skip

# --- talk ---------------------------------------------------------------------------------------


class Comforting(Value, frozen=True):
    """The reply to a feeling: a personal sentence, and a fact that bears on it."""

    feel: Feel
    fact: "Answer | None" = None


class Declined(Value, frozen=True):
    """The reply to a request to drive otherwise: what the car is going to do anyway."""

    request: Request
    able: bool = True  # False: this car cannot do that at all
    ahead: PlanAhead | None = None
    doing: Activity | None = None
    already: bool = False  # it is just what the car is doing
    cannot: str | None = None  # code of the reason why the plan cannot have it, if it cannot
    soon: float | None = None  # [s] when the plan does it anyway
    facts: tuple[Measure, ...] = ()  # that bear on it: our speed, when we drive on or arrive
    cause: MotionCause | None = None  # why the car must drive as it does
    reason: ChoiceReason | Options | Slowing | None = None  # against it; or what we do anyway


class Sociable(Value, frozen=True):
    """The reply to a social move."""

    kind: str  # of `meaning.Social`
    fact: "Answer | None" = None  # that bears on the subject of the move


class Helpful(Value, frozen=True):
    """The reply to a request for help: what can be asked."""


class Again(Value, frozen=True):
    """The last answer once more: as it was, in other words, shorter or at length."""

    how: Literal["repeat", "simpler", "shorter", "longer"]
    answer: "Answer | Refusal | None"


class Acknowledged(Value, frozen=True):
    """The reply to "never mind", "yes", "no" and the like, when no question is open."""

    kind: Literal["cancelled", "yes", "no", "nothing-open", "noted"]


class TakenAs(Value, frozen=True):
    """The plain question as which an unclear one was understood."""

    question: str  # in the passenger's words: "Why did we brake?"


class Unfamiliar(Value, frozen=True):
    """The words that were not understood, stated together with the answer to the rest."""

    words: tuple[str, ...] = ()  # as typed
    known: bool = False  # they are English, but have no place in the question


class Posed(Value, frozen=True):
    """A question of ours to the passenger, who wants to be quizzed."""

    kind: Literal["vehicle", "deed", "sooner"]  # who made us, what we would have done, when
    about: Question  # grounded; the solution is its answer from the record
    again: bool = False  # it was asked before, and the reply was no answer


class Judged(Value, frozen=True):
    """The judgement of the passenger's reply to a question of ours, and the solution."""

    judgement: Literal["right", "wrong", "passed"]
    posed: Posed
    answer: "Answer"


class NothingToAsk(Value, frozen=True):
    """There is no question left to ask the passenger."""

    asked: bool = False  # some were asked before


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

    words: tuple[str, ...] = ()  # that are in no vocabulary
    quote: str = ""  # the words that were not understood, if they are not the whole text
    rest: bool = False  # another part of the text was understood


class WhichOne(Value, frozen=True):
    """A clarification: which of several readings or vehicles is meant."""

    readings: tuple[Proposition | Thing, ...]
    looks: tuple[Look, ...] = ()  # where vehicles are to be distinguished
    between: Literal["vehicles", "meanings", "times"] = "vehicles"
    acts: tuple[Act, ...] = ()  # between meanings: the readings as whole grounded acts


class NoSuchVehicle(Value, frozen=True):
    """A thing that cannot be found: no such number, or nobody fits the description."""

    thing: Thing
    time: float  # [s]
    known: tuple[Look, ...] = ()  # vehicles that could be meant instead
    misdescribed: Look | None = None  # the one that fits except for its colour or kind


class DidNotHappen(Value, frozen=True):
    """A question that presupposes something that did not happen, and what happened instead."""

    asked: Event
    instead: tuple[Episode, ...] = ()
    planned: float | None = None  # [s] when it is going to happen
    elsewhen: float | None = None  # [s] it happened at another time than the one named
    answer: "Answer | None" = None  # to the question about what happened instead


class NotApplicable(Value, frozen=True):
    """The road or the situation did not permit the foil."""

    asked: tuple[MacroAction, ...]
    reason: str  # as the trace has it
    time: float | None = None  # [s] of the decision
    overtaking: bool = False  # the question was about overtaking


class TooLittle(Value, frozen=True):
    """Too little evidence, or too small an effect, for an answer."""

    reason: Literal["too-little-evidence", "effect-too-small", "no-influence"]
    asked: tuple[MacroAction, ...] = ()
    chosen: tuple[MacroAction, ...] = ()
    distinct: int = 0
    needed: int = 0
    delta: float | None = None  # [s]


class NotRecorded(Value, frozen=True):
    """Something that the record does not contain, and why."""

    gap: Gap
    thing: Thing | None = None
    since: float | None = None  # [s]
    until: float | None = None  # [s]
    about: str | None = None  # the attribute or topic


class CannotSay(Value, frozen=True):
    """A subject that the car does not speak about: advice, opinions, other drivers' minds."""

    topic: str
    words: str = ""
    reason: Literal["out-of-scope", "not-an-action"] = "out-of-scope"


class Unavailable(Value, frozen=True):
    """A failure of the planner that the answer needs."""

    reason: Literal["planner-unavailable", "timed-out", "busy", "planner-failed"]
    roadless: bool = False  # the record holds no roads on which anything could be planned


Refusal: TypeAlias = (
    NotUnderstood | WhichOne | NoSuchVehicle | DidNotHappen | NotApplicable | TooLittle
    | NotRecorded | CannotSay | Unavailable
)  # fmt: skip
Answer: TypeAlias = (
    ChoiceReason
    | MotionReason
    | NobodyElse
    | GoReason
    | Unslowed
    | OtherReason
    | SignalReason
    | OwnSignal
    | PlaceReason
    | SupposedOfUs
    | SupposedOfOther
    | LightAnswer
    | HiddenAnswer
    | Reaction
    | Measures
    | Verdict
    | Identified
    | Counted
    | Happenings
    | Lasted
    | Staying
    | Activity
    | PlanAhead
    | Located
    | Bound
    | Forecast
    | Beliefs
    | Options
    | Compared
    | Priority
    | Comfort
    | Closeness
    | PullingUp
    | Simulations
    | Slowing
    | Unblocking
    | Course
    | LaneFits
    | PeakMoment
    | Decided
    | Altered
    | Wavered
    | Grounds
    | Certainty
    | Method
    | DecisiveFactor
    | Avoidance
    | Comforting
    | Declined
    | Sociable
    | Helpful
    | Again
    | Acknowledged
    | TakenAs
    | Unfamiliar
    | Posed
    | Judged
    | NothingToAsk
)


class NeedRollout(Value, frozen=True):
    """A plan that the record lacks and the planner must compute (planner.record.trace.WhatIf)."""

    trace_id: str
    actions: tuple[MacroAction, ...] = ()  # forced for the ego, in order
    removed: int | tuple[int, ...] | None = None  # a vehicle to plan without, or several
    rollouts: int = 40
    vehicle: int | None = None  # another vehicle whose conduct is supposed
    goal: str | None = None  # where that vehicle goes: kind of a goal, or its edge
    vehicle_actions: tuple[MacroAction, ...] = ()  # what that vehicle does first
    faster: float | msgspec.UnsetType = msgspec.UNSET  # [m/s] by which it drives faster
    lights: tuple[LightSupposed, ...] | msgspec.UnsetType = msgspec.UNSET  # what they show
    seen_past: tuple[int, ...] | msgspec.UnsetType = msgspec.UNSET  # phantoms to plan without
