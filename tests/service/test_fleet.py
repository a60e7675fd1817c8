"""One service, many cars and passengers: turns, bounds, owners, gaps, shared turns and plans."""

import itertools
import json
import time
from collections.abc import Callable
from dataclasses import replace
from typing import NoReturn

import msgspec
import pytest

from planner.record import trace as plan_trace
from tests.dialogue.scripted import activity, scripted_pipeline
from tests.fakes import again, s1_moments
from tests.service.test_service import Bench
from xavi_dialogue.bus.interface import (
    Bus,
    Call,
    Keys,
    Refused,
    call,
    matches,
    vehicle_in,
)
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import (
    AliveReport,
    AskReply,
    AskRequest,
    CancelRequest,
    CarState,
    EventReport,
    Failure,
    ForgetRequest,
    HistoryReply,
    HistoryRequest,
    SceneReport,
    TraceReport,
    TurnReport,
    WhatIfRequest,
    pack,
    unpack,
)
from xavi_dialogue.dialogue.manager import advance, fold
from xavi_dialogue.dialogue.recollection import Result
from xavi_dialogue.dialogue.state.events import RecordMissing, TraceRecorded
from xavi_dialogue.dialogue.state.state import Dialogue
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Ask, Why
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.service import request_handler, server, vehicle_session
from xavi_dialogue.service.fair_queue import FairQueue
from xavi_dialogue.service.reorder_buffer import PATIENCE, ReorderBuffer, RideReports
from xavi_dialogue.storage.conversations import Store
from xavi_dialogue.storage.turn_log import Retention, TurnLog
from xavi_dialogue.vehicle.telemetry import Reporter

ANN, BOB = "a" * 43, "b" * 43  # tokens
_NAMES = itertools.count()


def ask(bench: Bench, text: str, vehicle: str = "car", **more: object) -> list[object]:
    """Lay a question on the desk; the list gets what comes back."""
    came: list[object] = []
    fields = {"request": f"r{next(_NAMES)}", "session": "ann", "text": text, **more}
    key = Keys(vehicle).of("@rpc/ask")
    asked = AskRequest(**fields)  # type: ignore[arg-type]
    bench.passenger.request(key, pack(asked), 1.0, came.append)
    return came


def drive(bench: Bench, vehicle: str, until: float) -> Bus:
    """Have a car report its ride up to a moment."""
    car, keys = bench.hub.connect(), Keys(vehicle)
    car.appear(keys.of("alive/car"))
    reporter = Reporter(car, keys, "s1", 4)
    for moment in s1_moments():
        reporter.record(moment)
        reporter.show(moment, "driving", 1.0)
        if moment.scene.time >= until:
            break
    bench.service.work()
    return car


def replied(came: list[object]) -> AskReply:
    [payload] = came
    assert isinstance(payload, bytes)
    return unpack(payload, AskReply)


def refused(came: list[object]) -> Failure:
    [refusal] = came
    assert isinstance(refusal, Refused)
    return unpack(refusal.payload, Failure)


def plans(bench: Bench, car: Bus, vehicle: str = "car") -> tuple[list[Call], Callable[[], None]]:
    """What the car is asked to plan; and how it answers all of it."""
    held: list[Call] = []
    car.serve(Keys(vehicle).of("@rpc/whatif"), held.append)

    def answer() -> None:
        for one in tuple(held):
            held.remove(one)
            wanted = unpack(one.payload, WhatIfRequest)
            traces = bench.service.vehicle_session(vehicle).dialogue.traces
            [trace] = [trace for trace in traces if trace.trace_id == wanted.trace_id]
            one.reply(plan_trace.encode(again(trace, wanted)))
        bench.service.work()

    return held, answer


@pytest.fixture
def bench() -> Bench:
    return Bench()


def test_one_of_each_in_turn() -> None:
    queue: FairQueue[int] = FairQueue()
    for item, who in enumerate("aaabbc"):
        queue.put(who, item)
    assert [queue.pop() for _ in range(len(queue))] == [0, 3, 5, 1, 4, 2]
    with pytest.raises(LookupError):
        queue.pop()


@pytest.mark.parametrize(
    ("key", "vehicle"),
    [
        ("xavi/v1/car/@rpc/ask", "car"),
        ("xavi/v1/bus-7/scene", "bus-7"),
        ("xavi/v1/*/scene", None),
        ("xavi/v1/a b/scene", None),
        ("xavi/v1//scene", None),
        ("xavi/v2/car/scene", None),
        ("xavi/v1/car", None),
        (f"xavi/v1/{'x' * 65}/scene", None),
    ],
)
def test_a_key_names_one_car_or_none(key: str, vehicle: str | None) -> None:
    assert vehicle_in(key) == vehicle


