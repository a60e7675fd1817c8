"""The state of all conversations about one ride: a value, folded from inputs."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from planner.events import Event
from planner.trace import PlanTrace
from xavi_dialogue.dialogue.events import Asked
from xavi_dialogue.dialogue.states import Phase, RidePhase
from xavi_dialogue.dialogue.turn import Judgement, Quiz, Turn
from xavi_dialogue.explain.explanation import NeedRollout, Reason
from xavi_dialogue.explain.query import Detail, Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.explain.when import Focus

EPSILON = 1e-6  # [s] times nearer than this are the same


@dataclass(frozen=True, slots=True)
class Understood:
    """What a passenger said, where it takes the record to reply to it."""

    text: str  # see Turn
    query: Query
    focus: Focus | None = None  # the part of the ride that it is about; None: what fits best
    again: bool = False  # a bare "why?", which asks for what was not told yet
    detail: Detail | None = None  # how much to tell this once, where nothing else was asked for
    aim: Literal["answer", "quiz", "verdict"] = "answer"
    quiz: Quiz | None = None  # of a verdict: the question that was answered ...
    judgement: Judgement | None = None  # ... and how
    posed_at: float | None = None  # ... and when [s] it was put


@dataclass(frozen=True, slots=True)
class Pending:
    """A question that is thought about, or waits for rollouts."""

    asked: Asked
    understood: Understood | None = None  # None: not looked at yet
    need: NeedRollout | None = None  # what it waits for
    extra: tuple[PlanTrace, ...] = ()  # what arrived for it so far
    refused: tuple[NeedRollout, ...] = ()  # what could not be had for it
    why: Reason = "planner-failed"  # the last of these could not be had


@dataclass(frozen=True, slots=True)
class Session:
    """One passenger's conversation."""

    phase: Phase = Phase.LISTENING
    turns: tuple[Turn, ...] = ()
    pending: Pending | None = None


@dataclass(frozen=True, slots=True)
class Dialogue:
    """The ride's record, and every conversation about it."""

    ride: RidePhase = RidePhase.UNDER_WAY
    ride_id: str | None = None  # id of its first trace: the same ride driven again has the same
    traces: tuple[PlanTrace, ...] = ()
    events: tuple[Event, ...] = ()
    ended_at: float | None = None  # [s]
    gaps: tuple[tuple[float, float], ...] = ()  # [s] of the record, from when to when
    sessions: Mapping[str, Session] = field(default_factory=dict)
    planned: Mapping[NeedRollout, PlanTrace] = field(default_factory=dict)  # planned again so far

    def session(self, name: str) -> Session:
        """A passenger's conversation, a fresh one at first."""
        return self.sessions.get(name, Session())

    def record(
        self,
        at: float,
        extra: tuple[PlanTrace, ...] = (),
        refused: tuple[NeedRollout, ...] = (),
    ) -> Record:
        """All that was known at a moment [s]; after the ride, at its end.

        Args:
            at: the moment [s].
            extra: plans made again.
            refused: requests for such plans that came to nothing.
        """
        ended = self.ended_at is not None and at >= self.ended_at - EPSILON
        now = self.ended_at if ended and self.ended_at is not None else at
        gaps = tuple(gap for gap in self.gaps if gap[0] <= now)
        whole = Record(now, self.traces, self.events, ended, extra, refused, gaps=gaps)
        return up_to(whole, now)


def up_to(record: Record, time: float) -> Record:
    """What was known at an earlier moment [s] of a record."""
    return replace(
        record,
        now=time,
        traces=tuple(t for t in record.traces if t.sim_time <= time + EPSILON),
        events=tuple(e for e in record.events if e.sim_time <= time + EPSILON),
        gaps=tuple(gap for gap in record.gaps if gap[0] <= time),
        ended=record.ended and time >= record.now - EPSILON,
    )
