"""The commands `xavi chat` and `xavi ask`: riding along, and asking."""

import sys
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime
from pathlib import Path
from secrets import token_hex
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from xavi_dialogue.cli.commands.common import (
    KEEP_DAYS,
    AsJson,
    Begin,
    Connect,
    Duration,
    EgoFrom,
    EgoId,
    EgoTo,
    KeepDays,
    Seed,
    SessionName,
    SpeedFactor,
    StoreFile,
    Streams,
    Vehicle,
    ZenohFile,
    moment,
    place,
)
from xavi_dialogue.cli.commands.sessions import keeping_in, typed_file

if TYPE_CHECKING:
    from xavi_dialogue.chat.main import ChatOptions
    from xavi_dialogue.chat.remote_backend import RemoteCar
    from xavi_dialogue.dialogue.reply import Reply
    from xavi_dialogue.security.client_token import Passenger
    from xavi_dialogue.storage.turn_log import Retention

DEFAULT_SCENARIO = "s1"

AnyScenario = Annotated[
    str | None,
    typer.Option("--scenario", help="A name, a folder, or a .sumocfg. Default: s1."),
]
Share = Annotated[
    bool, typer.Option("--share", help="Let others on the bus read the conversation.")
]


def add(app: typer.Typer, shell: Streams) -> None:
    """Add the commands."""
    app.command("chat")(_chat(shell))
    app.command("ask")(_ask(shell))


def _chat(shell: Streams) -> Callable[..., None]:
    def chat(
        scenario: AnyScenario = None,
        seed: Seed = None,
        duration: Duration = None,
        speed: SpeedFactor = None,
        session: SessionName = None,
        as_json: AsJson = False,
        connect: Connect = None,
        zenoh: ZenohFile = None,
        vehicle: Vehicle = "car",
        share: Share = False,
        record: Annotated[
            Path | None,
            typer.Option(dir_okay=False, metavar="FILE", help="Record the ride (MCAP)."),
        ] = None,
        force: Annotated[
            bool, typer.Option("--force", help="With --record: overwrite an existing file.")
        ] = False,
        store: StoreFile = None,
        keep_days: KeepDays = KEEP_DAYS,
        ego: EgoId = None,
        ego_from: EgoFrom = None,
        ego_to: EgoTo = None,
        begin: Begin = None,
    ) -> None:
        """Ride and talk; with --connect or --zenoh, in a car that is under way."""
        with shell.errors():
            scenario = place(scenario, ego, ego_from, ego_to, begin)
            keeping = keeping_in(store, keep_days)
            there = there_of(connect, zenoh, vehicle)
            if there is None:
                recording = None if record is None else _RecordingOptions(record, force)
                ride = _ride(shell, scenario, seed, session, keeping, share)
                ride = replace(ride, duration=duration)
                if recording is not None:
                    ride = replace(ride, record=recording.path, overwrite=recording.overwrite)
                _drive(shell, ride, speed, as_json)
                return
            alone(scenario=scenario, seed=seed, duration=duration, speed=speed)
            alone(record=record, force=force or None)
            _ride_along(shell, there, session, as_json, keeping, share)

    return chat


class _RecordingOptions:
    """The file that a ride is recorded in."""

    def __init__(self, path: Path, overwrite: bool) -> None:
        """Make sure that nothing is lost.

        Raises:
            BadParameter: the file exists, and must not be overwritten.
        """
        if path.exists() and not overwrite:
            raise typer.BadParameter(f"{path} is there already; --force overwrites it")
        self.path, self.overwrite = path, overwrite


def _ride(
    shell: Streams,
    scenario: str | None,
    seed: int | None,
    session: str | None,
    keeping: "Retention | None",
    share: bool,
) -> "ChatOptions":
    """Make the options of the ride, and print warnings and how the conversation goes on."""
    from xavi_dialogue.chat.main import ChatOptions
    from xavi_dialogue.storage import resume

    going = resume.fresh(datetime.now().astimezone(), token_hex(2))
    if session is not None:
        going = resume.find(keeping, session)
    place = going.place(scenario)
    loaded = shell.load(place, going.seed(seed, place))
    at = going.moment(loaded)
    if session is None or keeping is None or going.before is not None:
        shell.note(going.note(at, keeping))
    passenger = passenger_of(going.session, share, kept=keeping is not None)
    return ChatOptions(loaded.place, loaded.name, loaded.seed, passenger, keeping, at)


