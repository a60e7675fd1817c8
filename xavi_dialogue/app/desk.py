"""The desk of one car: questions that wait, for the record, their turn, or for rollouts.

No bus and no clock: what is heard and the time are given, what is to be sent is returned.
"""

import heapq
import logging
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TypeAlias

from planner.trace import PlanTrace
from xavi_dialogue.app.errands import Answer, Errand, PlanAgain, Question
from xavi_dialogue.app.fair import FairQueue
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
from xavi_dialogue.dialogue.state import Dialogue
from xavi_dialogue.dialogue.states import Phase
from xavi_dialogue.dialogue.turn import Turn
from xavi_dialogue.explain.explanation import NeedRollout, Reason
from xavi_dialogue.transports.messages import (
    AskRequest,
    CancelRequest,
    EventReport,
    SceneReport,
    TraceReport,
)

_LOG = logging.getLogger(__name__)
MAX_PAST = 200  # turns of a session that are known of
MAX_SESSIONS = 2000  # that are known of; who has been silent for longest is forgotten first
SPENT = 200  # questions that are over and still in the heap, before it is made anew

Heard: TypeAlias = SceneReport | TraceReport | EventReport


@dataclass
class Desk:
    """The questions about one car."""

    mind: Mind
    dialogue: Dialogue = field(default_factory=Dialogue)
    ledger: Ledger | None = None
    questions: dict[str, Question] = field(default_factory=dict)  # by request, in order
    past: dict[str, tuple[Turn, ...]] = field(default_factory=dict)  # by session, latest at the end
    car_alive: bool = False
    _turns: FairQueue[Question] = field(default_factory=FairQueue)  # those that are ready
    _planning: dict[NeedRollout, list[Question]] = field(default_factory=dict)
    _deadlines: list[tuple[float, int, Question]] = field(default_factory=list)  # a heap
    _taken: int = 0

    def resume(self, session: str, turns: tuple[Turn, ...]) -> None:
        """Know what was said in a session before; to be told before its first question."""
        self.past.pop(session, None)
        self.past[session] = turns[-MAX_PAST:]
        if len(self.past) > MAX_SESSIONS:
            self._drop_oldest()

    def hear(self, report: Heard) -> None:
        """Take down a report; the first of another ride begins a new record.

        What was said goes on: a session is resumed when its next question is begun.
        """
        if self.ledger is None or self.ledger.ride != report.ride:
            self._begin_anew(report.ride)
        assert self.ledger is not None
        match report:
            case SceneReport():
                inputs = self.ledger.see(report)
            case TraceReport():
                inputs = self.ledger.trace(report)
            case EventReport():
                inputs = self.ledger.event(report)
        self._record(inputs)

    def take(self, question: Question) -> None:
        """Take up a question."""
        self.questions[question.asked.request] = question
        if len(self._deadlines) > len(self.questions) + SPENT:
            self._deadlines = [one for one in self._deadlines if self._is_open(one[2])]
            heapq.heapify(self._deadlines)
        self._taken += 1
        heapq.heappush(self._deadlines, (question.deadline, self._taken, question))
        self._look_at(question)

    def open(self, session: str) -> int:
        """How many questions of a session are open."""
        return sum(one.asked.session == session for one in self.questions.values())

    def cancel(self, wanted: CancelRequest) -> Question | None:
        """Drop a question; None where there is no such question."""
        question = self.questions.get(wanted.request)
        if question is None or question.asked.session != wanted.session:
            return None
        del self.questions[wanted.request]
        if question.begun:
            self._tell(Cancelled(wanted.request, wanted.session))
            self._release(wanted.session)
        return question

    def forget(self, session: str) -> tuple[int, list[Question]]:
        """Forget a session; how many turns of it were known, and its questions, now dropped."""
        dropped = [one for one in self.questions.values() if one.asked.session == session]
        for question in dropped:
            del self.questions[question.asked.request]
        self._tell(Forgotten(session))
        return len(self.past.pop(session, ())), dropped

    def deliver(self, errand: PlanAgain, result: PlanTrace | Reason) -> list[Errand]:
        """Go on with the questions for which the planner planned again, or did not."""
        errands: list[Errand] = []
        waited = self._planning.pop(errand.need, [errand.question])
        still = [question for question in waited if self._waits(question, errand.need)]
        if result == "timed-out":  # those that came later have time left
            late = [one for one in still if one.deadline <= errand.question.deadline]
            still, later = late, [one for one in still if one not in late]
            if later:
                self._planning[errand.need] = later
                errands.append(PlanAgain(later[0], errand.need))
        for question in still:
            request, session = question.asked.request, question.asked.session
            if isinstance(result, str):
                errands += self._tell(RolloutsFailed(request, session, result))
            else:
                arrived = RolloutsArrived(request, session, result)
                errands += self._try(arrived, RolloutsFailed(request, session, "planner-failed"))
        return errands

    def settle(self, now: float) -> list[Errand]:
        """Give up the questions whose time is up, and begin the next one whose turn it is."""
        self._do_without(now)
        errands: list[Errand] = []
        while self._deadlines and self._deadlines[0][0] <= now:
            _, _, question = heapq.heappop(self._deadlines)
            if self._is_open(question):
                errands += self._expire(question)
        while self._turns:
            question = self._turns.pop()
            if not self._is_open(question) or question.begun or not question.ready:
                continue
            if not self._is_engaged(question.asked.session):
                return errands + self._begin(question)
            question.ready = False  # one at a time; see _look_at
        return errands

    @property
    def ready(self) -> int:
        """How many questions wait for nothing but their turn."""
        return len(self._turns)

    def look(self) -> None:
        """See which questions have all that they waited for; to be called when that may be so."""
        for question in self.questions.values():
            self._look_at(question)

    def next_deadline(self) -> float | None:
        """When the next question is given up [s] on the shell's clock."""
        while self._deadlines and not self._is_open(self._deadlines[0][2]):
            heapq.heappop(self._deadlines)
        return self._deadlines[0][0] if self._deadlines else None

    def _is_open(self, question: Question) -> bool:
        return self.questions.get(question.asked.request) is question

    def _waits(self, question: Question, need: NeedRollout) -> bool:
        """Whether a question waits for these rollouts; it may have been given up or begun anew."""
        pending = self.dialogue.session(question.asked.session).pending
        return (
            self._is_open(question)
            and question.begun
            and pending is not None
            and pending.asked.request == question.asked.request
            and pending.need == need
        )

    def _begin_anew(self, ride: str) -> None:
        self.ledger, self.dialogue = Ledger(ride), Dialogue()
        self._turns.clear()
        self._planning.clear()
        for question in self.questions.values():
            question.begun = question.ready = False

    def _do_without(self, now: float) -> None:
        """Go on without what has been missing from the record for too long."""
        if self.ledger is None:
            return
        lost = self.ledger.lost
        inputs = self.ledger.wait(now)
        if self.ledger.lost > lost:
            _LOG.warning("reports were lost", extra={"count": self.ledger.lost - lost})
            self._record(inputs)

    def _is_engaged(self, session: str) -> bool:
        """Whether a question of this session is being planned for."""
        return self.dialogue.session(session).phase is Phase.PLANNING

    def _release(self, session: str) -> None:
        """Let the next question of a session have its turn."""
        for question in self.questions.values():
            if question.asked.session == session:
                self._look_at(question)

    def _record(self, inputs: Iterable[Input]) -> None:
        for one in inputs:
            self._tell(one)
        self.look()

    def _moment(self, question: Question) -> float:
        """When it is asked [s]: as it says, else now."""
        if question.asked.at is not None:
            return question.asked.at
        scene = None if self.ledger is None else self.ledger.scene
        return 0.0 if scene is None else scene.sim_time

    def _look_at(self, question: Question) -> None:
        """Let a question wait for its turn if there is nothing else to wait for."""
        if question.ready or question.begun or self._is_engaged(question.asked.session):
            return
        at, ledger = self._moment(question), self.ledger
        complete = ledger is not None and ledger.complete(at)
        if complete or self._gone(at):
            question.ready = True
            self._turns.put(question.asked.session, question)

    def _gone(self, at: float) -> bool:
        """Whether a moment will not be heard of any more."""
        return not self.car_alive and (self.ledger is None or self.ledger.reached < at)

    def _begin(self, question: Question) -> list[Errand]:
        at = self._moment(question)
        asked = _asked(question.asked, at)
        self._go_on(question.asked.session)
        if self.ledger is not None and self.ledger.complete(at):
            question.begun = True
            return self._try(asked, TurnedAway(asked, "planner-failed"))
        return self._tell(TurnedAway(asked, "planner-unavailable"))

    def _expire(self, question: Question) -> list[Errand]:
        """Give a question up; one that only its turn has not come for fell to too many others."""
        session = question.asked.session
        if question.begun:
            return self._tell(RolloutsFailed(question.asked.request, session, "timed-out"))
        self._go_on(session)
        asked = _asked(question.asked, self._moment(question))
        return self._tell(TurnedAway(asked, "busy" if question.ready else "timed-out"))

    def _go_on(self, session: str) -> None:
        """Resume a session that the manager has not heard of on this ride."""
        before = self.past.get(session)
        if before and session not in self.dialogue.sessions:
            self._tell(Resumed(session, before))

    def _drop_oldest(self) -> None:
        """Forget the session that has been silent for longest, and waits for nothing."""
        for session in self.past:
            if self.dialogue.session(session).phase is not Phase.PLANNING:
                del self.past[session]
                self._tell(Forgotten(session))
                return

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
                    question = self.questions.pop(request)
                    if question.begun:
                        self._release(session)
                    yield Answer(question, reply, turn)
                case RolloutsWanted(request, _, need):
                    question = self.questions[request]
                    waiting = self._planning.setdefault(need, [])
                    waiting.append(question)
                    if len(waiting) == 1:
                        yield PlanAgain(question, need)


def _asked(request: AskRequest, at: float) -> Asked:
    return Asked(request.request, request.session, request.text, at, request.style)
