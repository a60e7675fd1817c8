"""Commands that show questions, scenarios and transcripts."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from xavi_dialogue.cli.commands.common import (
    AsJson,
    Begin,
    EgoFrom,
    EgoId,
    EgoTo,
    Streams,
    place,
    to_json,
)
from xavi_dialogue.process.exit_status import ExitStatus, UsageFault


def add(app: typer.Typer, shell: Streams) -> None:
    """Add the commands."""
    app.command("parse")(_parse(shell))
    app.command("scenarios")(_scenarios(shell))
    folders = typer.Typer(
        help="Write scenario folders.", no_args_is_help=True, rich_markup_mode=None
    )
    folders.callback()(_nothing)
    folders.command("new")(_scenario_new(shell))
    app.add_typer(folders, name="scenario")
    app.command("transcripts")(_transcripts(shell))


def _parse(shell: Streams) -> Callable[..., None]:
    def parse(
        text: Annotated[str | None, typer.Argument(help="Question to parse.")] = None,
        jsonl: Annotated[
            bool, typer.Option("--jsonl", help="Read lines of JSON, each with a question.")
        ] = False,
        vehicles: Annotated[
            str, typer.Option(help="Numbers of the vehicles in view, such as 0-5 or 0,2.")
        ] = "0-5",
        explain: Annotated[
            bool, typer.Option("--explain", help="Show what each word contributes.")
        ] = False,
        as_json: AsJson = False,
    ) -> None:
        """Show the meaning of a question as a query."""
        from xavi_dialogue.cli import parse as parsing

        with shell.errors():
            names = parsing.vehicle_names(vehicles)
            if jsonl:
                for answer in parsing.parse_lines(shell.lines(), names, shell.note):
                    shell.write(answer)
                return
            if text is None:
                raise UsageFault("a question is missing; or read lines with --jsonl")
            shown, understood = parsing.parse_text(text, names, explain=explain, as_json=as_json)
            shell.write(shown)
        if not understood:
            raise typer.Exit(ExitStatus.NOT_UNDERSTOOD)

    return parse


def _scenarios(shell: Streams) -> Callable[..., None]:
    def scenarios(as_json: AsJson = False) -> None:
        """List the scenarios that come with the program."""
        from sim.setup.scenario import descriptions

        with shell.errors():
            found = descriptions()
        if as_json:
            shell.write(
                to_json([{"name": name, "description": text} for name, text in found.items()])
            )
        else:
            for name, text in found.items():
                shell.write(f"{name:12} {text}")

    return scenarios


def _nothing() -> None:
    """Write scenario folders."""


def _scenario_new(shell: Streams) -> Callable[..., None]:
    def new(
        configuration: Annotated[Path, typer.Argument(metavar="FILE.sumocfg")],
        folder: Annotated[Path, typer.Argument(metavar="FOLDER")],
        ego: EgoId = None,
        ego_from: EgoFrom = None,
        ego_to: EgoTo = None,
        begin: Begin = None,
    ) -> None:
        """Write a scenario folder about a SUMO configuration.

        Unless it is named, the ego is the first car that departs.
        """
        from sim.setup.scenario import with_rider
        from xavi_dialogue.cli.new_scenario import write

        with shell.errors():
            asked = place(str(configuration), ego, ego_from, ego_to, begin)
            loaded = shell.load(with_rider(asked or str(configuration)), None)
            shell.write(str(write(loaded, folder)))

    return new


def _transcripts(shell: Streams) -> Callable[..., None]:
    def transcripts(
        accept: Annotated[
            bool, typer.Option("--accept", help="Rewrite transcripts that differ.")
        ] = False,
        covered: Annotated[
            bool, typer.Option("--coverage", help="Show what no conversation exercises.")
        ] = False,
        folder: Annotated[Path, typer.Option(help="Folder of the transcripts.")] = Path(
            "transcripts"
        ),
    ) -> None:
        """Replay the golden conversations in SUMO; show differences, or accept them."""
        from xavi_dialogue.transcripts.replay import replay_all, transcripts_in

        if covered:
            from xavi_dialogue.transcripts.coverage import measure

            with shell.errors():
                coverage = measure(transcripts_in(folder))
            shell.write(coverage.table())
            raise typer.Exit(ExitStatus.FAILED if coverage.missing else ExitStatus.ANSWERED)
        with shell.errors():
            differing = replay_all(folder, accept=accept, note=shell.note)
        raise typer.Exit(ExitStatus.FAILED if differing and not accept else ExitStatus.ANSWERED)

    return transcripts
