"""Commands about plan traces: show, check and explain recorded decisions."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Literal

import typer

from xavi_dialogue.cli.commands.common import AsJson, Streams, moment, to_json
from xavi_dialogue.process.exit_status import ExitStatus

ROADLESS = (
    "this takes planning the decision again, and no roads of it are known here; --scenario names "
    "a scenario that has them"
)

File = Annotated[str, typer.Argument(help="A trace or a ride, gzipped or not; - for stdin.")]


def add(app: typer.Typer, shell: Streams) -> None:
    """Add the commands."""
    traces = typer.Typer(
        help="Show and check recorded decisions.", no_args_is_help=True, rich_markup_mode=None
    )
    traces.command("show")(_show(shell))
    traces.command("check")(_check(shell))
    app.add_typer(traces, name="trace")
    app.command("explain")(_explain(shell))


def _show(shell: Streams) -> Callable[..., None]:
    def show(
        file: File,
        decision: Annotated[
            int | None, typer.Option(min=0, help="In a ride: number of the decision.")
        ] = None,
        at: Annotated[
            float | None,
            typer.Option(
                parser=moment, metavar="TIME", help="In a ride: the latest decision by [s or m:ss]."
            ),
        ] = None,
        depth: Annotated[int, typer.Option(min=1, help="Number of successive actions shown.")] = 2,
        everything: Annotated[
            bool, typer.Option("--all", help="Show every branch and reason.")
        ] = False,
    ) -> None:
        """Show the search tree of a decision; of a ride, first the list of its decisions."""
        from xavi_dialogue.inspection import decision_text as text
        from xavi_dialogue.inspection import trace_files

        with shell.errors():
            held = trace_files.load(file)
            trace = trace_files.choose(held, decision, at)
            extent = text.Extent(depth, everything)
            shown = text.listing(held.traces) if trace is None else text.show(trace, extent)
        shell.write(shown)

    return show


def _check(shell: Streams) -> Callable[..., None]:
    def check(file: File, as_json: AsJson = False) -> None:
        """Check plan traces of any planner: what they lack, and what cannot be answered so.

        The exit status is 1 if something is lacking, 2 if they cannot be read.
        """
        from dataclasses import asdict

        from xavi_dialogue.inspection import completeness, trace_files

        with shell.errors():
            held = trace_files.load(file)
            found = completeness.gaps(held.traces, ride=held.ride)
            text = completeness.report(held.traces, ride=held.ride)
        shell.write(to_json(list(map(asdict, found))) if as_json else text)
        raise typer.Exit(ExitStatus.FAILED if found else ExitStatus.ANSWERED)

    return check


def _explain(shell: Streams) -> Callable[..., None]:
    def explain(
        file: Annotated[
            Path, typer.Argument(metavar="FILE", help="Plan traces, a saved ride, or a recording.")
        ],
        text: Annotated[str, typer.Argument(metavar="QUESTION", help="Question to answer.")],
        at: Annotated[
            float | None,
            typer.Option(
                parser=moment,
                metavar="TIME",
                help="Moment of the question, simulation time [s or m:ss].",
            ),
        ] = None,
        scenario: Annotated[
            str | None,
            typer.Option(help="Scenario with the roads, to plan again what would have been."),
        ] = None,
        car: Annotated[
            str | None, typer.Option(metavar="NAME", help="Which car of a recording.")
        ] = None,
        style: Annotated[
            Literal["passenger", "paper"],
            typer.Option(help="Wording for passengers, or as in the paper's tables."),
        ] = "passenger",
        as_json: AsJson = False,
    ) -> None:
        """Answer one question from recorded decisions, without SUMO or a car, and exit."""
        from xavi_dialogue.dialogue.reply import encode
        from xavi_dialogue.library.sources import open_ride
        from xavi_dialogue.process.exit_status import status_of

        with shell.errors():
            ride = open_ride(file, scenario, car)
            reply = ride.conversation(style).reply(text, at)
        if ride.network is None and reply.reason == "planner-unavailable":
            shell.note(ROADLESS)
        shell.write(encode(reply) if as_json else reply.text)
        raise typer.Exit(status_of(reply))

    return explain
