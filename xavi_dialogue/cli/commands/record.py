"""The commands `xavi record`, `replay` and `export`: rides into files, back, and for viewers."""

import sys
from collections.abc import Callable
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from secrets import token_hex
from typing import TYPE_CHECKING, Annotated

import typer

from xavi_dialogue.cli.commands.common import (
    KEEP_DAYS,
    AsJson,
    Connect,
    Control,
    KeepDays,
    PlayedVehicle,
    SessionName,
    SpeedFactor,
    StoreFile,
    Streams,
    Vehicle,
    ZenohFile,
    moment,
)
from xavi_dialogue.cli.commands.log_options import logged, own_name
from xavi_dialogue.cli.commands.sessions import keeping_in, typed_file

if TYPE_CHECKING:
    from xavi_dialogue.storage.turn_log import Retention

Recording = Annotated[
    Path, typer.Argument(exists=True, dir_okay=False, metavar="FILE", help="A recording (MCAP).")
]
Car = Annotated[
    str | None,
    typer.Option(metavar="NAME", help="Which car of the recording. Default: the only one."),
]
From = Annotated[
    float | None, typer.Option("--from", min=0.0, metavar="T", help="Begin at this time [s].")
]


def add(app: typer.Typer, shell: Streams) -> None:
    """Add the commands."""
    app.command("record")(logged("recorder")(_record(shell)))
    app.command("replay")(logged("car", own_name(shell))(_replay(shell)))
    app.command("export")(_export(shell))


def _record(shell: Streams) -> Callable[..., None]:
    def record(
        file: Annotated[Path, typer.Argument(metavar="FILE", help="File to write (MCAP).")],
        connect: Connect = None,
        zenoh: ZenohFile = None,
        vehicle: Vehicle = "car",
        force: Annotated[bool, typer.Option("--force", help="Overwrite an existing file.")] = False,
        control: Control = False,
    ) -> None:
        """Record what a car reports, and what passengers share; --vehicle all: every car."""
        from xavi_dialogue.bus.link import Link
        from xavi_dialogue.recording.recorder import RecordOptions, record
        from xavi_dialogue.security.preflight import check

        with shell.errors():
            link = Link.to_hub(connect, zenoh)
            check(link, "record")
            record(RecordOptions(file, link, vehicle, force, control), shell.note)

    return record


def _replay(shell: Streams) -> Callable[..., None]:
    def replay(
        file: Recording,
        speed: SpeedFactor = None,
        start: From = None,
        car: Car = None,
        connect: Connect = None,
        zenoh: ZenohFile = None,
        vehicle: PlayedVehicle = None,
        session: SessionName = None,
        as_json: AsJson = False,
        store: StoreFile = None,
        keep_days: KeepDays = KEEP_DAYS,
        control: Control = False,
    ) -> None:
        """Talk about a recorded ride; with --connect or --zenoh, play it for others."""
        with shell.errors():
            if connect is not None or zenoh is not None:
                from xavi_dialogue.bus.link import Link
                from xavi_dialogue.recording.player import ReplayOptions, replay

                pace = 1.0 if speed is None else speed
                link = Link.to_hub(connect, zenoh)
                show = ReplayOptions(file, link, pace, start or 0.0, car, vehicle, control)
                replay(show, shell.note)
            else:
                own = _Own(file, car, start, session, keeping_in(store, keep_days))
                _talk(shell, own, speed, as_json)

    return replay


def _export(shell: Streams) -> Callable[..., None]:
    def export(
        source: Annotated[
            Path,
            typer.Argument(metavar="RIDE", help="A recording, a saved ride, or plan traces."),
        ],
        target: Annotated[Path, typer.Argument(metavar="OUT", help="File to write (MCAP).")],
        ask: Annotated[
            list[str] | None,
            typer.Option(
                metavar="QUESTION",
                help="Show what would have been driven by its answer. May be repeated.",
            ),
        ] = None,
        at: Annotated[
            float | None,
            typer.Option(
                parser=moment, metavar="TIME", help="Moment of the questions [s or m:ss]."
            ),
        ] = None,
        scenario: Annotated[
            str | None, typer.Option(help="Scenario with the roads, where it is not found.")
        ] = None,
        car: Car = None,
        layout: Annotated[
            Path | None,
            typer.Option(metavar="FILE", help="Write the layout of panels for viewers, too."),
        ] = None,
        force: Annotated[bool, typer.Option("--force", help="Overwrite existing files.")] = False,
    ) -> None:
        """Write a ride as a file that Foxglove and Lichtblick show in 3-D.

        Names each question of --ask without an answer; exit status as of `xavi explain`.
        """
        from xavi_dialogue.bus.sanitize import one_line
        from xavi_dialogue.library.sources import open_ride
        from xavi_dialogue.process.exit_status import ExitStatus, status_of

        with shell.errors():
            from xavi_dialogue.viewers.export import ExportOptions, export

            ride = open_ride(source, scenario, car)
            asked = tuple(ask or ())
            made = export(ride, ExportOptions(source, target, asked, at, force, layout))
        shell.write("\n".join(f"{topic:12} {count}" for topic, count in made.messages.items()))
        if asked and at is not None and at > ride.end:
            shell.note(f"{at:g} s is after the end: what was asked is asked at {ride.end:g} s")
        for answer in made.answers:
            if answer.ghost is None:
                shell.note(f"no /ghost for {answer.question!r}: {one_line(answer.text)}")
        declined = (status for one in made.answers if (status := status_of(one)))
        raise typer.Exit(next(declined, ExitStatus.ANSWERED))

    return export


@dataclass(frozen=True)
class _Own:
    """A private conversation about a recording."""

    file: Path
    car: str | None
    start: float | None  # [s]
    session: str | None
    keeping: "Retention | None"


def _talk(shell: Streams, own: _Own, speed: float | None, as_json: bool) -> None:
    from xavi_dialogue.chat.main import ChatOptions, at_terminal, through_pipe
    from xavi_dialogue.security.client_token import Passenger, default_path, own_secret, token_of
    from xavi_dialogue.storage.mcap_file import read
    from xavi_dialogue.storage.resume import fresh

    next(read(own.file), None)  # raises at once if it is no recording
    session = own.session or fresh(datetime.now().astimezone(), token_hex(2)).session
    secret = own_secret(default_path(), make=own.keeping is not None)
    passenger = Passenger(session, token_of(secret, session), False)
    which = () if own.car is None else ("--car", own.car)
    played = ("replay", str(own.file.absolute()), "--vehicle", "car", *which)
    name = own.file.name
    ride = ChatOptions(name, name, 0, passenger, own.keeping, own.start, played=played)
    if sys.stdin.isatty() and sys.stdout.isatty() and not as_json:
        at_terminal(ride, typed_file(), shell.note, speed=1.0 if speed is None else speed)
    else:
        lines, pace = shell.lines(), speed or 0.0
        through_pipe(ride, lines, shell.write, shell.note, speed=pace, as_json=as_json)