def test_a_star_stands_for_one_part_of_a_key() -> None:
    assert matches("xavi/v1/*/scene", "xavi/v1/car/scene")
    assert not matches("xavi/v1/*/scene", "xavi/v1/car/trace")
    assert not matches("xavi/v1/*/scene", "xavi/v1/a/b/scene")
    assert not matches("xavi/v1/*", "xavi/v1/@adv")


def test_each_car_is_spoken_of_by_its_own_record(bench: Bench) -> None:
    drive(bench, "one", 3.0)
    drive(bench, "two", 6.0)
    came = {name: ask(bench, "answer", name) for name in ("one", "two", "three")}
    bench.service.work()
    assert [replied(came[name]).sim_time for name in ("one", "two")] == [3.0, 6.0]
    assert replied(came["three"]).reason == "planner-unavailable"
    assert {*bench.service.handler.vehicles} == {"one", "two"}  # nobody can make up cars


def test_what_one_car_suffers_leaves_the_other_alone(bench: Bench) -> None:
    one, _ = drive(bench, "one", 3.0), drive(bench, "two", 6.0)
    one.close()
    lost, kept = ask(bench, "answer", "one", at=6.0), ask(bench, "answer", "two", at=6.0)
    bench.service.work()
    assert replied(lost).reason == "planner-unavailable"
    assert replied(kept).kind == "answer"


def test_a_service_shows_itself_at_every_car(bench: Bench) -> None:
    seen: list[str] = []
    bench.passenger.watch("xavi/v1/*/alive/service", lambda key, alive: seen.append(key))
    assert seen == ["xavi/v1/car/alive/service"]
    drive(bench, "two", 1.0)
    assert seen[1:] == ["xavi/v1/two/alive/service"]


