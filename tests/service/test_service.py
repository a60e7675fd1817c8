"""The service within one process: reports and questions over the in-memory bus."""

import json
import sqlite3
import time
from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path

import msgspec
import pytest

from planner.record import trace as plan_trace
from planner.record.events import Event
from tests.dialogue.scripted import scripted_pipeline
from tests.fakes import again, s1_moments
from xavi_dialogue.bus.catalogue import MESSAGES
from xavi_dialogue.bus.interface import (
    EVERY_CAR,
    Bus,
    BusFailed,
    Call,
    Keys,
    NoAnswer,
    Refused,
    call,
)
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import (
    AskReply,
    AskRequest,
    CancelReply,
    CancelRequest,
    Failure,
    ForgetReply,
    ForgetRequest,
    HistoryReply,
    HistoryRequest,
    PastTurn,
    WhatIfRequest,
    pack,
    unpack,
)
from xavi_dialogue.chat.client import Client, ServiceLost
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.runtime import system
from xavi_dialogue.service.erased import MAX_NAMES, REMEMBERED, ErasedQuestions
from xavi_dialogue.service.reorder_buffer import ReorderBuffer
from xavi_dialogue.service.requests import Answer
from xavi_dialogue.service.server import Service
from xavi_dialogue.storage import turn_log as memory
from xavi_dialogue.storage.conversations import DAY, New, NewTurn, RideName, Store
from xavi_dialogue.storage.turn_log import MAX_PAST, PURGED_EVERY, Retention, TurnLog
from xavi_dialogue.vehicle.telemetry import Reporter

KEYS = Keys()
ASK = KEYS.of("@rpc/ask")
ASKED = EVERY_CAR.of("@rpc/ask")


EMPTY = HistoryReply(session="ada", seq=0, sim_time=0.0, wall_time=0.0, turns=())


class Bench:
    """A service, a car that reports, and passengers, on one in-memory hub."""

    def __init__(self, memory: TurnLog | None = None) -> None:
        self.hub = MemoryHub()
        self.service = Service(self.hub.connect(), scripted_pipeline(), memory)
        self.service.open()
        self.car = self.hub.connect()
        self.passenger: Bus = self.hub.connect()

    def drive(self, until: float = 7.0, *, appear: bool = True) -> None:
        if appear:
            self.car.appear(KEYS.of("alive/car"))
        reporter = Reporter(self.car, KEYS, "s1", 4)
        for moment in s1_moments():
            reporter.record(moment)
            reporter.show(moment, "ended" if moment.ending else "driving", 1.0)
            if moment.scene.time >= until:
                break
        self.service.work()

    def send(self, text: str, **more: object) -> list[object]:
        """Ask; the list gets what comes back."""
        came: list[object] = []
        fields = {"request": "q1", "session": "ada", "text": text, **more}
        asked = AskRequest(**fields)  # type: ignore[arg-type]
        self.passenger.request(ASK, pack(asked), 1.0, came.append)
        for _ in range(3):  # the question, and what the car replied to the service
            self.service.work()
        return came

    def ask(self, text: str, **more: object) -> Reply:
        [came] = self.send(text, **more)
        assert isinstance(came, bytes)
        return unpack(came, AskReply).reply()

    def forget(self, session: str) -> ForgetReply:
        wanted = ForgetRequest(request="f1", session=session)
        return unpack(self._call("@rpc/forget", pack(wanted)), ForgetReply)

    def history(self) -> list[str]:
        """What was asked in the session."""
        wanted = HistoryRequest(session="ada")
        reply = unpack(self._call("@rpc/history", pack(wanted)), HistoryReply)
        return [turn.text for turn in reply.turns]

    def _call(self, rpc: str, wanted: bytes) -> bytes:
        came: list[bytes] = []
        self.passenger.request(KEYS.of(rpc), wanted, 1.0, came.append)  # type: ignore[arg-type]
        self.service.work()
        [reply] = came
        return reply


def planned(bench: Bench, asked: Call) -> None:
    """Reply to the service as the car does once it has planned again."""
    wanted = unpack(asked.payload, WhatIfRequest)
    traces = bench.service.vehicle_session().dialogue.traces
    [trace] = [trace for trace in traces if trace.trace_id == wanted.trace_id]
    asked.reply(plan_trace.encode(again(trace, wanted)))


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_a_question_is_answered_from_the_reported_record(bench: Bench) -> None:
    bench.drive()
    reply = bench.ask("foil")
    assert (reply.kind, reply.sim_time) == ("answer", 7.0)
    assert reply.timing_ms is not None
    assert reply.trace_id == bench.service.vehicle_session().dialogue.traces[-1].trace_id


