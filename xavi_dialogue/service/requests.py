"""Values for questions to the service and for the tasks that follow, without input or output."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TypeAlias

import msgspec

from xavi_dialogue.bus.interface import DEFAULT_VEHICLE, Call
from xavi_dialogue.bus.messages import AskRequest, PastTurn
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.domain.answers import NeedRollout

Name: TypeAlias = tuple[str, str]  # session, request

MARGIN = 0.05  # [s] before its deadline, when a question is given up so that no reply is late


@dataclass(eq=False)
class Question:
    """A question that has not been answered."""

    call: Call
    asked: AskRequest
    came: float  # [s] on the monotonic clock
    again: list[Call] = field(default_factory=list)  # repeated calls of the same request
    begun: bool = False  # whether the dialogue has it
    ready: bool = False  # whether it only waits for its turn

    @property
    def name(self) -> Name:
        """Its session and request; other sessions may use the same request names."""
        return self.asked.session, self.asked.request

    @property
    def calls(self) -> tuple[Call, ...]:
        """All calls that wait for the reply."""
        return self.call, *self.again

    def drop(self) -> None:
        """Leave all calls without a reply."""
        for call in self.calls:
            call.drop()

    @property
    def deadline(self) -> float:
        """The time [s] on the monotonic clock at which it is given up."""
        allowed = self.asked.deadline_ms / 1000.0
        return self.came + max(allowed - MARGIN, 0.5 * allowed)


@dataclass(frozen=True)
class Answer:
    """A reply to send, after its turn has been stored."""

    question: Question
    reply: Reply
    turn: Turn | None


@dataclass(frozen=True)
class PlanAgain:
    """A request to send to the car."""

    need: NeedRollout
    deadline: float  # [s] on the monotonic clock, of the first question that needs it
    request: str = "ahead"  # name of that question's request; "ahead" if there is no question yet
    session: str | None = None


Task: TypeAlias = Answer | PlanAgain


def latest(turns: Iterable[PastTurn], limit: int) -> tuple[PastTurn, ...]:
    """Return the latest turns that fit into a number of bytes."""
    kept: list[PastTurn] = []
    taken = 0
    for turn in reversed([*turns]):
        taken += len(msgspec.json.encode(turn)) + 1
        if taken > limit:
            break
        kept.append(turn)
    return tuple(reversed(kept))


def named(vehicle: str, name: str) -> str:
    """Return a name that is unique among cars."""
    return name if vehicle == DEFAULT_VEHICLE else f"{vehicle}/{name}"
