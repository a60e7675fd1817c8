"""The commands `xavi chat` and `xavi ask`: riding along, and asking."""

import sys
from collections.abc import Callable
from typing import Annotated, Literal

import typer

from xavi_dialogue.app.commands.sessions import keeping_in, typed_file
from xavi_dialogue.app.commands.shell import (
    KEEP_DAYS,
    AsJson,
    KeepDays,
    ScenarioName,
    Seed,
    SessionName,
    Shell,
    SpeedFactor,
    StoreFile,
)


def add(app: typer.Typer, shell: Shell) -> None:
    """Add the commands."""
    app.command("chat")(_chat(shell))
    app.command("ask")(_ask(shell))


def _chat(shell: Shell) -> Callable[..., None]:
    def chat(
        scenario: Annotated[
            str | None, typer.Option("--scenario", help="A name, or a folder. Default: s1.")
        ] = None,
        seed: Seed = None,
        speed: SpeedFactor = None,
        session: SessionName = None,
        as_json: AsJson = False,
        store: StoreFile = None,
        keep_days: KeepDays = KEEP_DAYS,
    ) -> None:
        """Ride and talk."""
        from datetime import datetime
        from secrets import token_hex

        from xavi_dialogue.app import going_on
        from xavi_dialogue.app.chat import Ride, at_terminal, through_pipe

        with shell.errors():
            keeping = keeping_in(store, keep_days)
            going = going_on.fresh(datetime.now().astimezone(), token_hex(2))
            if session is not None:
                going = going_on.find(keeping, session)
            loaded = shell.load(going.place(scenario))
            seed = going.seed(seed, loaded)
            at = going.moment(loaded, seed)
            shell.note(going.note(at, keeping))
            ride = Ride(str(loaded.folder), loaded.name, seed, going.session, keeping, at)
            if sys.stdin.isatty() and sys.stdout.isatty() and not as_json:
                pace = 1.0 if speed is None else speed
                at_terminal(ride, typed_file(), shell.note, speed=pace)
            else:
                through_pipe(
                    ride,
                    shell.lines(),
                    shell.write,
                    shell.note,
                    speed=speed or 0.0,
                    as_json=as_json,
                )

    return chat


def _ask(shell: Shell) -> Callable[..., None]:
    def ask(
        text: str,
        scenario: ScenarioName = "s1",
        seed: Seed = None,
        at: Annotated[float | None, typer.Option(min=0.0, help="Simulation time [s].")] = None,
        style: Annotated[Literal["passenger", "paper"], typer.Option()] = "passenger",
        as_json: AsJson = False,
    ) -> None:
        """Drive up to a moment, answer one question, and exit."""
        from xavi_dialogue.app.ask import ask_once
        from xavi_dialogue.app.exit_status import status_of
        from xavi_dialogue.dialogue.reply import encode

        with shell.errors():
            loaded = shell.load(scenario)
            reply = ask_once(loaded, loaded.seed if seed is None else seed, text, at, style)
        shell.write(encode(reply) if as_json else reply.text)
        raise typer.Exit(status_of(reply))

    return ask
