"""Answers that changed between two audits."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import msgspec

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
    answers = {
        (row["ride"], row["question"], row["when"]): row for row in _rows(folder, tables.ANSWERS)
    }
    rows = _rows(folder, tables.RIDES)
    rides = {row["ride"]: row["ride_hash"] for row in rows}
    return Earlier(answers, rides, next((row["program"] for row in rows), ""))


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


def _rows(folder: Path, name: str) -> list[dict[str, Any]]:
    try:
        return tables.read(folder / name)
    except tables.TableFault as fault:
        raise AuditError(f"{folder} holds no audit: {fault}; {REMEDY}") from fault
