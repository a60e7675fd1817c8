"""Files that hold plan traces: one trace, lines with one each, or a recorded ride."""

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import msgspec

from planner.errors import TraceError
from planner.record.trace import MAX_BYTES, PlanTrace
from planner.record.trace_reading import decode
from xavi_dialogue.process.exit_status import UsageFault
from xavi_dialogue.storage.ride_file import ENDING, RideFileError, parse, unpacked

MAX_RIDE_BYTES = 64 * 1024 * 1024
MAX_RIDE_LINES = 20_000
GZIP = b"\x1f\x8b"
MCAP = b"\x89MCAP"  # what a recording begins with
HEADER = 4096  # bytes of a line, within which the scenario is named if it begins a saved ride
WANTED = "give plan traces, or a ride that `xavi drive --save` or `Ride.save` wrote"
EPSILON = 1e-6  # [s]


class TraceFileError(UsageFault):
    """A file that holds no trace that can be shown, or not the one asked for."""


@dataclass(frozen=True, slots=True)
class Traces:
    """The contents of a file."""

    traces: tuple[PlanTrace, ...]
    ride: bool  # whether it is a recorded ride


def load(name: str) -> Traces:
    """Read a file; `-` is standard input, and a saved ride needs no ending.

    Raises:
        TraceFileError: it cannot be opened, or holds no trace; the message names it.
    """
    data = content(name)
    try:
        return read(data)
    except TraceFileError as error:
        raise TraceFileError(f"{name}: {error}; {WANTED}") from error


def content(name: str) -> bytes:
    """Return the bytes of a file; `-` is standard input, and a saved ride needs no ending.

    Raises:
        TraceFileError: it cannot be opened, or is too large.
    """
    if name == "-" and sys.stdin is None:
        raise TraceFileError("cannot read -: standard input is closed")
    try:
        with sys.stdin.buffer if name == "-" else _file(name).open("rb") as source:
            data = source.read(MAX_RIDE_BYTES + 1)
    except (OSError, ValueError) as error:
        raise TraceFileError(f"cannot read {name}: {error}") from error
    if len(data) > MAX_RIDE_BYTES:
        raise TraceFileError(f"{name} is larger than {MAX_RIDE_BYTES} bytes")
    return data


def _file(name: str) -> Path:
    path = Path(name)
    saved = path.with_name(f"{path.name}{ENDING}") if path.name else path
    return saved if not path.exists() and saved.is_file() else path


def read(data: bytes) -> Traces:
    """Read a trace, lines with one each, or a ride, gzipped or not.

    Raises:
        TraceFileError: it is neither.
    """
    if data.startswith(MCAP):
        raise TraceFileError(
            "it is a recording, which `xavi explain` and `xavi report` read; its name ends in .mcap"
        )
    text = _unpacked(data)
    if text.count(b"\n") > MAX_RIDE_LINES:
        raise TraceFileError(f"has more than {MAX_RIDE_LINES} lines")
    if text.lstrip()[:1] == b"[":
        raise TraceFileError("it is an array of JSON; write each trace in a line of its own")
    if _begins_ride(text.partition(b"\n")[0]):
        return _ride(text)
    lines = text.split(b"\n") if text.count(b"\n{") else [text]
    found = {
        number: _decoded(line.strip(), number if len(lines) > 1 else None)
        for number, line in enumerate(lines, 1)
        if line.strip()
    }
    return Traces(_of_one_vehicle(found), ride=False)


def _begins_ride(line: bytes) -> bool:
    """Check whether a line, which may be broken, is the first one of a saved ride."""
    if b'"scenario"' not in line[:HEADER]:
        return False
    try:
        return "schema" not in msgspec.json.decode(line, type=dict[str, msgspec.Raw])
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError):
        return b'"schema"' not in line[:HEADER]


def _decoded(data: bytes, line: int | None) -> PlanTrace:
    try:
        return decode(_compact(data) if len(data) > MAX_BYTES else data)
    except TraceError as error:
        where = "" if line is None else f"line {line}: "
        raise TraceFileError(f"{where}{error}") from error


def _compact(data: bytes) -> bytes:
    """Return JSON without the spaces that some writers put in, so that its size is that of it."""
    try:
        return msgspec.json.format(data, indent=-1)
    except (msgspec.MsgspecError, UnicodeDecodeError, RecursionError):
        return data


def _of_one_vehicle(traces: Mapping[int, PlanTrace]) -> tuple[PlanTrace, ...]:
    """Return the traces in order of time, given by their lines."""
    if not traces:
        raise TraceFileError("the file is empty")
    names = sorted({trace.vehicle for trace in traces.values()})
    if len(names) > 1:
        raise TraceFileError(f"holds traces of {' and '.join(names)}; give those of one vehicle")
    lines: dict[float, int] = {}
    for line, trace in traces.items():
        first = lines.setdefault(trace.sim_time, line)
        if first != line:
            raise TraceFileError(
                f"lines {first} and {line} hold decisions of the same time, {trace.sim_time:g} s; "
                "give one for each time"
            )
    return tuple(sorted(traces.values(), key=lambda trace: trace.sim_time))


def choose(held: Traces, decision: int | None, at: float | None) -> PlanTrace | None:
    """Return the wanted decision; None if one of several is still to be chosen.

    Args:
        held: the contents of the file.
        decision: running number of the decision.
        at: [s] the latest decision up to then.

    Raises:
        TraceFileError: the file holds no such decision.
    """
    found = held.traces
    if decision is not None:
        found = tuple(trace for trace in found if trace.decision == decision)
    if at is not None:
        found = tuple(trace for trace in found if trace.sim_time <= at + EPSILON)[-1:]
    if not found:
        numbers = ", ".join(str(trace.decision) for trace in held.traces) or "none"
        raise TraceFileError(f"there is no such decision in the file; it holds {numbers}")
    return found[0] if len(found) == 1 else None


def _ride(text: bytes) -> Traces:
    try:
        ride = parse(text)
    except RideFileError as error:
        raise TraceFileError(str(error)) from error
    if not ride.traces:
        raise TraceFileError("the ride holds no decision; drive it again, and longer")
    return Traces(tuple(ride.traces), ride=True)


def _unpacked(data: bytes) -> bytes:
    if not data.startswith(GZIP):
        return data
    try:
        return unpacked(data, MAX_RIDE_BYTES)
    except RideFileError as error:
        raise TraceFileError(str(error)) from error
