"""`xavi replay`: a recorded ride on the bus, as if a car drove it; no SUMO is needed.

Traces and events come once each, in their order, those that are skipped at once. Scenes go on
with rising numbers, also where their time goes back.
"""

import queue
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TypeAlias

import msgspec

from planner.record.events import Event
from sim.roads.netfile import NetworkError, read_network
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Bus, Call, CallHandler, Keys
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import (
    CarState,
    EventReport,
    Failure,
    SceneReport,
    TraceReport,
    pack,
)
from xavi_dialogue.nlg.narration import clock
from xavi_dialogue.process import child_commands
from xavi_dialogue.runtime import system
from xavi_dialogue.storage.mcap_file import read
from xavi_dialogue.storage.recording_format import (
    RecordedMessages,
    RecordingError,
    read_ride,
    unpacked,
)
from xavi_dialogue.vehicle.bus_session import (
    CHILD_PATIENCE,
    HUB_PATIENCE,
    QuitBeforeRide,
    claim,
    joined,
)
from xavi_dialogue.vehicle.episode import Moment
from xavi_dialogue.vehicle.map_server import serve_roads
from xavi_dialogue.vehicle.node import COUNTERS, SHOWN_EVERY, Pace, serve
from xavi_dialogue.vehicle.replanning import Replanner, workers
from xavi_dialogue.vehicle.telemetry import KEPT_EVENTS, KEPT_TRACES

NO_ROADS = "the recording holds no roads to plan on"

Note: TypeAlias = Callable[[str], None]


@dataclass
class Player:
    """A player that reports a recorded ride like a car; accepts the same commands, and Seek."""

    recorded: RecordedMessages
    bus: Bus
    keys: Keys
    pace: Pace
    record: Callable[[Moment], None] = lambda _: None  # called with every published decision
    note: Note = lambda _: None  # called with notes for the sender of commands
    alive: HealthReporter = field(default_factory=lambda: HealthReporter("car", COUNTERS))
    ride: str = field(default_factory=lambda: system.token(4))
    index: int = 0  # of the scene that is shown
    traces: int = 0  # number published
    events: list[Event] = field(default_factory=list)  # published
    scenes: int = 0  # number published
    told: tuple[int, int] = (0, 0)  # traces and events that the car had reported so far
    due: float = 0.0  # [s] on the monotonic clock, when the next scene is due
    shown: float = 0.0  # [s] on the monotonic clock, when the last scene was shown

    def __post_init__(self) -> None:
        self._scene = self.bus.publisher(self.keys.of("scene"))
        self._trace = self.bus.publisher(self.keys.of("trace"), keep=KEPT_TRACES)
        self._event = self.bus.publisher(self.keys.of("event"), keep=KEPT_EVENTS)
        self._first = self.recorded.first

    @property
    def at_end(self) -> bool:
        """Whether this is the last scene."""
        return self.index == len(self.recorded.scenes) - 1

    def play(self, orders: child_commands.Orders, *, stays: bool) -> None:
        """Play to the end, or until asked to quit.

        Args:
            orders: about the pace.
            stays: after the end, until asked to quit.
        """
        self.go_to(self.index)
        while not self.pace.quit and (stays or not self.at_end):
            self._listen(orders, min(self._delay(), SHOWN_EVERY))
            halted = self.at_end or not self.pace.running
            if halted:
                self._show()
                self.due = system.monotonic()
            elif self._delay() <= 0.0:
                self._advance()

    def go_to(self, index: int) -> None:
        """Publish a scene, and all reports that were known by then."""
        self.index = index
        scene = self._publish_record()
        self.pace.arrive(scene.sim_time, self.events)
        self._show(always=True)
        self.due = system.monotonic()

    def _delay(self) -> float:
        """Return the time [s] to the next scene."""
        if self.at_end or not self.pace.running:
            return SHOWN_EVERY
        if self.pace.speed == 0.0:
            return 0.0
        ahead = self.recorded.times[self.index + 1] - self.recorded.times[self.index]
        return self.due + ahead / self.pace.speed - system.monotonic()

    def _advance(self) -> None:
        times = self.recorded.times
        if self.pace.speed > 0.0:
            self.due += (times[self.index + 1] - times[self.index]) / self.pace.speed
        self.index += 1
        scene = self._publish_record()
        self.pace.arrive(scene.sim_time, self.events)
        self._show(always=not self.pace.running or self.at_end)

    def _listen(self, orders: child_commands.Orders, patience: float) -> None:
        try:
            order = orders.get(timeout=patience) if patience > 0.0 else orders.get_nowait()
        except queue.Empty:
            return
        self.pace.obey(order)
        index = self.index
        match order:
            case child_commands.Seek(time):
                self.tell_end(time)
                index = self.recorded.index_at(time)
            case child_commands.Until(float(time)):
                self.tell_end(time)
        self.go_to(index)

    def tell_end(self, wanted: float) -> None:
        """Write a note with the end of the recording, if a time [s] is later."""
        if self.recorded.ends_before(wanted):
            self.note(f"the recording ends at {clock(self.recorded.times[-1])}")

    def _publish_record(self) -> SceneReport:
        """Publish the decisions and events that were known when the scene was seen."""
        scene = self.recorded.scene(self.index)
        traces, events = self.recorded.known(scene)
        while self.traces < traces:
            self._publish_trace(scene)
        numbers = self.recorded.event_numbers
        for event in self.recorded.events[len(self.events) : events]:
            report = EventReport(
                ride=self.ride,
                seq=numbers[len(self.events)],  # missing reports stay missing
                sim_time=event.sim_time,
                wall_time=system.wall(),
                event=event,
            )
            self.alive.count("events")
            self._event.put(pack(report))
            self.events.append(event)
        return scene

    def _publish_trace(self, scene: SceneReport) -> None:
        trace = self.recorded.trace(self.traces)
        report = TraceReport(
            ride=self.ride,
            seq=self.recorded.trace_numbers[self.traces],
            sim_time=trace.sim_time,
            wall_time=system.wall(),
            trace=trace,
            first=self._first,
        )
        self.alive.count("decisions")
        self.record(Moment(scene.scene(), scene.plan, trace))
        self._trace.put(pack(report))
        self.traces += 1

    def _show(self, *, always: bool = False) -> None:
        if not always and system.monotonic() - self.shown < 0.9 * SHOWN_EVERY:
            return
        scene = self.recorded.scene(self.index)
        # Published reports stay known when the ride goes back; missing reports stay missing.
        self.told = (
            max(self.told[0], scene.traces),
            max(self.told[1], scene.events),
        )
        report = msgspec.structs.replace(
            scene,
            ride=self.ride,
            seq=self.scenes,
            wall_time=system.wall(),
            state=self._state(),
            speed_factor=self.pace.speed,
            traces=self.told[0],
            events=self.told[1],
            orders=self.pace.obeyed,
        )
        self.alive.count("scenes")
        self.alive.at(report.sim_time)
        self._scene.put(pack(report))
        self.scenes += 1
        self.shown = system.monotonic()

    def _state(self) -> CarState:
        if self.at_end:
            return "ended" if self.recorded.finished else "paused"
        return "driving" if self.pace.running else "paused"


