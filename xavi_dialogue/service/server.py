"""The dialogue service: hears the rides on the bus, and answers questions within their deadlines.

One service serves any number of cars. Everything that comes in is put into one inbox and handled
by one thread, so that each manager sees one row of inputs. Cars are asked to plan again, and
never waited for.
"""

import contextlib
import logging
import queue
import threading
import time
from collections.abc import Callable
from functools import partial
from typing import TypeAlias

import msgspec

from xavi_dialogue.bus.catalogue import CAR_MESSAGES, MESSAGES
from xavi_dialogue.bus.health import Alive
from xavi_dialogue.bus.interface import (
    DEFAULT_VEHICLE,
    EVERY_CAR,
    Bus,
    BusError,
    Call,
    Keys,
    Outcome,
    Presence,
    vehicle_in,
)
from xavi_dialogue.bus.messages import (
    AnyMessage,
    EventReport,
    Failure,
    MessageError,
    SceneReport,
    TraceReport,
    pack,
    schema_name,
    unpack,
)
from xavi_dialogue.bus.schema import schema_of
from xavi_dialogue.dialogue.mind import Mind
from xavi_dialogue.service.ownership import Owners
from xavi_dialogue.service.request_handler import Reception, Refusal
from xavi_dialogue.service.requests import Answer, Errand, PlanAgain
from xavi_dialogue.service.responder import Dispatch, named, planned, ride_of
from xavi_dialogue.service.vehicle_session import Desk
from xavi_dialogue.storage.conversations import RideName
from xavi_dialogue.storage.turn_log import Memory

_LOG = logging.getLogger(__name__)
IDLE = 0.5  # [s] between looks at whether to stop
HURRY = 0.05  # [s] between looks at whether what is missing still comes
MAX_INBOX = 20_000  # messages; beyond them reports are left out, and requests refused
MAX_BYTES = 128 * 1024 * 1024  # of reports
COUNTERS = (
    *("questions", "answered", "declined", "busy", "rejected", "foreign"),
    *("what_ifs", "faults"),
)

_Job: TypeAlias = Callable[[], None]
_Heard: TypeAlias = type[TraceReport | EventReport | SceneReport]


