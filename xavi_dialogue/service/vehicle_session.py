"""Questions about one vehicle, which wait for the record, for their turn, or for rollouts.

It has no bus and no clock. Reports and times are arguments; messages to send are return values.
"""

import logging
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field

from planner.record.trace import PlanTrace
from xavi_dialogue.bus.messages import AskRequest, CancelRequest
from xavi_dialogue.dialogue.manager import advance
from xavi_dialogue.dialogue.pipeline import Pipeline
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
from xavi_dialogue.service.prefetch import AHEAD, Prefetch
from xavi_dialogue.service.reorder_buffer import ReportOfRide, RideReports
from xavi_dialogue.service.requests import Answer, PlanAgain, Question, Task
from xavi_dialogue.service.ride_tracker import RideTracker
from xavi_dialogue.service.scheduler import Scheduler
from xavi_dialogue.storage.turn_log import MAX_PAST

_LOG = logging.getLogger(__name__)
MAX_SESSIONS = 2000  # sessions that are kept; the one silent for longest is dropped first


@dataclass
class VehicleSession:
    """The questions about one car."""

    vehicle: str
    pipeline: Pipeline
    dialogue: Dialogue = field(default_factory=Dialogue)
    rides: RideTracker = field(default_factory=RideTracker)
    scheduler: Scheduler = field(default_factory=Scheduler)
    past: dict[str, tuple[Turn, ...]] = field(default_factory=dict)  # by session, latest at the end
    car_alive: bool = False
    _planning: dict[NeedRollout, list[Question]] = field(default_factory=dict)  # that wait for it
    _prefetch: Prefetch = field(default_factory=Prefetch)

    @property
    def reports(self) -> RideReports | None:
        """The reports of the present ride; None: there is none."""
        return self.rides.reports

    def resume(self, session: str, turns: tuple[Turn, ...]) -> None:
        """Store the earlier turns of a session; call it before the session's first question."""
        self.past.pop(session, None)
        self.past[session] = turns[-MAX_PAST:]
        if len(self.past) > MAX_SESSIONS:
            self._drop_oldest()

    def hear(self, report: ReportOfRide) -> None:
        """Record a report; the first scene of another ride begins a new record.

        Conversations continue: a session is resumed when its next question begins.
        """
        begun, inputs = self.rides.hear(report)
        if begun:
            self._begin_anew()
        self._record(inputs)

    def take(self, question: Question) -> None:
        """Add a question."""
        self.scheduler.take(question)
        self._look_at(question)

    def is_early(self, asked: AskRequest) -> bool:
        """Check whether a question would have to wait for the record."""
        return asked.at is not None and self.reports is not None and asked.at > self.reports.reached

    def cancel(self, wanted: CancelRequest) -> Question | None:
        """Drop a question; return None if it is not open."""
        question = self.scheduler.remove((wanted.session, wanted.request))
        if question is None:
            return None
        if question.begun:
            self._tell(Cancelled(wanted.request, wanted.session))
            self._release(wanted.session)
        return question

    def forget(self, session: str) -> tuple[int, list[Question]]:
        """Erase a session; return the number of its turns, and its questions, now dropped."""
        dropped = self.scheduler.of(session)
        for question in dropped:
            self.scheduler.remove(question.name)
        self._tell(Forgotten(session))
        return len(self.past.pop(session, ())), dropped

    def decision(self, trace_id: str) -> PlanTrace | None:
        """Return a decision of the present ride, or one planned again; None if unknown."""
        known = (*self.dialogue.traces, *self.dialogue.planned.values())
        # From the end, since the ids of old ones may not have been computed yet.
        return next((trace for trace in reversed(known) if trace.trace_id == trace_id), None)

    def deliver(self, task: PlanAgain, result: PlanTrace | Reason) -> list[Task]:
        """Continue with the questions that waited for a plan, which was made or has failed."""
        tasks: list[Task] = []
        waited = self._planning.pop(task.need, [])
        still = [question for question in waited if self._waits(question, task.need)]
        if isinstance(result, PlanTrace) and not still:
            self._foresaw(task.need, result)
        if result == "timed-out":  # later ones have time left
            late = [one for one in still if one.deadline <= task.deadline]
            still, later = late, [one for one in still if one not in late]
            if later:
                self._planning[task.need] = later
                tasks.append(_plan_again(later[0], task.need))
        for question in still:
            session, request = question.name
            if isinstance(result, str):
                tasks += self._try(question, RolloutsFailed(request, session, result))
            else:
                tasks += self._try(question, RolloutsArrived(request, session, result))
        return tasks

    def settle(self, now: float) -> list[Task]:
        """Give up overdue questions, and begin the next one in turn."""
        self._do_without(now)
        tasks: list[Task] = []
        while (overdue := self.scheduler.overdue(now)) is not None:
            tasks += self._expire(overdue)
        while (question := self.scheduler.next_turn()) is not None:
            if not self._is_engaged(question.asked.session):
                return tasks + self._begin(question)
            question.ready = False  # one at a time; see _look_at
        return tasks

    def foresee(self, now: float) -> list[Task]:
        """Return a plan that the next "why?" will probably need; call it when idle.

        Args:
            now: [s] on the monotonic clock.
        """
        reports, dialogue = self.reports, self.dialogue
        if reports is None or reports.scene is None or self._planning or not self.car_alive:
            return []
        try:
            need = self._prefetch.need(self.pipeline, dialogue, reports.scene)
        except Exception:  # an internal error; a question will report it
            _LOG.exception(
                "what may be asked could not be foreseen", extra={"vehicle": self.vehicle}
            )
            return []
        if need is None:
            return []
        self._planning[need] = []
        return [PlanAgain(need, now + AHEAD)]

    def look(self) -> None:
        """Make the questions ready that can be answered now; call it after each change."""
        for question in self.scheduler.open.values():
            self._look_at(question)

    def _waits(self, question: Question, need: NeedRollout) -> bool:
        """Check whether a question still waits for these rollouts; it may have been given up."""
        pending = self.dialogue.session(question.asked.session).pending
        return (
            self.scheduler.has(question)
            and question.begun
            and pending is not None
            and pending.asked.request == question.asked.request
            and pending.need == need
        )

    def _begin_anew(self) -> None:
        self.dialogue, self._prefetch = Dialogue(), Prefetch()
        self._planning.clear()
        self.scheduler.begin_anew()

    def _foresaw(self, need: NeedRollout, trace: PlanTrace) -> None:
        """Store a plan that no question waits for."""
        with suppress(IllegalEvent):  # another ride has begun, or the plan does not fit
            self._tell(PlannedAhead(need, trace))

    def _do_without(self, now: float) -> None:
        """Continue without reports that have been missing for too long."""
        if self.reports is None:
            return
        lost = self.reports.lost
        inputs = self.reports.wait(now)
        if self.reports.lost > lost:
            known = {"vehicle": self.vehicle, "count": self.reports.lost - lost}
            _LOG.warning("reports were lost", extra=known)
            self._record(inputs)

    def _is_engaged(self, session: str) -> bool:
        """Check whether a plan is being made for a question of this session."""
        return self.dialogue.session(session).phase is Phase.PLANNING

    def _release(self, session: str) -> None:
        """Make the next question of a session ready."""
        for question in self.scheduler.of(session):
            self._look_at(question)

    def _record(self, inputs: Iterable[Input]) -> None:
        for one in inputs:
            self._tell(one)
        self.look()

    def _moment(self, question: Question) -> float:
        """Return the time [s] that a question is about: as it states, or of the latest scene."""
        if question.asked.at is not None:
            return question.asked.at
        scene = None if self.reports is None else self.reports.scene
        return 0.0 if scene is None else scene.sim_time

    def _look_at(self, question: Question) -> None:
        """Make a question ready if it only waits for its turn."""
        if question.ready or question.begun or self._is_engaged(question.asked.session):
            return
        at, reports = self._moment(question), self.reports
        complete = reports is not None and reports.complete(at)
        if complete or self._gone(at):
            self.scheduler.let_wait(question)

    def _gone(self, at: float) -> bool:
        """Check whether reports of a time [s] can no longer arrive."""
        return not self.car_alive and (self.reports is None or self.reports.reached < at)

    def _begin(self, question: Question) -> list[Task]:
        at = self._moment(question)
        asked = _asked(question.asked, at)
        self._go_on(question.asked.session)
        if self.reports is not None and self.reports.complete(at):
            question.begun = True
            return self._try(question, asked)
        return self._try(question, TurnedAway(asked, "planner-unavailable"))

    def _expire(self, question: Question) -> list[Task]:
        """Give a question up; the reason is "busy" if it only waited for its turn."""
        session = question.asked.session
        if question.begun:
            failed = RolloutsFailed(question.asked.request, session, "timed-out")
            return self._try(question, failed)
        self._go_on(session)
        asked = _asked(question.asked, self._moment(question))
        why: Reason = "busy" if question.ready else "timed-out"
        return self._try(question, TurnedAway(asked, why))

    def _go_on(self, session: str) -> None:
        """Resume a session that is new to the dialogue of this ride."""
        before = self.past.get(session)
        if before and session not in self.dialogue.sessions:
            self._tell(Resumed(session, before))

    def _drop_oldest(self) -> None:
        """Drop the session that was silent for longest and has no open questions."""
        for session in self.past:
            if self.dialogue.session(session).phase is not Phase.PLANNING:
                del self.past[session]
                self._tell(Forgotten(session))
                return

    def _try(self, question: Question, event: Input) -> list[Task]:
        """Pass an input to the dialogue; an internal error affects this passenger only.

        The dialogue is a pure function, so an error changes nothing for others.
        """
        try:
            return self._tell(event)
        except Exception:
            _LOG.exception("a question could not be answered", extra={"vehicle": self.vehicle})
        session, request = question.name
        if self._is_engaged(session):
            self._tell(Cancelled(request, session))
        self.scheduler.remove(question.name)
        self._release(session)
        return [Answer(question, sorry(question.asked, self._moment(question)), None)]

    def _tell(self, event: Input) -> list[Task]:
        self.dialogue, outputs = advance(self.pipeline, self.dialogue, event)
        return list(self._tasks(outputs))

    def _tasks(self, outputs: Iterable[Answered | RolloutsWanted]) -> Iterable[Task]:
        for output in outputs:
            match output:
                case Answered(request, session, reply, turn):
                    if turn is not None:
                        self.resume(session, (*self.past.get(session, ()), turn))
                    question = self.scheduler.open[session, request]
                    self.scheduler.remove(question.name)
                    if question.begun:
                        self._release(session)
                    yield Answer(question, reply, turn)
                case RolloutsWanted(request, session, need):
                    question = self.scheduler.open[session, request]
                    asked_for = need in self._planning
                    self._planning.setdefault(need, []).append(question)
                    if not asked_for:
                        yield _plan_again(question, need)


def _plan_again(question: Question, need: NeedRollout) -> PlanAgain:
    return PlanAgain(need, question.deadline, question.asked.request, question.asked.session)


def sorry(asked: AskRequest, at: float) -> Reply:
    """Return the reply to a question that an internal error prevented from being answered."""
    said = say(Unavailable("planner-failed"), SpeechContext(style=asked.style))
    return Reply(text=said.text, kind="refusal", reason="planner-failed", sim_time=at)


def _asked(request: AskRequest, at: float) -> Asked:
    return Asked(request.request, request.session, request.text, at, request.style)
