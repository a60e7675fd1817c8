"""The format of recordings: messages, their schemas, and the ride that they form.

RecordingError
├── NotARecording   no MCAP file, or not of this program
├── NothingToPlay   no ride in it that can be played
├── TooMuch         more than can be held while it is played
├── FileThere       the file exists already
└── Unwritable      the file cannot be written, or not any further
"""

import zlib
from bisect import bisect_left
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from planner.record import trace as plan_trace
from planner.record.events import Event
from sim.scene import EGO
from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.interface import matches, vehicle_in
from xavi_dialogue.bus.messages import (
    EventReport,
    Report,
    SceneReport,
    TraceReport,
    TurnReport,
    unpack,
)
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.process.exit_status import RunFault, UsageFault

PROFILE = "xavi"
EXPORT = "xavi.export"  # name of the facts that mark an export for viewers
NETWORK_ENDING = ".net.xml.gz"
MIB = 1024 * 1024
MAX_NETWORK = 64 * MIB  # bytes of a road network, unpacked
MAX_PACKED = 8 * MIB  # bytes of a road network, packed
MAX_TAPE = 512 * MIB  # bytes of one car's messages that are held while they are played
OVERHEAD = 512  # overhead in bytes of a message in memory
EPSILON = 1e-6  # [s]

#: The messages that are recorded, by the end of their key.
RECORDED: Mapping[str, type[Report | TurnReport]] = {
    "scene": SceneReport,
    "trace": TraceReport,
    "event": EventReport,
    "dialogue/*/turn": TurnReport,
}


class RecordingError(RunFault):
    """A recording cannot be written, read or played."""


class NotARecording(RecordingError, UsageFault):
    """The file is no MCAP file, or not of this program."""


class NothingToPlay(RecordingError, UsageFault):
    """The recording has no ride that can be played."""


class TooMuch(RecordingError, UsageFault):
    """The recording has more than memory may hold while it is played."""


class FileThere(RecordingError, UsageFault):
    """The file exists already."""


class Unwritable(RecordingError):
    """The file cannot be written, or not any further."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One message as received."""

    key: str
    payload: bytes
    seq: int
    published: int  # [ns since 1970] by the sender's clock
    logged: int  # [ns since 1970] when it came


@dataclass(frozen=True, slots=True)
class AttachedFile:
    """A file within the recording."""

    name: str
    data: bytes


@dataclass(frozen=True, slots=True)
class Truncation:
    """The recording ends here, before its proper end; everything before this is whole."""

    why: str


@dataclass(frozen=True, slots=True)
class ForViewers:
    """The mark at the beginning of an export, which need not hold a ride to play."""


Piece: TypeAlias = Entry | AttachedFile | Truncation | ForViewers


def kind_of(key: str) -> type[Report | TurnReport] | None:
    """Return the type of message that is recorded under a key; None if there is none."""
    tail = key.split("/", 3)[-1]
    return next((kind for end, kind in RECORDED.items() if matches(end, tail)), None)


def network_name(vehicle: str, ride: str) -> str:
    """Return the name of the file with the roads of a ride."""
    return f"{vehicle}/{ride}{NETWORK_ENDING}"


def unpacked(data: bytes) -> bytes | None:
    """Unpack the road network; None if there is none, or it is too large."""
    inflater = zlib.decompressobj(31)
    try:
        text = inflater.decompress(data, MAX_NETWORK)
    except zlib.error:
        return None
    return text if inflater.eof else None


@dataclass(frozen=True, slots=True)
class RecordedMessages:
    """One ride of one car as it was recorded, in order of time."""

    vehicle: str
    ride: str
    times: tuple[float, ...]  # [s] of the scenes; each later than the one before
    scenes: tuple[bytes, ...]  # SceneReports
    traces: tuple[bytes, ...]  # TraceReports
    events: tuple[Event, ...]
    trace_numbers: tuple[int, ...]  # the car's sequence numbers; rising
    event_numbers: tuple[int, ...]
    networks: tuple[bytes, ...] = ()  # packed; see `unpacked`

    def scene(self, index: int) -> SceneReport:
        """Return a scene."""
        return unpack(self.scenes[index], SceneReport)

    def trace(self, index: int) -> plan_trace.PlanTrace:
        """Return a decision."""
        return unpack(self.traces[index], TraceReport).trace

    @property
    def first(self) -> str | None:
        """The id of the ride's first decision; None if there is none."""
        if not self.traces:
            return None
        report = unpack(self.traces[0], TraceReport)
        return report.first or report.trace.trace_id

    def known(self, scene: SceneReport) -> tuple[int, int]:
        """Return the numbers of traces and events that were sent before a scene."""
        return (
            bisect_left(self.trace_numbers, scene.traces),
            bisect_left(self.event_numbers, scene.events),
        )

    def index_at(self, time: float) -> int:
        """Return the index of the first scene from a time [s] on, else of the last one."""
        return min(bisect_left(self.times, time - EPSILON), len(self.times) - 1)

    def ends_before(self, time: float) -> bool:
        """Check whether a time [s] is after the last scene."""
        return self.times[-1] < time - EPSILON

    @property
    def finished(self) -> bool:
        """Whether the ride had ended when the recording did."""
        return self.scene(len(self.scenes) - 1).state == "ended"


