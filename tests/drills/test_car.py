"""The car among others: on a bus that stalls, hubs that come and go, told to end at any time."""

import json
import logging
import os
import queue
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import pytest

from planner.record.trace import Action
from sim.setup.scenario import load
from sim.sumo import EgoGone, SumoFailed
from tests.drills.processes import PATIENCE, until
from tests.fakes import s1_moments
from tests.vehicle.pool_jobs import children, there
from tests.vehicle.test_outbox import Bench as StalledBench
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Bus, Call, Keys, NoAnswer, call
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.memory_bus import MemoryHub
from xavi_dialogue.bus.messages import (
    AliveReport,
    EventReport,
    SceneReport,
    TraceReport,
    WhatIfRequest,
    pack,
    unpack,
)
from xavi_dialogue.bus.zenoh_bus import host, join
from xavi_dialogue.process.child_commands import Order, Orders, Quit, Signals
from xavi_dialogue.vehicle.bus_session import NameTaken, QuitBeforeRide, ServiceMonitor, claim
from xavi_dialogue.vehicle.episode import Moment
from xavi_dialogue.vehicle.main import _remedied
from xavi_dialogue.vehicle.node import COUNTERS, Pace, VehicleNode
from xavi_dialogue.vehicle.telemetry import Reporter

KEY = Keys().of


def test_the_ride_goes_on_while_the_bus_stalls_and_all_of_it_is_reported_then() -> None:
    bench = StalledBench().open()
    times: list[float] = []

    def note(moment: Moment) -> None:
        times.append(moment.scene.time)

    orders: Orders = queue.SimpleQueue()
    reporter = Reporter(bench.outbox, Keys(), alive=bench.alive)
    VehicleNode(
        s1_moments(), 0.5, (note,), reporter, orders, Pace(0.0, running=True), stays=False
    ).run()
    assert times == [moment.scene.time for moment in s1_moments()]
    assert bench.bus.sent == []
    bench.bus.gate.set()
    assert bench.outbox.close(PATIENCE)
    sent = [json.loads(payload) for payload in bench.bus.sent if payload != "first"]
    for schema, expected in (("xavi.trace/1", 4), ("xavi.event_report/1", 6)):
        numbers = [report["seq"] for report in sent if report["schema"] == schema]
        assert numbers == list(range(expected))
    assert sent[-1]["state"] == "ended"
    assert bench.dropped() == (0, 0)


def test_a_car_claims_a_name_that_nobody_has() -> None:
    claim(MemoryHub().connect(), Keys(), Signals())


def test_two_cars_of_one_name_are_one_too_many() -> None:
    hub = MemoryHub()
    HealthReporter("car", COUNTERS).serve(hub.connect(), Keys("shuttle-3"))
    with pytest.raises(NameTaken, match=r"a car named 'shuttle-3' .* --vehicle NAME"):
        claim(hub.connect(), Keys("shuttle-3"), Signals())
    claim(hub.connect(), Keys("shuttle-4"), Signals())


def test_a_car_that_does_not_answer_is_waited_for_until_it_is_gone() -> None:
    hub, asked = MemoryHub(), list[Call]()
    with hub.connect() as dying:

        def stall(one: Call) -> None:
            asked.append(one)
            if len(asked) == 3:
                dying.close()
            one.drop()

        dying.serve(KEY("alive/car"), stall)
        claim(hub.connect(), Keys(), Signals())
        assert len(asked) == 3
        dying.serve(KEY("alive/car"), stall)
        with pytest.raises(NameTaken):
            claim(hub.connect(), Keys(), Signals(), patience=0.0)


def test_a_car_told_to_quit_claims_nothing() -> None:
    signals, orders = Signals(), queue.SimpleQueue[Order]()
    before = {one: signal.getsignal(one) for one in (signal.SIGTERM, signal.SIGINT)}
    try:
        signals.listen(orders)
        signal.raise_signal(signal.SIGTERM)
        signal.raise_signal(signal.SIGINT)
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    assert (signals.status, orders.get_nowait()) == (143, Quit())
    with pytest.raises(QuitBeforeRide):
        claim(MemoryHub().connect(), Keys(), signals)


def test_it_is_logged_when_the_service_goes_and_comes_back(
    caplog: pytest.LogCaptureFixture,
) -> None:
    caplog.set_level(logging.INFO)
    hub = MemoryHub()
    hub.connect().watch(KEY("alive/service"), ServiceMonitor("shuttle-3"))
    for _ in range(2):
        with hub.connect() as service:
            service.appear(KEY("alive/service"))
    told = [(record.getMessage(), record.__dict__["vehicle"]) for record in caplog.records]
    lost, back = ("service lost; driving on", "shuttle-3"), ("service back", "shuttle-3")
    assert told == [lost, back, lost]


@pytest.mark.parametrize("kind", [SumoFailed, EgoGone])
def test_faults_of_the_simulation_say_where_to_look(kind: type[Exception]) -> None:
    scenario = load("s1")
    with pytest.raises(kind) as told, _remedied(scenario):
        raise kind("SUMO at 3 s: it stopped")
    assert str(told.value) == (
        "SUMO at 3 s: it stopped;"
        f" look at the vehicles in {scenario.routes} and at the roads in {scenario.network}"
    )
    named = f"{scenario.routes}: SUMO refuses it: why"
    with pytest.raises(kind) as told, _remedied(scenario):
        raise kind(named)
    assert str(told.value) == named


def free_endpoint() -> str:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return f"tcp/127.0.0.1:{probe.getsockname()[1]}"


