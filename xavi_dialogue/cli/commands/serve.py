"""The commands `xavi drive` and `xavi serve`: the processes behind a conversation."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, TypeAlias

import typer

from xavi_dialogue.cli.commands.common import (
    KEEP_DAYS,
    AsJson,
    Begin,
    Connect,
    Control,
    Duration,
    EgoFrom,
    EgoId,
    EgoTo,
    KeepDays,
    OwnVehicle,
    ScenarioName,
    Seed,
    SpeedFactor,
    StoreFile,
    Streams,
    ZenohFile,
    place,
    to_json,
)
from xavi_dialogue.cli.commands.log_options import logged, own_name
from xavi_dialogue.cli.commands.sessions import keeping_in

if TYPE_CHECKING:
    from xavi_dialogue.bus.shards import Shard


SaveDecisions: TypeAlias = Annotated[
    Path | None,
    typer.Option(
        metavar="FILE",
        help="Save the decisions, for `trace show`; a name without an ending gets .ride.jsonl.gz.",
    ),
]
Trees: TypeAlias = Annotated[
    int,
    typer.Option(
        min=1,
        max=64,
        envvar="XAVI_TREES",
        help="Search trees of a decision; all but the first grow in processes of their own."
        " The same number gives the same ride on every machine.",
    ),
]


def add(app: typer.Typer, shell: Streams) -> None:
    """Add the commands."""
    app.command("drive")(_drive(shell))
    app.command("serve")(_serve(shell))


def _drive(shell: Streams) -> Callable[..., None]:
    @logged("car", own_name(shell))
    def drive(
        scenario: ScenarioName = "s1",
        seed: Seed = None,
        duration: Duration = None,
        speed: SpeedFactor = 0.0,
        connect: Connect = None,
        zenoh: ZenohFile = None,
        vehicle: OwnVehicle = None,
        save: SaveDecisions = None,
        workers: Annotated[
            int, typer.Option(min=1, max=64, help="Worker processes for what-ifs.")
        ] = 1,
        waiting: Annotated[
            int, typer.Option(min=1, max=1000, help="What-ifs that may wait for a worker.")
        ] = 8,
        trees: Trees = 1,
        as_json: AsJson = False,
        control: Control = False,
        ego: EgoId = None,
        ego_from: EgoFrom = None,
        ego_to: EgoTo = None,
        begin: Begin = None,
    ) -> None:
        """Drive a scenario; with --connect or --zenoh, reported on the bus."""
        from xavi_dialogue.bus.interface import DEFAULT_VEHICLE
        from xavi_dialogue.bus.link import Link
        from xavi_dialogue.nlg.narration import story
        from xavi_dialogue.process.child_commands import Signals
        from xavi_dialogue.storage.ride_file import named
        from xavi_dialogue.vehicle.bus_session import ReplanningOptions
        from xavi_dialogue.vehicle.main import DriveOptions, drive

        with shell.errors():
            asked = place(scenario, ego, ego_from, ego_to, begin) or scenario
            loaded = shell.load(asked, seed, told=control)
            link = Link.to_hub(connect, zenoh) if connect or zenoh else None
            replanning, signals = ReplanningOptions(workers, waiting), Signals()
            name = vehicle or DEFAULT_VEHICLE
            file = save and named(save)
            manner = DriveOptions(
                speed or 0.0, duration, link, name, control, file, replanning, trees
            )
            summary = drive(loaded, manner, signals)
            if file is not None:
                shell.note(f"the decisions are in {file}")
        if not control:
            shell.write(to_json(summary) if as_json else story(summary.events))
        if signals.told:
            raise typer.Exit(signals.status)

    return drive


def _serve(shell: Streams) -> Callable[..., None]:
    @logged("service")
    def serve(
        listen: Annotated[
            str | None,
            typer.Option(
                envvar="XAVI_LISTEN",
                metavar="ENDPOINT",
                help="Where others find the hub. Default: tcp/127.0.0.1:7447.",
            ),
        ] = None,
        connect: Annotated[
            list[str] | None,
            typer.Option(metavar="ENDPOINT", help="Routers of a fleet to join; repeatable."),
        ] = None,
        mode: Annotated[
            Literal["peer", "router", "client"] | None,
            typer.Option(
                help="Default: peer; router: also forward messages between hubs; client: join"
                " a router, and be no hub."
            ),
        ] = None,
        shard: Annotated[
            str | None,
            typer.Option(
                metavar="K/N",
                help="Answer about a part of the fleet's cars: 2/4 is the second of four.",
            ),
        ] = None,
        zenoh: ZenohFile = None,
        store: StoreFile = None,
        keep_days: KeepDays = KEEP_DAYS,
        control: Control = False,
    ) -> None:
        """Run the dialogue service, and the hub that the others join."""
        from xavi_dialogue.bus.link import Link
        from xavi_dialogue.security.preflight import check
        from xavi_dialogue.service.main import serve
        from xavi_dialogue.storage.turn_log import TurnLog

        with shell.errors():
            link = Link.of_hub(listen, tuple(connect or ()), mode, zenoh)
            check(link, "answer passengers")
            part = _shard("1/1" if shard is None else shard)
            memory = TurnLog(
                keeping_in(store, keep_days), lambda text: shell.note(f"warning: {text}")
            )
            serve(link, memory, shell.note, controlled=control, shard=part)

    return serve


def _shard(text: str) -> "Shard":
    from xavi_dialogue.bus.shards import Shard

    try:
        return Shard.read(text)
    except ValueError as error:
        raise typer.BadParameter(str(error), param_hint="--shard") from error
