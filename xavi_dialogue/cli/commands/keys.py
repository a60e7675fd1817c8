"""The command `xavi keys`: makes certificates for a bus with access control."""

import shlex
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from xavi_dialogue.cli.commands.common import Streams

if TYPE_CHECKING:
    from datetime import datetime

    from xavi_dialogue.security.provisioning import KeyOptions


def add(app: typer.Typer, shell: Streams) -> None:
    """Add the command."""
    app.command("keys")(_keys(shell))


def _keys(shell: Streams) -> Callable[..., None]:
    def keys(
        folder: Annotated[Path, typer.Argument(help="Folder to write; it holds nothing else.")],
        host: Annotated[
            list[str] | None,
            typer.Option(
                metavar="NAME_OR_ADDRESS",
                help="Another host name of the hub, besides this machine; repeatable.",
            ),
        ] = None,
        listen: Annotated[
            str | None,
            typer.Option(
                metavar="ENDPOINT", help="Where the hub listens. Default: tls/127.0.0.1:7447."
            ),
        ] = None,
        connect: Annotated[
            str | None,
            typer.Option(metavar="ENDPOINT", help="Where clients find it. Default: the same."),
        ] = None,
        passenger: Annotated[
            list[str] | None,
            typer.Option(metavar="NAME", help="Passenger with a separate certificate; repeatable."),
        ] = None,
        vehicle: Annotated[
            list[str] | None,
            typer.Option(metavar="NAME", help="Car with a separate certificate; repeatable."),
        ] = None,
        router: Annotated[
            list[str] | None,
            typer.Option(
                metavar="NAME=ENDPOINT",
                help="Router of a fleet, such as north=tls/north.example.org:7447; repeatable."
                " With routers the service is a client of them.",
            ),
        ] = None,
        days: Annotated[int, typer.Option(min=1, max=3650, help="Days of validity.")] = 365,
        force: Annotated[bool, typer.Option("--force", help="Replace all existing keys.")] = False,
    ) -> None:
        """Make keys for a bus on which every component may do only what its role permits."""
        from xavi_dialogue.bus.certificates import utc_now
        from xavi_dialogue.security.provisioning import keep, material, wanted

        with shell.errors():
            order = wanted(
                host or (), listen, connect, passenger or (), vehicle or (), days, router or ()
            )
            now, place = utc_now(), folder.resolve()
            keep(material(order, place, now), place, force=force)
        shell.write(_told(order, place, now, vehicle[0] if vehicle else None))

    return keys


def _told(order: "KeyOptions", folder: Path, now: "datetime", vehicle: str | None) -> str:
    """List the written files, and the next commands to run."""
    ends = (now + order.valid).date().isoformat()
    width = max(len(one.common_name) for one in order.members)
    hub = f"the hub is at {order.connect}"
    if order.routers:
        hub = f"the routers are at {' and '.join(endpoint for _, endpoint in order.routers)}"
    lines = [f"Keys in {folder}, valid until {ends}; {hub}."]
    for one in order.members:
        name = one.common_name
        lines.append(f"  {name:{width}}  {name}.json5 (with {name}.pem, {name}.key)")
    for name, _ in order.routers:
        lines.append(f"  router.{name}: router.{name}.json5, for `zenohd --config`")
    lines += [
        "Give each machine ca.pem and the three files of its role, under the same path.",
        "Keep ca.key secret: with it, any identity on the bus can be made.",
        "Then:",
    ]
    car = "car" if vehicle is None else f"car.{vehicle}"
    called = () if vehicle is None else ("--vehicle", vehicle)
    client = ("--mode", "client") if order.routers else ()
    for words in (
        ("xavi", "serve", "--zenoh", str(folder / "service.json5"), *client),
        ("xavi", "drive", "--speed", "1", "--zenoh", str(folder / f"{car}.json5"), *called),
        ("xavi", "chat", "--zenoh", str(folder / "passenger.json5"), *called),
    ):
        lines.append(f"  {shlex.join(words)}")
    return "\n".join(lines)
