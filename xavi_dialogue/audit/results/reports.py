"""Reports on findings, beside the page: one HTML file each, named after all that decides it."""

import warnings
from collections.abc import Mapping, Sequence
from shlex import quote
from typing import Final, TypeAlias

from xavi_dialogue.audit.audit import Audit, Looked
from xavi_dialogue.audit.program import digest
from xavi_dialogue.audit.results.findings import Finding, Kind
from xavi_dialogue.audit.store import DIGITS, Store
from xavi_dialogue.library import sources as rides
from xavi_dialogue.process.program import program_hash

FOLDER: Final = "reports"
ENDS: Final = b"</html>\n"
MOMENTS: Final = {"collision": "collision", "hard-braking": "hardest braking"}

Written: TypeAlias = Mapping[tuple[Kind, int], str]  # files of reports, by kind and rank


def write_reports(audit: Audit, findings: Sequence[Finding], store: Store, count: int) -> Written:
    """Write the reports on the foremost findings of each kind; those that are there are kept.

    A finding of which no report can be made has none.

    Args:
        audit: the rides.
        findings: what was found in them.
        store: the folder of the audit.
        count: how many findings of each kind get a report.

    Raises:
        AuditFailed: a file cannot be written.
    """
    looked = {one.source.ride: one for one in audit.rides}
    found: dict[tuple[Kind, int], str] = {}
    for one in findings:
        moment = moment_of(one)
        if one.rank > count or moment is None:
            continue
        ride = looked[one.ride]
        name = f"{FOLDER}/{_key(ride, moment)}.html"
        if store.read(name).endswith(ENDS) or _write(store, name, ride, moment):
            found[one.kind, one.rank] = name
    return found


def moment_of(finding: Finding) -> str | None:
    """Return the moment of a finding, as `xavi report --at` takes it."""
    known = MOMENTS.get(finding.kind)
    if known is not None or finding.at is None:
        return known
    return f"{finding.at:g}"


def command(ride: Looked, finding: Finding) -> str | None:
    """Return the command that reports on a finding."""
    moment = moment_of(finding)
    return None if moment is None else f"xavi report {quote(ride.file)} --at {quote(moment)}"


def _key(ride: Looked, moment: str) -> str:
    parts = (program_hash(), ride.facts.ride_hash, moment)
    return digest(*(part.encode() for part in parts))[:DIGITS]


def _write(store: Store, name: str, ride: Looked, moment: str) -> bool:
    """Write the report on a moment of a ride; False if none can be made."""
    place = ride.source.place if ride.source.seed is not None else None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            opened = rides.open_ride(store.folder / ride.file, scenario=place)
            page = opened.report(moment).html()
    except Exception:  # also for a fault of this program: the page then shows the command
        return False
    store.write(name, page.encode())
    return True
