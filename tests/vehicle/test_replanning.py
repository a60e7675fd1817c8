"""Planning again beside the driving: what is asked of the car, and what its workers do."""

import os
import queue
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field

import msgspec
import pytest

from planner.counterfactuals.whatif import replan
from planner.driving.driver import Driver, DriveStep
from planner.record.trace import PlanTrace, WhatIf, encode
from planner.record.trace_reading import decode
from planner.search.decide import decide
from sim.scene import Scene
from sim.setup.scenario import load
from tests.fakes import s1_moments
from tests.planner.worlds import QUICK, before_end, changing, driven, frame, moment, roads, still
from tests.vehicle.pool_jobs import PATIENCE, PoolClient, children, command, remains, there, until
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Keys, Outcome, Refused, call
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import (
    Failure,
    TraceReport,
    WhatIfRequest,
    pack,
    unpack,
)
from xavi_dialogue.chat.client import Client
from xavi_dialogue.chat.local_backend import first_scene, start_local
from xavi_dialogue.process.child_commands import Orders, Until
from xavi_dialogue.vehicle import replan_worker
from xavi_dialogue.vehicle.episode import Moment
from xavi_dialogue.vehicle.node import COUNTERS, Pace, VehicleNode
from xavi_dialogue.vehicle.replan_worker import ReplanOrder, Result, obey
from xavi_dialogue.vehicle.replanning import Replanner, durations, workers
from xavi_dialogue.vehicle.worker_pool import Job

KEY = Keys().of("@rpc/whatif")
NETWORK = roads("s1").network


@pytest.fixture(scope="module")
def trace() -> PlanTrace:
    line = changing("s1", "main_in_1", "main_in_0", before_end("s1", "main_in_1", 85.0))
    scene = {
        0: still("s1", ("main_in_0",), before_end("s1", "main_in_0", 95.0)),
        1: driven(line, 14.0, [8.0] * 8),
    }
    return decide(frame("s1", QUICK), moment("s1", scene)).trace


@dataclass
class Slow:
    """Takes jobs and never begins one."""

    jobs: list[Job] = field(default_factory=list)

    def submit(self, job: Job) -> None:
        self.jobs.append(job)


@dataclass
class Bench:
    """A car that is asked over a bus."""

    planners: Slow = field(default_factory=Slow)
    hub: MemoryHub = field(default_factory=MemoryHub)
    outcomes: list[Outcome] = field(default_factory=list)

    def serve(self, *traces: PlanTrace, kept: int = 300) -> "Bench":
        replanner = Replanner(self.planners, kept)
        for trace in traces:
            replanner.record(Moment(Scene(trace.sim_time, trace.scene), (), trace))
        self.hub.connect().serve(KEY, replanner)
        return self

    def ask(self, payload: bytes) -> None:
        self.hub.connect().request(KEY, payload, 1.0, self.outcomes.append)

    def failure(self) -> Failure:
        (outcome,) = self.outcomes
        assert isinstance(outcome, Refused)
        return unpack(outcome.payload, Failure)


ENDLESS = WhatIf(("change-left",), rollouts=1_000_000)


def order(trace: PlanTrace, what_if: WhatIf) -> ReplanOrder:
    return ReplanOrder(msgspec.Raw(encode(trace)), what_if)


def text(wanted: ReplanOrder) -> str:
    """The order as a line."""
    return msgspec.json.encode(wanted).decode()


def test_a_request_becomes_a_job_with_all_that_is_needed(trace: PlanTrace) -> None:
    bench = Bench().serve(trace)
    before = time.monotonic()
    what_if = WhatIf(("stop",), 2, 1, "exit-right", ("exit-right",), 7)
    fields = msgspec.to_builtins(what_if)
    request = WhatIfRequest(request="q", trace_id=trace.trace_id, deadline_ms=5000.0, **fields)
    bench.ask(pack(msgspec.convert(msgspec.to_builtins(request), WhatIfRequest)))
    (job,) = bench.planners.jobs
    wanted = msgspec.json.decode(job.order, type=ReplanOrder)
    assert bytes(wanted.trace) == encode(trace)
    assert wanted.what_if == what_if
    assert before + 5.0 <= job.deadline <= time.monotonic() + 5.0
    assert b"\n" not in job.order
    assert bench.outcomes == []
    job.done(b"planned")
    assert bench.outcomes == [b"planned"]


