"""Sending of replies, shared turns and requests to cars; it never waits."""

import logging
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field

import msgspec

from planner.errors import TraceError
from planner.record import trace_reading
from planner.record.trace import PlanTrace
from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import (
    Bus,
    Keys,
    NobodyThere,
    Outcome,
    Refused,
    TooLate,
    TransportError,
    vehicle_in,
)
from xavi_dialogue.bus.messages import (
    AskReply,
    AskRequest,
    Failure,
    PastTurn,
    TurnReport,
    WhatIfRequest,
    pack,
    unpack,
)
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.state import EPSILON
from xavi_dialogue.domain.answers import Reason
from xavi_dialogue.runtime import system
from xavi_dialogue.service.ownership import SessionOwners
from xavi_dialogue.service.requests import Answer, PlanAgain, named
from xavi_dialogue.service.vehicle_session import VehicleSession
from xavi_dialogue.storage.conversations import RideName
from xavi_dialogue.storage.turn_log import TurnLog

_LOG = logging.getLogger(__name__)
MAX_SENT = 500  # replies that are kept to be repeated
AGAIN = 30.0  # [s] for which a repeated request gets the same reply
#: Reasons that may no longer hold when the question is repeated.
PASSING = frozenset[Reason | None](("busy", "planner-failed", "planner-unavailable", "timed-out"))


@dataclass
class Responder:
    """A sender of replies and of requests for plans."""

    bus: Bus
    owners: SessionOwners
    memory: TurnLog
    alive: HealthReporter
    replies: int = 0  # number of replies so far
    shared: int = 0  # number of shared turns so far
    #: The reply to each request and its time [s], by session and request.
    sent: dict[tuple[str, str], tuple[AskRequest, bytes, float]] = field(default_factory=dict)

    def next(self) -> int:
        """Return the sequence number of a reply."""
        self.replies += 1
        return self.replies - 1

    def answer(self, vehicle_session: VehicleSession, answer: Answer) -> None:
        """Store the turn, then send the reply, and publish it if the passenger shares it."""
        question, asked = answer.question, answer.question.asked
        if answer.turn is not None:
            owner = self.owners.known.get(asked.session)
            name = named(vehicle_session.vehicle, asked.request)
            self.memory.keep(
                asked.session, ride_of(vehicle_session), system.wall(), answer.turn, owner, name
            )
        taken = round((system.monotonic() - question.came) * 1000.0, 3)
        payload = self._packed(asked, answer.reply, taken)
        if answer.reply.reason not in PASSING:
            key = (asked.session, named(vehicle_session.vehicle, asked.request))
            self.sent[key] = (asked, payload, system.monotonic())
        while len(self.sent) > MAX_SENT:
            del self.sent[next(iter(self.sent))]
        for call in question.calls:
            with suppress(TransportError):  # the client has disconnected
                call.reply(payload)
        self._count(answer, taken)
        if asked.share:
            self._share(answer)

    def repeat(self, vehicle: str, asked: AskRequest) -> bytes | None:
        """Return the reply to a request that was answered recently, else None.

        Messages may arrive twice, and a client that missed a reply repeats its request.
        """
        name = named(vehicle, asked.request)
        before = self.sent.get((asked.session, name))
        if before is not None:
            told, payload, at = before
            fresh = system.monotonic() - at < AGAIN
            return payload if told == asked and fresh else None
        turn = self.memory.answered(asked.session, name, system.wall() - AGAIN)
        if turn is None or turn.text != asked.text or turn.reply.reason in PASSING:
            return None
        if asked.at is not None and abs(turn.reply.sim_time - asked.at) > EPSILON:
            return None
        return self._packed(asked, turn.reply, turn.reply.timing_ms)

    def forget(self, session: str) -> None:
        """Drop the replies of a session, so that they are not repeated."""
        for key in [key for key in self.sent if key[0] == session]:
            del self.sent[key]

    def _packed(self, asked: AskRequest, reply: Reply, taken: float | None) -> bytes:
        fields = msgspec.structs.asdict(reply) | {"timing_ms": taken}
        return pack(
            AskReply(**fields, request=asked.request, seq=self.next(), wall_time=system.wall())
        )

    def _count(self, answer: Answer, taken: float) -> None:
        reply, asked = answer.reply, answer.question.asked
        self.alive.count("questions")
        self.alive.count("answered" if reply.kind == "answer" else "declined")
        self.alive.count("busy", reply.reason == "busy")
        known = {
            "vehicle": vehicle_in(answer.question.call.key),
            "session": asked.session,
            "request": asked.request,
            "trace_id": reply.trace_id,
            "kind": reply.kind,
            "reason": reply.reason,
            "duration_ms": taken,
        }
        _LOG.info("a question was answered", extra=known)

    def _share(self, answer: Answer) -> None:
        """Publish a turn that the passenger shares."""
        asked, reply = answer.question.asked, answer.reply
        vehicle = vehicle_in(answer.question.call.key)
        assert vehicle is not None
        report = TurnReport(
            session=asked.session,
            seq=self.shared,
            sim_time=reply.sim_time,
            wall_time=system.wall(),
            turn=PastTurn(asked.text, reply),
        )
        self.shared += 1
        key = Keys(vehicle).of(f"dialogue/{asked.session}/turn")
        with suppress(TransportError):  # sharing is optional
            self.bus.send(key, pack(report))

    def plan_again(self, vehicle: str, task: PlanAgain, done: Callable[[Outcome], None]) -> None:
        """Ask a car to plan again; `done` gets the result, on a thread of the bus."""
        remaining = max(task.deadline - system.monotonic(), 0.001)
        fields = msgspec.structs.asdict(task.need)
        wanted = WhatIfRequest(
            **{name: value for name, value in fields.items() if value is not msgspec.UNSET},
            request=task.request,
            deadline_ms=remaining * 1000.0,
        )
        self.alive.count("what_ifs")
        known = {"vehicle": vehicle, "session": task.session, "request": task.request}
        _LOG.info("a what-if is asked for", extra={**known, "trace_id": task.need.trace_id})
        self.bus.request(Keys(vehicle).of("@rpc/whatif"), pack(wanted), remaining, done)


def ride_of(vehicle_session: VehicleSession) -> RideName | None:
    """Return the present ride of a vehicle."""
    reports = vehicle_session.reports
    if reports is None:
        return None
    scene, name = reports.scene, named(vehicle_session.vehicle, reports.ride)
    if scene is None:
        return RideName(name)
    return RideName(name, scene.scenario, scene.seed)


def planned(outcome: Outcome) -> PlanTrace | Reason:
    """Decode the outcome of a request to a car: a plan, or the reason why there is none."""
    match outcome:
        case bytes():
            try:
                return trace_reading.decode(outcome)
            except TraceError:
                return "planner-failed"
        case Refused(payload=payload):
            try:
                return unpack(payload, Failure).reason
            except MessageError:
                return "planner-failed"
        case NobodyThere():
            return "planner-unavailable"
        case TooLate():
            return "timed-out"
    return "planner-unavailable"
