"""The audit that `xavi audit` runs."""

import os
from dataclasses import dataclass
from pathlib import Path

from xavi_dialogue.audit import audit, report
from xavi_dialogue.audit.errors import AuditError
from xavi_dialogue.audit.questions import Question
from xavi_dialogue.audit.results.changes import earlier
from xavi_dialogue.audit.running import cluster, local
from xavi_dialogue.audit.running.progress import bar
from xavi_dialogue.audit.sources import Source
from xavi_dialogue.audit.store import Store


@dataclass(frozen=True, slots=True)
class Options:
    """What is audited, and how."""

    sources: tuple[Source, ...]
    questions: tuple[Question, ...]
    folder: Path
    against: Path | None = None
    jobs: int | None = None  # None: one process for each processor
    dask: str | None = None  # the scheduler of a cluster, instead of local processes
    top: int = 10
    reports: int = 1


def run(options: Options) -> report.Summary:
    """Run an audit and write its files.

    Raises:
        AuditError: it cannot be run as it was asked for.
        AuditFailed: it broke off.
    """
    before = None
    if options.against is not None:
        if options.against.resolve() == options.folder.resolve():
            raise AuditError("--against is the folder of results itself; give another with --out")
        before = earlier(options.against)
    store = Store(options.folder)
    with bar() as progress:
        found = audit.run(options.sources, options.questions, store, runner(options), progress)
    return report.write(found, store, options.top, before, options.reports)


def runner(options: Options) -> audit.Runner:
    """Return what works on rides."""
    if options.dask is not None:
        address = options.dask
        return lambda tasks, lost: cluster.run(tasks, address, lost)
    jobs = options.jobs or len(os.sched_getaffinity(0))
    return lambda tasks, lost: local.run(tasks, jobs, lost)
