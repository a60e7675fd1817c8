"""Answers that changed between two audits."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec

from planner.record.foreign_text import unprintable
from xavi_dialogue.audit.audit import Audit
from xavi_dialogue.audit.errors import AuditError
from xavi_dialogue.audit.results import tables

REMEDY = "give the folder of an audit that ran to its end"


class Change(msgspec.Struct, frozen=True):
    """An answer that is not what it was."""

    ride: str
    question: str
    when: str
    at: float | None  # [s] now
    before_kind: str | None
    kind: str | None
    before: str
    now: str
    ride_changed: bool  # what was driven or recorded is not the same, either


class Earlier(msgspec.Struct, frozen=True):
    """The answers of an earlier audit, by ride, question and moment; and its rides' hashes."""

    answers: Mapping[tuple[str, str, str], Mapping[str, Any]]
    rides: Mapping[str, str]
    program: str


def earlier(folder: Path) -> Earlier:
    """Read an earlier audit.

    Raises:
        AuditError: the folder holds none.
    """
    if not folder.is_dir():
        raise AuditError(f"{folder} is no folder; {REMEDY}")
    answers = _keyed(folder, tables.ANSWERS, ("ride", "question", "when"), ("text",))
    rides = _keyed(folder, tables.RIDES, ("ride",), ("ride_hash", "program"))
    hashes = {name: row["ride_hash"] for (name,), row in rides.items()}
    return Earlier(answers, hashes, next((row["program"] for row in rides.values()), ""))


def changes(before: Earlier, audit: Audit) -> tuple[Change, ...]:
    """Return the answers that changed, in the order of the audit.

    Raises:
        AuditError: the audits have no ride and question in common.
    """
    found, common = [], 0
    for one in audit.rides:
        for answer in one.answers:
            row = before.answers.get((one.source.ride, answer.question, answer.when))
            if row is None:
                continue
            common += 1
            if (row["text"], row["kind"]) != (answer.text, answer.kind):
                same = before.rides.get(one.source.ride) == one.facts.ride_hash
                found.append(
                    Change(
                        one.source.ride, answer.question, answer.when, answer.at, row["kind"],
                        answer.kind, row["text"], answer.text, not same,
                    )
                )  # fmt: skip
    if not common and audit.rides:
        raise AuditError("the earlier audit asked no ride of this one any of these questions")
    return tuple(found)


def _keyed(
    folder: Path, name: str, keys: tuple[str, ...], stated: tuple[str, ...]
) -> dict[Any, dict[str, Any]]:
    """Return the rows of a table by some columns, in their order.

    Args:
        folder: of the audit.
        name: of the table.
        keys: the columns, which tell rows apart.
        stated: further columns in which something has to stand.

    Raises:
        AuditError: it cannot be read, or no audit wrote it.
    """
    try:
        rows = tables.read(folder / name)
        texts = [text for row in rows for text in row.values() if isinstance(text, str)]
        strange = unprintable(msgspec.json.encode([text.replace("\n", " ") for text in texts]))
    except tables.TableFault as fault:
        raise AuditError(f"{folder} holds no audit: {fault}; {REMEDY}") from fault
    found = {tuple(row[key] for key in keys): row for row in rows}
    if strange is not None:
        why = f"{name}: {strange}"
    elif any(row[column] is None for row in rows for column in (*keys, *stated)):
        why = f"{name} has rows that lack {' or '.join((*keys, *stated))}"
    elif len(found) < len(rows):
        why = f"{name} has two rows of the same {' and '.join(keys)}"
    else:
        return found
    raise AuditError(f"{folder} holds no audit: {why}; {REMEDY}")
