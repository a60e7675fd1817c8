"""The dialogue service: follows the rides on the bus and answers questions in time.

One service serves any number of cars. Everything that arrives is put into one inbox and handled
by one thread, so that each dialogue gets its inputs in one sequence. The service asks cars to plan
again, but never blocks on their answer.
"""

import contextlib
import logging
import queue
import threading
from collections.abc import Callable
from functools import partial
from typing import TypeAlias

import msgspec

from xavi_dialogue.bus.catalogue import CAR_MESSAGES, MESSAGES
from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import (
    DEFAULT_VEHICLE,
    EVERY_CAR,
    Bus,
    Call,
    Outcome,
    TransportError,
    vehicle_in,
)
from xavi_dialogue.bus.messages import (
    AnyMessage,
    EventReport,
    Failure,
    SceneReport,
    TraceReport,
    pack,
    schema_name,
    unpack,
)
from xavi_dialogue.bus.schema import schema_of
from xavi_dialogue.dialogue.pipeline import Pipeline
from xavi_dialogue.runtime import system
from xavi_dialogue.service.membership import Membership, Place
from xavi_dialogue.service.ownership import SessionOwners
from xavi_dialogue.service.request_handler import Rejection, RequestHandler
from xavi_dialogue.service.requests import Answer, PlanAgain, Task, named
from xavi_dialogue.service.responder import Responder, planned, ride_of
from xavi_dialogue.service.vehicle_session import VehicleSession
from xavi_dialogue.storage.conversations import RideName
from xavi_dialogue.storage.turn_log import TurnLog

_LOG = logging.getLogger(__name__)
IDLE = 0.5  # [s] between checks for a request to stop
HURRY = 0.05  # [s] between checks for missing reports
MAX_INBOX = 20_000  # messages, beyond which reports are discarded and requests refused
MAX_BYTES = 128 * 1024 * 1024  # of reports in the inbox
COUNTERS = (
    *("questions", "answered", "declined", "busy", "rejected", "foreign"),
    *("what_ifs", "faults"),
)

_Job: TypeAlias = Callable[[], None]
_Heard: TypeAlias = type[TraceReport | EventReport | SceneReport]


