"""`xavi record`: a recorder of the messages about one car or all cars.

Handlers on threads of the bus only queue messages; one thread checks and writes them.
"""

import logging
import queue
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import TypeAlias

from xavi_dialogue import __version__
from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import DEFAULT_VEHICLE, EVERY_CAR, Bus, Keys, Outcome, vehicle_in
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import Report, SceneReport, TurnReport, unpack
from xavi_dialogue.process import child_commands
from xavi_dialogue.storage.mcap_file import McapWriter
from xavi_dialogue.storage.recording_format import (
    MAX_PACKED,
    MIB,
    OVERHEAD,
    Entry,
    kind_of,
    network_name,
    unpacked,
)
from xavi_dialogue.vehicle.bus_session import CHILD_PATIENCE, HUB_PATIENCE, QuitBeforeRide, joined
from xavi_dialogue.vehicle.map_server import NETWORK

_LOG = logging.getLogger(__name__)
EVERY = "all"  # stands for all cars
NETWORK_PATIENCE = 10.0  # [s] for a car to send its roads
FLUSHED_EVERY = 1.0  # [s]
LOOK = 0.2  # [s] between checks for a request to stop
MAX_WAITING = 64 * MIB  # bytes that may wait to be written; beyond, messages are discarded
AT_ONCE = 500  # messages written between checks for flushing and stopping
MAX_RIDES = 200  # greatest number of rides that the file describes
MAX_APART = 10_000  # numbers of a ride that are remembered while earlier ones are missing
COUNTERS = ("messages", "bytes", "dropped", "rejected")

Note: TypeAlias = Callable[[str], None]
_Job: TypeAlias = Callable[[], None]


@dataclass
class SeenNumbers:
    """The sequence numbers that were seen."""

    below: int = 0  # all numbers below this one were seen
    apart: set[int] = field(default_factory=set)

    def new(self, number: int) -> bool:
        """Add a number; return whether it is new."""
        if number < self.below or number in self.apart:
            return False
        self.apart.add(number)
        if len(self.apart) > MAX_APART:
            self.below = min(self.apart)
        while self.below in self.apart:
            self.apart.remove(self.below)
            self.below += 1
        return True