def test_a_question_about_a_moment_to_come_waits_for_it(bench: Bench) -> None:
    bench.drive(until=3.0)
    came = bench.send("answer", at=6.0)
    assert came == []
    bench.drive(appear=False)  # a new ride gets there
    [payload] = came
    assert unpack(payload, AskReply).sim_time == 6.0  # type: ignore[arg-type]


def test_reports_may_come_in_any_order() -> None:
    items: ReorderBuffer[str] = ReorderBuffer(9, len)
    assert items.add(1, "b") == []
    assert items.add(0, "a") == ["a", "b"]
    assert items.add(0, "a") == []
    assert items.add(2, "c") == ["c"]


def test_who_joins_late_begins_with_what_is_still_kept() -> None:
    items: ReorderBuffer[str] = ReorderBuffer(9, len)
    assert items.add(7, "h") == []
    assert items.begin(0) == []
    assert items.begin(6) == []  # the seventh may still come
    assert items.add(6, "g") == ["g", "h"]
    assert items.begin(5) == []
    assert items.add(8, "i") == ["i"]
    late: ReorderBuffer[str] = ReorderBuffer(9, len)
    assert [late.add(3, "d"), late.add(4, "e")] == [[], []]
    assert late.begin(4) == ["d", "e"]  # a little more was kept than had to be


def test_without_a_car_there_is_no_planner(bench: Bench) -> None:
    reply = bench.ask("answer")
    assert (reply.kind, reply.reason) == ("refusal", "planner-unavailable")


def test_when_the_car_is_gone_the_conversation_goes_on(bench: Bench) -> None:
    bench.drive(until=3.0)
    bench.car.close()
    assert bench.ask("answer").kind == "answer"
    assert bench.ask("answer", at=6.0).reason == "planner-unavailable"
    assert bench.ask("lack").reason == "planner-unavailable"


def test_a_question_is_given_up_before_its_deadline(bench: Bench) -> None:
    bench.drive(until=3.0)
    came = bench.send("answer", at=6.0, deadline_ms=2000.0)
    vehicle_session = bench.service.vehicle_session()
    [question] = vehicle_session.scheduler.open.values()
    deadline = question.came + 2.0
    assert vehicle_session.settle(deadline - 0.2) == []
    [given_up] = vehicle_session.settle(deadline - 0.01)
    assert isinstance(given_up, Answer)
    assert given_up.reply.reason == "timed-out"
    assert (came, vehicle_session.scheduler.open) == ([], {})


def test_a_question_that_is_planned_for_is_given_up_too(bench: Bench) -> None:
    bench.drive()
    bench.car.serve(KEYS.of("@rpc/whatif"), lambda _: None)
    bench.send("lack", deadline_ms=2000.0)
    vehicle_session = bench.service.vehicle_session()
    [given_up] = vehicle_session.settle(vehicle_session.scheduler.open["ada", "q1"].came + 1.99)
    assert isinstance(given_up, Answer)
    assert given_up.reply.reason == "timed-out"
    assert bench.ask("answer", request="q2").kind == "answer"


def test_the_car_plans_again_on_request(bench: Bench) -> None:
    bench.drive()
    wanted: list[WhatIfRequest] = []

    def plan(asked: Call) -> None:
        wanted.append(unpack(asked.payload, WhatIfRequest))
        planned(bench, asked)

    bench.car.serve(KEYS.of("@rpc/whatif"), plan)
    came = bench.send("lack more")
    assert unpack(came[0], AskReply).kind == "answer"  # type: ignore[arg-type]
    assert [w.rollouts for w in wanted] == [1, 2]


def test_the_car_is_told_what_is_supposed_of_another_vehicle(bench: Bench) -> None:
    bench.drive()
    wanted: list[WhatIfRequest] = []

    def plan(asked: Call) -> None:
        wanted.append(unpack(asked.payload, WhatIfRequest))
        planned(bench, asked)

    bench.car.serve(KEYS.of("@rpc/whatif"), plan)
    assert bench.ask("suppose").kind == "answer"
    assert bench.ask("lack", request="q2").kind == "answer"
    told = [(one.vehicle, one.goal, one.vehicle_actions) for one in wanted]
    assert told == [(1, "exit-right", ("stop",)), (None, None, ())]


