"""Handling of requests: they are checked, admitted, and passed to the session of their vehicle."""

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TypeVar

from planner.record import trace as plan_trace
from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Call, vehicle_in
from xavi_dialogue.bus.messages import (
    KIB,
    AskRequest,
    CancelReply,
    CancelRequest,
    EvidenceRequest,
    Failure,
    ForgetReply,
    ForgetRequest,
    HistoryReply,
    HistoryRequest,
    PastTurn,
    pack,
    unpack,
)
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.domain.answers import Reason
from xavi_dialogue.errors import XaviError
from xavi_dialogue.runtime import system
from xavi_dialogue.service.erased import ErasedQuestions
from xavi_dialogue.service.ownership import UNKNOWN, SessionOwners
from xavi_dialogue.service.requests import Question, latest, named
from xavi_dialogue.service.vehicle_session import VehicleSession
from xavi_dialogue.storage.store_errors import StoreError
from xavi_dialogue.storage.turn_log import TurnLog

_LOG = logging.getLogger(__name__)
KEPT_GONE = 64  # cars that have left the bus and are remembered; the oldest are dropped first
MAX_CARS = 10_000  # cars of one service, of which not even a fast machine follows so many
MAX_AGAIN = 8  # times that a request may be repeated while it is open
MAX_OPEN = 4  # open questions of a session
MAX_EARLY = 500  # questions about one car that may wait for the record; they do not delay others
HOPE = 0.7  # share of its deadline that a question may wait for its turn; see RequestHandler.ask
LEARNT = 0.1  # weight of the latest question in the pace
UNREADABLE = "whose conversation this is cannot be read at the moment; ask again soon"
UNREAD = "what was said before cannot be read at the moment; ask again soon"
ERASED = "this was asked before the conversation was erased"
UNHEARD = "no decision of this ride that is still remembered has this id"
FOREIGN = "this conversation belongs to somebody else; begin another with --session NAME"

Told = TypeVar("Told", AskRequest, HistoryRequest, ForgetRequest, CancelRequest, EvidenceRequest)
Wanted = TypeVar("Wanted", AskRequest, HistoryRequest, ForgetRequest, CancelRequest)


class Rejection(XaviError):
    """A request is not accepted."""

    def __init__(self, reason: Reason, detail: str) -> None:
        super().__init__(detail)
        self.failure = Failure(reason=reason, detail=detail)


