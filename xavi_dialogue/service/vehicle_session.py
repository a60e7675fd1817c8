"""The desk of one car: questions that wait, for the record, their turn, or for rollouts.

No bus and no clock: what is heard and the time are given, what is to be sent is returned.
"""

import logging
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field

from planner.record.trace import PlanTrace
from xavi_dialogue.bus.messages import AskRequest, CancelRequest
from xavi_dialogue.dialogue.manager import advance
from xavi_dialogue.dialogue.mind import Mind
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.events import (
    Answered,
    Asked,
    Cancelled,
    Forgotten,
    Input,
    PlannedAhead,
    Resumed,
    RolloutsArrived,
    RolloutsFailed,
    RolloutsWanted,
    TurnedAway,
)
from xavi_dialogue.dialogue.state.state import Dialogue
from xavi_dialogue.dialogue.state.states import IllegalEvent, Phase
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.domain.answers import NeedRollout, Reason, Unavailable
from xavi_dialogue.nlg.context import SpeechContext
from xavi_dialogue.nlg.say import say
from xavi_dialogue.service.prefetch import AHEAD, Foreseen
from xavi_dialogue.service.reorder_buffer import Heard, Ledger
from xavi_dialogue.service.requests import Answer, Errand, PlanAgain, Question
from xavi_dialogue.service.ride_tracker import Rides
from xavi_dialogue.service.scheduler import Waiting
from xavi_dialogue.storage.turn_log import MAX_PAST

_LOG = logging.getLogger(__name__)
MAX_SESSIONS = 2000  # that are known of; who has been silent for longest is forgotten first