class Gone:
    """A call whose caller is gone."""

    def __init__(self, payload: bytes) -> None:
        self.key, self.payload = ASK, payload

    def reply(self, payload: bytes) -> None:
        raise BusFailed(f"{len(payload)} bytes for nobody")

    refuse = reply

    def drop(self) -> None:
        raise AssertionError("it is to be answered")


def test_who_asks_and_goes_harms_nobody(bench: Bench) -> None:
    bench.drive()
    asked = AskRequest(request="q0", session="ada", text="answer")
    serve = bench.hub.servers[ASKED][0][1]
    serve(Gone(pack(asked)))
    serve(Gone(b"junk"))
    assert bench.ask("answer").kind == "answer"
    assert bench.service.vehicle_session().scheduler.open == {}


@pytest.mark.parametrize(
    ("answer", "reason"),
    [
        (lambda asked: asked.refuse(pack(Failure(reason="outside-record"))), "outside-record"),
        (lambda asked: asked.refuse(b"junk"), "planner-failed"),
        (lambda asked: asked.reply(b"junk"), "planner-failed"),
        (lambda asked: asked.drop(), "timed-out"),
    ],
)
def test_what_the_car_cannot_plan_is_told(
    bench: Bench, answer: Callable[[Call], None], reason: str
) -> None:
    bench.drive()
    bench.car.serve(KEYS.of("@rpc/whatif"), answer)
    came = bench.send("lack")
    assert unpack(came[0], AskReply).reason == reason  # type: ignore[arg-type]


def test_a_cancelled_question_gets_no_reply(bench: Bench) -> None:
    bench.drive()
    held: list[Call] = []
    bench.car.serve(KEYS.of("@rpc/whatif"), held.append)
    came = bench.send("lack")
    wanted = pack(CancelRequest(request="q1", session="ada"))
    outcomes: list[bytes] = []
    bench.passenger.request(KEYS.of("@rpc/cancel"), wanted, 1.0, outcomes.append)  # type: ignore[arg-type]
    bench.service.work()
    assert unpack(outcomes[0], CancelReply).cancelled
    assert [type(one).__mro__[1] for one in came] == [NoAnswer]
    planned(bench, held[0])
    bench.service.work()  # too late, and no harm done
    assert bench.ask("answer").kind == "answer"


def test_rollouts_that_come_late_are_not_taken_for_those_of_another_question(bench: Bench) -> None:
    bench.drive()
    held: list[Call] = []
    bench.car.serve(KEYS.of("@rpc/whatif"), held.append)
    bench.send("suppose")
    wanted = pack(CancelRequest(request="q1", session="ada"))
    bench.passenger.request(KEYS.of("@rpc/cancel"), wanted, 1.0, lambda _: None)
    bench.service.work()
    came = bench.send("lack")  # under the same name
    planned(bench, held[0])
    bench.service.work()
    assert came == []
    assert [need.vehicle for need in bench.service.vehicle_session().dialogue.planned] == [
        1
    ]  # kept, unasked
    planned(bench, held[1])
    bench.service.work()
    assert unpack(came[0], AskReply).kind == "answer"  # type: ignore[arg-type]


def test_a_car_that_plans_something_else_has_failed(bench: Bench) -> None:
    bench.drive()
    trace = bench.service.vehicle_session().dialogue.traces[0]
    bench.car.serve(KEYS.of("@rpc/whatif"), lambda asked: asked.reply(plan_trace.encode(trace)))
    assert bench.ask("lack").reason == "planner-failed"


def test_another_ride_begins_another_record(bench: Bench) -> None:
    bench.drive()
    bench.drive(until=3.0, appear=False)
    assert bench.ask("answer").sim_time == 3.0
    assert len(bench.service.vehicle_session().dialogue.traces) == 1


def test_the_history_of_a_session_can_be_read(bench: Bench) -> None:
    bench.drive()
    bench.ask("answer")
    bench.ask("refuse", request="q2")
    assert bench.history() == ["answer", "refuse"]


def reply_of(text: str) -> Reply:
    return Reply(text=text, kind="answer", sim_time=0.0)


