"""State: all conversations about one ride as one value, a fold over inputs."""

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
from xavi_dialogue.explain.history.between import seen_last
from xavi_dialogue.explain.history.record import Record

EPSILON = 1e-6  # [s] times closer than this are equal


@dataclass(frozen=True, slots=True)
class Understood:
    """A passenger's turn, ready to be replied to."""

    acts: tuple[GroundedAct, ...] = ()  # in the order in which they are answered
    before: tuple[Refusal, ...] = ()  # corrections that come before the answers
    behind: tuple[Refusal, ...] = ()  # refusals and clarifications that come after them
    offer: Offer | None = None  # what a clarification offers
    named: GroundedAct | None = None  # the vehicle named in a part that was not understood
    quotes: Mapping[GroundedAct, str] = field(default_factory=dict)  # the words of each act
    taken_as: str = ""  # the plain question as which an unclear one was understood
    aim: Literal["answer", "quiz", "again", "verdict"] = "answer"
    quiz: Quiz | None = None  # the question of ours that was answered, or was not ...
    judgement: Judgement | None = None  # ... and the judgement


@dataclass(frozen=True, slots=True)
class Pending:
    """A question that is being answered, or waits for rollouts."""

    asked: Asked
    understood: Understood | None = None  # None: not read yet
    done: tuple[tuple[Answer | Refusal, ...], ...] = ()  # answers to its first acts
    need: NeedRollout | None = None  # the plan that it waits for
    extra: tuple[PlanTrace, ...] = ()  # plans that have arrived for it
    refused: tuple[NeedRollout, ...] = ()  # plans that could not be made for it
    why: Reason = "planner-failed"  # why the last of these could not be made
    roadless: bool = False  # because the record holds no roads


@dataclass(frozen=True, slots=True)
class Session:
    """One passenger's conversation."""

    phase: Phase = Phase.LISTENING
    turns: tuple[Turn, ...] = ()
    pending: Pending | None = None


@dataclass(frozen=True, slots=True)
class Dialogue:
    """The record of the ride, and all conversations about it."""

    ride: RidePhase = RidePhase.UNDER_WAY
    ride_id: str | None = None  # id of its first trace; the same ride driven again has the same id
    traces: tuple[PlanTrace, ...] = ()
    events: tuple[Event, ...] = ()
    scenes: tuple[Scene, ...] = ()  # the last few, in order of arrival
    ended_at: float | None = None  # [s]
    gaps: tuple[tuple[float, float], ...] = ()  # [s] gaps in the record, from when to when
    sessions: Mapping[str, Session] = field(default_factory=dict)
    planned: Mapping[NeedRollout, PlanTrace] = field(default_factory=dict)  # new plans so far

    def session(self, name: str) -> Session:
        """Return a passenger's conversation; a new one if there is none."""
        return self.sessions.get(name, Session())

    def record(
        self,
        at: float,
        extra: tuple[PlanTrace, ...] = (),
        refused: tuple[NeedRollout, ...] = (),
    ) -> Record:
        """Return all that was known at a moment [s]; after the end of the ride, at its end.

        Args:
            at: the moment [s].
            extra: decisions that were planned again.
            refused: requests for such plans that failed.
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
    traces = tuple(t for t in record.traces if t.sim_time <= time + EPSILON)
    kept = record.scene if record.scene and record.scene.time <= time + EPSILON else None
    scene = seen_last(kept, record.traces, time) or kept
    return replace(
        record,
        now=time,
        traces=traces,
        events=tuple(e for e in record.events if e.sim_time <= time + EPSILON),
        gaps=tuple(gap for gap in record.gaps if gap[0] <= time),
        ended=record.ended and time >= record.now - EPSILON,
        scene=scene,
    )