@dataclass
class Desk:
    """The questions about one car."""

    vehicle: str
    mind: Mind
    dialogue: Dialogue = field(default_factory=Dialogue)
    rides: Rides = field(default_factory=Rides)
    waiting: Waiting = field(default_factory=Waiting)
    past: dict[str, tuple[Turn, ...]] = field(default_factory=dict)  # by session, latest at the end
    car_alive: bool = False
    _planning: dict[NeedRollout, list[Question]] = field(default_factory=dict)  # who needs what
    _foreseen: Foreseen = field(default_factory=Foreseen)

    @property
    def ledger(self) -> Ledger | None:
        """What was heard of the present ride; None: there is none."""
        return self.rides.ledger

    def resume(self, session: str, turns: tuple[Turn, ...]) -> None:
        """Know what was said in a session before; to be told before its first question."""
        self.past.pop(session, None)
        self.past[session] = turns[-MAX_PAST:]
        if len(self.past) > MAX_SESSIONS:
            self._drop_oldest()

    def hear(self, report: Heard) -> None:
        """Take down a report; the first scene of another ride begins a new record.

        What was said goes on: a session is resumed when its next question is begun.
        """
        begun, inputs = self.rides.hear(report)
        if begun:
            self._begin_anew()
        self._record(inputs)

    def take(self, question: Question) -> None:
        """Take up a question."""
        self.waiting.take(question)
        self._look_at(question)

    def is_early(self, asked: AskRequest) -> bool:
        """Whether a question would have to wait for the record to get there."""
        return asked.at is not None and self.ledger is not None and asked.at > self.ledger.reached

    def cancel(self, wanted: CancelRequest) -> Question | None:
        """Drop a question; None where there is no such question."""
        question = self.waiting.open.pop((wanted.session, wanted.request), None)
        if question is None:
            return None
        if question.begun:
            self._tell(Cancelled(wanted.request, wanted.session))
            self._release(wanted.session)
        return question

    def forget(self, session: str) -> tuple[int, list[Question]]:
        """Forget a session; how many turns of it were known, and its questions, now dropped."""
        dropped = self.waiting.of(session)
        for question in dropped:
            del self.waiting.open[question.name]
        self._tell(Forgotten(session))
        return len(self.past.pop(session, ())), dropped

    def decision(self, trace_id: str) -> PlanTrace | None:
        """A decision of the present ride, or one planned again; None where it is not known."""
        known = (*self.dialogue.traces, *self.dialogue.planned.values())
        # From the end, for the names of old ones may not have been worked out yet.
        return next((trace for trace in reversed(known) if trace.trace_id == trace_id), None)

    def deliver(self, errand: PlanAgain, result: PlanTrace | Reason) -> list[Errand]:
        """Go on with the questions for which the planner planned again, or did not."""
        errands: list[Errand] = []
        waited = self._planning.pop(errand.need, [])
        still = [question for question in waited if self._waits(question, errand.need)]
        if isinstance(result, PlanTrace) and not still:
            self._foresaw(errand.need, result)
        if result == "timed-out":  # those that came later have time left
            late = [one for one in still if one.deadline <= errand.deadline]
            still, later = late, [one for one in still if one not in late]
            if later:
                self._planning[errand.need] = later
                errands.append(_plan_again(later[0], errand.need))
        for question in still:
            session, request = question.name
            if isinstance(result, str):
                errands += self._try(question, RolloutsFailed(request, session, result))
            else:
                errands += self._try(question, RolloutsArrived(request, session, result))
        return errands

    def settle(self, now: float) -> list[Errand]:
        """Give up the questions whose time is up, and begin the next one whose turn it is."""
        self._do_without(now)
        errands: list[Errand] = []
        while (overdue := self.waiting.overdue(now)) is not None:
            errands += self._expire(overdue)
        while (question := self.waiting.next_turn()) is not None:
            if not self._is_engaged(question.asked.session):
                return errands + self._begin(question)
            question.ready = False  # one at a time; see _look_at
        return errands

    def foresee(self, now: float) -> list[Errand]:
        """Have planned what the next passenger who asks why will need; to be called when idle.

        Args:
            now: [s] on the shell's clock.
        """
        ledger, dialogue = self.ledger, self.dialogue
        if ledger is None or ledger.scene is None or self._planning or not self.car_alive:
            return []
        try:
            need = self._foreseen.need(self.mind, dialogue, ledger.scene)
        except Exception:  # a fault of ours; whoever asks will be told
            _LOG.exception(
                "what may be asked could not be foreseen", extra={"vehicle": self.vehicle}
            )
            return []
        if need is None:
            return []
        self._planning[need] = []
        return [PlanAgain(need, now + AHEAD)]

    def look(self) -> None:
        """See which questions have all that they waited for; to be called when that may be so."""
        for question in self.waiting.open.values():
            self._look_at(question)

    def _waits(self, question: Question, need: NeedRollout) -> bool:
        """Whether a question waits for these rollouts; it may have been given up or begun anew."""
        pending = self.dialogue.session(question.asked.session).pending
        return (
            self.waiting.has(question)
            and question.begun
            and pending is not None
            and pending.asked.request == question.asked.request
            and pending.need == need
        )

    def _begin_anew(self) -> None:
        self.dialogue, self._foreseen = Dialogue(), Foreseen()
        self._planning.clear()
        self.waiting.begin_anew()

    def _foresaw(self, need: NeedRollout, trace: PlanTrace) -> None:
        """Keep a plan that nobody waits for."""
        with suppress(IllegalEvent):  # another ride has begun, or it is not what was wanted
            self._tell(PlannedAhead(need, trace))

    def _do_without(self, now: float) -> None:
        """Go on without what has been missing from the record for too long."""
        if self.ledger is None:
            return
        lost = self.ledger.lost
        inputs = self.ledger.wait(now)
        if self.ledger.lost > lost:
            known = {"vehicle": self.vehicle, "count": self.ledger.lost - lost}
            _LOG.warning("reports were lost", extra=known)
            self._record(inputs)

    def _is_engaged(self, session: str) -> bool:
        """Whether a question of this session is being planned for."""
        return self.dialogue.session(session).phase is Phase.PLANNING

    def _release(self, session: str) -> None:
        """Let the next question of a session have its turn."""
        for question in self.waiting.of(session):
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
            self.waiting.let_wait(question)

    def _gone(self, at: float) -> bool:
        """Whether a moment will not be heard of any more."""
        return not self.car_alive and (self.ledger is None or self.ledger.reached < at)

    def _begin(self, question: Question) -> list[Errand]:
        at = self._moment(question)
        asked = _asked(question.asked, at)
        self._go_on(question.asked.session)
        if self.ledger is not None and self.ledger.complete(at):
            question.begun = True
            return self._try(question, asked)
        return self._try(question, TurnedAway(asked, "planner-unavailable"))

    def _expire(self, question: Question) -> list[Errand]:
        """Give a question up; one that only its turn has not come for fell to too many others."""
        session = question.asked.session
        if question.begun:
            failed = RolloutsFailed(question.asked.request, session, "timed-out")
            return self._try(question, failed)
        self._go_on(session)
        asked = _asked(question.asked, self._moment(question))
        why: Reason = "busy" if question.ready else "timed-out"
        return self._try(question, TurnedAway(asked, why))

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

    def _try(self, question: Question, event: Input) -> list[Errand]:
        """Tell the manager; should it fail through a fault of ours, one passenger is told so.

        All others are served on: the manager is pure, so nothing has changed.
        """
        try:
            return self._tell(event)
        except Exception:
            _LOG.exception("a question could not be answered", extra={"vehicle": self.vehicle})
        session, request = question.name
        if self._is_engaged(session):
            self._tell(Cancelled(request, session))
        del self.waiting.open[question.name]
        self._release(session)
        return [Answer(question, sorry(question.asked, self._moment(question)), None)]

    def _tell(self, event: Input) -> list[Errand]:
        self.dialogue, outputs = advance(self.mind, self.dialogue, event)
        return list(self._errands(outputs))

    def _errands(self, outputs: Iterable[Answered | RolloutsWanted]) -> Iterable[Errand]:
        for output in outputs:
            match output:
                case Answered(request, session, reply, turn):
                    if turn is not None:
                        self.resume(session, (*self.past.get(session, ()), turn))
                    question = self.waiting.open.pop((session, request))
                    if question.begun:
                        self._release(session)
                    yield Answer(question, reply, turn)
                case RolloutsWanted(request, session, need):
                    question = self.waiting.open[session, request]
                    asked_for = need in self._planning
                    self._planning.setdefault(need, []).append(question)
                    if not asked_for:
                        yield _plan_again(question, need)


def _plan_again(question: Question, need: NeedRollout) -> PlanAgain:
    return PlanAgain(need, question.deadline, question.asked.request, question.asked.session)


def sorry(asked: AskRequest, at: float) -> Reply:
    """What is said where nothing else can be, for the record itself may be at fault."""
    said = say(Unavailable("planner-failed"), SpeechContext(style=asked.style))
    return Reply(text=said.text, kind="refusal", reason="planner-failed", sim_time=at)


def _asked(request: AskRequest, at: float) -> Asked:
    return Asked(request.request, request.session, request.text, at, request.style)