@dataclass
class RequestHandler:
    """A handler of requests, one at a time."""

    pipeline: Pipeline
    memory: TurnLog
    owners: SessionOwners
    alive: HealthReporter
    repeat: Callable[[str, AskRequest], bytes | None]  # returns the reply that was sent recently
    forgotten: Callable[[str], None]  # called with a session that was erased
    vehicles: dict[str, VehicleSession] = field(default_factory=dict)  # by car
    erased: ErasedQuestions = field(default_factory=ErasedQuestions)
    pace: float = 0.0  # [s] running average of the time per question
    _active: dict[int, VehicleSession] = field(default_factory=dict)  # with something to be done
    _changed: dict[int, VehicleSession] = field(default_factory=dict)  # since it was last idle
    _room: int = KEPT_GONE  # number of cars at which it is looked for some to drop

    def __post_init__(self) -> None:
        self.nowhere = VehicleSession(
            "nowhere", self.pipeline
        )  # of all cars that were never heard of

    def vehicle_session(self, vehicle: str) -> VehicleSession:
        """Return the session of a vehicle.

        Raises:
            Rejection: there are too many cars.
        """
        if vehicle not in self.vehicles:
            if len(self.vehicles) >= self._room:
                self._make_room()
            self.vehicles[vehicle] = VehicleSession(vehicle, self.pipeline)
        return self.vehicles[vehicle]

    def all_vehicles(self) -> list[VehicleSession]:
        """Return the sessions of all cars, and the one for cars never heard of."""
        return [*self.vehicles.values(), self.nowhere]

    def active(self) -> tuple[VehicleSession, ...]:
        """Return the sessions of cars with open questions or missing reports."""
        return tuple(self._active.values())

    def changed(self) -> tuple[VehicleSession, ...]:
        """Return the sessions of cars that were stirred since the last call."""
        found = tuple(self._changed.values())
        self._changed.clear()
        return found

    def stir(self, vehicle_session: VehicleSession) -> None:
        """Note that something may have to be done about a car."""
        self._active[id(vehicle_session)] = self._changed[id(vehicle_session)] = vehicle_session

    def rest(self, vehicle_session: VehicleSession) -> None:
        """Note that something was done about a car, unless more is to be done."""
        reports = vehicle_session.reports
        if not vehicle_session.scheduler.open and (reports is None or reports.missing is None):
            self._active.pop(id(vehicle_session), None)

    def waiting(self) -> int:
        """Return the number of open questions."""
        return sum(len(one.scheduler.open) for one in self.active())

    def ready(self) -> int:
        """Return the number of questions that only wait for their turn."""
        return sum(one.scheduler.ready for one in self.active())

    def learn(self, taken: float) -> None:
        """Update the average time [s] of a question."""
        self.pace += LEARNT * (taken - self.pace)

    def ask(self, call: Call, came: float) -> None:
        """Accept a question if it can probably be answered in time.

        Otherwise reject it at once: under overload a growing queue would delay all passengers.

        Args:
            call: the question.
            came: [s] on the monotonic clock, when it arrived.

        Raises:
            Rejection: it is not accepted.
        """
        vehicle_session, asked = self._admitted(call, AskRequest)
        name = named(vehicle_session.vehicle, asked.request)
        if self.erased.came(asked.session, name, asked.text, came):
            raise Rejection("busy", ERASED)
        known = vehicle_session.scheduler.open.get((asked.session, asked.request))
        if known is not None:
            if known.asked == asked and len(known.again) < MAX_AGAIN:
                known.again.append(call)  # it came twice, and is answered once
                return
            raise Rejection("busy", "a request of this name is open in this session")
        with self._reading():
            said = self.repeat(vehicle_session.vehicle, asked)
        if said is not None:
            call.reply(said)
            return
        wait = self.pace * self.ready()
        early = len(
            vehicle_session.scheduler.open
        ) - vehicle_session.scheduler.ready >= MAX_EARLY and vehicle_session.is_early(asked)
        late = wait > HOPE * asked.deadline_ms / 1000.0
        if early or late or len(vehicle_session.scheduler.of(asked.session)) >= MAX_OPEN:
            raise Rejection("busy", "too many questions are waiting; ask again in a moment")
        self._know(vehicle_session, asked.session)
        self._claim(asked)
        vehicle_session.take(Question(call, asked, came))
        self.stir(vehicle_session)

    def cancel(self, call: Call) -> None:
        """Drop a question.

        Raises:
            Rejection: the request is not accepted.
        """
        vehicle_session, wanted = self._admitted(call, CancelRequest)
        dropped = vehicle_session.cancel(wanted)
        if dropped is not None:
            dropped.drop()
        call.reply(pack(CancelReply(request=wanted.request, cancelled=dropped is not None)))

    def forget(self, call: Call) -> None:
        """Erase a session.

        Raises:
            Rejection: the request is not accepted.
        """
        _, wanted = self._admitted(call, ForgetRequest, erasing=True)
        known = self.put_away(wanted.session)
        erased = self.memory.forget(wanted.session)
        self.owners.release(wanted.session)
        reply = ForgetReply(
            request=wanted.request,
            session=wanted.session,
            turns=known if erased is None else max(erased, known),
            forgotten=erased is not None,
        )
        call.reply(pack(reply))

    def forget_too(self, call: Call) -> None:
        """Erase a session of which another service is asked; that one replies."""
        try:
            _, wanted = self._admitted(call, ForgetRequest, erasing=True)
            self.put_away(wanted.session)
            self.memory.forget(wanted.session)
            self.owners.release(wanted.session)
        except Rejection:
            pass
        finally:
            call.drop()

    def put_away(self, session: str) -> int:
        """Erase a session from memory; return the number of its turns."""
        known = 0
        for vehicle_session in self.all_vehicles():  # it may have been about several cars
            turns, dropped = vehicle_session.forget(session)
            known += turns
            for question in dropped:
                question.drop()
        self.forgotten(session)
        self.erased.erase(session, system.monotonic())
        return known

    def history(self, call: Call, seq: int) -> None:
        """Reply with the turns of a session.

        Raises:
            Rejection: the request is not accepted.
        """
        vehicle_session, wanted = self._admitted(call, HistoryRequest)
        past = vehicle_session.past.get(wanted.session)
        with self._reading():
            turns = self.memory.recall(wanted.session) if past is None else past
        shown = (PastTurn(turn.text, turn.reply) for turn in turns[-wanted.turns :])
        scene = None if vehicle_session.reports is None else vehicle_session.reports.scene
        reply = HistoryReply(
            session=wanted.session,
            seq=seq,
            sim_time=0.0 if scene is None else scene.sim_time,
            wall_time=system.wall(),
            total=len(turns),
            turns=latest(shown, HistoryReply.LIMIT - KIB),
        )
        call.reply(pack(reply))

    def evidence(self, call: Call) -> None:
        """Reply with a decision of the present ride, or one that was planned again from it.

        Raises:
            Rejection: the request is not accepted, or there is no such decision.
        """
        vehicle, wanted = self._read(call, EvidenceRequest)
        found = self.vehicles.get(vehicle, self.nowhere).decision(wanted.trace_id)
        if found is None:
            raise Rejection("outside-record", UNHEARD)
        call.reply(plan_trace.encode(found))

    def _admitted(
        self, call: Call, kind: type[Wanted], *, erasing: bool = False
    ) -> tuple[VehicleSession, Wanted]:
        """Decode and check a request; return the session of its vehicle and the request.

        Raises:
            Rejection: it cannot be read, or the session belongs to another client.
        """
        vehicle, wanted = self._read(call, kind)
        begun = erasing or self._is_begun(wanted.session)
        if not self.owners.admits(wanted.session, wanted.token, begun=begun):
            if self.owners.of(wanted.session) == UNKNOWN:
                raise Rejection("busy", UNREADABLE)
            self.alive.count("foreign")
            _LOG.warning("a wrong token", extra={"vehicle": vehicle, "session": wanted.session})
            raise Rejection("out-of-scope", FOREIGN)
        return self.vehicles.get(vehicle, self.nowhere), wanted

    def _read(self, call: Call, kind: type[Told]) -> tuple[str, Told]:
        """Return the car that a request is about, and the request.

        Raises:
            Rejection: it cannot be read.
        """
        vehicle = vehicle_in(call.key)
        if vehicle is None:
            raise Rejection("not-understood", "name one car in the key")
        try:
            return vehicle, unpack(call.payload, kind)
        except MessageError as error:
            self.alive.count("rejected")
            raise Rejection("not-understood", str(error)) from error

    def _claim(self, asked: AskRequest) -> None:
        """Assign a new session to the client that begins it; without a token it stays open."""
        if not self._is_begun(asked.session):
            vehicles = self.all_vehicles()
            held = lambda: {name for one in vehicles for name in one.past}  # noqa: E731
            self.owners.claim(asked.session, asked.token, held)

    def _is_begun(self, session: str) -> bool:
        """Check whether anything of a session is in memory."""
        return any(one.past.get(session) for one in self.all_vehicles()) or any(
            one.scheduler.of(session) for one in self.active()
        )

    def _know(self, vehicle_session: VehicleSession, session: str) -> None:
        """Load the earlier turns of a session.

        Raises:
            Rejection: they cannot be read now; without them, answers would be others.
        """
        if session not in vehicle_session.past:
            with self._reading():
                turns = self.memory.recall(session)
            vehicle_session.resume(session, turns)

    @contextmanager
    def _reading(self) -> Iterator[None]:
        """Refuse what depends on the file if that cannot be read now.

        Raises:
            Rejection: it cannot be read.
        """
        try:
            yield
        except StoreError as error:
            raise Rejection("busy", UNREAD) from error

    def _make_room(self) -> None:
        """Drop the cars that left the bus first, but for the latest few."""
        gone = [name for name, one in self.vehicles.items() if not one.car_alive]
        for name in gone[: max(len(gone) - KEPT_GONE, 0)]:
            if not self.vehicles[name].scheduler.open:
                vehicle_session = self.vehicles.pop(name)
                self._active.pop(id(vehicle_session), None)
                self._changed.pop(id(vehicle_session), None)
        if len(self.vehicles) >= MAX_CARS:
            raise Rejection("busy", f"this service talks about {MAX_CARS} cars already")
        there = sum(one.car_alive for one in self.vehicles.values())
        self._room = min(there + KEPT_GONE, MAX_CARS)
