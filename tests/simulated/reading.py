"""Reading of messages in the simulated world: what many read is read once.

Messages are frozen, so that all readers may share them. Equal decisions are one object in all runs,
which keeps what was computed about it, such as its name.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache, lru_cache
from typing import Any

import msgspec

from planner.record.trace import PlanTrace
from planner.record.trace_reading import fault_of
from xavi_dialogue.bus import messages
from xavi_dialogue.bus.messages import TraceReport

REMEMBERED = 8192  # messages

_FIELDS = msgspec.structs.fields(TraceReport)
_Bare: Any = msgspec.defstruct(
    "_Bare",
    [
        (one.name, msgspec.Raw if one.name == "trace" else one.type)
        if one.required
        else (one.name, one.type, one.default)
        for one in _FIELDS
    ],
    kw_only=True,
)


@contextmanager
def read_once() -> Iterator[None]:
    """Read each message once within."""
    before = messages.decode, messages.fault_of
    messages.decode, messages.fault_of = _decoded, _fault_of  # type: ignore[assignment]
    try:
        yield
    finally:
        messages.decode, messages.fault_of = before


@lru_cache(REMEMBERED)
def _decoded(data: bytes, kind: Any) -> Any:
    if kind is not TraceReport:
        return msgspec.json.decode(data, type=kind)
    bare = msgspec.json.decode(data, type=_Bare)
    fields = {one.name: getattr(bare, one.name) for one in _FIELDS}
    return TraceReport(**{**fields, "trace": _trace(bytes(bare.trace))})


_checked: dict[int, tuple[PlanTrace, str | None]] = {}  # what is wrong with it, by its address


def _fault_of(trace: PlanTrace) -> str | None:
    if id(trace) not in _checked:
        _checked[id(trace)] = trace, fault_of(trace)
    return _checked[id(trace)][1]


@cache
def _trace(data: bytes) -> PlanTrace:
    return msgspec.json.decode(data, type=PlanTrace)
