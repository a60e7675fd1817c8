"""Recorded rides: traces, events and replanned decisions, as gzipped JSON lines."""

import gzip
import hashlib
import zlib
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import msgspec

from planner.errors import TraceError
from planner.record.events import Event
from planner.record.foreign_text import unprintable
from planner.record.trace import PlanTrace, WhatIf
from planner.record.trace_reading import LATEST, check
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.process.exit_status import UsageFault

ENDING = ".ride.jsonl.gz"
GZIP = 31  # the format in zlib's numbers: of gzip, with any window
MAX_BYTES = 512 * 1024 * 1024  # of a ride, unpacked
MAX_SEED = 2**31 - 1
MAX_NAME = 4096  # letters of a scenario, which may be a path
MAX_AT_ONCE = 16  # events that may share a moment


class RideFileError(UsageFault):
    """A recorded ride that cannot be read or written."""


class _Line(msgspec.Struct, omit_defaults=True):
    """One line: one of the groups `scenario` to `halt`, `whatif` with its result, or a field."""

    scenario: str | None = None
    seed: int | None = None
    halt: float | None = None  # [s] the default moment of questions
    event: Event | None = None
    ended: float | None = None  # [s]
    whatif: str | None = None  # key of a request, see `key`
    failure: str | None = None  # the reason why there is no plan
    trace: PlanTrace | None = None


@dataclass
class RecordedRide:
    """The data of a ride that a conversation about it needs."""

    scenario: str
    seed: int
    halt: float  # [s]
    traces: list[PlanTrace] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)
    ended: float | None = None  # [s]
    whatifs: dict[str, PlanTrace] = field(default_factory=dict)
    failures: dict[str, str] = field(default_factory=dict)  # reasons why there is no plan, by key


def key(need: NeedRollout) -> str:
    """Return the key under which the plan for a request is stored.

    It is the hash of the request: the decision, and its changes.
    """
    what_if = msgspec.convert(msgspec.to_builtins(need), WhatIf)
    return hashlib.sha256(msgspec.json.encode((need.trace_id, what_if))).hexdigest()[:16]


def dump(ride: RecordedRide) -> bytes:
    """Return the ride as a file; the same ride gives the same bytes."""
    lines = [_Line(scenario=ride.scenario, seed=ride.seed, halt=ride.halt)]
    lines += [_Line(trace=trace) for trace in ride.traces]
    lines += [_Line(event=event) for event in ride.events]
    lines += [_Line(ended=ride.ended)] if ride.ended is not None else []
    lines += [_Line(whatif=name, trace=trace) for name, trace in sorted(ride.whatifs.items())]
    lines += [_Line(whatif=name, failure=why) for name, why in sorted(ride.failures.items())]
    text = b"".join(msgspec.json.encode(line) + b"\n" for line in lines)
    return gzip.compress(text, mtime=0)


def named(path: Path) -> Path:
    """Return a path with the ending of recorded rides, unless it has one of its own."""
    return path if path.suffix or not path.name else path.with_name(path.name + ENDING)


def save(ride: RecordedRide, path: Path) -> None:
    """Write the ride to a file.

    Raises:
        RideFileError: the file cannot be written.
    """
    try:
        path.write_bytes(dump(ride))
    except OSError as error:
        raise RideFileError(f"cannot write {path}: {error.strerror}") from error


def load(data: bytes) -> RecordedRide:
    """Read a ride.

    Raises:
        RideFileError: the data is no recorded ride.
    """
    try:
        text = unpacked(data, MAX_BYTES)
    except RideFileError as error:
        raise RideFileError(f"not a recorded ride: {error}") from error
    return parse(text)


