"""The loop of the car process: drives the ride at its pace, and reports it on the bus."""

import queue
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import cache, partial

import msgspec

from planner.record import trace as plan_trace
from planner.record.events import Event
from planner.record.trace import PlanTrace
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Bus, Call, CallHandler, Keys
from xavi_dialogue.bus.messages import CarState, EventReport, SceneReport, TraceReport
from xavi_dialogue.bus.schema import schema_of
from xavi_dialogue.process.child_commands import Order, Orders, Pause, Quit, Resume, Speed, Until
from xavi_dialogue.runtime import system
from xavi_dialogue.vehicle.episode import Moment, halts
from xavi_dialogue.vehicle.outbox import REPORTS, SCENES
from xavi_dialogue.vehicle.telemetry import Reporter

SHOWN_EVERY = 0.1  # [s] of wall time: the scene, at 10 Hz
TOLD = {"scene": SceneReport, "trace": TraceReport, "event_report": EventReport}
COUNTERS = ("decisions", "events", "scenes", SCENES, REPORTS, "what_ifs")  # see HealthReporter


@dataclass
class Pace:
    """The speed of the ride, and the time at which it halts."""

    speed: float  # simulated seconds per second; 0 is as fast as possible
    running: bool
    until: float | None = None  # [s] when to halt; for None see episode.halts
    stops: bool = False  # whether to halt then
    quit: bool = False
    obeyed: int = 0  # number of orders carried out

    def obey(self, order: Order) -> None:
        """Change the pace as ordered."""
        self.obeyed += 1
        match order:
            case Pause():
                self.running = False
            case Resume():
                self.running, self.stops = True, False
            case Until(moment):
                self.running, self.stops, self.until = True, True, moment
            case Speed(factor):
                self.speed = factor
            case Quit():
                self.quit = True

    def arrive(self, at: float, events: list[Event]) -> None:
        """Halt if the time to halt is reached."""
        if self.running and self.stops and halts(self.until, at, events):
            self.running = False


@dataclass
class VehicleNode:
    """A car that drives a ride, reports it, and obeys orders about its pace."""

    ride: Iterator[Moment]
    step: float  # [s]
    records: tuple[Callable[[Moment], None], ...]  # called with every moment
    reporter: Reporter | None  # None: nothing is published
    orders: Orders
    pace: Pace
    stays: bool  # whether it stays on the bus after the ride until asked to quit
    events: list[Event] = field(default_factory=list)
    due: float = 0.0  # [s] on the monotonic clock: when the next step may be taken

    def run(self) -> None:
        """Drive to the end, or until asked to quit."""
        for moment in self.ride:
            self.events.extend(moment.events)
            for record in self.records:
                record(moment)
            if self.reporter is not None:
                self.reporter.record(moment)
            self.pace.arrive(moment.scene.time, self.events)
            self._show(moment, always=not self.pace.running or moment.ending is not None)
            self._wait(moment)
            if self.pace.quit:
                return

    def _wait(self, moment: Moment) -> None:
        """Wait until the next step is due; after the ride, until asked to quit."""
        if self.pace.speed > 0.0:
            self.due = max(self.due, system.monotonic() - self.step) + self.step / self.pace.speed
        over = moment.ending is not None
        while not self.pace.quit and (not over or self.stays):
            halted = over or not self.pace.running
            delay = 0.0 if self.pace.speed == 0.0 else self.due - system.monotonic()
            self._listen(moment, SHOWN_EVERY if halted else min(delay, SHOWN_EVERY))
            if halted:
                self._show(moment)
                self.due = system.monotonic()
            elif delay <= 0.0:
                return

    def _listen(self, moment: Moment, patience: float) -> None:
        """Wait up to `patience` [s] for one command, and carry it out."""
        try:
            order = (
                self.orders.get(timeout=patience) if patience > 0.0 else self.orders.get_nowait()
            )
        except queue.Empty:
            return
        self.pace.obey(order)
        self.pace.arrive(moment.scene.time, self.events)
        self._show(moment, always=True)

    def _show(self, moment: Moment, *, always: bool = False) -> None:
        reporter, pace = self.reporter, self.pace
        if reporter is None or not (always or reporter.idle_time() >= 0.9 * SHOWN_EVERY):
            return
        state: CarState = "driving" if pace.running else "paused"
        if moment.ending is not None:
            state = "ended"
        reporter.show(moment, state, pace.speed, pace.obeyed)


def serve(bus: Bus, keys: Keys, planning: CallHandler, alive: HealthReporter | None = None) -> None:
    """Answer requests to the car, and announce that it is on the bus.

    Args:
        bus: of the car.
        keys: of the car.
        planning: handles requests for planning again.
        alive: reports the health of the car.
    """
    bus.serve(keys.of("@rpc/whatif"), planning)
    for name, document in _schemas().items():
        bus.serve(keys.of(f"@schema/{name}"), partial(_reply_with, document))
    (HealthReporter("car", COUNTERS) if alive is None else alive).serve(bus, keys)


@cache
def _schemas() -> dict[str, bytes]:
    """Return the schemas of what a car sends, by name."""
    found = {name: schema_of(kind) for name, kind in TOLD.items()}
    found["plan_trace"] = schema_of(PlanTrace, plan_trace.SCHEMA)
    return {name: msgspec.json.encode(schema) for name, schema in found.items()}


def _reply_with(document: bytes, call: Call) -> None:
    call.reply(document)