def test_requests_are_counted_by_what_came_of_them(trace: PlanTrace) -> None:
    bench, alive = Bench(), HealthReporter("car", COUNTERS)
    replanner = Replanner(bench.planners, alive=alive)
    replanner.record(Moment(Scene(trace.sim_time, trace.scene), (), trace))
    bench.hub.connect().serve(KEY, replanner)
    for trace_id in (trace.trace_id, trace.trace_id, "unknown"):
        bench.ask(pack(WhatIfRequest(request="q", trace_id=trace_id)))
    assert alive.counted("what_ifs") == 1  # two are open
    bench.planners.jobs[0].done(b"planned")
    bench.planners.jobs[1].done(Failure(reason="timed-out"))
    told = alive.report().counters
    assert {name: count for name, count in told.items() if name.startswith("what_ifs")} == {
        "what_ifs": 3.0,
        "what_ifs_outside_record": 1.0,
        "what_ifs_planned": 1.0,
        "what_ifs_timed_out": 1.0,
    }


def test_a_failure_is_told_as_such(trace: PlanTrace) -> None:
    bench = Bench().serve(trace)
    bench.ask(pack(WhatIfRequest(request="q", trace_id=trace.trace_id)))
    bench.planners.jobs[0].done(Failure(reason="timed-out"))
    assert bench.failure().reason == "timed-out"


def test_only_the_latest_decisions_are_known(trace: PlanTrace) -> None:
    traces = [msgspec.structs.replace(trace, decision=number) for number in range(5)]
    bench = Bench().serve(*traces, kept=3)
    for known in traces:
        bench.ask(pack(WhatIfRequest(request="q", trace_id=known.trace_id)))
    assert len(bench.planners.jobs) == 3
    reasons = [unpack(o.payload, Failure).reason for o in bench.outcomes if isinstance(o, Refused)]
    assert reasons == ["outside-record"] * 2


@pytest.mark.parametrize(
    "change",
    [
        {"rollouts": 1001},
        {"rollouts": 0},
        {"actions": ["fly"]},
        {"actions": ["stop"] * 9},
        {"vehicle_actions": ["stop"] * 9},
        {"goal": ""},
        {"goal": "x" * 129},
        {"removed": "ego"},
        {"deadline_ms": 0},
        {"schema": "xavi.whatif/2"},
    ],
)
def test_what_is_no_request_is_refused(trace: PlanTrace, change: dict[str, object]) -> None:
    bench = Bench().serve(trace)
    fields = msgspec.to_builtins(WhatIfRequest(request="q", trace_id=trace.trace_id))
    bench.ask(msgspec.json.encode({**fields, **change}))
    assert bench.failure().reason == "planner-failed"
    assert bench.planners.jobs == []


def test_the_ride_goes_on_while_a_request_is_open() -> None:
    """All moments are driven and recorded though the planners never answer."""
    bench = Bench()
    replanner = Replanner(bench.planners)
    bench.hub.connect().serve(KEY, replanner)
    times: list[float] = []

    def ask_at_once(moment: Moment) -> None:
        times.append(moment.scene.time)
        if moment.trace is not None:
            bench.ask(pack(WhatIfRequest(request="q", trace_id=moment.trace.trace_id)))

    pace = Pace(speed=0.0, running=True)
    orders: Orders = queue.SimpleQueue()
    car = VehicleNode(
        s1_moments(), 0.5, (replanner.record, ask_at_once), None, orders, pace, stays=False
    )
    car.run()
    moments = list(s1_moments())
    assert times == [moment.scene.time for moment in moments]
    assert len(bench.planners.jobs) == sum(moment.trace is not None for moment in moments) > 1
    assert bench.outcomes == []


def test_a_worker_gives_the_trace_or_the_reason(trace: PlanTrace) -> None:
    done = obey(order(trace, WhatIf(removed=1)), NETWORK)
    assert done.planned
    assert decode(bytes(done.message)) == replan(trace, NETWORK, WhatIf(removed=1))
    for what_if, reason in (
        (WhatIf(removed=7), "unknown-vehicle"),
        (WhatIf(vehicle=1, vehicle_actions=("exit-left",)), "not-applicable"),
        (WhatIf(("stop",) * 5), "planner-failed"),
    ):
        refused = obey(order(trace, what_if), NETWORK)
        assert not refused.planned
        assert msgspec.json.decode(bytes(refused.message), type=Failure).reason == reason
    broken = ReplanOrder(msgspec.Raw(b'{"schema":"xavi.plan_trace/1"}'), WhatIf())
    assert not obey(broken, NETWORK).planned


