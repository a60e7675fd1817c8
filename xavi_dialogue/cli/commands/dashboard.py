"""The command `xavi dashboard`: a car, its decisions and the conversation in a web page."""

from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from secrets import token_hex
from typing import TYPE_CHECKING, Annotated

import typer

from xavi_dialogue.cli.commands.chat import AnyScenario, alone, passenger_of
from xavi_dialogue.cli.commands.common import (
    KEEP_DAYS,
    Begin,
    Connect,
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
    place,
)
from xavi_dialogue.cli.commands.log_options import logged
from xavi_dialogue.cli.commands.sessions import keeping_in

if TYPE_CHECKING:
    from xavi_dialogue.chat.main import ChatOptions
    from xavi_dialogue.security.client_token import Passenger
    from xavi_dialogue.storage.resume import ResumePoint
    from xavi_dialogue.storage.turn_log import Retention

ListenAt = Annotated[
    str | None,
    typer.Option(
        "--listen",
        envvar="XAVI_DASHBOARD_LISTEN",
        metavar="HOST:PORT",
        help="Address of the page. Default: 127.0.0.1:8480; port 0: any free port.",
    ),
]
Token = Annotated[
    str | None,
    typer.Option(
        envvar="XAVI_DASHBOARD_TOKEN",
        help="Token for browsers; every user of this machine can see it here, so better give"
        " --token-file or the variable. Default: none on this machine only, else a random one.",
    ),
]
TokenFile = Annotated[
    Path | None,
    typer.Option(
        "--token-file",
        dir_okay=False,
        metavar="FILE",
        help="File with the token for browsers. A missing one is written, with a random token.",
    ),
]
HostNames = Annotated[
    list[str] | None,
    typer.Option("--host-name", metavar="NAME", help="Another host name of the page; repeatable."),
]
Played = Annotated[
    Path | None,
    typer.Option(
        "--replay", exists=True, dir_okay=False, metavar="FILE", help="Show a recording (MCAP)."
    ),
]
Opens = Annotated[
    bool,
    typer.Option("--open/--no-open", help="Open the page in a browser, unless it has a token."),
]

SOURCES = ("COMMANDLINE", "ENVIRONMENT", "DEFAULT_MAP")  # of an option, in the order they count
SEEN = (
    "warning: every user of this machine can see --token in the list of processes; move the token"
    " to a file for --token-file, or to XAVI_DASHBOARD_TOKEN, and browsers stay signed in"
)


def add(app: typer.Typer, shell: Streams) -> None:
    """Add the command."""
    app.command("dashboard")(logged("dashboard")(_dashboard(shell)))


def _dashboard(shell: Streams) -> Callable[..., None]:
    def dashboard(
        context: typer.Context,
        scenario: AnyScenario = None,
        seed: Seed = None,
        speed: SpeedFactor = None,
        replay: Played = None,
        connect: Connect = None,
        zenoh: ZenohFile = None,
        vehicle: Vehicle = "car",
        session: SessionName = None,
        listen: ListenAt = None,
        token: Token = None,
        token_file: TokenFile = None,
        host_name: HostNames = None,
        opens: Opens = True,
        store: StoreFile = None,
        keep_days: KeepDays = KEEP_DAYS,
        ego: EgoId = None,
        ego_from: EgoFrom = None,
        ego_to: EgoTo = None,
        begin: Begin = None,
    ) -> None:
        """Show a car, its decisions and the conversation in a web page.

        A car of your own, a recording, or with --connect or --zenoh a car that is under way.
        """
        from xavi_dialogue.bus.link import Link
        from xavi_dialogue.dashboard.main import DashboardOptions, run
        from xavi_dialogue.dashboard.web.address import ListenOptions
        from xavi_dialogue.security.preflight import check
        from xavi_dialogue.storage import resume

        with shell.errors():
            scenario = place(scenario, ego, ego_from, ego_to, begin)
            shown = _token(shell, context, token, token_file)
            where = ListenOptions.read(listen, token=shown, names=tuple(host_name or ()))
            going = resume.fresh(datetime.now().astimezone(), token_hex(2))
            passenger = passenger_of(session or going.session, share=False)
            if connect is not None or zenoh is not None:
                alone(scenario=scenario, seed=seed, speed=speed, replay=replay)
                link = Link.to_hub(connect, zenoh)
                check(link, "show a car")
                task = DashboardOptions(where, vehicle, passenger, link, opens=opens)
            else:
                own = _own(shell, scenario, seed, replay, passenger, keeping_in(store, keep_days))
                pace = 1.0 if speed is None else speed
                task = DashboardOptions(where, "car", passenger, own, speed=pace, opens=opens)
            run(task, shell.note)

    return dashboard


def _token(
    shell: Streams, context: typer.Context, token: str | None, file: Path | None
) -> str | None:
    """Return the token as given, or as in the file; warn of one that others can see.

    Of both, the one counts that was set nearer to the command.
    """
    from xavi_dialogue.security.browser_token import token_in

    spoken, named = _source(context, "token"), _source(context, "token_file")
    if token is not None and file is not None and spoken == named:
        raise typer.BadParameter("give either --token or --token-file")
    if file is not None and (token is None or named < spoken):
        return token_in(file, shell.note)
    if token is not None and spoken == 0:
        shell.note(SEEN)
    return token


def _source(context: typer.Context, name: str) -> int:
    """Return where an option comes from, as the index in SOURCES; beyond them: nowhere."""
    source = context.get_parameter_source(name)
    said = "" if source is None else source.name
    return SOURCES.index(said) if said in SOURCES else len(SOURCES)


def _own(
    shell: Streams,
    scenario: str | None,
    seed: int | None,
    replay: Path | None,
    passenger: "Passenger",
    keeping: "Retention | None",
) -> "ChatOptions":
    """Make the options of the ride to drive or play."""
    from xavi_dialogue.chat.main import ChatOptions
    from xavi_dialogue.storage.mcap_file import read
    from xavi_dialogue.storage.resume import find

    if replay is None:
        going = find(keeping, passenger.session)
        there = going.place(scenario)
        loaded = shell.load(there, going.seed(seed, there))
        at = going.moment(loaded)
        if going.before is not None:
            shell.note(going.note(at, keeping))
        return ChatOptions(loaded.place, loaded.name, loaded.seed, passenger, keeping, at)
    if scenario is not None or seed is not None:
        raise typer.BadParameter("a recording has its own scenario and seed; leave out --replay")
    next(read(replay), None)  # raises at once if it is no recording
    going = find(keeping, passenger.session)
    at = _reached(replay, going)
    if going.before is not None:
        shell.note(going.note(at, keeping))
    played = ("replay", str(replay.absolute()), "--vehicle", "car")
    return ChatOptions(replay.name, replay.name, 0, passenger, keeping, at, played=played)


def _reached(replay: Path, going: "ResumePoint") -> float | None:
    """Return the time [s] of the last question; None if it was not about the recorded ride."""
    from xavi_dialogue.recording.player import load

    if going.before is None:
        return None
    begun = load(replay, None, lambda _: None).scene(0)
    return None if begun.scenario is None else going.moment_in(begun.scenario, begun.seed)