class Recorder:
    """A recorder of the messages about a car."""

    def __init__(self, bus: Bus, keys: Keys, file: McapWriter, note: Note) -> None:
        """Begin to record, once opened.

        Args:
            bus: of the car.
            keys: of the car, or of every car.
            file: gets the messages.
            note: is called with notes on problems.
        """
        self.alive = HealthReporter("recorder", COUNTERS)
        self._bus, self._keys, self._file, self._note = bus, keys, file, note
        self._inbox: queue.SimpleQueue[_Job] = queue.SimpleQueue()
        self._waiting = 0  # bytes
        self._over = False
        self._lock = threading.Lock()
        self._numbers: dict[tuple[str, str], SeenNumbers] = {}  # of a key and a ride
        self._rides: set[tuple[str, str]] = set()
        self._shown: set[str] = set()
        self._flushed = time.monotonic()

    def open(self) -> None:
        """Declare subscriptions."""
        bus, key = self._bus, self._keys.of
        bus.subscribe(key("trace"), self._hear, kept=True)
        bus.subscribe(key("event"), self._hear, kept=True)
        bus.subscribe(key("scene"), self._hear)
        bus.subscribe(key("dialogue/*/turn"), self._hear)
        bus.serve(key("alive/recorder"), self.alive.answer)
        self._show(DEFAULT_VEHICLE if self._keys == EVERY_CAR else self._keys.vehicle)
        _LOG.info("recording", extra={"vehicle": self._keys.vehicle})

    def work(self, patience: float = 0.0) -> None:
        """Write some messages, waiting up to `patience` [s] for them.

        Raises:
            Unwritable: the file cannot be written any further.
        """
        with suppress(queue.Empty):
            self._inbox.get(patience > 0.0, patience)()
            for _ in range(AT_ONCE - 1):
                self._inbox.get_nowait()()
        if time.monotonic() >= self._flushed + FLUSHED_EVERY:
            self._file.flush()
            self._flushed = time.monotonic()

    def finish(self) -> None:
        """Stop receiving, and write all that waits.

        Raises:
            Unwritable: the file cannot be written any further.
        """
        with self._lock:
            self._over = True
        while not self._inbox.empty():
            self.work()

    def _hear(self, key: str, payload: bytes) -> None:
        size = len(payload) + OVERHEAD
        with self._lock:
            if self._over:
                return
            full = self._waiting + size > MAX_WAITING
            if not full:
                self._waiting += size
                self._inbox.put(partial(self._take, key, payload, time.time_ns()))
        if full:
            self.alive.count("dropped")

    def _take(self, key: str, payload: bytes, came: int) -> None:
        with self._lock:
            self._waiting -= len(payload) + OVERHEAD
        vehicle, kind = vehicle_in(key), kind_of(key)
        try:
            report = None if kind is None else unpack(payload, kind)
        except MessageError:
            report = None
        if vehicle is None or report is None:
            self.alive.count("rejected")
        elif self._is_new(key, report):
            published = round(report.wall_time * 1e9) if abs(report.wall_time) < 1e12 else 0
            if self._file.add(Entry(key, payload, report.seq, published, came)):
                self.alive.count("messages")
                self.alive.count("bytes", len(payload))
            else:
                self.alive.count("dropped")
            self.alive.at(report.sim_time)
            if isinstance(report, SceneReport):
                self._know(vehicle, report)

    def _is_new(self, key: str, report: Report | TurnReport) -> bool:
        """Check whether a message is new; those kept for late joiners come more than once."""
        if isinstance(report, (TurnReport, SceneReport)):
            return True
        numbers = self._numbers.setdefault((key, report.ride), SeenNumbers())
        while len(self._numbers) > 2 * MAX_RIDES:
            del self._numbers[next(iter(self._numbers))]
        return numbers.new(report.seq)

    def _know(self, vehicle: str, scene: SceneReport) -> None:
        """Describe a ride that is new, and ask the car for its roads."""
        if (vehicle, scene.ride) in self._rides or len(self._rides) >= MAX_RIDES:
            return
        self._rides.add((vehicle, scene.ride))
        self._show(vehicle)
        facts = {"vehicle": vehicle, "ride": scene.ride, "version": __version__}
        if scene.scenario is not None and scene.seed is not None:
            facts |= {"scenario": scene.scenario, "seed": str(scene.seed)}
        self._file.describe("xavi.ride", facts)
        done = partial(self._on_network, vehicle, scene.ride)
        self._bus.request(Keys(vehicle).of(NETWORK), b"", NETWORK_PATIENCE, done)

    def _on_network(self, vehicle: str, ride: str, outcome: Outcome) -> None:
        self._inbox.put(partial(self._keep_network, vehicle, ride, outcome))

    def _keep_network(self, vehicle: str, ride: str, outcome: Outcome) -> None:
        packed = outcome if isinstance(outcome, bytes) else b""
        if len(packed) <= MAX_PACKED and unpacked(packed) is not None:
            self._file.attach(network_name(vehicle, ride), packed, time.time_ns())
        else:
            self._note(f"warning: {vehicle} does not tell its roads; replayed, it cannot plan")

    def _show(self, vehicle: str) -> None:
        if vehicle not in self._shown:
            self._shown.add(vehicle)
            self._bus.appear(Keys(vehicle).of("alive/recorder"))


@dataclass(frozen=True)
class RecordOptions:
    """Options of recording."""

    path: Path
    link: Link
    vehicle: str = DEFAULT_VEHICLE  # or EVERY
    overwrite: bool = False
    controlled: bool = False  # whether orders come on standard input


def record(task: RecordOptions, note: Note) -> None:
    """Record until asked to stop.

    Args:
        task: what and where.
        note: is called with notes.

    Raises:
        HubUnreachable: there is no hub at the endpoint.
        RecordingError: the file exists, or cannot be written.
    """
    orders: child_commands.Orders = queue.SimpleQueue()
    signals = child_commands.Signals()
    signals.listen(orders)
    if task.controlled:
        child_commands.listen(sys.stdin, orders)
    keys = EVERY_CAR if task.vehicle == EVERY else Keys(task.vehicle)
    try:
        patience = CHILD_PATIENCE if task.controlled else HUB_PATIENCE
        connection = joined(task.link, signals, patience)
    except QuitBeforeRide:
        return
    with (
        connection as bus,
        McapWriter(task.path, __version__, overwrite=task.overwrite) as file,
    ):
        recorder = Recorder(bus, keys, file, note)
        recorder.open()
        if not task.controlled:
            note(f"recording into {task.path}; Ctrl-C ends it")
        while orders.empty() or not isinstance(orders.get(), child_commands.Quit):
            recorder.work(LOOK)
        recorder.finish()
    note(f"{file.messages} messages are in {task.path}")
    dropped = recorder.alive.counted("dropped")
    if dropped:
        note(f"warning: {dropped:.0f} messages are not; they came too fast, or under too many keys")
