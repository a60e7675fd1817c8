"""State: all conversations about one ride as a value, folded from inputs."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from planner.record.events import Event
from planner.record.trace import PlanTrace
from sim.scene import Scene
from xavi_dialogue.dialogue.state.events import Asked
from xavi_dialogue.dialogue.state.states import Phase, RidePhase
from xavi_dialogue.dialogue.state.turn import Judgement, Offer, Quiz, Turn
from xavi_dialogue.domain.answers import Answer, NeedRollout, Reason, Refusal
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.explain.history.record import Record

EPSILON = 1e-6  # [s] times nearer than this are the same


@dataclass(frozen=True, slots=True)
class Understood:
    """A passenger's turn, as it is to be replied to."""

    acts: tuple[GroundedAct, ...] = ()  # in the order in which they are answered
    before: tuple[Refusal, ...] = ()  # what is put right before they are
    behind: tuple[Refusal, ...] = ()  # what is declined or asked back after that
    offer: Offer | None = None  # what is offered where it is asked back
    named: GroundedAct | None = None  # who was named in what was not understood
    quotes: Mapping[GroundedAct, str] = field(default_factory=dict)  # the words of each act
    taken_as: str = ""  # the plain question that an unclear one was taken for
    aim: Literal["answer", "quiz", "again", "verdict"] = "answer"
    quiz: Quiz | None = None  # the question of ours that was answered, or was not ...
    judgement: Judgement | None = None  # ... and how


@dataclass(frozen=True, slots=True)
class Pending:
    """A question that is thought about, or waits for rollouts."""

    asked: Asked
    understood: Understood | None = None  # None: not looked at yet
    done: tuple[tuple[Answer | Refusal, ...], ...] = ()  # what its first acts were answered
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
    scenes: tuple[Scene, ...] = ()  # the last few, in the order in which they came
    ended_at: float | None = None  # [s]
    gaps: tuple[tuple[float, float], ...] = ()  # [s] of the record, from when to when
    sessions: Mapping[str, Session] = field(default_factory=dict)
    planned: Mapping[NeedRollout, PlanTrace] = field(default_factory=dict)  # planned again so far

    def session(self, name: str) -> Session:
        """Return a passenger's conversation, a fresh one at first."""
        return self.sessions.get(name, Session())

    def record(
        self,
        at: float,
        extra: tuple[PlanTrace, ...] = (),
        refused: tuple[NeedRollout, ...] = (),
    ) -> Record:
        """Return all that was known at a moment [s]; after the ride, at its end.

        Args:
            at: the moment [s].
            extra: plans made again.
            refused: requests for such plans that came to nothing.
        """
        ended = self.ended_at is not None and at >= self.ended_at - EPSILON
        now = self.ended_at if ended and self.ended_at is not None else at
        gaps = tuple(gap for gap in self.gaps if gap[0] <= now)
        seen = (scene for scene in self.scenes if scene.time <= now + EPSILON)
        scene = max(seen, key=lambda one: one.time, default=None)
        whole = Record(now, self.traces, self.events, ended, extra, refused, gaps, scene)
        return up_to(whole, now)


def up_to(record: Record, time: float) -> Record:
    """Return what was known at an earlier moment [s] of a record."""
    seen = record.scene is not None and record.scene.time <= time + EPSILON
    return replace(
        record,
        now=time,
        traces=tuple(t for t in record.traces if t.sim_time <= time + EPSILON),
        events=tuple(e for e in record.events if e.sim_time <= time + EPSILON),
        gaps=tuple(gap for gap in record.gaps if gap[0] <= time),
        ended=record.ended and time >= record.now - EPSILON,
        scene=record.scene if seen else None,
    )