def unpacked(data: bytes, most: int) -> bytes:
    """Unpack the text of a gzipped file, of which no more than a limit is ever unpacked.

    Raises:
        RideFileError: it is empty, not packed so, cut off, too large, or more follows it.
    """
    if not data:
        raise RideFileError("the file is empty")
    inflater = zlib.decompressobj(GZIP)
    try:
        text = inflater.decompress(data, most + 1)
    except zlib.error as error:
        raise RideFileError(f"it cannot be unpacked: {error}") from error
    if len(text) > most:
        raise RideFileError(f"it unpacks to more than {most} bytes, the most that is read")
    if not inflater.eof:
        raise RideFileError("it is cut off; copy the file again")
    if inflater.unused_data:
        extra = len(inflater.unused_data)
        raise RideFileError(f"{extra} bytes follow its end; copy the file again")
    return text


def parse(text: bytes) -> RecordedRide:
    """Read a ride from the unpacked text of its file.

    Raises:
        RideFileError: it is no recorded ride.
    """
    ride: RecordedRide | None = None
    for number, data in enumerate(text.splitlines(), 1):
        if not data.strip():
            continue
        try:
            line = _line(data)
            if ride is None:
                ride = _header(line)
            else:
                _add(ride, line)
        except (RideFileError, TraceError) as error:
            raise RideFileError(f"not a recorded ride: line {number}: {error}") from error
    if ride is None:
        raise RideFileError("not a recorded ride: it holds no line")
    return ride


def _line(data: bytes) -> _Line:
    try:
        strange = unprintable(data)
        if strange is not None:
            raise RideFileError(strange)
        return msgspec.json.decode(data, type=_Line)
    except RecursionError as error:
        raise RideFileError("it is nested too deeply") from error
    except (msgspec.MsgspecError, UnicodeDecodeError) as error:
        raise RideFileError(str(error)) from error


def _header(line: _Line) -> RecordedRide:
    if line.scenario is None or line.seed is None or line.halt is None:
        missing = [name for name in ("scenario", "seed", "halt") if getattr(line, name) is None]
        raise RideFileError(f"it names no {', '.join(missing)}")
    if not 0 < len(line.scenario) <= MAX_NAME:
        raise RideFileError(f"`scenario` has no letter, or more than {MAX_NAME}")
    if not 0 <= line.seed <= MAX_SEED:
        raise RideFileError(f"`seed` is not a number from 0 to {MAX_SEED}")
    return RecordedRide(line.scenario, line.seed, _moment("halt", line.halt))


def _add(ride: RecordedRide, line: _Line) -> None:
    """Add what a line holds.

    Raises:
        RideFileError: the line is empty, repeats an earlier one, or is out of order of time.
        TraceError: its trace is of an unknown schema, or contradicts itself.
    """
    if line.trace is not None:
        check(line.trace)
    if line.whatif is not None:
        if line.whatif in ride.whatifs or line.whatif in ride.failures:
            raise RideFileError(f"`whatif` {line.whatif} comes twice")
        if line.trace is not None:
            ride.whatifs[line.whatif] = line.trace
        elif line.failure is not None:
            ride.failures[line.whatif] = line.failure
        else:
            raise RideFileError(f"`whatif` {line.whatif} has no result")
    elif line.trace is not None:
        _check_order("decisions", ride.traces, line.trace)
        ride.traces.append(line.trace)
    elif line.event is not None:
        _check_order("events", ride.events, line.event)
        ride.events.append(line.event)
    elif line.ended is not None and ride.ended is None:
        ride.ended = _moment("ended", line.ended)
    else:
        raise RideFileError("it tells nothing, or the end a second time")


def _moment(name: str, time: float) -> float:
    if not 0.0 <= time <= LATEST:
        raise RideFileError(f"`{name}` is {time:g}; give 0 to {LATEST:g} s")
    return time


def _check_order(
    name: str, before: Sequence[PlanTrace] | Sequence[Event], one: PlanTrace | Event
) -> None:
    """Check that something comes after what is there; events may share a moment, if they differ."""
    if not before:
        return
    last = before[-1].sim_time
    if one.sim_time < last or (isinstance(one, PlanTrace) and one.sim_time == last):
        late = f"{one.sim_time:g} s after {last:g} s"
        raise RideFileError(f"{name} are not in order of time, or come twice: {late}")
    if one in before[-MAX_AT_ONCE:]:
        raise RideFileError(f"{name} come twice: that at {one.sim_time:g} s")
