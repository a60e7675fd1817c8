"""The dialogue service: hears the ride on the bus, and answers questions within their deadlines.

Everything that comes in is put into one inbox and handled by one thread, so that the manager
sees one row of inputs. The car is asked to plan again, and never waited for.
"""

import contextlib
import queue
import time
from collections.abc import Callable
from functools import partial
from typing import TypeAlias

import msgspec

from planner import trace as plan_trace
from planner.trace import PlanTrace, TraceError
from xavi_dialogue.app.desk import Answer, Desk, Errand, PlanAgain, Question
from xavi_dialogue.app.memory import Memory
from xavi_dialogue.dialogue.mind import Mind
from xavi_dialogue.explain.explanation import Reason
from xavi_dialogue.transports.bus import (
    Bus,
    BusError,
    Call,
    Keys,
    NobodyThere,
    Outcome,
    Refused,
    TooLate,
)
from xavi_dialogue.transports.messages import (
    KIB,
    MESSAGES,
    AnyMessage,
    AskReply,
    AskRequest,
    CancelReply,
    CancelRequest,
    EventReport,
    Failure,
    ForgetReply,
    ForgetRequest,
    HistoryReply,
    HistoryRequest,
    MessageError,
    PastTurn,
    SceneReport,
    TraceReport,
    WhatIfRequest,
    pack,
    schema_name,
    unpack,
)
from xavi_dialogue.transports.schema import schema_of
from xavi_dialogue.transports.store import RideName

MAX_TURNS = 100  # in a history, and fewer where they would be too large
IDLE = 0.5  # [s] between looks at whether to stop
CAR_MESSAGES = (SceneReport, TraceReport, EventReport)  # the car tells their schemas

_Job: TypeAlias = Callable[[], None]


