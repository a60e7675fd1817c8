"""The command `xavi report`: an incident of a ride as one file."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from xavi_dialogue.cli.commands.common import Streams


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
    ) -> None:
        """Report what a ride's record shows of an incident, as one HTML file.

        It covers 7 s before and after the moment. Decisions are planned again where the roads are
        known, which takes up to a minute. The same ride, moment and program give the same bytes.
        """
        from xavi_dialogue.library.ride import check_moment
        from xavi_dialogue.library.sources import open_ride

        with shell.errors():
            opened = open_ride(ride, scenario, car)
            check_moment(opened, at)
            shell.note("planning again ...")
            found = opened.report(at)
            if as_json and out is None:
                shell.write(found.json())
                return
            file = out or Path(f"{ride.name.partition('.')[0]}-{found.time:g}s.html")
            found.save(file, as_json=as_json)
        shell.write(str(file))

    return report
