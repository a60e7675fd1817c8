"""The desk: questions that wait, for the record, for rollouts, or until their time is up.

No bus and no clock: what is heard and the time are given, what is to be sent is returned.
"""

import logging
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TypeAlias

from planner.trace import PlanTrace
from xavi_dialogue.app.ledger import Ledger
from xavi_dialogue.dialogue.events import (
    Answered,
    Asked,
    Cancelled,
    Forgotten,
    Input,
    Resumed,
    RolloutsArrived,
    RolloutsFailed,
    RolloutsWanted,
    TurnedAway,
)
from xavi_dialogue.dialogue.manager import advance
from xavi_dialogue.dialogue.mind import Mind
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state import Dialogue
from xavi_dialogue.dialogue.turn import Turn
from xavi_dialogue.explain.explanation import NeedRollout, Reason
from xavi_dialogue.transports.bus import Call
from xavi_dialogue.transports.messages import (
    AskRequest,
    CancelRequest,
    EventReport,
    SceneReport,
    TraceReport,
)

_LOG = logging.getLogger(__name__)
MAX_PAST = 200  # turns of a session that are known of
MARGIN = 0.05  # [s] before its deadline at which a question is given up, so no reply is late

Heard: TypeAlias = SceneReport | TraceReport | EventReport


@dataclass
class Question:
    """A question that has not been answered."""

    call: Call
    asked: AskRequest
    came: float  # [s] on the shell's clock
    begun: bool = False  # the manager has it

    @property
    def deadline(self) -> float:
        """When it is given up [s] on the shell's clock."""
        allowed = self.asked.deadline_ms / 1000.0
        return self.came + max(allowed - MARGIN, 0.5 * allowed)


@dataclass(frozen=True)
class Answer:
    """A reply to be sent, after its turn has been kept."""

    question: Question
    reply: Reply
    turn: Turn | None


@dataclass(frozen=True)
class PlanAgain:
    """A request to be sent to the car."""

    question: Question
    need: NeedRollout


Errand: TypeAlias = Answer | PlanAgain


@dataclass
class Desk:
    """The questions about one car."""

    mind: Mind
    dialogue: Dialogue = field(default_factory=Dialogue)
    ledger: Ledger | None = None
    questions: dict[str, Question] = field(default_factory=dict)  # by request, in order
    past: dict[str, tuple[Turn, ...]] = field(default_factory=dict)  # by session
    car_alive: bool = False

    def resume(self, session: str, turns: tuple[Turn, ...]) -> None:
        """Know what was said in a session before; to be told before its first question."""
        self.past[session] = turns[-MAX_PAST:]

    def hear(self, report: Heard) -> None:
        """Take down a report; the first of another ride begins a new record.

        What was said goes on: a session is resumed when its next question is begun.
        """
        if self.ledger is None or self.ledger.ride != report.ride:
            self.ledger, self.dialogue = Ledger(report.ride), Dialogue()
            for question in self.questions.values():
                question.begun = False
        match report:
            case SceneReport():
                inputs = self.ledger.see(report)
            case TraceReport():
                inputs = self.ledger.trace(report)
            case EventReport():
                inputs = self.ledger.event(report)
        for one in inputs:
            self._tell(one)

    def take(self, question: Question) -> None:
        """Take up a question."""
        self.questions[question.asked.request] = question

    def cancel(self, wanted: CancelRequest) -> Question | None:
        """Drop a question; None where there is no such question."""
        question = self.questions.get(wanted.request)
        if question is None or question.asked.session != wanted.session:
            return None
        del self.questions[wanted.request]
        if question.begun:
            self._tell(Cancelled(wanted.request, wanted.session))
        return question

    def forget(self, session: str) -> tuple[int, list[Question]]:
        """Forget a session; how many turns of it were known, and its questions, now dropped."""
        dropped = [one for one in self.questions.values() if one.asked.session == session]
        for question in dropped:
            del self.questions[question.asked.request]
        self._tell(Forgotten(session))
        return len(self.past.pop(session, ())), dropped

    def deliver(self, errand: PlanAgain, result: PlanTrace | Reason) -> list[Errand]:
        """Go on with a question for which the planner planned again, or did not."""
        asked = errand.question.asked
        request, session = asked.request, asked.session
        pending = self.dialogue.session(session).pending
        waits = self.questions.get(request) is errand.question and errand.question.begun
        if not waits or pending is None or pending.need != errand.need:
            return []  # cancelled or given up meanwhile, or begun anew on another ride
        if isinstance(result, str):
            return self._tell(RolloutsFailed(request, session, result))
        arrived = RolloutsArrived(request, session, result)
        return self._try(arrived, RolloutsFailed(request, session, "planner-failed"))

    def settle(self, now: float) -> list[Errand]:
        """Begin every question whose record is complete; give up those whose time is up."""
        errands: list[Errand] = []
        for request, question in list(self.questions.items()):
            if not question.begun:
                errands += self._begin(question, now)
            elif question.deadline <= now:
                session = question.asked.session
                errands += self._tell(RolloutsFailed(request, session, "timed-out"))
        return errands

    def next_deadline(self) -> float | None:
        """When the next question is given up [s] on the shell's clock."""
        return min((question.deadline for question in self.questions.values()), default=None)

    def _begin(self, question: Question, now: float) -> list[Errand]:
        known = None if self.ledger is None else self.ledger.scene
        at = question.asked.at
        if at is None:
            at = 0.0 if known is None else known.sim_time
        asked = _asked(question.asked, at)
        complete = self.ledger is not None and self.ledger.complete(at)
        gone = not self.car_alive and (known is None or known.sim_time < at)
        if not (complete or gone or question.deadline <= now):
            return []
        self._go_on(question.asked.session)
        if complete:
            question.begun = True
            return self._try(asked, TurnedAway(asked, "planner-failed"))
        return self._tell(TurnedAway(asked, "planner-unavailable" if gone else "timed-out"))

    def _go_on(self, session: str) -> None:
        """Resume a session that the manager has not heard of on this ride."""
        before = self.past.get(session)
        if before and session not in self.dialogue.sessions:
            self._tell(Resumed(session, before))

    def _try(self, event: Input, otherwise: Input) -> list[Errand]:
        """Tell the manager; should it fail through a fault of ours, one passenger is told so.

        All others are served on: the manager is pure, so nothing has changed.
        """
        try:
            return self._tell(event)
        except Exception:
            _LOG.exception("a question could not be answered")
            return self._tell(otherwise)

    def _tell(self, event: Input) -> list[Errand]:
        self.dialogue, outputs = advance(self.mind, self.dialogue, event)
        return list(self._errands(outputs))

    def _errands(self, outputs: Iterable[Answered | RolloutsWanted]) -> Iterable[Errand]:
        for output in outputs:
            match output:
                case Answered(request, session, reply, turn):
                    if turn is not None:
                        self.resume(session, (*self.past.get(session, ()), turn))
                    yield Answer(self.questions.pop(request), reply, turn)
                case RolloutsWanted(request, _, need):
                    yield PlanAgain(self.questions[request], need)


def _asked(request: AskRequest, at: float) -> Asked:
    return Asked(request.request, request.session, request.text, at, request.style)