class Service:
    """The service that answers questions about every car of its shard."""

    def __init__(
        self,
        bus: Bus,
        pipeline: Pipeline,
        memory: TurnLog | None = None,
        place: Place | None = None,
        note: Callable[[str], None] = lambda _: None,
    ) -> None:
        """Begin to serve, once opened.

        Args:
            bus: of the cars and the passengers.
            pipeline: answers.
            memory: stores turns; None: they are lost when this process ends.
            place: in a fleet; None: it answers about every car.
            note: is called with messages for the operator.
        """
        self.alive = HealthReporter("service", COUNTERS)
        self._memory = TurnLog() if memory is None else memory
        owners = SessionOwners(self._memory.owner, lambda session: self.handler.put_away(session))
        self._responder = Responder(bus, owners, self._memory, self.alive)
        self.handler = RequestHandler(
            pipeline,
            self._memory,
            owners,
            self.alive,
            self._responder.repeat,
            self._responder.forget,
        )
        self._bus = bus
        self._inbox: system.Queue[_Job] = system.new_queue()
        self._held, self._room = 0, threading.Lock()  # bytes of the reports in the inbox
        heard = (
            ("trace", self._hearer(TraceReport), True),
            ("event", self._hearer(EventReport), True),
            ("scene", self._hearer(SceneReport), False),
        )
        self.membership = Membership(bus, place or Place(), heard, note)
        self.rest: Callable[[], None] = lambda: None  # called when nobody waits for an answer

    def vehicle_session(self, vehicle: str = DEFAULT_VEHICLE) -> VehicleSession:
        """Return the session of a vehicle."""
        return self.handler.vehicle_session(vehicle)

    def open(self) -> None:
        """Declare subscriptions and services on the bus."""
        bus, key, handler = self._bus, EVERY_CAR.of, self.handler
        bus.watch(key("alive/car"), lambda key, alive: self._post(self._on_car, key, alive))
        requests = {
            "cancel": handler.cancel,
            "evidence": handler.evidence,
            "history": self._history,
        }
        for name, handle in requests.items():
            bus.serve(key(f"@rpc/{name}"), partial(self._take, handle))
        bus.serve(key("@rpc/forget"), self._take_erasing)
        bus.serve(key("@rpc/ask"), self._take_question)
        for name, message in MESSAGES.items():
            if name not in CAR_MESSAGES:
                bus.serve(key(f"@schema/{name}"), partial(_tell_schema, message))
        self.alive.gauge("cars", lambda: sum(d.car_alive for d in handler.all_vehicles()))
        self.alive.gauge("sessions", lambda: sum(len(d.past) for d in handler.all_vehicles()))
        self.alive.gauge("waiting", handler.waiting)
        bus.serve(key("alive/service"), self._fares)
        self.membership.join(self.alive.answer, lambda: self._post(self.membership.refresh))

    def run(self, stopped: Callable[[], bool]) -> None:
        """Serve until asked to stop."""
        _LOG.info("serving")
        while not stopped():
            self.work(IDLE, stopped)
        _LOG.info("no longer serving")

    def work(self, patience: float = 0.0, stopped: Callable[[], bool] = lambda: False) -> None:
        """Handle messages, waiting up to `patience` [s] for the first, and enforce deadlines.

        Questions are answered one at a time; reports that arrive meanwhile are recorded in between.
        When asked to stop, it leaves the remaining questions unanswered.
        """
        handler = self.handler
        with contextlib.suppress(queue.Empty):
            wait = self._patience(patience)
            self._do(self._inbox.get(wait > 0.0, wait))
        while not stopped():
            self._empty_inbox()
            for vehicle_session in handler.active():
                self._settle(vehicle_session)
                handler.rest(vehicle_session)
            self._memory.flush()
            if self._inbox.empty() and not handler.ready():
                break
        idle = not handler.waiting()
        self._memory.tidy(system.wall(), idle=idle)
        for vehicle_session in handler.changed() if idle else ():
            if self.membership.answers(vehicle_session.vehicle):
                self._run(vehicle_session, vehicle_session.foresee(system.monotonic()))
        if idle:
            self.rest()

    def _do(self, job: _Job) -> None:
        """Run one action; an internal error in it does not stop the service."""
        try:
            job()
        except TransportError:
            pass  # the client has disconnected
        except Exception:
            self.alive.count("faults")
            _LOG.exception("internal error")

    def _settle(self, vehicle_session: VehicleSession) -> None:
        """Answer one question of a vehicle's session, and update the average time."""
        ready, began = vehicle_session.scheduler.ready, system.monotonic()
        self._do(lambda: self._run(vehicle_session, vehicle_session.settle(began)))
        if ready:
            self.handler.learn(system.monotonic() - began)

    def _empty_inbox(self) -> None:
        with contextlib.suppress(queue.Empty):
            for _ in range(MAX_INBOX):  # bounded, since a flood of reports would block all answers
                self._do(self._inbox.get_nowait())

    def _patience(self, patience: float) -> float:
        """Return how long [s] nothing needs to be done unless a message arrives."""
        for vehicle_session in self.handler.active():
            deadline = vehicle_session.scheduler.next_deadline()
            if deadline is not None:
                patience = min(patience, max(deadline - system.monotonic(), 0.0))
            if vehicle_session.reports is not None and vehicle_session.reports.missing is not None:
                patience = min(patience, HURRY)
        return patience

    def _post(self, job: Callable[..., None], *arguments: object) -> None:
        self._inbox.put(partial(job, *arguments))

    def _take(self, handle: Callable[[Call], None], call: Call) -> None:
        """Queue a request, refuse it, or leave it to another service; called by the bus."""
        if not self.membership.answers(vehicle_in(call.key)):
            call.drop()
        else:
            self._queue(handle, call)

    def _queue(self, handle: Callable[[Call], None], call: Call) -> None:
        if self._inbox.qsize() > MAX_INBOX:
            with contextlib.suppress(TransportError):  # the client has disconnected
                call.refuse(pack(Failure(reason="busy", detail="too much comes in")))
        else:
            self._post(self._handle, handle, call)

    def _take_question(self, call: Call) -> None:
        """Queue a question; its deadline counts from now on."""
        self._take(partial(self.handler.ask, came=system.monotonic()), call)

    def _take_erasing(self, call: Call) -> None:
        """Queue a request to erase; what another service was told of the session goes as well."""
        here = self.membership.answers(vehicle_in(call.key))
        self._queue(self.handler.forget if here else self.handler.forget_too, call)

    def _fares(self, call: Call) -> None:
        """Tell how this service fares, unless another one answers about the car."""
        if self.membership.answers(vehicle_in(call.key)):
            self.alive.answer(call)
        else:
            call.drop()

    def _handle(self, handle: Callable[[Call], None], call: Call) -> None:
        try:
            handle(call)
        except Rejection as refusal:
            self.alive.count("busy", refusal.failure.reason == "busy")
            known = {"vehicle": vehicle_in(call.key), "reason": refusal.failure.reason}
            _LOG.info("a request was refused", extra=known)
            call.refuse(pack(refusal.failure))
        except TransportError:
            raise
        except Exception:
            call.refuse(pack(Failure(reason="planner-failed", detail="a fault of the service")))
            raise

    def _history(self, call: Call) -> None:
        self.handler.history(call, self._responder.next())

    def _hearer(self, kind: _Heard) -> Callable[[str, bytes], None]:
        def hear(key: str, payload: bytes) -> None:
            with self._room:
                fits = self._inbox.qsize() <= MAX_INBOX and self._held + len(payload) <= MAX_BYTES
                self._held += len(payload) if fits else 0
            if fits:
                self._post(self._on_report, kind, key, payload)
            else:
                self.alive.count("rejected")

        return hear

    def _on_report(self, kind: _Heard, key: str, payload: bytes) -> None:
        with self._room:
            self._held -= len(payload)
        try:
            report = unpack(payload, kind)
            vehicle = vehicle_in(key)
            vehicle_session = None if vehicle is None else self.vehicle_session(vehicle)
        except (MessageError, Rejection) as error:
            self.alive.count("rejected")
            known = {"vehicle": vehicle_in(key), "report": schema_name(kind)}
            _LOG.info("a report was rejected", extra={**known, "problem": type(error).__name__})
            return
        if vehicle_session is None:
            self.alive.count("rejected")
            return
        vehicle_session.hear(report)
        self.handler.stir(vehicle_session)
        self.alive.at(report.sim_time)
        if isinstance(report, EventReport):
            ride = ride_of(vehicle_session)
            if (
                vehicle_session.reports is None or vehicle_session.reports.ride != report.ride
            ):  # it is not seen yet
                ride = None
            ride = ride or RideName(named(vehicle_session.vehicle, report.ride))
            self._memory.hear(ride, report.seq, system.wall(), report.event)

    def _on_car(self, key: str, alive: bool) -> None:
        vehicle = vehicle_in(key)
        if vehicle is None or not self.membership.shard.has(vehicle):
            return
        with contextlib.suppress(Rejection):
            vehicle_session = self.vehicle_session(vehicle)
            vehicle_session.car_alive = alive
            vehicle_session.look()
            _LOG.info("a car appears" if alive else "a car is gone", extra={"vehicle": vehicle})
            self.handler.stir(vehicle_session)
            if alive:
                self.membership.keep(self.handler.vehicles)
                self.membership.follow(vehicle)

    def _run(self, vehicle_session: VehicleSession, tasks: list[Task]) -> None:
        for task in tasks:
            match task:
                case Answer():
                    self._responder.answer(vehicle_session, task)
                case PlanAgain():
                    done = partial(self._post, self._on_planned, vehicle_session, task)
                    self._responder.plan_again(vehicle_session.vehicle, task, done)

    def _on_planned(
        self, vehicle_session: VehicleSession, task: PlanAgain, outcome: Outcome
    ) -> None:
        result = planned(outcome)
        known = {
            "vehicle": vehicle_session.vehicle,
            "session": task.session,
            "request": task.request,
            "trace_id": task.need.trace_id,
        }
        reason = result if isinstance(result, str) else None
        _LOG.info("a decision was planned again", extra={**known, "reason": reason})
        self._run(vehicle_session, vehicle_session.deliver(task, result))
        self.handler.stir(vehicle_session)


def _tell_schema(message: type[AnyMessage], call: Call) -> None:
    with contextlib.suppress(TransportError):  # the client has disconnected
        call.reply(msgspec.json.encode(schema_of(message, schema_name(message))))