def test_of_cars_that_are_gone_the_latest_are_remembered(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(request_handler, "KEPT_GONE", 2)
    bench.service.handler._room = 2
    for name in ("one", "two", "three", "four"):
        drive(bench, name, 1.0).close()
        bench.service.work()
    drive(bench, "five", 1.0)
    assert {*bench.service.handler.vehicles} == {"three", "four", "five"}


def test_cars_that_are_there_are_all_kept(bench: Bench) -> None:
    cars = [f"car-{k}" for k in range(request_handler.KEPT_GONE + 10)]
    for name in cars:
        bench.hub.connect().appear(Keys(name).of("alive/car"))
    bench.service.work()
    assert {*bench.service.handler.vehicles} == {*cars}


def test_no_more_cars_than_there_is_room_for(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(request_handler, "MAX_CARS", 2)
    bench.service.handler._room = 2
    for name in ("one", "two", "three"):
        drive(bench, name, 1.0)
    assert {*bench.service.handler.vehicles} == {"one", "two"}
    came = ask(bench, "answer", "three")
    bench.service.work()
    assert replied(came).reason == "planner-unavailable"


def test_who_asks_most_waits_longest(bench: Bench) -> None:
    drive(bench, "car", 3.0)
    order: list[str] = []
    for who in ("ann", "ann", "ann", "bob", "cat"):
        came = AskRequest(request=f"f{next(_NAMES)}", session=who, text="answer")
        key = Keys().of("@rpc/ask")
        bench.passenger.request(key, pack(came), 1.0, lambda _, who=who: order.append(who))  # type: ignore[misc]
    bench.service.work()
    assert order == ["ann", "bob", "cat", "ann", "ann"]


def test_beyond_a_few_open_questions_a_session_is_told_to_wait(bench: Bench) -> None:
    held, answer = plans(bench, drive(bench, "car", 3.0))
    first = [ask(bench, "lack") for _ in range(request_handler.MAX_OPEN)]
    bench.service.work()
    beyond, other = ask(bench, "answer"), ask(bench, "answer", session="bob")
    bench.service.work()
    assert refused(beyond).reason == "busy"
    assert replied(other).kind == "answer"
    assert [len(came) for came in first] == [0] * request_handler.MAX_OPEN
    answer()
    assert held == []
    assert [replied(came).kind for came in first] == ["answer"] * request_handler.MAX_OPEN
    told = bench.service.alive.report().counters
    assert (told["busy"], told["questions"]) == (1.0, 1.0 + request_handler.MAX_OPEN)


def test_questions_of_a_session_are_answered_in_their_order(bench: Bench) -> None:
    _, answer = plans(bench, drive(bench, "car", 3.0))
    slow, quick = ask(bench, "lack"), ask(bench, "answer")
    bench.service.work()
    assert (slow, quick) == ([], [])
    answer()
    assert [replied(slow).kind, replied(quick).kind] == ["answer", "answer"]
    turns = bench.service.vehicle_session().dialogue.sessions["ann"].turns
    assert [turn.text for turn in turns] == ["lack", "answer"]


def test_when_one_is_taken_back_the_next_has_its_turn(bench: Bench) -> None:
    plans(bench, drive(bench, "car", 3.0))
    ask(bench, "lack", request="slow")
    quick = ask(bench, "answer")
    bench.service.work()
    wanted = pack(CancelRequest(request="slow", session="ann"))
    bench.passenger.request(Keys().of("@rpc/cancel"), wanted, 1.0, lambda _: None)
    bench.service.work()
    assert replied(quick).kind == "answer"


def test_what_many_need_is_planned_once(bench: Bench) -> None:
    held, answer = plans(bench, drive(bench, "car", 3.0))
    came = [ask(bench, "lack", session=f"s{k}") for k in range(20)]
    bench.service.work()
    assert len(held) == 1
    answer()
    assert [replied(one).kind for one in came] == ["answer"] * 20
    assert bench.service.alive.counted("what_ifs") == 1


def test_who_came_later_has_time_left(bench: Bench) -> None:
    held, answer = plans(bench, drive(bench, "car", 3.0))
    ask(bench, "lack", session="hasty", deadline_ms=1000.0)
    patient = ask(bench, "lack", session="patient", deadline_ms=60_000.0)
    bench.service.work()
    held.pop().refuse(pack(Failure(reason="timed-out")))
    bench.service.work()
    assert len(held) == 1  # asked for anew, on behalf of the patient
    answer()
    assert replied(patient).kind == "answer"


def test_a_question_whose_turn_does_not_come_in_time_fell_to_a_busy_service(bench: Bench) -> None:
    drive(bench, "car", 3.0)
    came = ask(bench, "answer", deadline_ms=1000.0)
    bench.service._empty_inbox()
    vehicle_session = bench.service.vehicle_session()
    [question] = vehicle_session.scheduler.open.values()
    [given_up, *_] = vehicle_session.settle(question.came + 1.0)
    assert given_up.reply.reason == "busy"  # type: ignore[union-attr]
    assert (came, vehicle_session.scheduler.open) == ([], {})


def test_who_could_not_be_answered_in_time_is_told_at_once(bench: Bench) -> None:
    plans(bench, drive(bench, "car", 3.0))
    bench.service.handler.pace = 1.0  # [s] that a question takes
    came = [ask(bench, "answer", session=f"s{k}", deadline_ms=5000.0) for k in range(10)]
    patient = ask(bench, "answer", session="patient", deadline_ms=60_000.0)
    bench.service._empty_inbox()
    assert [len(one) for one in came] == [0] * 4 + [1] * 6  # more than 3.5 s would be too long
    assert {refused(one).reason for one in came[4:]} == {"busy"}
    bench.service.work()
    assert [replied(one).kind for one in (*came[:4], patient)] == ["answer"] * 5
    assert bench.service.handler.pace < 1.0  # it takes less


def history(bench: Bench, session: str, token: str | None) -> bytes:
    came: list[object] = []
    wanted = pack(HistoryRequest(session=session, token=token))
    bench.passenger.request(Keys().of("@rpc/history"), wanted, 1.0, came.append)
    bench.service.work()
    [payload] = came
    if isinstance(payload, Refused):
        raise payload
    assert isinstance(payload, bytes)
    return payload


def test_a_session_belongs_to_whoever_begins_it(bench: Bench) -> None:
    drive(bench, "car", 3.0)
    ask(bench, "answer", token=ANN)
    bench.service.work()
    assert len(unpack(history(bench, "ann", ANN), HistoryReply).turns) == 1
    for token in (BOB, None):
        with pytest.raises(Refused) as denied:
            history(bench, "ann", token)
        assert unpack(denied.value.payload, Failure).reason == "out-of-scope"
        came = ask(bench, "answer", token=token)
        bench.service.work()
        assert "somebody else" in refused(came).detail
        gone: list[object] = []
        wanted = pack(ForgetRequest(request="f", session="ann", token=token))
        bench.passenger.request(Keys().of("@rpc/forget"), wanted, 1.0, gone.append)
        bench.service.work()
        assert "somebody else" in refused(gone).detail
    assert len(unpack(history(bench, "ann", ANN), HistoryReply).turns) == 1
    assert bench.service.alive.counted("foreign") == 6


def test_a_session_that_was_begun_without_a_token_is_open(bench: Bench) -> None:
    drive(bench, "car", 3.0)
    ask(bench, "answer")
    bench.service.work()
    assert len(unpack(history(bench, "ann", BOB), HistoryReply).turns) == 1
    other = ask(bench, "answer", token=ANN)  # and remains so: nobody can take it
    bench.service.work()
    assert replied(other).kind == "answer"
    assert len(unpack(history(bench, "ann", None), HistoryReply).turns) == 2


def test_the_owner_is_known_to_another_service_and_forgotten_with_the_session(
    keeping: Retention,
) -> None:
    first = Bench(TurnLog(keeping))
    drive(first, "car", 3.0)
    ask(first, "answer", token=ANN)
    first.service.work()
    later = Bench(TurnLog(keeping))
    with pytest.raises(Refused):
        history(later, "ann", BOB)
    assert len(unpack(history(later, "ann", ANN), HistoryReply).turns) == 1
    wanted = pack(ForgetRequest(request="f", session="ann", token=ANN))
    later.passenger.request(Keys().of("@rpc/forget"), wanted, 1.0, lambda _: None)
    later.service.work()
    assert unpack(history(later, "ann", BOB), HistoryReply).turns == ()


@pytest.fixture
def keeping(tmp_path_factory: pytest.TempPathFactory) -> Retention:
    return Retention(tmp_path_factory.mktemp("kept") / "dialogue.sqlite3", 30)


def test_others_read_a_turn_only_where_the_passenger_allows(bench: Bench) -> None:
    drive(bench, "car", 3.0)
    heard: list[tuple[str, bytes]] = []
    key = "xavi/v1/*/dialogue/*/turn"
    bench.passenger.subscribe(key, lambda key, payload: heard.append((key, payload)))
    ask(bench, "answer")
    ask(bench, "refuse", share=True, session="bob")
    bench.service.work()
    [(where, payload)] = heard
    assert where == "xavi/v1/car/dialogue/bob/turn"
    report = unpack(payload, TurnReport)
    assert (report.turn.text, report.seq, report.sim_time) == ("refuse", 0, 3.0)
    assert report.turn.reply.reason == "too-little-evidence"


def test_who_was_silent_for_longest_is_forgotten_first(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(vehicle_session, "MAX_SESSIONS", 2)
    _, answer = plans(bench, drive(bench, "car", 3.0))
    waits = ask(bench, "lack", session="waits")
    for name in ("a", "b", "c", "d"):
        ask(bench, "answer", session=name)
        bench.service.work()
    assert {"waits", "d"} <= {*bench.service.vehicle_session().past}
    assert len(bench.service.vehicle_session().past) == 2
    assert {*bench.service.vehicle_session().dialogue.sessions} == {"waits", "d"}
    answer()
    assert replied(waits).kind == "answer"


def test_how_the_service_fares_can_be_asked(bench: Bench) -> None:
    drive(bench, "car", 3.0)
    bench.car.publisher(Keys().of("trace")).put(b"junk")
    bench.car.publisher("xavi/v1/a b/scene").put(b"junk")
    ask(bench, "answer")
    bench.service.work()
    told = unpack(call(bench.passenger, Keys().of("alive/service"), b"", 1.0), AliveReport)
    assert (told.component, told.sim_time) == ("service", 3.0)
    counters = told.counters
    names = ("questions", "answered", "rejected", "cars", "sessions", "waiting")
    assert [counters[name] for name in names] == [1.0, 1.0, 2.0, 1.0, 1.0, 0.0]


def reports() -> list[SceneReport | TraceReport | EventReport]:
    """A ride as a car reports it."""
    hub, keys = MemoryHub(), Keys()
    heard: list[SceneReport | TraceReport | EventReport] = []
    for name, kind in (("scene", SceneReport), ("trace", TraceReport), ("event", EventReport)):
        hub.connect().subscribe(
            keys.of(name),
            lambda _, payload, kind=kind: heard.append(unpack(payload, kind)),  # type: ignore[misc]
        )
    reporter = Reporter(hub.connect(), keys)
    for moment in s1_moments():
        reporter.record(moment)
        reporter.show(moment, "ended" if moment.ending else "driving", 1.0)
    return heard


def test_what_is_lost_for_good_is_given_up_and_the_record_goes_on() -> None:
    buffer, recorded = RideReports(reports()[0].ride), 0
    lost = [r for r in reports() if isinstance(r, TraceReport)][2]
    for report in reports():
        match report:
            case SceneReport():
                recorded += sum(isinstance(one, TraceRecorded) for one in buffer.see(report))
            case TraceReport() if report.seq != lost.seq:
                recorded += sum(isinstance(one, TraceRecorded) for one in buffer.trace(report))
            case EventReport():
                buffer.event(report)
    traces = sum(isinstance(report, TraceReport) for report in reports())
    assert not buffer.complete(1.0)
    assert recorded == lost.seq
    assert buffer.wait(100.0) == []  # it may still come
    assert buffer.wait(100.0 + 0.5 * PATIENCE) == []
    recorded += sum(isinstance(r, TraceRecorded) for r in buffer.wait(100.0 + PATIENCE))
    assert (recorded, buffer.lost) == (traces - 1, 1)
    assert buffer.complete(1.0)
    assert buffer.over
    assert buffer.trace(lost) == []  # too late, and no harm done


def test_the_last_that_is_lost_is_not_waited_for_without_end() -> None:
    items: ReorderBuffer[str] = ReorderBuffer(9, len)
    items.add(0, "a")
    assert items.give_up(3) == []
    assert (items.next, items.lost) == (3, 2)
    assert items.add(1, "b") == []
    assert items.add(3, "d") == ["d"]


def test_nothing_that_comes_after_the_end_counts(bench: Bench) -> None:
    bench.drive()
    traces = bench.service.vehicle_session().dialogue.traces
    ride = bench.service.vehicle_session().reports.ride  # type: ignore[union-attr]
    more = TraceReport(ride=ride, seq=len(traces), sim_time=99.0, wall_time=0.0, trace=traces[-1])
    bench.car.publisher(Keys().of("trace")).put(pack(more))
    bench.service.work()
    assert bench.ask("answer").kind == "answer"
    assert bench.service.vehicle_session().dialogue.traces == traces


def test_a_scene_may_go_back_in_time_and_be_asked_about(bench: Bench) -> None:
    bench.drive(until=6.0)
    scene = bench.service.vehicle_session().reports.scene  # type: ignore[union-attr]
    assert scene is not None
    fields = {name: getattr(scene, name) for name in scene.__struct_fields__}
    back = SceneReport(**{**fields, "seq": scene.seq + 1, "sim_time": 2.0})
    bench.car.publisher(Keys().of("scene")).put(pack(back))
    bench.service.work()
    assert bench.ask("answer").sim_time == 2.0
    assert bench.ask("answer", request="q2", at=6.0).sim_time == 6.0


def test_a_ride_is_known_by_its_first_decision_however_late_it_is_joined() -> None:
    """What was said about a ride stays true where the service joins it after a while."""
    rides = []
    for late in (False, True):
        buffer, named = RideReports(reports()[0].ride), Dialogue()
        for report in reports():
            if isinstance(report, TraceReport):
                if late and report.seq < 3:
                    buffer.traces.begin(3)
                for one in buffer.trace(report):
                    named, _ = advance(scripted_pipeline(), named, one)
        rides.append((named.ride_id, len(named.traces)))
    assert rides[0][0] == rides[1][0] is not None
    assert rides[0][1] == rides[1][1] + 3


def test_the_time_of_a_question_runs_wherever_it_waits(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    drive(bench, "car", 3.0)
    came = ask(bench, "answer", deadline_ms=1000.0)
    now = time.monotonic()
    monkeypatch.setattr(time, "monotonic", lambda: now + 1.0)
    bench.service.work()
    assert replied(came).reason == "busy"


def test_a_service_that_is_told_to_stop_leaves_the_rest(bench: Bench) -> None:
    drive(bench, "car", 3.0)
    came = [ask(bench, "answer", session=f"s{k}") for k in range(5)]
    told = iter([False, False, True])
    bench.service.work(0.0, lambda: next(told))
    assert [len(one) for one in came] == [1, 1, 0, 0, 0]


def test_a_request_that_comes_twice_is_answered_once(bench: Bench) -> None:
    held, answer = plans(bench, drive(bench, "car", 3.0))
    slow = [ask(bench, "lack", request="slow") for _ in range(2)]
    bench.service.work()
    assert len(held) == 1
    answer()
    assert slow[0] == slow[1]  # both hear the same, and nothing is said twice
    assert replied(slow[0]).kind == "answer"
    turns = bench.service.vehicle_session().dialogue.sessions["ann"].turns
    assert [turn.text for turn in turns] == ["lack"]


def test_who_missed_the_reply_may_ask_again(bench: Bench) -> None:
    drive(bench, "car", 3.0)
    came = [ask(bench, "answer", request="once") for _ in range(2)]
    bench.service.work()
    again, other = ask(bench, "answer", request="once"), ask(bench, "refuse", request="once")
    bench.service.work()
    assert came[0] == again
    assert replied(other).reason == "too-little-evidence"  # another question of the same name
    turns = bench.service.vehicle_session().dialogue.sessions["ann"].turns
    assert [turn.text for turn in turns] == ["answer", "refuse"]


def test_what_could_not_be_answered_may_be_asked_again(bench: Bench) -> None:
    lost = ask(bench, "answer", request="1")
    bench.service.work()
    assert replied(lost).reason == "planner-unavailable"
    drive(bench, "car", 3.0)
    came = ask(bench, "answer", request="1")
    bench.service.work()
    assert replied(came).kind == "answer"


def test_after_a_while_a_name_is_another_request(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    car = drive(bench, "car", 3.0)
    before = ask(bench, "answer", request="1")
    bench.service.work()
    car.close()
    drive(bench, "car", 6.0)
    again = ask(bench, "answer", request="1")
    bench.service.work()
    assert again == before
    now = time.monotonic() + 60.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    later = ask(bench, "answer", request="1")
    bench.service.work()
    assert [replied(one).sim_time for one in (before, later)] == [3.0, 6.0]


def test_a_turn_that_was_kept_before_a_kill_is_not_said_twice(keeping: Retention) -> None:
    first, later = Bench(TurnLog(keeping)), Bench(TurnLog(keeping))
    for bench in (first, later):  # the first is killed before its reply arrives
        drive(bench, "car", 3.0)
        said = ask(bench, "answer", request="once", at=3.0)
        bench.service.work()
        assert replied(said).sim_time == 3.0
    assert len(unpack(history(later, "ann", None), HistoryReply).turns) == 1
    anew = ask(later, "answer", request="once", at=2.0)
    later.service.work()
    assert replied(anew).sim_time == 2.0
    forgotten = pack(ForgetRequest(request="f", session="ann"))
    later.passenger.request(Keys().of("@rpc/forget"), forgotten, 1.0, lambda _: None)
    later.service.work()
    assert later.service._responder.sent == {}


def foreseeing(bench: Bench, calls: list[NeedRollout]) -> None:
    """Have the pipeline need a plan to say why."""

    def explain(act: GroundedAct, record: Record) -> Result:
        need = NeedRollout(trace_id=record.traces[0].trace_id, removed=1)
        if not record.extra and need not in record.refused:
            calls.append(need)
            return need
        return activity(record)

    bench.service.handler.pipeline = replace(scripted_pipeline(), explain=explain)


def test_what_a_passenger_will_ask_for_is_planned_before(bench: Bench) -> None:
    foreseeing(bench, [])
    held, answer = plans(bench, drive(bench, "car", 3.0))
    bench.service.work()
    assert [unpack(one.payload, WhatIfRequest).removed for one in held] == [1]
    answer()
    bench.service.work()
    assert held == []
    came = ask(bench, "why?")
    bench.service.work()
    assert replied(came).kind == "answer"
    assert held == []


def test_who_asks_meanwhile_waits_for_the_same_plan(bench: Bench) -> None:
    foreseeing(bench, [])
    held, answer = plans(bench, drive(bench, "car", 3.0))
    bench.service.work()
    came = ask(bench, "why?")
    bench.service.work()
    assert (len(held), came) == (1, [])
    answer()
    assert replied(came).kind == "answer"


def test_what_is_foreseen_in_vain_is_asked_for_anew(bench: Bench) -> None:
    foreseeing(bench, [])
    held, answer = plans(bench, drive(bench, "car", 3.0))
    bench.service.work()
    came = ask(bench, "why?")
    bench.service.work()
    held.pop().refuse(pack(Failure(reason="timed-out")))
    bench.service.work()
    assert (len(held), came) == (1, [])
    answer()
    assert replied(came).kind == "answer"


@pytest.mark.parametrize(("state", "speed"), [("paused", 1.0), ("driving", 0.0), ("driving", 9.0)])
def test_nothing_is_foreseen_where_the_ride_is_no_ride(
    bench: Bench, state: CarState, speed: float
) -> None:
    calls: list[NeedRollout] = []
    foreseeing(bench, calls)
    reporter = Reporter(bench.car, Keys())
    bench.car.appear(Keys().of("alive/car"))
    for moment in s1_moments():
        reporter.record(moment)
        reporter.show(moment, state, speed)
    bench.service.work()
    bench.service.work()
    assert calls == []


def test_a_fault_in_foreseeing_is_nobody_s_business(
    bench: Bench, caplog: pytest.LogCaptureFixture
) -> None:
    def explain(act: GroundedAct, record: Record) -> Result:
        if isinstance(act.act, Ask) and isinstance(act.act.question, Why):
            raise ZeroDivisionError
        return activity(record)

    bench.service.handler.pipeline = replace(scripted_pipeline(), explain=explain)
    drive(bench, "car", 3.0)
    bench.service.work()
    assert "ZeroDivisionError" in caplog.text
    came = ask(bench, "what are you doing?")
    bench.service.work()
    assert replied(came).kind == "answer"


def test_names_of_requests_are_the_passengers_own(bench: Bench) -> None:
    held, answer = plans(bench, drive(bench, "car", 3.0))
    slow = ask(bench, "lack", request="1", session="ann")
    bench.service.work()
    quick = ask(bench, "answer", request="1", session="bob")
    bench.service.work()
    assert (len(held), slow, replied(quick).kind) == (1, [], "answer")
    wanted = pack(CancelRequest(request="1", session="bob"))
    bench.passenger.request(Keys().of("@rpc/cancel"), wanted, 1.0, lambda _: None)
    answer()
    assert replied(slow).kind == "answer"


def test_a_fault_of_ours_costs_one_request_and_no_more(
    bench: Bench, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    drive(bench, "car", 3.0)
    monkeypatch.setattr(bench.service.vehicle_session(), "take", lambda _: 1 // 0)
    lost = ask(bench, "answer")
    bench.service.work()
    assert refused(lost).reason == "planner-failed"
    monkeypatch.undo()
    came = ask(bench, "answer")
    bench.service.work()
    assert replied(came).kind == "answer"
    assert bench.service.alive.counted("faults") == 1
    assert "ZeroDivisionError" in caplog.text


def test_what_comes_in_faster_than_it_is_read_is_bounded(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(server, "MAX_BYTES", 1000)
    publisher = bench.car.publisher(Keys().of("trace"))
    for _ in range(50):
        publisher.put(b"x" * 100)
    assert bench.service._inbox.qsize() <= 11
    assert bench.service.alive.counted("rejected") == 40
    bench.service.work()
    monkeypatch.undo()
    drive(bench, "car", 3.0)
    came = ask(bench, "answer")
    bench.service.work()
    assert replied(came).kind == "answer"


def test_what_waits_for_an_earlier_one_is_bounded() -> None:
    items: ReorderBuffer[str] = ReorderBuffer(2, len)
    for number in range(1, 9):
        assert items.add(number, "x") == []
    assert len(items.held) == 2


def test_questions_about_what_is_to_come_are_bounded_and_hold_up_nobody(
    bench: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(request_handler, "MAX_EARLY", 3)
    drive(bench, "car", 3.0)
    early = [ask(bench, "answer", session=f"s{k}", at=1e6) for k in range(5)]
    now = ask(bench, "answer", session="now")
    bench.service.work()
    assert [len(came) for came in early] == [0, 0, 0, 1, 1]
    assert refused(early[-1]).reason == "busy"
    assert replied(now).kind == "answer"


def test_reading_makes_nothing_that_could_push_others_out(bench: Bench) -> None:
    drive(bench, "car", 3.0)
    ask(bench, "answer")
    bench.service.work()
    for k in range(5):
        history(bench, f"made-up-{k}", None)
        ask(bench, "answer", f"made-up-{k}", session="bob")
    bench.service.work()
    assert {*bench.service.vehicle_session().past} == {"ann"}
    assert {*bench.service.handler.vehicles} == {"car"}


def test_a_record_at_fault_gets_a_bare_refusal_and_the_service_goes_on(
    bench: Bench, caplog: pytest.LogCaptureFixture
) -> None:
    def fail(*_: object) -> NoReturn:
        raise OverflowError  # whatever is asked, and whatever is to be said instead

    sound = bench.service.handler.pipeline
    bench.service.handler.pipeline = replace(scripted_pipeline(), explain=fail, say=fail)
    drive(bench, "bad", 3.0)
    bench.service.handler.pipeline = sound
    drive(bench, "car", 3.0)
    lost = [ask(bench, "answer", "bad"), ask(bench, "answer", "bad", session="bob", at=9.0)]
    came = ask(bench, "answer")
    bench.service.work()
    assert (replied(lost[0]).reason, replied(lost[0]).kind) == ("planner-failed", "refusal")
    assert replied(came).kind == "answer"
    vehicle_session = bench.service.vehicle_session("bad")
    [late] = vehicle_session.settle(time.monotonic() + 60.0)
    assert late.reply.reason == "planner-failed"  # type: ignore[union-attr]
    assert vehicle_session.scheduler.open == {}


@pytest.mark.parametrize("change", ["no ego", "huge"])
def test_a_trace_that_does_not_fit_together_is_rejected(bench: Bench, change: str) -> None:
    [first, *_] = [r for r in reports() if isinstance(r, TraceReport)]
    wrong = json.loads(pack(first))
    if change == "no ego":
        del wrong["trace"]["scene"]["0"]
    else:
        wrong["trace"]["rollouts"][0]["components"]["time"] = 1e300
    bench.car.publisher(Keys().of("trace")).put(json.dumps(wrong).encode())
    bench.service.work()
    assert bench.service.alive.counted("rejected") == 1


@pytest.mark.parametrize("name", ["ada\n", "", "a/b", "a*", "a b", "@a", "x" * 65, "ä"])
def test_a_name_is_a_plain_word(bench: Bench, name: str) -> None:
    came = ask(bench, "answer", session=name)
    bench.service.work()
    assert refused(came).reason == "not-understood"


def test_what_is_missing_of_the_record_is_known_to_be() -> None:
    """A denial needs the whole record: what is not in it may have been lost."""
    buffer, told = RideReports(reports()[0].ride), []
    for report in reports():
        match report:
            case SceneReport():
                told += buffer.see(report)
            case TraceReport():
                told += buffer.trace(report)
            case EventReport() if report.seq not in (1, 2):
                told += buffer.event(report)
    buffer.wait(100.0)
    told += buffer.wait(100.0 + PATIENCE)
    events = [r for r in reports() if isinstance(r, EventReport)]
    [gap] = [one for one in told if isinstance(one, RecordMissing)]
    assert gap.until == events[3].sim_time
    assert gap.since <= gap.until
    dialogue = fold(scripted_pipeline(), told)
    assert dialogue.record(99.0).gaps == ((gap.since, gap.until),)
    assert dialogue.record(gap.since - 0.1).gaps == ()


def test_a_record_that_begins_late_knows_nothing_of_before() -> None:
    buffer, told = RideReports(reports()[0].ride), []
    for report in reports():
        if isinstance(report, SceneReport):
            told += buffer.see(report)
        elif isinstance(report, TraceReport) and report.seq >= 3:
            told += buffer.trace(report)
    buffer.wait(100.0)
    told += buffer.wait(100.0 + PATIENCE)
    traces = [report for report in reports() if isinstance(report, TraceReport)]
    gaps = [one for one in told if isinstance(one, RecordMissing)]
    assert (gaps[0].since, gaps[0].until) == (0.0, traces[3].sim_time)


def test_a_name_of_a_request_is_another_one_at_another_car(bench: Bench) -> None:
    drive(bench, "a", 3.0)
    drive(bench, "b", 6.0)
    came = []
    for name in ("a", "b", "a"):
        came.append(ask(bench, "answer", name, request="1"))
        bench.service.work()
    assert [replied(one).sim_time for one in came] == [3.0, 6.0, 3.0]
    assert came[0] == came[2]


def test_only_a_ride_that_is_seen_begins_another_record(bench: Bench) -> None:
    drive(bench, "car", 6.0)
    vehicle_session = bench.service.vehicle_session()
    before = vehicle_session.dialogue.traces
    for kind, name in ((TraceReport, "trace"), (EventReport, "event")):
        [forged, *_] = [r for r in reports() if isinstance(r, kind)]
        bench.car.publisher(Keys().of(name)).put(pack(forged))
    bench.service.work()
    assert vehicle_session.dialogue.traces is before
    car = drive(bench, "car", 3.0)  # decisions are heard of before the first scene is
    assert len(vehicle_session.dialogue.traces) < len(before)
    assert vehicle_session.dialogue.ride_id == before[0].trace_id
    late = msgspec.structs.replace(
        next(r for r in reports() if isinstance(r, SceneReport)), ride="seen-before"
    )
    scene = car.publisher(Keys().of("scene"))
    scene.put(pack(late))
    bench.service.work()
    scene.put(pack(msgspec.structs.replace(late, ride="newest")))
    scene.put(pack(msgspec.structs.replace(late, seq=99)))  # of a ride that is past
    bench.service.work()
    assert vehicle_session.reports is not None
    assert vehicle_session.reports.ride == "newest"


def test_who_asked_twice_and_takes_it_back_is_left_waiting_nowhere(bench: Bench) -> None:
    plans(bench, drive(bench, "car", 3.0))
    came = [ask(bench, "lack", request="slow") for _ in range(2)]
    bench.service.work()
    wanted = pack(CancelRequest(request="slow", session="ann"))
    bench.passenger.request(Keys().of("@rpc/cancel"), wanted, 1.0, lambda _: None)
    bench.service.work()
    assert [len(one) for one in came] == [1, 1]


def test_an_event_is_kept_with_its_own_ride(keeping: Retention) -> None:
    bench = Bench(TurnLog(keeping))
    drive(bench, "car", 3.0)
    [stray, *_] = [report for report in reports() if isinstance(report, EventReport)]
    bench.car.publisher(Keys().of("event")).put(pack(stray))
    bench.service.work()
    with Store(keeping.path) as store:
        rides = {row[0] for row in store._file.rows("SELECT DISTINCT ride FROM events")}
    assert stray.ride in rides
    assert len(rides) == 2
