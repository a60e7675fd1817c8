"""`xavi bench dashboard`: from a scene on the bus to pixels, frames, memory of server and page.

A made-up car reports on a bus of this process; the dashboard runs as its users start it, and a
browser without a window shows its page. Both clocks are this machine's.
"""

import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import count
from typing import Any

import msgspec
from msgspec.structs import replace

from benchmarks.figures import Figure, figure, figures_table, in_columns
from benchmarks.service.browser import Window, opened
from benchmarks.service.served import Served, served
from benchmarks.service.synthetic_vehicle import SyntheticVehicle, Traffic
from planner.record.trace import PlanTrace
from sim.roads.network import Network
from sim.setup.scenario import Scenario, load
from xavi_dialogue.bus.interface import Bus, Keys
from xavi_dialogue.vehicle.episode import network_of, start

SCENARIO = "town"
SEED = 0
VEHICLES = (3, 60, 300)
CROWD = 60  # vehicles while memory is measured
PERIOD = 0.1  # [s] between scenes
DECISIONS = 10  # scenes from one decision to the next
SETTLE = 3.0  # [s] at the start that are not counted, while roads load and code is compiled
SAMPLE = 20.0  # [s] between measurements of memory
MEGABYTE = 1024.0 * 1024.0

SHOWING = "() => window.xavi?.map?.frames().latest_scene?.drawn > 0"
OVERVIEW = "window.xavi.map.follow(false); window.xavi.map.fit()"
DROPPED = "window.xavi.store.status.dropped"
#: Records how long [ms] after sending a scene the first frame towards it was painted, and the frame
#: in which all vehicles have reached their places; checks 50 times a second.
LISTEN = """
window.latencies = { latest_scene: [], reached_scene: [] };
const last = window.xavi.map.frames();
setInterval(() => {
  const now = window.xavi.map.frames();
  for (const [name, taken] of Object.entries(window.latencies)) {
    const scene = now[name];
    if (!scene || scene.seq === last[name]?.seq) continue;
    last[name] = scene;
    taken.push(scene.drawn - 1000 * scene.wall);
  }
}, 20);
"""
SIGHTS = {"latest_scene": "first frame", "reached_scene": "all there"}


class Frames(msgspec.Struct, frozen=True):
    """The smoothness of the display for a number of vehicles."""

    vehicles: int
    seconds: float  # [s] duration of the measurement
    scenes: int  # scenes that were sent
    painted: int  # scenes that were painted
    dropped: int  # scenes that were dropped because the page was too slow
    fps: float  # frames per second
    draw_ms: float  # [ms] to draw the map once
    worst_ms: float  # [ms] longest time to draw the map since the page was loaded


class Memory(msgspec.Struct, frozen=True):
    """The memory [MB] after some minutes."""

    minutes: float
    server: float  # resident
    page: float  # heap of the page's program, after a collection


class Report(msgspec.Struct, frozen=True):
    """The results of the benchmark."""

    bench: str
    scenario: str  # scenario whose roads are shown
    figures: tuple[Figure, ...]  # latency [ms], by number of vehicles and awaited event
    frames: tuple[Frames, ...]
    vehicles: int  # while memory is measured
    memory: tuple[Memory, ...]
    dropped: int  # scenes while memory is measured

    def table(self) -> str:
        """Return the report for people."""
        frames: list[tuple[str, ...]] = [
            ("vehicles", "scenes", "painted", "dropped", "frames/s", "ms a frame", "most")
        ]
        for f in self.frames:
            counts = map(str, (f.vehicles, f.scenes, f.painted, f.dropped))
            frames.append((*counts, *(f"{one:.1f}" for one in (f.fps, f.draw_ms, f.worst_ms))))
        memory = [("minutes", "server MB", "page MB")]
        memory += [(f"{m.minutes:.1f}", f"{m.server:.1f}", f"{m.page:.1f}") for m in self.memory]
        return "\n\n".join([figures_table(self.figures), in_columns(frames), in_columns(memory)])


