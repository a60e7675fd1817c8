"""Asking the engine about made-up and recorded rides, with what was planned again beside them."""

from pathlib import Path
from typing import Any

import msgspec

from planner.record.trace import WhatIf
from tests.planted import Moment, decision, without
from tests.stories import rides
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.domain.discourse import GroundedAct, Span
from xavi_dialogue.domain.meaning import Ask
from xavi_dialogue.explain.answers.engine import explain
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import RecordedRide

RECORDED = Path(__file__).parents[3] / "transcripts" / "rides"


def story(name: str) -> RecordedRide:
    """A ride made up for transcripts."""
    return rides()[name]


def recorded(name: str) -> RecordedRide:
    """A ride that was driven in SUMO."""
    return ride_file.load((RECORDED / f"{name}.ride.jsonl.gz").read_bytes())


def single(at: Moment, removed: tuple[int, ...] = ()) -> RecordedRide:
    """A ride of one decision."""
    found = RecordedRide("made", 0, at.time, traces=[decision(at)])
    found.whatifs = {str(v): without(at, v)[1] for v in removed}
    return found


def told(ride: RecordedRide, question: Any, now: float, span: Span | None = None) -> Any:
    """What the engine makes of a question; plans that nobody made are refused.

    A plan that is asked for again after it was refused ends it: there is no answer without it.
    """
    act = GroundedAct(Ask(question), span)
    record = Record(
        now,
        tuple(t for t in ride.traces if t.sim_time <= now),
        tuple(e for e in ride.events if e.sim_time <= now),
        ended=ride.ended is not None and ride.ended <= now,
    )
    found = explain(act, record)
    while isinstance(found, NeedRollout) and found not in record.refused:
        record = _answered(ride, record, found)
        found = explain(act, record)
    return found


def _answered(ride: RecordedRide, record: Record, need: NeedRollout) -> Record:
    wanted = msgspec.convert(msgspec.to_builtins(need), WhatIf)
    origin = next(t for t in record.traces if t.trace_id == need.trace_id)
    for plan in ride.whatifs.values():
        if plan.what_if == wanted and plan.sim_time == origin.sim_time:
            return _planned(record, plan)
    return Record(
        record.now,
        record.traces,
        record.events,
        record.ended,
        record.extra,
        (*record.refused, need),
    )


def _planned(record: Record, plan: Any) -> Record:
    """The record with a plan that was made again."""
    extra = (*record.extra, plan)
    return Record(record.now, record.traces, record.events, record.ended, extra, record.refused)