class Service:
    """Answers questions about every car on the bus."""

    def __init__(self, bus: Bus, mind: Mind, memory: Memory | None = None) -> None:
        """Begin to serve, once opened.

        Args:
            bus: of the cars and the passengers.
            mind: answers.
            memory: keeps what is said; none: it is forgotten when this process ends.
        """
        self.alive = Alive("service", COUNTERS)
        self._memory = Memory() if memory is None else memory
        owners = Owners(self._memory.owner, lambda session: self.reception.put_away(session))
        self._dispatch = Dispatch(bus, owners, self._memory, self.alive)
        self.reception = Reception(
            mind, self._memory, owners, self.alive, self._dispatch.repeat, self._dispatch.forget
        )
        self._bus = bus
        self._inbox: queue.SimpleQueue[_Job] = queue.SimpleQueue()
        self._held, self._room = 0, threading.Lock()  # bytes of the reports in it
        self._seen: dict[str, Presence] = {}  # our signs of life, by car

    def desk(self, vehicle: str = DEFAULT_VEHICLE) -> Desk:
        """The desk of a car."""
        return self.reception.desk(vehicle)

    def open(self) -> None:
        """Declare what is heard and what is answered."""
        bus, key, reception = self._bus, EVERY_CAR.of, self.reception
        bus.watch(key("alive/car"), lambda key, alive: self._post(self._on_car, key, alive))
        bus.subscribe(key("trace"), self._hearer(TraceReport), kept=True)
        bus.subscribe(key("event"), self._hearer(EventReport), kept=True)
        bus.subscribe(key("scene"), self._hearer(SceneReport))
        requests = {
            "cancel": reception.cancel,
            "evidence": reception.evidence,
            "forget": reception.forget,
            "history": self._history,
        }
        for name, handle in requests.items():
            bus.serve(key(f"@rpc/{name}"), partial(self._take, handle))
        bus.serve(key("@rpc/ask"), self._take_question)
        for name, message in MESSAGES.items():
            if name not in CAR_MESSAGES:
                bus.serve(key(f"@schema/{name}"), partial(_tell_schema, message))
        self.alive.gauge("cars", lambda: sum(d.car_alive for d in reception.all_desks()))
        self.alive.gauge("sessions", lambda: sum(len(d.past) for d in reception.all_desks()))
        self.alive.gauge("waiting", reception.waiting)
        bus.serve(key("alive/service"), self.alive.answer)
        self._show(DEFAULT_VEHICLE)

    def run(self, stopped: Callable[[], bool]) -> None:
        """Serve until told to stop."""
        _LOG.info("serving")
        while not stopped():
            self.work(IDLE, stopped)
        _LOG.info("no longer serving")

    def work(self, patience: float = 0.0, stopped: Callable[[], bool] = lambda: False) -> None:
        """Handle what came in, waiting up to `patience` [s] for it, and keep deadlines.

        Questions are answered one at a time; what comes in meanwhile is taken down in between.
        Told to stop, it leaves the others for what they are.
        """
        with contextlib.suppress(queue.Empty):
            wait = self._patience(patience)
            self._do(self._inbox.get(wait > 0.0, wait))
        while not stopped():
            self._empty_inbox()
            for desk in self.reception.all_desks():
                self._settle(desk)
            if self._inbox.empty() and not self.reception.ready():
                break
        idle = not self.reception.waiting()
        self._memory.tidy(time.time(), idle=idle)
        for desk in self.reception.all_desks() if idle else ():
            self._run(desk, desk.foresee(time.monotonic()))

    def _do(self, job: _Job) -> None:
        """Do one thing; should it fail through a fault of ours, all others are served on."""
        try:
            job()
        except BusError:
            pass  # who asked is gone
        except Exception:
            self.alive.count("faults")
            _LOG.exception("a fault of ours")

    def _settle(self, desk: Desk) -> None:
        """Have a desk answer one question, and learn how long that takes."""
        ready, began = desk.waiting.ready, time.monotonic()
        self._do(lambda: self._run(desk, desk.settle(began)))
        if ready:
            self.reception.learn(time.monotonic() - began)

    def _empty_inbox(self) -> None:
        with contextlib.suppress(queue.Empty):
            for _ in range(MAX_INBOX):  # else a flood would keep anybody from being answered
                self._do(self._inbox.get_nowait())

    def _patience(self, patience: float) -> float:
        """How long [s] nothing has to be done unless something comes in."""
        for desk in self.reception.all_desks():
            deadline = desk.waiting.next_deadline()
            if deadline is not None:
                patience = min(patience, max(deadline - time.monotonic(), 0.0))
            if desk.ledger is not None and desk.ledger.missing is not None:
                patience = min(patience, HURRY)
        return patience

    def _post(self, job: Callable[..., None], *arguments: object) -> None:
        self._inbox.put(partial(job, *arguments))

    def _take(self, handle: Callable[[Call], None], call: Call) -> None:
        """Have a request handled; on a thread of the bus."""
        if self._inbox.qsize() > MAX_INBOX:
            with contextlib.suppress(BusError):  # who asked is gone
                call.refuse(pack(Failure(reason="busy", detail="too much comes in")))
        else:
            self._post(self._handle, handle, call)

    def _take_question(self, call: Call) -> None:
        """Have a question taken up; its time runs from now on, wherever it waits."""
        self._take(partial(self.reception.ask, came=time.monotonic()), call)

    def _handle(self, handle: Callable[[Call], None], call: Call) -> None:
        try:
            handle(call)
        except Refusal as refusal:
            self.alive.count("busy", refusal.failure.reason == "busy")
            known = {"vehicle": vehicle_in(call.key), "reason": refusal.failure.reason}
            _LOG.info("a request was refused", extra=known)
            call.refuse(pack(refusal.failure))
        except BusError:
            raise
        except Exception:
            call.refuse(pack(Failure(reason="planner-failed", detail="a fault of the service")))
            raise

    def _history(self, call: Call) -> None:
        self.reception.history(call, self._dispatch.next())

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
            desk = None if vehicle is None else self.desk(vehicle)
        except (MessageError, Refusal) as error:
            self.alive.count("rejected")
            known = {"vehicle": vehicle_in(key), "report": schema_name(kind)}
            _LOG.info("a report was rejected", extra={**known, "problem": type(error).__name__})
            return
        if desk is None:
            self.alive.count("rejected")
            return
        desk.hear(report)
        self.alive.at(report.sim_time)
        if isinstance(report, EventReport):
            ride = ride_of(desk)
            if desk.ledger is None or desk.ledger.ride != report.ride:  # it is not seen yet
                ride = None
            ride = ride or RideName(named(desk.vehicle, report.ride))
            self._memory.hear(ride, report.seq, time.time(), report.event)

    def _on_car(self, key: str, alive: bool) -> None:
        vehicle = vehicle_in(key)
        if vehicle is None:
            return
        with contextlib.suppress(Refusal):
            desk = self.desk(vehicle)
            desk.car_alive = alive
            desk.look()
            _LOG.info("a car appears" if alive else "a car is gone", extra={"vehicle": vehicle})
            if alive:
                self._show(vehicle)

    def _show(self, vehicle: str) -> None:
        """Show those who look for this car's service that it is there."""
        for gone in self._seen.keys() - self.reception.desks.keys() - {DEFAULT_VEHICLE}:
            self._seen.pop(gone).withdraw()
        if vehicle not in self._seen:
            self._seen[vehicle] = self._bus.appear(Keys(vehicle).of("alive/service"))

    def _run(self, desk: Desk, errands: list[Errand]) -> None:
        for errand in errands:
            match errand:
                case Answer():
                    self._dispatch.answer(desk, errand)
                case PlanAgain():
                    done = partial(self._post, self._on_planned, desk, errand)
                    self._dispatch.plan_again(desk.vehicle, errand, done)

    def _on_planned(self, desk: Desk, errand: PlanAgain, outcome: Outcome) -> None:
        result = planned(outcome)
        known = {
            "vehicle": desk.vehicle,
            "session": errand.session,
            "request": errand.request,
            "trace_id": errand.need.trace_id,
        }
        reason = result if isinstance(result, str) else None
        _LOG.info("a decision was planned again", extra={**known, "reason": reason})
        self._run(desk, desk.deliver(errand, result))


def _tell_schema(message: type[AnyMessage], call: Call) -> None:
    with contextlib.suppress(BusError):  # who asked is gone
        call.reply(msgspec.json.encode(schema_of(message, schema_name(message))))