class Service:
    """Answers questions about one car."""

    def __init__(self, bus: Bus, keys: Keys, mind: Mind, memory: Memory | None = None) -> None:
        """Begin to serve, once opened.

        Args:
            bus: of the car and the passengers.
            keys: of the car.
            mind: answers.
            memory: keeps what is said; none: it is forgotten when this process ends.
        """
        self.desk = Desk(mind)
        self._memory = Memory() if memory is None else memory
        self.rejected = 0  # reports that could not be read
        self._bus, self._keys = bus, keys
        self._inbox: queue.SimpleQueue[_Job] = queue.SimpleQueue()
        self._replies = 0

    def open(self) -> None:
        """Declare what is heard and what is answered."""
        bus, key = self._bus, self._keys.of
        bus.watch(key("alive/car"), lambda _, alive: self._post(self._on_car, alive))
        bus.subscribe(key("trace"), self._hearer(TraceReport), kept=True)
        bus.subscribe(key("event"), self._hearer(EventReport), kept=True)
        bus.subscribe(key("scene"), self._hearer(SceneReport))
        bus.serve(key("@rpc/ask"), partial(self._post, self._on_ask))
        bus.serve(key("@rpc/history"), partial(self._post, self._on_history))
        bus.serve(key("@rpc/forget"), partial(self._post, self._on_forget))
        bus.serve(key("@rpc/cancel"), partial(self._post, self._on_cancel))
        for name, message in MESSAGES.items():
            if message not in CAR_MESSAGES:
                bus.serve(key(f"@schema/{name}"), partial(_tell_schema, message))
        bus.appear(key("alive/service"))

    def run(self, stopped: Callable[[], bool]) -> None:
        """Serve until told to stop."""
        while not stopped():
            self.work(IDLE)

    def work(self, patience: float = 0.0) -> None:
        """Handle what came in, waiting up to `patience` [s] for it, and keep deadlines."""
        deadline = self.desk.next_deadline()
        if deadline is not None:
            patience = min(patience, max(deadline - time.monotonic(), 0.0))
        try:
            _do(self._inbox.get(patience > 0.0, patience))
            while True:
                _do(self._inbox.get_nowait())
        except queue.Empty:
            self._memory.tidy(time.time(), idle=not self.desk.questions)
            self._run(self.desk.settle(time.monotonic()))

    def _post(self, job: Callable[..., None], *arguments: object) -> None:
        self._inbox.put(partial(job, *arguments))

    def _hearer(self, kind: type[TraceReport | EventReport | SceneReport]) -> Callable[..., None]:
        def hear(_: str, payload: bytes) -> None:
            self._post(self._on_report, kind, payload)

        return hear

    def _on_report(
        self, kind: type[TraceReport | EventReport | SceneReport], payload: bytes
    ) -> None:
        try:
            report = unpack(payload, kind)
        except MessageError:
            self.rejected += 1
            return
        self.desk.hear(report)
        if isinstance(report, EventReport):
            ride = self._ride() or RideName(report.ride)
            self._memory.hear(ride, report.seq, time.time(), report.event)

    def _ride(self) -> RideName | None:
        """The ride that is heard of."""
        ledger = self.desk.ledger
        if ledger is None:
            return None
        scene = ledger.scene
        if scene is None:
            return RideName(ledger.ride)
        return RideName(ledger.ride, scene.scenario, scene.seed)

    def _know(self, session: str) -> None:
        """Make sure that the desk knows what was said in a session before."""
        if session not in self.desk.past:
            self.desk.resume(session, self._memory.recall(session))

    def _on_car(self, alive: bool) -> None:
        self.desk.car_alive = alive

    def _on_ask(self, call: Call) -> None:
        try:
            asked = unpack(call.payload, AskRequest)
        except MessageError as error:
            call.refuse(pack(Failure(reason="not-understood", detail=str(error))))
            return
        if asked.request in self.desk.questions:
            call.refuse(pack(Failure(reason="busy", detail="a request of this name is open")))
            return
        came = time.monotonic()
        self._know(asked.session)
        self.desk.take(Question(call, asked, came))

    def _on_cancel(self, call: Call) -> None:
        try:
            wanted = unpack(call.payload, CancelRequest)
        except MessageError as error:
            call.refuse(pack(Failure(reason="not-understood", detail=str(error))))
            return
        dropped = self.desk.cancel(wanted)
        if dropped is not None:
            dropped.call.drop()
        call.reply(pack(CancelReply(request=wanted.request, cancelled=dropped is not None)))

    def _on_forget(self, call: Call) -> None:
        try:
            wanted = unpack(call.payload, ForgetRequest)
        except MessageError as error:
            call.refuse(pack(Failure(reason="not-understood", detail=str(error))))
            return
        known, dropped = self.desk.forget(wanted.session)
        for question in dropped:
            question.call.drop()
        erased = self._memory.forget(wanted.session)
        reply = ForgetReply(
            request=wanted.request,
            session=wanted.session,
            turns=known if erased is None else max(erased, known),
            forgotten=erased is not None,
        )
        call.reply(pack(reply))

    def _on_history(self, call: Call) -> None:
        try:
            wanted = unpack(call.payload, HistoryRequest)
        except MessageError as error:
            call.refuse(pack(Failure(reason="not-understood", detail=str(error))))
            return
        self._know(wanted.session)
        turns = self.desk.past[wanted.session][-MAX_TURNS:]
        past = tuple(PastTurn(turn.text, turn.reply) for turn in turns)
        ledger = self.desk.ledger
        scene = None if ledger is None else ledger.scene
        reply = HistoryReply(
            session=wanted.session,
            seq=self._next(),
            sim_time=0.0 if scene is None else scene.sim_time,
            wall_time=time.time(),
            turns=_latest(past, HistoryReply.LIMIT - KIB),
        )
        call.reply(pack(reply))

    def _run(self, errands: list[Errand]) -> None:
        for errand in errands:
            match errand:
                case Answer():
                    self._send(errand)
                case PlanAgain():
                    self._plan_again(errand)

    def _send(self, answer: Answer) -> None:
        asked = answer.question.asked
        if answer.turn is not None:
            self._memory.keep(asked.session, self._ride(), time.time(), answer.turn)
        taken = round((time.monotonic() - answer.question.came) * 1000.0, 3)
        fields = msgspec.structs.asdict(answer.reply) | {"timing_ms": taken}
        reply = AskReply(**fields, request=asked.request, seq=self._next(), wall_time=time.time())
        _do(partial(answer.question.call.reply, pack(reply)))

    def _plan_again(self, errand: PlanAgain) -> None:
        need, request = errand.need, errand.question.asked.request
        remaining = max(errand.question.deadline - time.monotonic(), 0.001)
        fields = msgspec.structs.asdict(need)
        wanted = WhatIfRequest(
            **{name: value for name, value in fields.items() if value is not msgspec.UNSET},
            request=request,
            deadline_ms=remaining * 1000.0,
        )
        done = partial(self._post, self._on_planned, errand)
        self._bus.request(self._keys.of("@rpc/whatif"), pack(wanted), remaining, done)

    def _on_planned(self, errand: PlanAgain, outcome: Outcome) -> None:
        self._run(self.desk.deliver(errand, _planned(outcome)))

    def _next(self) -> int:
        self._replies += 1
        return self._replies - 1


def _do(job: _Job) -> None:
    with contextlib.suppress(BusError):  # who asked is gone
        job()


def _latest(turns: tuple[PastTurn, ...], limit: int) -> tuple[PastTurn, ...]:
    """As many of the latest turns as have so many bytes."""
    taken = 0
    for kept, turn in enumerate(reversed(turns)):
        taken += len(msgspec.json.encode(turn)) + 1
        if taken > limit:
            return turns[len(turns) - kept :]
    return turns


def _planned(outcome: Outcome) -> PlanTrace | Reason:
    """What the car sent back, or why there is nothing."""
    match outcome:
        case bytes():
            try:
                return plan_trace.decode(outcome)
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


def _tell_schema(message: type[AnyMessage], call: Call) -> None:
    call.reply(msgspec.json.encode(schema_of(message, schema_name(message))))
