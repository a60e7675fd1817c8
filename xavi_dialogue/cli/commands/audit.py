"""The command `xavi audit`."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from xavi_dialogue.cli.commands.common import AsJson, Streams, to_json
from xavi_dialogue.process.exit_status import ExitStatus

if TYPE_CHECKING:
    from xavi_dialogue.audit.questions import Question
    from xavi_dialogue.audit.sources import Source

Recordings = Annotated[
    Path | None,
    typer.Argument(metavar="[RECORDINGS]", help="Folder of rides that were saved or recorded."),
]
Scenarios = Annotated[
    list[str] | None,
    typer.Option("--scenario", help="Scenario to drive: a name, a folder, a .sumocfg. Repeatable."),
]
Seeds = Annotated[
    str | None, typer.Option(help="Seeds to drive each with: 0-9 or 1,4,7-9. Default: 0-9.")
]
Duration = Annotated[
    float | None, typer.Option(min=0.1, help="Time after which a ride ends at the latest [s].")
]
Questions = Annotated[
    list[str] | None,
    typer.Option(
        "--question",
        help="Question for every ride; may end in @ 8, @ braking, @ closest or @ end. Repeatable.",
    ),
]
QuestionFile = Annotated[
    Path | None, typer.Option("--questions", metavar="FILE", help="File of questions, one a line.")
]
Out = Annotated[Path, typer.Option(metavar="FOLDER", help="Where results are kept.")]
Against = Annotated[
    Path | None,
    typer.Option(metavar="OLD", help="Folder of an earlier audit: shows which answers changed."),
]
Jobs = Annotated[
    int | None,
    typer.Option(min=1, max=256, help="Local processes. Default: one for each processor."),
]
Dask = Annotated[
    str | None,
    typer.Option(metavar="ADDRESS", help="Scheduler of a Dask cluster: tcp://127.0.0.1:8786."),
]
Reports = Annotated[
    int, typer.Option(min=0, help="Findings of each kind of which a report is written, too.")
]
Top = Annotated[int, typer.Option(min=1, help="Findings of each kind on the page.")]


def add(app: typer.Typer, shell: Streams) -> None:
    """Add the command."""
    app.command("audit")(_audit(shell))


def _audit(shell: Streams) -> Callable[..., None]:
    def audit(
        recordings: Recordings = None,
        scenario: Scenarios = None,
        seeds: Seeds = None,
        duration: Duration = None,
        question: Questions = None,
        questions: QuestionFile = None,
        out: Out = Path("audit"),
        against: Against = None,
        jobs: Jobs = None,
        dask: Dask = None,
        top: Top = 10,
        reports: Reports = 1,
        as_json: AsJson = False,
    ) -> None:
        """Look through many rides for what deserves a look, and ask each the same questions.

        Writes tables (Parquet), a page (audit.html) and reports on the foremost findings.
        What is done already is not done again. The exit status is 1 if a ride failed.
        """
        with shell.errors():
            _check(recordings, scenario, seeds, duration, jobs, dask)
            from xavi_dialogue.audit.command import Options, run

            found = run(
                Options(
                    sources=_sources(recordings, scenario or [], seeds or "0-9", duration),
                    questions=_questions(question or [], questions),
                    folder=out,
                    against=against,
                    jobs=jobs,
                    dask=dask,
                    top=top,
                    reports=reports,
                )
            )
        shell.write(to_json(found) if as_json else f"{found.table()}\n{out / 'audit.html'}")
        raise typer.Exit(ExitStatus.FAILED if found.failed else ExitStatus.ANSWERED)

    return audit


def _check(
    recordings: Path | None,
    scenarios: list[str] | None,
    seeds: str | None,
    duration: float | None,
    jobs: int | None,
    dask: str | None,
) -> None:
    """Check that options go together."""
    from xavi_dialogue.audit.errors import AuditError

    if recordings is None and not scenarios:
        raise AuditError("there is nothing to audit; give --scenario s1, or a folder of recordings")
    if recordings is not None and (scenarios or seeds is not None or duration is not None):
        raise AuditError(
            "--scenario, --seeds and --duration drive rides, and recordings are driven already;"
            " give one or the other"
        )
    if jobs is not None and dask is not None:
        raise AuditError("--jobs is for local processes; with --dask the cluster has its workers")


def _sources(
    recordings: Path | None, scenarios: list[str], seeds: str, duration: float | None
) -> "tuple[Source, ...]":
    from xavi_dialogue.audit import sources

    if recordings is not None:
        return sources.recorded(recordings)
    return sources.driven(scenarios, sources.read_seeds(seeds), duration)


def _questions(said: list[str], file: Path | None) -> "tuple[Question, ...]":
    from xavi_dialogue.audit import questions

    found = [questions.read(line) for line in said]
    found += questions.read_file(file) if file is not None else []
    return questions.distinct(found) or questions.DEFAULT