def _drive(shell: Streams, ride: "ChatOptions", speed: float | None, as_json: bool) -> None:
    """Talk in a car that this command starts."""
    from xavi_dialogue.chat.main import at_terminal, through_pipe

    if _terminal(as_json):
        pace = 1.0 if speed is None else speed
        at_terminal(ride, typed_file(), shell.note, speed=pace)
    else:
        lines, pace = shell.lines(), speed or 0.0
        through_pipe(ride, lines, shell.write, shell.note, speed=pace, as_json=as_json)


def _ride_along(
    shell: Streams,
    there: "RemoteCar",
    session: str | None,
    as_json: bool,
    keeping: "Retention | None",
    share: bool,
) -> None:
    """Talk in a car that others started."""
    from xavi_dialogue.chat import remote_backend
    from xavi_dialogue.chat.interactive import InputHistoryOptions
    from xavi_dialogue.storage import resume

    if session is None:
        session = resume.fresh(datetime.now().astimezone(), token_hex(2)).session
        shell.note(f"this conversation is {session}: --session {session} goes on with it")
    passenger = passenger_of(session, share)
    if _terminal(as_json):
        typed = InputHistoryOptions(typed_file(), None if keeping is None else keeping.days)
        remote_backend.at_terminal(there, passenger, typed, shell.note)
    else:
        lines = shell.lines()
        remote_backend.through_pipe(
            there, passenger, lines, shell.write, shell.note, as_json=as_json
        )


def _ask(shell: Streams) -> Callable[..., None]:
    def ask(
        text: Annotated[str, typer.Argument(help="Question to ask.")],
        scenario: AnyScenario = None,
        seed: Seed = None,
        at: Annotated[
            float | None,
            typer.Option(
                parser=moment,
                metavar="TIME",
                help="Moment of the question, simulation time [s or m:ss].",
            ),
        ] = None,
        style: Annotated[
            Literal["passenger", "paper"],
            typer.Option(help="Wording for passengers, or as in the paper's tables."),
        ] = "passenger",
        as_json: AsJson = False,
        connect: Connect = None,
        zenoh: ZenohFile = None,
        vehicle: Vehicle = "car",
        session: SessionName = None,
        share: Share = False,
        ego: EgoId = None,
        ego_from: EgoFrom = None,
        ego_to: EgoTo = None,
        begin: Begin = None,
    ) -> None:
        """Drive up to a moment, answer one question, and exit; or ask a car that is under way."""
        from xavi_dialogue.dialogue.reply import encode
        from xavi_dialogue.process.exit_status import status_of

        def driven() -> "Reply":
            from xavi_dialogue.cli.ask import ask_once

            asked = place(scenario, ego, ego_from, ego_to, begin)
            loaded = shell.load(asked or DEFAULT_SCENARIO, seed)
            return ask_once(loaded, text, at, style)

        def under_way(there: "RemoteCar") -> "Reply":
            from xavi_dialogue.chat.remote_backend import ask_there
            from xavi_dialogue.storage import resume

            alone(scenario=place(scenario, ego, ego_from, ego_to, begin), seed=seed)
            fresh = resume.fresh(datetime.now().astimezone(), token_hex(2))
            passenger = passenger_of(session or fresh.session, share)
            return ask_there(there, passenger, text, at, style)

        with shell.errors():
            there = there_of(connect, zenoh, vehicle)
            reply = driven() if there is None else under_way(there)
        shell.write(encode(reply) if as_json else reply.text)
        raise typer.Exit(status_of(reply))

    return ask


def there_of(connect: str | None, zenoh: Path | None, vehicle: str) -> "RemoteCar | None":
    """Return the car to talk with; None: none was named."""
    if connect is None and zenoh is None:
        return None
    from xavi_dialogue.bus.link import Link
    from xavi_dialogue.chat.remote_backend import RemoteCar
    from xavi_dialogue.security.preflight import check

    link = Link.to_hub(connect, zenoh)
    check(link, "ask")
    return RemoteCar(link, vehicle)


def alone(**given: object) -> None:
    """Reject options that need a car of the chat's own."""
    for name, value in given.items():
        if value is not None:
            raise typer.BadParameter(
                f"--{name} is for a car of your own, and --connect or --zenoh for one under way"
            )


def passenger_of(session: str, share: bool, *, kept: bool = True) -> "Passenger":
    """Return the passenger, with this user's token for a conversation.

    Args:
        session: name of the conversation.
        share: whether others may read it.
        kept: whether to write the user's secret if there is none yet.
    """
    from xavi_dialogue.security.client_token import Passenger, default_path, own_secret, token_of

    secret = own_secret(default_path(), make=kept)
    return Passenger(session, token_of(secret, session), share)


def _terminal(as_json: bool) -> bool:
    return sys.stdin.isatty() and sys.stdout.isatty() and not as_json