@dataclass
class _Track:
    """One ride while it is read."""

    scenes: dict[float, bytes] = field(default_factory=dict)
    traces: dict[int, bytes] = field(default_factory=dict)
    events: dict[int, Event] = field(default_factory=dict)


@dataclass
class _Reading:
    """Cars and their rides, in order of their first messages."""

    tracks: dict[str, dict[str, _Track]] = field(default_factory=dict)
    networks: dict[str, list[bytes]] = field(default_factory=dict)
    why: str | None = None  # the reason why the recording ends too early, if it does
    size: int = 0  # bytes
    exported: bool = False  # whether it is an export for viewers

    def take(self, piece: Piece, only: str | None) -> None:
        """Add a piece of the recording.

        Args:
            piece: the piece.
            only: the car whose messages are kept; None: all.
        """
        match piece:
            case Entry(key=key):
                vehicle, kind = vehicle_in(key), kind_of(key)
                if vehicle is not None and kind in (SceneReport, TraceReport, EventReport):
                    tracks = self.tracks.setdefault(vehicle, {})
                    if only in (None, vehicle):
                        self._count(len(piece.payload))
                        _add(tracks, piece, kind)
            case AttachedFile(name, data) if (
                name.endswith(NETWORK_ENDING) and len(data) <= MAX_PACKED
            ):
                vehicle = name.partition("/")[0]
                if only in (None, vehicle):
                    self._count(len(data))
                    self.networks.setdefault(vehicle, []).append(data)
            case Truncation(why):
                self.why = why
            case ForViewers():
                self.exported = True

    def _count(self, size: int) -> None:
        self.size += size + OVERHEAD
        if self.size > MAX_TAPE:
            raise TooMuch(
                f"it holds more than the {MAX_TAPE // MIB} MiB that can be played;"
                " record less, or name one car with --car"
            )


def _add(tracks: dict[str, _Track], entry: Entry, kind: Any) -> None:
    try:
        report = unpack(entry.payload, kind)
    except MessageError as error:
        raise NotARecording(f"{one_line(entry.key)}: {error}") from error
    track = tracks.setdefault(report.ride, _Track())
    match report:
        case SceneReport():
            if EGO not in report.vehicles:
                raise NotARecording(f"{one_line(entry.key)}: a scene without the car itself")
            track.scenes[report.sim_time] = entry.payload
        case TraceReport():
            if report.trace.schema not in plan_trace.READABLE:
                other = one_line(report.trace.schema)[:64]
                raise NotARecording(f"it holds decisions of the unknown schema {other!r}")
            track.traces[report.seq] = entry.payload
        case EventReport():
            track.events[report.seq] = report.event


def read_ride(
    pieces: Iterable[Piece], vehicle: str | None = None
) -> tuple[RecordedMessages, str | None]:
    """Return the latest ride of a car in a recording.

    Args:
        pieces: of the recording.
        vehicle: name of the car; None: the only one.

    Returns:
        The ride, and why the recording ends too early, if it does.

    Raises:
        NothingToPlay: there is no such ride.
        NotARecording: a message cannot be read.
        TooMuch: it is too large.
    """
    reading = _Reading()
    for piece in pieces:
        reading.take(piece, vehicle)
    name = _chosen(reading, vehicle)
    rides = {ride: one for ride, one in reading.tracks[name].items() if one.scenes}
    if not rides:
        raise NothingToPlay(f"it holds no scene of {name}")
    ride, track = list(rides.items())[-1]
    return _tape(name, ride, track, reading.networks.get(name, ())), reading.why


def _chosen(reading: _Reading, vehicle: str | None) -> str:
    names = tuple(reading.tracks)
    listed = ", ".join(names)
    if not names:
        why = "an export of a saved ride is for viewers alone; give the saved ride"
        if reading.why is not None:
            rest = "; it is an export for viewers: give the ride that it was made of"
            why = reading.why + (rest if reading.exported else "")
        raise NothingToPlay(f"it holds no ride: {why}")
    if vehicle is None and len(names) > 1:
        raise NothingToPlay(f"it holds several cars; name one with --car: {listed}")
    if vehicle is not None and vehicle not in names:
        raise NothingToPlay(f"it holds no car {vehicle!r}; there is: {listed}")
    return vehicle or names[0]


def _tape(vehicle: str, ride: str, track: _Track, networks: Sequence[bytes]) -> RecordedMessages:
    times, traces, events = sorted(track.scenes), sorted(track.traces), sorted(track.events)
    return RecordedMessages(
        vehicle,
        ride,
        tuple(times),
        tuple(track.scenes[time] for time in times),
        tuple(track.traces[number] for number in traces),
        tuple(track.events[number] for number in events),
        tuple(traces),
        tuple(events),
        tuple(networks),
    )
