"""Discourse: the state of a conversation, as far as understanding the next turn needs it."""

from xavi_dialogue.domain.base import Value
from xavi_dialogue.domain.meaning import Act, Question
from xavi_dialogue.domain.terms import Ego, Event, Junction, Proposition, Thing, Vehicle, Vehicles


class Mention(Value, frozen=True):
    """A thing that was mentioned."""

    thing: Ego | Vehicle | Vehicles | Thing
    turn: int  # number of the turn
    by_car: bool  # the car named it
    salience: float  # the higher, the likelier "it" means this
    role: str | None = None  # subject, object, cause, other


class Discourse(Value, frozen=True):
    """The state of the conversation before a turn."""

    turn: int = 0  # number of the coming turn
    mentions: tuple[Mention, ...] = ()  # most salient first
    question: Question | None = None  # under discussion, grounded
    propositions: tuple[Proposition, ...] = ()  # that either side asserted, latest first
    episode: tuple[float, float] | None = None  # [s] that "that" or "then" refers to
    stretch: tuple[float, float] | None = None  # [s] the same, if it was named for an account
    named: tuple[float, float] | None = None  # [s] past time that was named earlier in the turn
    offered: tuple[Act, ...] = ()  # readings that a clarification offered, grounded
    offered_things: tuple[Thing, ...] = ()  # vehicles that a clarification offered
    pending: Act | None = None  # the act that a clarification was about, to be completed
    last_acts: tuple[Act, ...] = ()  # grounded acts of the last turn
    asked_at: float | None = None  # [s] when the last question was asked
    times: tuple[float, ...] = ()  # [s] that the passenger named, latest first
    anchor: Event | Junction | None = None  # one of several that timed the last question
    moments: tuple[float, ...] = ()  # [s] that the car told on being asked when, latest first
    option: Event | None = None  # an option of ours, discussed as alternative to what was decided
    weighed_at: float | None = None  # [s] of the decision whose options were told last
    decided: Event | None = None  # what was decided instead of that option


class Span(Value, frozen=True):
    """The part of the ride that an act is about."""

    begin: float  # [s]
    end: float  # [s]
    said: bool = False  # the passenger named the time; else it was inferred
    ahead: bool = False  # it lies in the future
    whole: bool = False  # the whole ride so far, because no time was said


class GroundedAct(Value, frozen=True):
    """An act with its things, times and anaphors resolved."""

    act: Act
    span: Span | None = None  # None: no time was named and none is implied
    leaned: bool = False  # it was completed from an earlier turn
    doubts: tuple[str, ...] = ()  # words that were not understood; the answer has to say so
    strange: tuple[str, ...] = ()  # those of them that are in no vocabulary
    presupposed: bool = True  # its presuppositions hold, as far as could be checked
    anchor: Event | Junction | None = None  # one of several by which its time was told
    listed: Span | None = None  # it is one of several that were asked for, of that part of the ride