def test_a_history_has_the_latest_turns_that_fit(bench: Bench) -> None:
    large = reply_of("\U0001f600" * 10_000)
    turns = tuple(Turn(text=str(k), reply=large) for k in range(60))
    bench.service.vehicle_session().resume("ada", turns)
    told = [int(text) for text in bench.history()]
    assert told == [*range(60 - len(told), 60)]
    size = len(pack(EMPTY)) + len(told) * len(msgspec.json.encode(PastTurn("59", large)))
    assert HistoryReply.LIMIT - 60_000 < size < HistoryReply.LIMIT
    huge = Turn(text="huge", reply=reply_of("x" * 2**20))
    bench.service.vehicle_session().resume("ada", (turns[0], huge, turns[1], turns[2]))
    assert bench.history() == ["1", "2"]


@pytest.mark.parametrize("rpc", ["ask", "history", "forget", "cancel"])
def test_nonsense_is_refused_with_its_reason(bench: Bench, rpc: str) -> None:
    came: list[object] = []
    bench.passenger.request(KEYS.of(f"@rpc/{rpc}"), b'{"schema": 3}', 1.0, came.append)
    bench.service.work()
    [refused] = came
    assert isinstance(refused, Refused)
    assert "no xavi." in unpack(refused.payload, Failure).detail


def test_nonsense_in_the_record_is_counted_and_left_out(bench: Bench) -> None:
    bench.car.publisher(KEYS.of("trace")).put(b"junk")
    bench.drive()
    assert bench.service.alive.counted("rejected") == 1
    assert bench.ask("answer").kind == "answer"


@pytest.mark.parametrize("text", ["break", "lack, break"])
def test_a_fault_of_ours_costs_one_answer(
    bench: Bench, text: str, caplog: pytest.LogCaptureFixture
) -> None:
    bench.drive()
    bench.car.serve(KEYS.of("@rpc/whatif"), partial(planned, bench))
    reply = bench.ask(text)
    assert (reply.kind, reply.reason) == ("refusal", "planner-failed")
    assert "ZeroDivisionError" in caplog.text
    assert bench.ask("answer", request="q2").kind == "answer"


def test_one_name_one_question(bench: Bench) -> None:
    bench.drive()
    bench.car.serve(KEYS.of("@rpc/whatif"), lambda _: None)
    bench.send("lack")
    [refused] = bench.send("answer")
    assert isinstance(refused, Refused)
    assert unpack(refused.payload, Failure).reason == "busy"


def test_the_service_tells_its_schemas(bench: Bench) -> None:
    told = [name for name in MESSAGES if EVERY_CAR.of(f"@schema/{name}") in bench.hub.servers]
    assert {"ask", "reply", "history", "forget", "cancel", "whatif", "failure"} <= set(told)
    schema = json.loads(call(bench.passenger, KEYS.of("@schema/ask"), b"", 1.0))
    assert schema["properties"]["schema"] == {"const": "xavi.ask/1"}


def test_a_client_without_a_service_is_told_so(bench: Bench) -> None:
    alone = Client(MemoryHub().connect(), KEYS, "ada")
    with pytest.raises(ServiceLost, match="does not answer"):
        alone.ask("why?")


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """A file that fails is tried again at once."""
    monkeypatch.setattr(memory, "REST", 0.0)