@dataclass(frozen=True)
class ReplayOptions:
    """Options of replaying."""

    path: Path
    link: Link
    speed: float = 1.0  # recorded seconds per second; 0 is as fast as possible
    start: float = 0.0  # [s] of the ride
    car: str | None = None  # which one of the recording; None: the only one
    vehicle: str | None = None  # name under which it is played; None: its own
    controlled: bool = False  # by a parent process: halts at first, and stays


def load(path: Path, car: str | None, note: Note) -> RecordedMessages:
    """Read the ride to play.

    Raises:
        RecordingError: there is none, or it cannot be read.
    """
    try:
        recorded, why = read_ride(read(path), car)
    except RecordingError as error:
        told = str(error)
        raise type(error)(told if str(path) in told else f"{path}: {told}") from error
    if why is not None:
        note(f"warning: {path}: {why}; what is whole of it is played")
    return recorded


def replay(show: ReplayOptions, note: Note) -> None:
    """Play a recording on a bus; commands come on standard input.

    Raises:
        HubUnreachable: there is no hub at the endpoint.
        NameTaken: there is a car of this name on the bus.
        RecordingError: the file cannot be played.
    """
    orders: child_commands.Orders = queue.SimpleQueue()
    signals = child_commands.Signals()
    signals.listen(orders)
    recorded = load(show.path, show.car, note)
    keys = Keys(show.vehicle or recorded.vehicle)
    patience = CHILD_PATIENCE if show.controlled else HUB_PATIENCE
    alive = HealthReporter("car", COUNTERS)
    with suppress(QuitBeforeRide), joined(show.link, signals, patience) as bus:
        claim(bus, keys, signals)
        child_commands.listen(sys.stdin, orders, None if show.controlled else note)
        with planning_for(recorded, bus, keys, alive, note) as (planning, record):
            serve(bus, keys, planning, alive)
            if not show.controlled:
                note(f"playing {recorded.times[-1]:.1f} s of {recorded.vehicle} as {keys.vehicle}")
            pace = Pace(show.speed, running=not show.controlled)
            tell = partial(_warn, note) if show.controlled else note
            player = Player(recorded, bus, keys, pace, record, tell, alive)
            player.tell_end(show.start)
            player.index = recorded.index_at(show.start)
            player.play(orders, stays=True)


def _warn(note: Note, text: str) -> None:
    """Write notes for the passenger, through the process that plays the recording."""
    note(f"warning: {text}")


@contextmanager
def planning_for(
    recorded: RecordedMessages, bus: Bus, keys: Keys, alive: HealthReporter, note: Note
) -> Iterator[tuple[CallHandler, Callable[[Moment], None]]]:
    """Start planning again from recorded decisions; yield it with the recorder of moments."""
    with tempfile.TemporaryDirectory(prefix="xavi-") as folder:
        path = Path(folder) / "network.net.xml"
        if not find_network(recorded, path):
            note(f"warning: {NO_ROADS}; what would have been cannot be asked")
            yield _refuse, lambda _: None
            return
        serve_roads(bus, keys, path)
        with workers(path) as pool:
            planning = Replanner(pool, max(len(recorded.traces), 1), alive)
            yield planning, planning.record


def find_network(recorded: RecordedMessages, path: Path) -> bool:
    """Write the road network of the decisions to a file; return whether there is one."""
    wanted = recorded.trace(0).network if recorded.traces else None
    for packed in recorded.networks:
        text = unpacked(packed)
        if text is None:
            continue
        path.write_bytes(text)
        try:
            if wanted in (None, read_network(path).hash):
                return True
        except NetworkError:
            continue
    return False


def _refuse(call: Call) -> None:
    call.refuse(pack(Failure(reason="planner-unavailable", detail=NO_ROADS)))
