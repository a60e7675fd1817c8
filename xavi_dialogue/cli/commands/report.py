"""The command `xavi report`: an incident of a ride as one file."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from xavi_dialogue.cli.commands.common import Streams
from xavi_dialogue.process.exit_status import UsageFault
from xavi_dialogue.report.content import SCHEMA

HEAD = 1024  # [byte] of a file, in which a report names its schema


def add(app: typer.Typer, shell: Streams) -> None:
    """Add the command."""
    app.command("report")(_report(shell))


def _report(shell: Streams) -> Callable[..., None]:
    def report(
        ride: Annotated[
            Path, typer.Argument(metavar="RIDE", help="A saved ride, a recording, or plan traces.")
        ],
        at: Annotated[
            str | None,
            typer.Option(
                metavar="MOMENT",
                help="A time [s or m:ss], or: collision, hardest braking, closest approach, "
                "red light. Default: the most remarkable moment.",
            ),
        ] = None,
        out: Annotated[
            Path | None,
            typer.Option(metavar="FILE", help="File to write. Default: named after ride and time."),
        ] = None,
        as_json: Annotated[
            bool,
            typer.Option("--json", help="Print the content as JSON instead; with --out: write it."),
        ] = False,
        scenario: Annotated[
            str | None,
            typer.Option(help="Scenario with the roads, where the ride does not name it."),
        ] = None,
        car: Annotated[
            str | None, typer.Option(metavar="NAME", help="Which car of a recording.")
        ] = None,
        force: Annotated[
            bool, typer.Option("--force", help="Write over a file that is no report, too.")
        ] = False,
    ) -> None:
        """Report what a ride's record shows of an incident, as one HTML file.

        It covers 7 s before and after the moment. Decisions are planned again where the roads are
        known, which takes up to a minute. The same ride, moment and program give the same bytes.
        """
        from xavi_dialogue.library.ride import check_moment
        from xavi_dialogue.library.sources import open_ride

        with shell.errors():
            opened = open_ride(ride, scenario, car)
            if out is not None:
                _check_target(out, ride, force=force)
            check_moment(opened, at)
            shell.note("planning again ...")
            found = opened.report(at)
            if as_json and out is None:
                shell.write(found.json())
                return
            file = out or Path(f"{ride.name.partition('.')[0]}-{found.time:g}s.html")
            _check_target(file, ride, force=force)
            found.save(file, as_json=as_json)
        shell.write(str(file))

    return report


def _check_target(file: Path, ride: Path, *, force: bool) -> None:
    """Check that a report is not written over the ride, nor over a file that is no report.

    Raises:
        UsageFault: it would be.
    """
    if not file.is_file():
        return
    if ride.exists() and file.samefile(ride):
        raise UsageFault(f"{file} is the ride itself; give another file to write")
    with file.open("rb") as known:
        head = known.read(HEAD)
    if not force and SCHEMA.encode() not in head:
        raise UsageFault(f"{file} is there already, and is no report; --force overwrites it")
