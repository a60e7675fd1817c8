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
    from xavi_dialogue.storage.turn_log import Retention

ListenAt = Annotated[
    str | None,
    typer.Option(
        "--listen",
        envvar="XAVI_DASHBOARD_LISTEN",
        metavar="HOST:PORT",
        help="Where browsers find the page. Default: 127.0.0.1:8480; port 0: any that is free.",
    ),
]
Token = Annotated[
    str | None,
    typer.Option(
        envvar="XAVI_DASHBOARD_TOKEN",
        help="That browsers must bring. Default: none on this machine alone, else a random one.",
    ),
]
HostNames = Annotated[
    list[str] | None,
    typer.Option(
        "--host-name", metavar="NAME", help="A name that the page is opened under; repeatable."
    ),
]
Played = Annotated[
    Path | None,
    typer.Option(
        "--replay", exists=True, dir_okay=False, metavar="FILE", help="Show a recording (MCAP)."
    ),
]
Opens = Annotated[bool, typer.Option("--open/--no-open", help="Open the page in a browser.")]


def add(app: typer.Typer, shell: Streams) -> None:
    """Add the command."""
    app.command("dashboard")(logged("dashboard")(_dashboard(shell)))


def _dashboard(shell: Streams) -> Callable[..., None]:
    def dashboard(
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
            where = ListenOptions.read(listen, token=token, names=tuple(host_name or ()))
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
        loaded = shell.load(going.place(scenario))
        chosen = going.seed(seed, loaded)
        at = going.moment(loaded, chosen)
        if going.before is not None:
            shell.note(going.note(at, keeping))
        return ChatOptions(loaded.place, loaded.name, chosen, passenger, keeping, at)
    if scenario is not None or seed is not None:
        raise typer.BadParameter("a recording has its own scenario and seed; leave out --replay")
    next(read(replay), None)  # raises at once if it is no recording
    played = ("replay", str(replay.absolute()), "--vehicle", "car")
    return ChatOptions(replay.name, replay.name, 0, passenger, keeping, played=played)