@dataclass
class _Ride:
    """A synthetic ride in real time, on its own thread."""

    bus: Bus
    scenario: Scenario
    network: Network
    decision: PlanTrace  # reported again and again
    vehicles: int
    sent: int = 0  # scenes sent
    over: threading.Event = field(default_factory=threading.Event)

    def go(self) -> None:
        """Report until it is over."""
        car = SyntheticVehicle(self.bus, Keys(), self.scenario.network)
        car.appear()
        traffic = Traffic(self.network, self.vehicles, SEED)
        began = time.monotonic()
        for k in count():
            now = round(k * PERIOD, 3)
            if k % DECISIONS == 0:
                car.decide(replace(self.decision, sim_time=now, decision=k // DECISIONS))
            car.see(now, traffic.vehicles)
            self.sent = car.scenes
            traffic.go_on(PERIOD)
            if self.over.wait(max(began + now + PERIOD - time.monotonic(), 0.0)):
                break
        car.vanish()


def measure(seconds: float, minutes: float, note: Callable[[str], None]) -> Report:
    """Measure the dashboard.

    Args:
        seconds: [s] of measurement for each number of vehicles.
        minutes: [min] over which memory is measured.
        note: is called with notes on progress.

    Raises:
        NoBrowser: none is installed, or playwright is not.
        ChildFailed: the dashboard does not come up.
    """
    scenario = load(SCENARIO, SEED)
    network = network_of(scenario)
    with start(scenario, network) as moments:
        decision = next(moment.trace for moment in moments if moment.trace is not None)
    figures, frames = [], []
    for vehicles in VEHICLES:
        note(f"{vehicles} vehicles, {seconds:g} s")
        with _shown(scenario, network, decision, vehicles) as stage:
            latencies, smooth = _smoothness(stage, seconds)
        for name, taken in latencies.items():
            figures.append(figure(f"{vehicles} vehicles, {SIGHTS[name]}", "ms", taken))
        frames.append(smooth)
    note(f"memory over {minutes:g} minutes with {CROWD} vehicles")
    with _shown(scenario, network, decision, CROWD) as stage:
        memory = tuple(_memory(stage, minutes))
        dropped = int(stage.page.run(DROPPED))
    return Report("dashboard", SCENARIO, tuple(figures), tuple(frames), CROWD, memory, dropped)


@dataclass(frozen=True)
class _Stage:
    """A page that shows a synthetic ride."""

    ride: _Ride
    server: Served
    page: Window


@contextmanager
def _shown(
    scenario: Scenario, network: Network, decision: PlanTrace, vehicles: int
) -> Iterator[_Stage]:
    with served() as server, opened() as page:
        ride = _Ride(server.bus, scenario, network, decision, vehicles)
        thread = threading.Thread(target=ride.go, daemon=True)
        thread.start()
        try:
            page.visit(server.address)
            page.until(SHOWING)
            page.run(OVERVIEW)
            page.wait(SETTLE)
            yield _Stage(ride, server, page)
        finally:
            ride.over.set()
            thread.join()


def _smoothness(stage: _Stage, seconds: float) -> tuple[dict[str, list[float]], Frames]:
    """Return latencies [ms] by awaited event, and frames, over some time [s]."""
    ride, page = stage.ride, stage.page
    page.run(LISTEN)
    sent, dropped, began = ride.sent, page.run(DROPPED), time.perf_counter()
    before = _frames(page)
    page.wait(seconds)
    after, span = _frames(page), time.perf_counter() - began
    latencies: dict[str, list[float]] = page.run("window.latencies")
    found = Frames(
        vehicles=ride.vehicles,
        seconds=round(span, 2),
        scenes=ride.sent - sent,
        painted=len(latencies["latest_scene"]),
        dropped=int(page.run(DROPPED)) - int(dropped),
        fps=round((after["count"] - before["count"]) / span, 1),
        draw_ms=round(after["draw_ms"], 2),
        worst_ms=round(after["worst_ms"], 2),
    )
    return latencies, found


def _frames(page: Window) -> dict[str, Any]:
    found: dict[str, Any] = page.run("window.xavi.map.frames()")
    return found


def _memory(stage: _Stage, minutes: float) -> Iterator[Memory]:
    """Measure the memory from time to time."""
    began = time.monotonic()
    while True:
        passed = time.monotonic() - began
        server, heap = stage.server.resident() / MEGABYTE, stage.page.heap() / MEGABYTE
        yield Memory(round(passed / 60.0, 2), round(server, 1), round(heap, 2))
        left = 60.0 * minutes - passed
        if left <= 0.0:
            return
        stage.page.wait(min(SAMPLE, left))
