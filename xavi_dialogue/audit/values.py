"""What is known of a ride after it was looked through; all values are frozen."""

from typing import Literal, TypeAlias

import msgspec

from planner.record.trace import Action

Ending: TypeAlias = Literal["arrived", "collided", "ended", "cut-off"]


class Peak(msgspec.Struct, frozen=True):
    """The most extreme value of a ride."""

    value: float
    at: float  # [s]
    vehicle: int | None = None
    who: str | None = None  # that vehicle in words


class Choice(msgspec.Struct, frozen=True):
    """A decision between several first actions."""

    at: float  # [s]
    trace_id: str
    chosen: Action
    rival: Action  # the best other one
    margin: float  # [s] by which the chosen one's expected reward is higher
    error: float  # [s] standard error of the margin, over the situations that were tried

    @property
    def close(self) -> bool:
        """Whether the margin is within its error."""
        return self.margin <= self.error


class Mistake(msgspec.Struct, frozen=True):
    """A vehicle that was expected elsewhere than it went, over decisions in a row."""

    vehicle: int
    who: str
    begin: float  # [s] of the first of these decisions
    end: float  # [s] of the last
    expected: str  # where it was expected, in words
    probability: float  # of that, at its highest
    came: str  # where it went, in words
    given: float  # the probability that this had, at its lowest
    came_at: float  # [s] when it was first seen there
    mattered: bool | None  # with the truth something else was decided; None: cannot be told
    at: float  # [s] of the decision in which it mattered most, else of the first
    trace_id: str  # of that decision
    chosen: Action | None = None  # what was decided there
    instead: Action | None = None  # what had been decided with the truth
    gain: float | None = None  # [s] of expected reward by which that is better


class Facts(msgspec.Struct, frozen=True):
    """What stands out in a ride."""

    scenario: str
    seed: int
    end: float  # [s]
    ending: Ending
    decisions: int
    ride_hash: str  # SHA-256 of the stored ride or of the recording
    ride_bytes: int
    collision: Peak | None  # value: our speed [m/s]
    braking: Peak | None  # [m/s2]
    distance: Peak | None  # [m] between the bodies
    time_to_collision: Peak | None  # [s]
    choices: tuple[Choice, ...]
    mistakes: tuple[Mistake, ...]


class Answered(msgspec.Struct, frozen=True):
    """A question and what was answered."""

    question: str
    when: str  # the moment as it was asked for
    at: float | None  # [s]; None: there was no such moment, so that it was not asked
    kind: str | None = None
    reason: str | None = None
    text: str = ""
    content: str = ""  # JSON of the typed answer
    traces: tuple[str, ...] = ()  # that it rests on


class Cost(msgspec.Struct, frozen=True):
    """What a ride cost on the machine that worked on it; no part of the results."""

    drive: float  # [s] of processor time
    look: float  # [s] likewise, to find what stands out
    answer: float  # [s] likewise
    memory: int  # [bytes] the largest so far of the worker process
    worker: str  # host and process


class Done(msgspec.Struct, frozen=True):
    """What a worker found."""

    ride: bytes | None  # a saved ride; None: it was known, or is a recording
    facts: Facts | None  # None: they were known
    answers: tuple[Answered, ...]
    cost: Cost


class Failed(msgspec.Struct, frozen=True):
    """Why there is no result."""

    why: str
