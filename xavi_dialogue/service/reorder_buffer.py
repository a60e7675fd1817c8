"""A buffer that puts the reports of one ride in order: they may arrive in any order."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Generic, TypeAlias, TypeVar

from xavi_dialogue.bus.messages import EventReport, SceneReport, TraceReport
from xavi_dialogue.dialogue.state.events import (
    EventRecorded,
    Input,
    RecordMissing,
    RideEnded,
    SceneSeen,
    TraceRecorded,
)
from xavi_dialogue.dialogue.state.state import EPSILON
from xavi_dialogue.vehicle.telemetry import KEPT_EVENTS, KEPT_TRACES

Item = TypeVar("Item")
ReportOfRide: TypeAlias = SceneReport | TraceReport | EventReport

PATIENCE = 1.0  # [s] to wait for missing reports; the bus recovers lost ones in half that time


@dataclass
class ReorderBuffer(Generic[Item]):
    """A buffer that passes numbered items on in the order of their numbers, each once."""

    limit: int  # items that may wait for an earlier one
    time_of: Callable[[Item], float]  # [s]
    next: int = 0  # number of the first item that has not been passed on
    held: dict[int, Item] = field(default_factory=dict)
    lost: int = 0  # number of items that were given up
    known: float | None = None  # [s] latest time of an item that was passed on; None: none was
    gaps: list[tuple[float, float]] = field(default_factory=list)  # [s] not yet returned by `told`
    _open: float | None = None  # [s] start of a gap that ends when the next item comes

    def add(self, number: int, item: Item) -> list[Item]:
        """Add an item; return the items that are now in order."""
        if number >= self.next and len(self.held) < self.limit:
            self.held.setdefault(number, item)
        return self._ready()

    def begin(self, oldest: int) -> list[Item]:
        """Give up items that the sender no longer keeps; return those that are now in order.

        Args:
            oldest: number of the oldest item that may still come.
        """
        if self.next < oldest:
            self._skip_to(min([oldest, *self.held]))
        return self._ready()

    def give_up(self, end: int) -> list[Item]:
        """Give up all that is missing before a number; return the items that are now in order."""
        ready: list[Item] = []
        while self.next < end:
            after = min([end, *self.held])
            self.lost += after - self.next
            self._skip_to(after)
            ready += self._ready()
        return ready

    def told(self, now: float) -> list[tuple[float, float]]:
        """Return the gaps not returned before; one that is still open ends at a time [s]."""
        if self._open is not None:
            self.gaps.append((self._open, max(self._open, now)))
            self._open = None
        told, self.gaps = self.gaps, []
        return told

    def _skip_to(self, number: int) -> None:
        if number > self.next and self._open is None:
            self._open = self.known or 0.0
        self.next = number

    def _ready(self) -> list[Item]:
        ready = []
        while self.next in self.held:
            item = self.held.pop(self.next)
            time = self.time_of(item)
            if self._open is not None:
                self.gaps.append((self._open, max(self._open, time)))
                self._open = None
            self.known = max(time, self.known or 0.0)
            ready.append(item)
            self.next += 1
        return ready


@dataclass
class RideReports:
    """The reports of one ride."""

    ride: str
    traces: ReorderBuffer[TraceRecorded] = field(
        default_factory=lambda: ReorderBuffer(KEPT_TRACES, lambda one: one.trace.sim_time)
    )
    events: ReorderBuffer[EventRecorded] = field(
        default_factory=lambda: ReorderBuffer(KEPT_EVENTS, lambda one: one.event.sim_time)
    )
    scene: SceneReport | None = None  # the latest
    reached: float = 0.0  # [s] latest time of a scene
    over: bool = False
    missing: tuple[float, int, int] | None = None  # [s] since this time; the next numbers

    def hear(self, report: ReportOfRide) -> list[Input]:
        """Return the inputs for the dialogue after a report of this ride."""
        match report:
            case SceneReport():
                return self.see(report)
            case TraceReport():
                return self.trace(report)
            case EventReport():
                return self.event(report)

    def trace(self, report: TraceReport) -> list[Input]:
        """Return the inputs for the dialogue after a trace report."""
        recorded = TraceRecorded(report.trace, report.first)
        ready = [] if self.over else self.traces.add(report.seq, recorded)
        return [*self._gaps(), *ready, *self._end()]

    def event(self, report: EventReport) -> list[Input]:
        """Return the inputs for the dialogue after an event report."""
        recorded = EventRecorded(report.event)
        ready = [] if self.over else self.events.add(report.seq, recorded)
        return [*self._gaps(), *ready, *self._end()]

    def see(self, report: SceneReport) -> list[Input]:
        """Return the inputs for the dialogue after a scene report.

        Its time may be earlier than that of the previous scene, as a recording may be replayed.
        """
        if self.scene is not None and report.seq <= self.scene.seq:
            return self._end()
        self.scene = report
        self.reached = max(self.reached, report.sim_time)
        if self.over:
            return []
        # A service that joins late gets only what the sender has kept.
        traces = self.traces.begin(report.traces - KEPT_TRACES)
        events = self.events.begin(report.events - KEPT_EVENTS)
        seen = SceneSeen(report.scene())
        return [*self._gaps(), *traces, *events, seen, *self._end()]

    def complete(self, at: float) -> bool:
        """Check whether all reports up to a time [s] have arrived."""
        scene = self.scene
        if self.over:
            return True
        if scene is None or not self._arrived(scene):
            return False
        return self.reached >= at - EPSILON

    def wait(self, now: float) -> list[Input]:
        """Give up reports that have been missing too long; return the inputs for the dialogue.

        Args:
            now: [s] on the monotonic clock.
        """
        scene = self.scene
        if scene is None or self.over or self._arrived(scene):
            self.missing = None
            return []
        at = (self.traces.next, self.events.next)
        if self.missing is None or self.missing[1:] != at:
            self.missing = (now, *at)
            return []
        if now < self.missing[0] + PATIENCE:
            return []
        self.missing = None
        traces = self.traces.give_up(scene.traces)
        events = self.events.give_up(scene.events)
        return [*self._gaps(), *traces, *events, *self._end()]

    def _gaps(self) -> list[Input]:
        """Return an input for each gap left by reports that were given up."""
        gaps = (*self.traces.told(self.reached), *self.events.told(self.reached))
        return [RecordMissing(since, until) for since, until in gaps]

    @property
    def lost(self) -> int:
        """The number of reports that were given up."""
        return self.traces.lost + self.events.lost

    def _arrived(self, scene: SceneReport) -> bool:
        return self.traces.next >= scene.traces and self.events.next >= scene.events

    def _end(self) -> list[Input]:
        scene = self.scene
        if self.over or scene is None or scene.state != "ended" or not self._arrived(scene):
            return []
        self.over = True
        return [RideEnded(scene.sim_time)]
