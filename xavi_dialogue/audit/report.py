"""The files of an audit, beside its rides: tables, page, and a list of hashes."""

import hashlib
from collections import Counter
from pathlib import Path
from typing import Final

import msgspec

from xavi_dialogue.audit.audit import Audit
from xavi_dialogue.audit.results.changes import Earlier, changes
from xavi_dialogue.audit.results.findings import KINDS, Finding, findings
from xavi_dialogue.audit.results.page import ONE, TITLES, page
from xavi_dialogue.audit.results.plots import plots
from xavi_dialogue.audit.results.reports import write_reports
from xavi_dialogue.audit.results.tables import tables
from xavi_dialogue.audit.store import Store

PAGE: Final = "audit.html"
LIST: Final = "audit.json"
SCHEMA: Final = "xavi.audit/1"


class Summary(msgspec.Struct, frozen=True):
    """What an audit came to."""

    schema: str
    program: str
    questions: tuple[str, ...]
    rides: int
    failed: dict[str, str]  # reasons by ride
    findings: dict[str, int]  # their numbers by kind
    files: dict[str, str]  # SHA-256 of tables, page, reports and rides, by name

    def table(self) -> str:
        """Return it as text."""
        asked = len(self.questions)
        rides = f"{self.rides} ride{'s' * (self.rides != 1)}"
        lines = [f"{rides}, {asked} question{'s' * (asked != 1)} each"]
        lines += [f"{count:6} {_named(kind, count)}" for kind, count in self.findings.items()]
        lines += [f"failed: {ride}: {why}" for ride, why in self.failed.items()]
        return "\n".join(lines)


def write(
    audit: Audit, store: Store, top: int, before: Earlier | None, reports: int = 0
) -> Summary:
    """Write all files of an audit.

    Args:
        audit: the rides.
        store: its folder.
        top: number of findings of each kind that the page shows.
        before: an earlier audit to compare with.
        reports: number of findings of each kind of which a report is written.

    Raises:
        AuditError: there is nothing to compare with the earlier audit.
        AuditFailed: they cannot be written.
    """
    changed = None if before is None else changes(before, audit)
    found = findings(audit, changed or ())
    written = tables(audit, found, changed)
    program = None if before is None else before.program
    reported = write_reports(audit, found, store, reports)
    written[PAGE] = page(audit, found, plots(audit), top, program, reported)
    for name, data in written.items():
        store.write(name, data)
    written |= {name: store.read(name) for name in reported.values()}
    hashes = {name: hashlib.sha256(data).hexdigest() for name, data in sorted(written.items())}
    summary = Summary(
        schema=SCHEMA,
        program=audit.program,
        questions=tuple(map(str, audit.questions)),
        rides=len(audit.rides),
        failed={source.ride: why for source, why in audit.failed},
        findings=_counted(found, compared=changed is not None),
        files={**hashes, **{one.file: one.facts.ride_hash for one in audit.rides}},
    )
    store.write(LIST, msgspec.json.format(msgspec.json.encode(summary)) + b"\n")
    return summary


def _named(kind: str, count: int) -> str:
    """Return a kind of findings in words, of one or of several."""
    return (ONE if count == 1 else TITLES)[kind].lower()


def page_of(folder: Path) -> Path:
    """Return where the page of an audit is."""
    return folder / PAGE


def _counted(found: tuple[Finding, ...], *, compared: bool) -> dict[str, int]:
    counts = Counter(one.kind for one in found)
    return {kind: counts[kind] for kind in KINDS if compared or kind != "changed-answer"}