def test_a_result_is_one_line(trace: PlanTrace) -> None:
    line = msgspec.json.encode(obey(order(trace, WhatIf(("stop",), rollouts=3)), NETWORK))
    assert b"\n" not in line
    assert msgspec.json.decode(line, type=Result).planned


def test_warming_up_takes_a_decision_among_others(monkeypatch: pytest.MonkeyPatch) -> None:
    decided: list[PlanTrace] = []

    class Watched(Driver):
        def step(self, scene: Scene, dt: float) -> DriveStep:
            done = super().step(scene, dt)
            assert done.trace is not None
            decided.append(done.trace)
            return done

    monkeypatch.setattr(replan_worker, "Driver", Watched)
    for name in ("s1", "s2"):
        replan_worker.warm_up(roads(name).network)
    assert len(decided) == 2
    for taken in decided:
        assert taken.plan
        assert taken.predictions[0].goals


def test_every_kind_of_request_can_be_timed(trace: PlanTrace) -> None:
    taken = durations([trace], NETWORK)
    assert set(taken) == {
        *("actions forced", "vehicle removed", "goal supposed", "actions supposed")
    }


@pytest.mark.slow
def test_workers_plan_as_this_process_does_and_end_with_the_pool(trace: PlanTrace) -> None:
    requests = {
        "removed": WhatIf(removed=1),
        "forced": WhatIf(("change-left",), rollouts=5),
        "supposed": WhatIf(vehicle=1, goal="continue"),
    }
    with workers(load("s1").network) as pool:
        client = PoolClient(pool)
        for name, what_if in requests.items():
            client.ask(text(order(trace, what_if)), name=name)
        for name, what_if in requests.items():
            assert client.answer(name) == encode(replan(trace, NETWORK, what_if))
        pid = client.pid()
    assert not remains(pid)


@pytest.mark.slow
def test_a_worker_that_is_late_is_killed(trace: PlanTrace) -> None:
    with workers(load("s1").network) as pool:
        client = PoolClient(pool)
        client.ask(text(order(trace, WhatIf(rollouts=1))), name="ready")
        assert isinstance(client.answer("ready"), bytes)
        late = client.pid()
        client.ask(text(order(trace, ENDLESS)), within=0.5, name="endless")
        assert client.reason("endless") == "timed-out"
        assert until(lambda: not remains(late))


@pytest.mark.slow
def test_a_worker_ends_with_its_input_in_the_middle_of_planning(trace: PlanTrace) -> None:
    command = [sys.executable, "-m", "xavi_dialogue.vehicle.replan_worker", str(load("s1").network)]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdin is not None
    assert process.stdout is not None
    assert process.stdout.readline() == replan_worker.READY
    process.stdin.write(text(order(trace, ENDLESS)).encode() + b"\n")
    process.stdin.close()
    assert process.stdout.read() == b""
    assert process.wait(PATIENCE) == 0
    process.stdout.close()


@pytest.mark.slow
def test_a_car_plans_again_over_the_bus_and_its_worker_dies_with_it() -> None:
    found: queue.SimpleQueue[PlanTrace] = queue.SimpleQueue()
    with start_local("s1", 0, 0.0) as behind:
        client = Client(behind.bus, Keys(), "test")
        first_scene(behind, client)
        behind.drive(client, Until(1.0), halt=True)
        behind.bus.subscribe(
            Keys().of("trace"),
            lambda _, told: found.put(unpack(told, TraceReport).trace),
            kept=True,
        )
        seen = found.get(timeout=PATIENCE)
        wanted = WhatIfRequest(request="q", trace_id=seen.trace_id, removed=1, rollouts=5)
        answer = call(behind.bus, KEY, pack(wanted), PATIENCE)
        assert answer == encode(replan(seen, NETWORK, WhatIf(removed=1, rollouts=5)))
        (car,) = (pid for pid in children(os.getpid()) if b"\0drive\0" in command(pid))
        (planner,) = children(car)
        os.kill(car, signal.SIGKILL)
        assert until(lambda: not there(planner))