@contextmanager
def xavi(*arguments: str, log: Path | None = None) -> Iterator[subprocess.Popen[str]]:
    """A process of ours; its standard error goes into a file."""
    with (log or Path(os.devnull)).open("w", encoding="utf-8") as errors:
        process = subprocess.Popen(
            [sys.executable, "-m", "xavi_dialogue", *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=errors,
            text=True,
        )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


class Listener:
    """Hears a car on the bus."""

    def __init__(self, bus: Bus) -> None:
        self.bus = bus
        self.scenes: list[SceneReport] = []
        self.traces: list[TraceReport] = []
        self.events: list[EventReport] = []
        self.alive: list[bool] = []
        bus.watch(KEY("alive/car"), lambda _, there: self.alive.append(there))
        bus.subscribe(KEY("scene"), lambda _, p: self.scenes.append(unpack(p, SceneReport)))
        for name, kind, to in (
            ("trace", TraceReport, self.traces.append),
            ("event", EventReport, self.events.append),
        ):
            bus.subscribe(KEY(name), _hearer(kind, to), kept=True)

    def plans_again(self, rollouts: int = 3, action: Action = "stop") -> bytes:
        """Have the car plan again from its first decision."""
        request = WhatIfRequest(
            request="q",
            trace_id=self.traces[0].trace.trace_id,
            actions=(action,),
            rollouts=rollouts,
            deadline_ms=60_000.0,
        )
        return call(self.bus, KEY("@rpc/whatif"), pack(request), PATIENCE)

    def fares(self) -> AliveReport:
        return unpack(call(self.bus, KEY("alive/car"), b"", PATIENCE), AliveReport)


def _hearer(kind: type, to: Callable[..., None]) -> Callable[[str, bytes], None]:
    return lambda _, payload: to(unpack(payload, kind))


@pytest.mark.slow
def test_a_hub_that_is_killed_and_comes_back_finds_all_that_was_reported(tmp_path: Path) -> None:
    endpoint, log = free_endpoint(), tmp_path / "log"
    serve = ("serve", "--listen", endpoint, "--keep-days", "0")
    with ExitStack() as first, ExitStack() as ride:
        hub = first.enter_context(xavi(*serve))
        bus = first.enter_context(join(Link.to_hub(endpoint), PATIENCE))
        ride.enter_context(xavi("drive", "--connect", endpoint, "--speed", "0.5", log=log))
        listener = Listener(bus)
        came = until(lambda: bool(listener.scenes) and len(listener.traces) >= 2)
        assert came, log.read_text()
        hub.kill()
        hub.wait()
        first.close()
        assert until(lambda: "service lost; driving on" in log.read_text())
        with xavi(*serve), join(Link.to_hub(endpoint), PATIENCE) as bus:
            listener = Listener(bus)
            assert until(lambda: bool(listener.scenes and listener.traces and listener.events))
            assert until(lambda: bool(listener.alive))
            assert listener.alive == [True]
            assert until(lambda: len(listener.traces) == listener.scenes[-1].traces)
            for reports in (listener.traces, listener.events):
                assert [report.seq for report in reports] == list(range(len(reports)))
            assert listener.plans_again()
            fares = listener.fares().counters
            assert fares["what_ifs_planned"] >= 1.0  # the service may have asked as well
            assert fares["workers"] == 1.0
            assert fares["reports_dropped"] == 0.0
            assert until(lambda: "service back" in log.read_text())
            assert log.read_text().count("service lost") == 1  # until this one ends


@pytest.mark.slow
def test_a_car_that_waits_for_its_hub_ends_when_told_to(tmp_path: Path) -> None:
    with xavi("drive", "--connect", free_endpoint(), log=tmp_path / "log") as car:
        # Its Zenoh session has threads; from then on it looks for the hub.
        assert until(lambda: len(list(Path(f"/proc/{car.pid}/task").iterdir())) > 4)
        car.terminate()
        assert car.wait(PATIENCE) in (143, -signal.SIGTERM)
    assert "Traceback" not in (tmp_path / "log").read_text()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("state", "number"),
    [("driving", signal.SIGINT), ("paused", signal.SIGTERM), ("ended", signal.SIGTERM)],
)
def test_a_car_ends_when_told_to_in_every_state(state: str, number: int, tmp_path: Path) -> None:
    """While it is paused it is planning again."""
    endpoint, log = free_endpoint(), tmp_path / "log"
    duration = "2" if state == "ended" else "60"
    drive = ["drive", "--connect", endpoint, "--control", "--duration", duration]
    with (
        host(Link.of_hub(endpoint)),
        xavi(*drive, log=log) as car,
        join(Link.to_hub(endpoint)) as bus,
    ):
        listener = Listener(bus)
        assert until(lambda: bool(listener.scenes and listener.traces))
        assert car.stdin is not None
        if state != "paused":
            car.stdin.write("resume\n" if state == "ended" else "speed 1\nresume\n")
            car.stdin.flush()
        assert until(lambda: listener.scenes[-1].state == state)
        if state == "paused":
            assert until(lambda: listener.fares().counters["workers_idle"] == 1.0)
            threading.Thread(target=_plan_for_long, args=(listener,), daemon=True).start()
            assert until(lambda: listener.fares().counters["workers_idle"] == 0.0)
        assert until(lambda: len(children(car.pid)) == 1)
        workers = children(car.pid)
        car.send_signal(number)
        assert car.wait(PATIENCE) == 128 + number
        assert until(lambda: not any(map(there, workers)))
    assert "Traceback" not in log.read_text()


def _plan_for_long(listener: Listener) -> None:
    with suppress(NoAnswer):
        listener.plans_again(rollouts=1000)
