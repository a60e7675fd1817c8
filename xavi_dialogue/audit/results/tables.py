"""Tables of an audit in Parquet; the same audit gives the same bytes."""

import io
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from xavi_dialogue.audit.errors import needing
from xavi_dialogue.errors import XaviError

with needing("audit", "pip install pyarrow"):
    import pyarrow as pa
    import pyarrow.parquet as pq

if TYPE_CHECKING:
    from xavi_dialogue.audit.audit import Audit, Looked
    from xavi_dialogue.audit.results.changes import Change
    from xavi_dialogue.audit.results.findings import Finding

RIDES: Final = "rides.parquet"
ANSWERS: Final = "answers.parquet"
DECISIONS: Final = "decisions.parquet"
MISTAKES: Final = "predictions.parquet"
FINDINGS: Final = "findings.parquet"
CHANGES: Final = "changes.parquet"

_TEXT, _REAL, _COUNT, _FLAG = pa.string(), pa.float64(), pa.int64(), pa.bool_()


def _schema(**columns: pa.DataType) -> pa.Schema:
    return pa.schema(list(columns.items()))


_RIDES: Final = _schema(
    ride=_TEXT, program=_TEXT, scenario=_TEXT, seed=_COUNT, file=_TEXT, ride_hash=_TEXT,
    ride_bytes=_COUNT, end=_REAL, ending=_TEXT, decisions=_COUNT, close_decisions=_COUNT,
    wrong_predictions=_COUNT, mattered=_COUNT, questions=_COUNT, refusals=_COUNT,
    braking=_REAL, braking_at=_REAL, distance=_REAL, distance_at=_REAL, distance_vehicle=_COUNT,
    time_to_collision=_REAL, time_to_collision_at=_REAL, time_to_collision_vehicle=_COUNT,
    collision_speed=_REAL, collision_at=_REAL, collision_vehicle=_COUNT,
)  # fmt: skip
_ANSWERS: Final = _schema(
    ride=_TEXT, question=_TEXT, when=_TEXT, at=_REAL, kind=_TEXT, reason=_TEXT, text=_TEXT,
    content=_TEXT, traces=pa.list_(_TEXT),
)  # fmt: skip
_DECISIONS: Final = _schema(
    ride=_TEXT, at=_REAL, trace_id=_TEXT, chosen=_TEXT, rival=_TEXT, margin=_REAL, error=_REAL,
    close=_FLAG,
)  # fmt: skip
_MISTAKES: Final = _schema(
    ride=_TEXT, vehicle=_COUNT, who=_TEXT, begin=_REAL, end=_REAL, expected=_TEXT,
    probability=_REAL, came=_TEXT, given=_REAL, came_at=_REAL, mattered=_FLAG, at=_REAL,
    trace_id=_TEXT, chosen=_TEXT, instead=_TEXT, gain=_REAL,
)  # fmt: skip
_FINDINGS: Final = _schema(
    kind=_TEXT, rank=_COUNT, ride=_TEXT, at=_REAL, value=_REAL, unit=_TEXT, text=_TEXT,
    vehicle=_COUNT, trace_id=_TEXT, question=_TEXT,
)  # fmt: skip
_CHANGES: Final = _schema(
    ride=_TEXT, question=_TEXT, when=_TEXT, at=_REAL, before_kind=_TEXT, kind=_TEXT, before=_TEXT,
    now=_TEXT, ride_changed=_FLAG,
)  # fmt: skip


_SCHEMAS: Final = {
    RIDES: _RIDES, ANSWERS: _ANSWERS, DECISIONS: _DECISIONS, MISTAKES: _MISTAKES,
    FINDINGS: _FINDINGS, CHANGES: _CHANGES,
}  # fmt: skip


class TableFault(XaviError):
    """A table that cannot be read."""


def tables(
    audit: "Audit", findings: Sequence["Finding"], changes: Sequence["Change"] | None
) -> dict[str, bytes]:
    """Return the tables of an audit as files, by name; that of changes if they were looked for."""
    rides = [(one.source.ride, one) for one in audit.rides]
    found = {
        RIDES: _packed(_RIDES, [ride_row(audit.program, one) for one in audit.rides]),
        ANSWERS: _packed(_ANSWERS, [{"ride": r, **_plain(a)} for r, o in rides for a in o.answers]),
        DECISIONS: _packed(
            _DECISIONS,
            [{"ride": r, "close": c.close, **_plain(c)} for r, o in rides for c in o.facts.choices],
        ),
        MISTAKES: _packed(
            _MISTAKES, [{"ride": r, **_plain(m)} for r, o in rides for m in o.facts.mistakes]
        ),
        FINDINGS: _packed(_FINDINGS, [_plain(one) for one in findings]),
    }
    if changes is not None:
        found[CHANGES] = _packed(_CHANGES, [_plain(one) for one in changes])
    return found


def ride_row(program: str, one: "Looked") -> dict[str, Any]:
    """Return the row of a ride."""
    facts, answers = one.facts, one.answers
    row: dict[str, Any] = {
        "ride": one.source.ride,
        "program": program,
        "file": one.file,
        "close_decisions": sum(choice.close for choice in facts.choices),
        "wrong_predictions": len(facts.mistakes),
        "mattered": sum(wrong.mattered is True for wrong in facts.mistakes),
        "questions": sum(answer.at is not None for answer in answers),
        "refusals": sum(answer.kind in ("refusal", "clarification") for answer in answers),
    }
    for name in ("scenario", "seed", "ride_hash", "ride_bytes", "end", "ending", "decisions"):
        row[name] = getattr(facts, name)
    for name in ("braking", "distance", "time_to_collision", "collision"):
        peak = getattr(facts, name)
        if peak is not None:
            row["collision_speed" if name == "collision" else name] = peak.value
            row[f"{name}_at"], row[f"{name}_vehicle"] = peak.at, peak.vehicle
    return row


def read(path: Path) -> list[dict[str, Any]]:
    """Read a table that `tables` wrote; its name says which.

    Raises:
        TableFault: it cannot be read.
    """
    try:
        found = pq.read_table(path)
        if not found.schema.equals(_SCHEMAS[path.name]):
            raise TableFault(f"{path.name} has other columns")
        rows: list[dict[str, Any]] = found.to_pylist()
    except (OSError, pa.ArrowException) as error:
        why = "is missing" if isinstance(error, FileNotFoundError) else "cannot be read"
        raise TableFault(f"{path.name} {why}") from error
    return rows


def _plain(value: Any) -> dict[str, Any]:
    return {name: getattr(value, name) for name in value.__struct_fields__}


def _packed(schema: pa.Schema, rows: Sequence[dict[str, Any]]) -> bytes:
    columns = [[row.get(name) for row in rows] for name in schema.names]
    arrays = [pa.array(c, type=t) for c, t in zip(columns, schema.types, strict=True)]
    sink = io.BytesIO()
    pq.write_table(pa.Table.from_arrays(arrays, schema=schema), sink, compression="zstd")
    return sink.getvalue()
