"""The outbox on a bus that stalls."""

import threading
from collections.abc import Iterator
from dataclasses import dataclass, field

import pytest

from tests.vehicle.pool_jobs import until
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import BusFailed
from xavi_dialogue.bus.memory_bus import MemoryBus, MemoryHub
from xavi_dialogue.vehicle.outbox import REPORTS, SCENES, Bounds, Outbox

PATIENCE = 30.0


@dataclass
class Stalling:
    """A publisher that hangs while the gate is shut."""

    gate: threading.Event
    sent: list[str]

    def put(self, payload: bytes) -> None:
        assert self.gate.wait(PATIENCE)
        self.sent.append(payload.decode())
        if payload == b"broken":
            raise BusFailed("it is closed")


class StallingBus(MemoryBus):
    """A bus whose publishers hang while the gate is shut."""

    def __init__(self) -> None:
        super().__init__(MemoryHub())
        self.gate, self.sent = threading.Event(), []

    def publisher(self, key: str, keep: int = 0) -> Stalling:
        return Stalling(self.gate, self.sent)


@dataclass
class Bench:
    """An outbox on a stalled bus, with the first message stuck in it."""

    bus: StallingBus = field(default_factory=StallingBus)
    alive: HealthReporter = field(default_factory=lambda: HealthReporter("car", [SCENES, REPORTS]))

    def open(self, bounds: Bounds | None = None) -> "Bench":
        self.outbox = Outbox(self.bus, self.alive, bounds)
        self.scene = self.outbox.publisher("scene")
        self.trace = self.outbox.publisher("trace", keep=3)
        self.trace.put(b"first")
        return self

    def dropped(self) -> tuple[float, float]:
        return self.alive.counted(SCENES), self.alive.counted(REPORTS)


@pytest.fixture
def bench() -> Iterator[Bench]:
    one = Bench()
    yield one
    one.bus.gate.set()


def test_who_sends_does_not_wait_and_all_arrives_in_order(bench: Bench) -> None:
    bench.open()
    for number in range(10):
        bench.trace.put(b"t%d" % number)
        bench.scene.put(b"s%d" % number)
    assert bench.bus.sent == []
    assert bench.outbox.waiting() == 21
    bench.bus.gate.set()
    assert bench.outbox.close(PATIENCE)
    expected = [f"{kind}{number}" for number in range(10) for kind in "ts"]
    assert bench.bus.sent == ["first", *expected]
    assert bench.dropped() == (0, 0)


def test_of_scenes_the_latest_stay(bench: Bench) -> None:
    bench.open(Bounds(droppable=2))
    for number in range(5):
        bench.scene.put(b"s%d" % number)
    bench.trace.put(b"t")
    bench.bus.gate.set()
    assert bench.outbox.close(PATIENCE)
    assert [one for one in bench.bus.sent if one != "first"] == ["s3", "s4", "t"]
    assert bench.dropped() == (3, 0)


@pytest.mark.parametrize("bounds", [Bounds(messages=3), Bounds(size=6)])
def test_when_it_is_full_scenes_go_first_and_then_the_oldest_reports(
    bench: Bench, bounds: Bounds
) -> None:
    bench.open(bounds)
    assert until(lambda: not bench.outbox._waiting)  # the first is being sent
    for payload in (b"t0", b"t1"):
        bench.trace.put(payload)
    bench.scene.put(b"s0")
    bench.trace.put(b"t2")
    assert bench.dropped() == (1, 0)
    bench.trace.put(b"t3")
    assert bench.dropped() == (1, 1)
    bench.scene.put(b"s1")
    assert bench.dropped() == (2, 1)
    bench.bus.gate.set()
    assert bench.outbox.close(PATIENCE)
    assert bench.bus.sent == ["first", "t1", "t2", "t3"]


def test_what_cannot_be_sent_in_time_is_counted(bench: Bench) -> None:
    bench.open()
    assert until(lambda: len(bench.outbox._waiting) == 0)
    bench.trace.put(b"t")
    bench.scene.put(b"s")
    assert not bench.outbox.close(0.0)
    assert bench.dropped() == (1, 1)
    bench.trace.put(b"late")
    assert bench.dropped() == (1, 2)
    bench.bus.gate.set()
    assert until(lambda: bench.bus.sent == ["first"])


def test_a_message_that_is_refused_does_not_stop_the_others(bench: Bench) -> None:
    bench.open()
    bench.bus.gate.set()
    bench.trace.put(b"broken")
    bench.trace.put(b"after")
    assert bench.outbox.close(PATIENCE)
    assert bench.bus.sent == ["first", "broken", "after"]