def test_a_file_that_holds_everybody_up_is_left_alone_for_a_while(
    kept: Retention, monkeypatch: pytest.MonkeyPatch
) -> None:
    with Store(kept.path):
        pass
    other = sqlite3.connect(kept.path, isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    tries: list[int] = []
    keep = Store.keep

    def counted(store: Store, news: Iterable[New]) -> None:
        tries.append(1)
        keep(store, news)

    monkeypatch.setattr(Store, "keep", counted)
    bench = Bench(TurnLog(kept))
    bench.drive()
    monkeypatch.setattr(memory, "REST", 1e6)
    tries.clear()
    assert [bench.ask("answer", request=f"r{k}").kind for k in range(5)] == ["answer"] * 5
    assert len(tries) <= 1
    other.execute("ROLLBACK")
    other.close()


def test_whose_a_session_is_counts_once_it_can_be_read_again(kept: Retention) -> None:
    """Nobody takes over what belongs to somebody else while the file cannot be read."""
    victim, thief = "v" * 43, "t" * 43
    first = Bench(TurnLog(kept))
    first.drive()
    first.ask("answer", token=victim)
    first.service._memory.close()
    hidden = kept.path.with_suffix(".hidden")
    kept.path.rename(hidden)
    kept.path.write_bytes(b"no database" * 100)  # which can never be read again
    later = Bench(TurnLog(kept))
    later.drive()
    assert later.ask("refuse", token=thief).kind == "refusal"  # of a conversation of its own
    hidden.rename(kept.path)
    [denied] = later.send("answer", request="q2", token=thief)
    assert isinstance(denied, Refused)
    assert texts(kept) == ["answer"]


def test_as_long_as_it_cannot_be_read_whose_a_session_is_nobody_gets_it(kept: Retention) -> None:
    victim, thief = "v" * 43, "t" * 43
    first = Bench(TurnLog(kept))
    first.drive()
    for name in ("r1", "r2"):
        first.ask("answer", token=victim, request=name, session=name)
    first.service._memory.close()
    bench = Bench(TurnLog(kept))
    bench.drive()
    assert bench.ask("answer", token=victim, request="again", session="r1").kind == "answer"
    store = bench.service._memory._store
    assert store is not None
    bench.service._memory._store = None
    hidden = kept.path.with_suffix(".hidden")
    kept.path.rename(hidden)
    kept.path.mkdir()

    def tried(kind: str, session: str) -> str:
        make = {"history": HistoryRequest, "forget": ForgetRequest, "ask": AskRequest}[kind]
        more = {
            "history": {},
            "forget": {"request": "f"},
            "ask": {"request": "q9", "text": "answer"},
        }
        wanted = make(session=session, token=thief, **more[kind])  # type: ignore[arg-type]
        came: list[object] = []
        bench.passenger.request(KEYS.of(f"@rpc/{kind}"), pack(wanted), 1.0, came.append)
        bench.service.work()
        [outcome] = came
        return unpack(outcome.payload, Failure).reason if isinstance(outcome, Refused) else "done"

    assert [tried(kind, "r1") for kind in ("history", "ask", "forget")] == ["out-of-scope"] * 3
    assert tried("forget", "r2") == "busy"  # what is on disk is not to be erased by whoever comes
    assert tried("ask", "r2") == "busy"
    kept.path.rmdir()
    hidden.rename(kept.path)
    assert [tried(kind, "r2") for kind in ("history", "ask", "forget")] == ["out-of-scope"] * 3
    assert bench.service.vehicle_session().past.get("r2") is None
    store.close()
    assert texts(kept, "r2") == ["answer"]


def test_while_earlier_turns_cannot_be_read_nothing_is_answered_without_them(
    kept: Retention,
) -> None:
    first = Bench(TurnLog(kept))
    first.drive()
    first.ask("answer", request="q1")
    first.service._memory.close()
    hidden = kept.path.with_suffix(".hidden")
    kept.path.rename(hidden)
    kept.path.mkdir()
    said: list[str] = []
    later = Bench(TurnLog(kept, said.append))
    later.drive()
    for request in ("q1", "q2"):  # one that comes again, and another
        [refused] = later.send("answer", request=request)
        assert isinstance(refused, Refused)
        failure = unpack(refused.payload, Failure)
        assert failure.reason == "busy"
        assert "cannot be read" in failure.detail
    assert sum("questions are refused" in one for one in said) == 1
    kept.path.rmdir()
    hidden.rename(kept.path)
    assert later.ask("answer", request="q1").text
    assert texts(kept) == ["answer"]
    later.ask("answer", request="q2")
    assert texts(kept) == ["answer"] * 2
    assert len(later.service.vehicle_session().past["ada"]) == 2


def test_a_question_that_comes_again_after_its_conversation_was_erased_begins_no_other(
    kept: Retention,
) -> None:
    bench = Bench(TurnLog(kept))
    bench.drive()
    bench.ask("answer", request="q1")
    bench.passenger.request(
        KEYS.of("@rpc/forget"),
        pack(ForgetRequest(request="f", session="ada")),
        1.0,
        lambda _: None,
    )
    bench.service.work()
    [refused] = bench.send("answer", request="q1")
    assert isinstance(refused, Refused)
    assert unpack(refused.payload, Failure).reason == "busy"
    assert texts(kept) == []
    assert bench.ask("answer", request="q2").kind == "answer"
    assert "ada" not in str(bench.service.handler.erased._gone)


def test_questions_of_erased_sessions_are_known_for_a_while_only() -> None:
    questions = ErasedQuestions()
    assert not questions.came("ada", "q1", "why?", 0.0)
    questions.erase("ada", 1.0)
    assert questions.came("ada", "q1", "why?", 2.0)
    assert not questions.came("ada", "q1", "how?", 2.0)
    assert not questions.came("ada", "q2", "why?", 2.0)
    assert not questions.came("bea", "q1", "why?", 2.0)
    assert not questions.came("ada", "q1", "why?", 1.0 + REMEMBERED)
    for number in range(2 * MAX_NAMES):
        questions.came("ada", str(number), "why?", 40.0)
    questions.erase("ada", 41.0)
    assert len(questions._came) + len(questions._gone) <= MAX_NAMES + 1


def test_a_session_is_resumed_with_what_waits_for_the_disk(kept: Retention) -> None:
    memory = TurnLog(kept)
    bench = Bench(memory)
    bench.drive()
    bench.ask("answer", request="q1")
    assert memory._store is not None
    memory._store.cap(0)
    for number in range(2, 40):
        bench.ask("answer", request=f"q{number}")
    assert memory._missed
    assert len(memory.recall("ada")) == 39


@pytest.fixture
def kept(tmp_path: Path) -> Retention:
    return Retention(tmp_path / "dialogue.sqlite3", 30)


def texts(keeping: Retention, session: str = "ada") -> list[str]:
    with Store(keeping.path) as store:
        return [turn.text for turn in store.turns(session, 200)]


def test_a_turn_is_on_disk_before_its_reply_is_sent(kept: Retention) -> None:
    bench = Bench(TurnLog(kept))
    bench.drive()
    seen: list[list[str]] = []
    asked = AskRequest(request="q1", session="ada", text="answer")
    bench.passenger.request(ASK, pack(asked), 1.0, lambda _: seen.append(texts(kept)))
    bench.service.work()
    assert seen == [["answer"]]


def test_nobody_waits_for_the_disk_itself(kept: Retention, monkeypatch: pytest.MonkeyPatch) -> None:
    done: list[str] = []
    monkeypatch.setattr(Store, "sync", lambda _: done.append("on the disk"))
    monkeypatch.setattr("xavi_dialogue.storage.turn_log.FLUSHED_EVERY", 0.0)
    bench = Bench(TurnLog(kept))
    bench.drive()
    done.clear()
    asked = AskRequest(request="q1", session="ada", text="answer")
    bench.passenger.request(ASK, pack(asked), 1.0, lambda _: done.append("answered"))
    for _ in range(3):
        bench.service.work()
    assert done == ["answered", "on the disk"]


def test_what_is_said_is_on_the_disk_in_time_even_if_somebody_always_waits(
    kept: Retention, monkeypatch: pytest.MonkeyPatch
) -> None:
    done: list[str] = []
    monkeypatch.setattr(Store, "sync", lambda _: done.append("on the disk"))
    bench = Bench(TurnLog(kept))
    bench.drive()
    for _ in range(3):
        bench.service.work()
    bench.send("answer", request="early", session="eve", at=60.0)  # waits for that time
    done.clear()
    bench.ask("answer", request="q1")
    assert done == []
    monkeypatch.setattr(memory, "OVERDUE", 0.0)
    for _ in range(3):
        bench.service.work()
    assert done == ["on the disk"]
    bench.ask("answer", request="q2")
    assert done == ["on the disk"] * 2


def test_a_file_is_tried_again_in_time_whatever_took_long(
    kept: Retention, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The whole process may have been stopped in the middle of an attempt."""
    bench = Bench(TurnLog(kept))
    bench.drive()
    monkeypatch.setattr(memory, "REST", 1e6)
    monkeypatch.setattr(memory, "LONGEST", 0.0)
    other = sqlite3.connect(kept.path, isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    bench.ask("answer", request="q1")
    other.execute("ROLLBACK")
    other.close()
    bench.ask("refuse", request="q2")
    assert texts(kept) == ["answer", "refuse"]


def test_a_conversation_is_resumed_by_another_service(kept: Retention) -> None:
    first = Bench(TurnLog(kept))
    first.drive()
    first.ask("answer")
    later = Bench(TurnLog(kept))
    assert later.history() == ["answer"]  # before any car is heard of
    later.drive()
    later.ask("refuse")
    turns = later.service.vehicle_session().dialogue.sessions["ada"].turns
    assert [turn.text for turn in turns] == ["answer", "refuse"]
    assert texts(kept) == ["answer", "refuse"]


def test_a_conversation_goes_on_when_another_ride_begins() -> None:
    bench = Bench()
    bench.drive()
    bench.ask("answer")
    bench.drive(until=3.0, appear=False)
    bench.ask("refuse", request="q2")
    turns = bench.service.vehicle_session().dialogue.sessions["ada"].turns
    assert [turn.text for turn in turns] == ["answer", "refuse"]


def test_no_more_is_resumed_than_can_be_used(kept: Retention) -> None:
    reply = Reply(text="So.", kind="answer", sim_time=0.0)
    with Store(kept.path) as store:
        new = [Turn(text=str(k), reply=reply) for k in range(MAX_PAST + 5)]
        store.keep(NewTurn("ada", None, time.time(), turn) for turn in new)
    bench = Bench(TurnLog(kept))
    bench.drive()
    bench.ask("answer")
    turns = bench.service.vehicle_session().dialogue.sessions["ada"].turns
    assert [turn.text for turn in turns] == [*map(str, range(5, MAX_PAST + 5)), "answer"]


def test_what_happens_is_kept_once_with_how_to_drive_it_again(kept: Retention) -> None:
    bench = Bench(TurnLog(kept))
    bench.drive()
    bench.ask("answer")
    with Store(kept.path) as store:
        [listed] = store.sessions()
        lines = [json.loads(line) for line in store.export()]
    assert (listed.scenario, listed.seed, listed.sim_time) == ("s1", 4, 7.0)
    happened = [line["event"]["sim_time"] for line in lines if "event" in line]
    assert happened == [event.sim_time for event in bench.service.vehicle_session().dialogue.events]
    assert happened


def test_a_conversation_is_forgotten_on_request(kept: Retention) -> None:
    bench = Bench(TurnLog(kept))
    bench.drive()
    bench.ask("answer")
    bench.ask("answer", request="q2", session="bob")
    assert bench.forget("ada") == ForgetReply(request="f1", session="ada", turns=1, forgotten=True)
    assert (texts(kept), texts(kept, "bob")) == ([], ["answer"])
    assert bench.history() == []
    bench.ask("refuse", request="q3")
    assert [
        turn.text for turn in bench.service.vehicle_session().dialogue.sessions["ada"].turns
    ] == ["refuse"]
    assert bench.forget("eve").turns == 0


def test_forgetting_without_a_file_counts_what_was_said() -> None:
    bench = Bench()
    bench.drive()
    bench.ask("answer")
    told = bench.forget("ada")
    assert (told.turns, told.forgotten) == (1, True)
    assert bench.history() == []


def test_who_is_forgotten_gets_no_answer_any_more(bench: Bench) -> None:
    bench.drive()
    held: list[Call] = []
    bench.car.serve(KEYS.of("@rpc/whatif"), held.append)
    came = bench.send("lack")
    bench.forget("ada")
    assert [type(one).__mro__[1] for one in came] == [NoAnswer]
    planned(bench, held[0])
    bench.service.work()  # too late, and no harm done
    assert bench.history() == []
    assert bench.ask("answer").kind == "answer"


def test_where_nothing_can_be_written_the_answer_comes_all_the_same(kept: Retention) -> None:
    warnings: list[str] = []
    bench = Bench(TurnLog(kept, warnings.append))
    bench.drive()
    bench.ask("answer")
    hog = sqlite3.connect(kept.path, isolation_level=None)
    hog.execute("BEGIN IMMEDIATE")
    assert bench.ask("refuse", request="q2").kind == "refusal"
    assert bench.ask("huh", request="q3").kind == "refusal"
    [warning] = warnings
    assert "locked" in warning
    assert not bench.forget("eve").forgotten
    hog.execute("ROLLBACK")
    hog.close()
    bench.ask("answer", request="q4")
    assert "again" in warnings[1]
    assert texts(kept) == ["answer", "refuse", "huh", "answer"]


def test_what_was_to_be_forgotten_is_erased_as_soon_as_it_can_be(kept: Retention) -> None:
    bench = Bench(TurnLog(kept))
    bench.drive()
    bench.ask("answer")
    hog = sqlite3.connect(kept.path, isolation_level=None)
    hog.execute("BEGIN IMMEDIATE")
    assert bench.forget("ada").turns == 1
    assert bench.history() == []
    hog.execute("ROLLBACK")
    hog.close()
    assert texts(kept) == ["answer"]
    bench.ask("refuse", request="q2")
    assert texts(kept) == ["refuse"]


def test_a_file_that_cannot_be_used_is_told_once_and_answers_come(kept: Retention) -> None:
    kept.path.write_bytes(b"no database at all" * 100)
    warnings: list[str] = []
    bench = Bench(TurnLog(kept, warnings.append))
    bench.drive()
    assert bench.ask("answer").kind == "answer"
    assert bench.ask("answer", request="q2").kind == "answer"
    [warning] = warnings
    assert str(kept.path) in warning


def test_what_is_too_old_goes_when_the_service_starts(kept: Retention) -> None:
    reply = Reply(text="So.", kind="answer", sim_time=0.0)
    old = Turn(text="old", reply=reply)
    with Store(kept.path) as store:
        store.keep([NewTurn("ada", None, time.time() - 31 * DAY, old)])
    Bench(TurnLog(kept)).service.work()
    assert texts(kept) == []


def test_a_damaged_turn_is_told_and_others_are_spoken_with_as_ever(kept: Retention) -> None:
    first = Bench(TurnLog(kept))
    first.drive()
    first.ask("answer")
    first.ask("answer", request="q2", session="bob")
    with sqlite3.connect(kept.path) as other:
        other.execute("UPDATE turns SET turn = x'ff' WHERE session = 'ada'")
    other.close()
    warnings: list[str] = []
    bench = Bench(TurnLog(kept, warnings.append))
    bench.drive()
    assert bench.ask("answer").kind == "answer"
    [warning] = warnings
    assert "xavi forget ada" in warning
    bench.ask("refuse", request="q2", session="bob")
    assert texts(kept, "bob") == ["answer", "refuse"]
    assert bench.forget("ada").forgotten
    assert texts(kept) == []
    bench.ask("answer", request="q3")
    assert (texts(kept), len(warnings)) == (["answer"], 1)


def test_what_no_file_can_hold_costs_no_other_turn(kept: Retention) -> None:
    warnings: list[str] = []
    memory = TurnLog(kept, warnings.append)
    memory.hear(RideName("r1"), 2**63, 100.0, Event("arrived", 3.0))
    reply = Reply(text="So.", kind="answer", sim_time=0.0)
    memory.keep("ada", RideName("r1"), 100.0, Turn(text="Why?", reply=reply))
    [warning] = warnings
    assert "cannot be kept" in warning
    assert texts(kept) == ["Why?"]
    memory.close()


def test_what_is_erased_is_forgotten_once_nobody_reads_it_any_more(kept: Retention) -> None:
    bench = Bench(TurnLog(kept))
    bench.drive()
    bench.ask("answer")
    reader = sqlite3.connect(kept.path, isolation_level=None)
    reader.execute("BEGIN")
    reader.execute("SELECT * FROM turns").fetchall()
    assert not bench.forget("ada").forgotten
    assert not bench.forget("ada").forgotten
    bench.ask("refuse", request="q2")  # which is kept all the same
    assert texts(kept) == ["refuse"]
    reader.close()
    assert bench.forget("ada").forgotten


def test_what_was_erased_is_purged_by_and_by(
    kept: Retention, monkeypatch: pytest.MonkeyPatch
) -> None:
    passed = 1000.0
    monkeypatch.setattr(system, "monotonic", lambda: passed)
    memory = TurnLog(kept)
    reply = Reply(text="xyzzy", kind="answer", sim_time=0.0)
    memory.keep("ada", None, 100.0, Turn(text="Why?", reply=reply))
    reader = sqlite3.connect(kept.path, isolation_level=None)
    reader.execute("BEGIN")
    reader.execute("SELECT * FROM turns").fetchall()
    assert memory.forget("ada") is None
    memory.tidy(1e6, idle=True)
    reader.close()
    passed += 1.0
    memory.tidy(1e6 + 1.0, idle=True)
    assert b"xyzzy" in words(kept)
    passed += PURGED_EVERY
    memory.tidy(1e6 - 86400.0, idle=True)  # somebody set the clock back meanwhile
    assert b"xyzzy" not in words(kept)
    memory.close()


def words(keeping: Retention) -> bytes:
    files = keeping.path.parent.glob(f"{keeping.path.name}*")
    return b"".join(file.read_bytes() for file in files)
