"""Recorded rides: traces, events and replanned decisions, as gzipped JSON lines."""

import gzip
import hashlib
import zlib
from dataclasses import dataclass, field
from pathlib import Path

import msgspec

from planner.record.events import Event
from planner.record.trace import READABLE, PlanTrace, WhatIf, fault_of
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.process.exit_status import UsageFault

ENDING = ".ride.jsonl.gz"


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
    return path if path.suffix else path.with_name(path.name + ENDING)


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
        lines = gzip.decompress(data).splitlines()
        first, *rest = (msgspec.json.decode(line, type=_Line) for line in lines)
    except (OSError, EOFError, ValueError, zlib.error, msgspec.MsgspecError) as error:
        raise RideFileError(f"not a recorded ride: {error}") from error
    if first.scenario is None or first.seed is None or first.halt is None:
        raise RideFileError("not a recorded ride: its first line names no scenario")
    ride = RecordedRide(first.scenario, first.seed, first.halt)
    for line in rest:
        if line.trace is not None:
            _check(line.trace)
        if line.whatif is not None and line.trace is not None:
            ride.whatifs[line.whatif] = line.trace
        elif line.whatif is not None and line.failure is not None:
            ride.failures[line.whatif] = line.failure
        elif line.trace is not None:
            ride.traces.append(line.trace)
        elif line.event is not None:
            ride.events.append(line.event)
        else:
            ride.ended = line.ended
    return ride


def _check(trace: PlanTrace) -> None:
    fault = fault_of(trace)
    if trace.schema not in READABLE:
        fault = f"trace schema is {trace.schema!r}"
    if fault is not None:
        raise RideFileError(f"not a recorded ride: decision {trace.decision}: {fault}")
