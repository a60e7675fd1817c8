"""Values for questions to the service and for the tasks that follow, without input or output."""

from dataclasses import dataclass, field
from typing import TypeAlias

from xavi_dialogue.bus.interface import Call
from xavi_dialogue.bus.messages import AskRequest
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
