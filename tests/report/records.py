"""Rides of which reports are made, opened once, and look-ups in their records by source."""

import re
from functools import cache
from pathlib import Path
from typing import Any

import msgspec

import xavi_dialogue as xavi
from planner.record.trace import PlanTrace
from xavi_dialogue.report.content import Incident
from xavi_dialogue.report.figures import Figure, Source

HERE = Path(__file__).parent
UNHEEDED = HERE / "unheeded-0.ride.jsonl.gz"  # a van drives into our way, and does not give way
RIDES = HERE.parents[1] / "transcripts" / "rides"
BRAKING = RIDES / "s2-2.ride.jsonl.gz"
LIGHT = RIDES / "junction-0.ride.jsonl.gz"
STEADY = RIDES / "s1-0.ride.jsonl.gz"  # it never brakes
TOWN = HERE / "town-0.ride.jsonl.gz"  # driven by another version: it turns off before a bus


@cache
def ride(path: Path) -> xavi.Ride:
    """Return a ride with its roads."""
    scenario = HERE / "worlds" / "unheeded" if path == UNHEEDED else None
    return xavi.open(path, scenario=scenario)


@cache
def report(path: Path, at: float | str | None = None) -> xavi.Report:
    """Return the report of a moment of a ride."""
    return ride(path).report(at)


def figures(value: object) -> list[Figure]:
    """Return all figures in a part of a report."""
    return [one for one in _all(value) if isinstance(one, Figure)]


def sources(value: object) -> list[Source]:
    """Return all sources in a part of a report."""
    return [one for one in _all(value) if isinstance(one, Source)]


def _all(value: object) -> list[object]:
    if isinstance(value, msgspec.Struct):
        fields = (getattr(value, name) for name in value.__struct_fields__)
        return [value, *(one for part in fields for one in _all(part))]
    if isinstance(value, dict):
        return [one for part in value.values() for one in _all(part)]
    if isinstance(value, (tuple, list)):
        return [one for part in value for one in _all(part)]
    return []


def traces(path: Path) -> dict[int, PlanTrace]:
    """Return the decisions of a ride by their numbers."""
    return {trace.decision: trace for trace in ride(path).record.traces}


def looked_up(trace: PlanTrace, field: str) -> Any:
    """Return what stands at a path in a trace, by its JSON alone."""
    value: Any = msgspec.json.decode(msgspec.json.encode(trace))
    for step in re.findall(r"[^.\[\]]+", field):
        value = value[int(step)] if isinstance(value, list) else value[step]
    return value


def incident(path: Path, at: str | None = None) -> Incident:
    """Return the content of a report."""
    return report(path, at).content
