"""Shared by commands: output streams, error reports, and common options."""

import re
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from xavi_dialogue.process.clock_time import seconds_of

if TYPE_CHECKING:
    from sim.setup.scenario import Scenario

NAME = r"[A-Za-z0-9_.-]{1,64}"
KEEP_DAYS = 30


@dataclass(frozen=True)
class Streams:
    """The process's streams."""

    errors: Callable[[], AbstractContextManager[None]]  # reports errors in one line
    write: Callable[[str], None]  # writes to standard output
    note: Callable[[str], None]  # writes to standard error
    lines: Callable[[], Iterator[str]]  # lines of standard input, even with invalid bytes

    def load(self, name: str, seed: int | None, *, told: bool = False) -> "Scenario":
        """Load a scenario, and print its warnings unless the parent process did.

        Args:
            name: or path.
            seed: of the ride; None: the scenario's.
            told: whether the parent process did.
        """
        from sim.setup.scenario import load

        scenario = load(name, seed)
        for warning in () if told else scenario.warnings:
            self.note(f"warning: {warning}")
        return scenario


def place(
    scenario: str | None,
    ego: str | None,
    origin: str | None,
    destination: str | None,
    begin: float | None,
) -> str | None:
    """Return the scenario as text for child processes, with its ego."""
    asked = {"ego": ego, "from": origin, "to": destination, "begin": begin}
    wishes = {key: str(value) for key, value in asked.items() if value is not None}
    if not wishes:
        return scenario
    from sim.setup.place_text import is_place, with_wishes

    if scenario is None or not is_place(scenario):
        raise typer.BadParameter(
            "--ego, --ego-from, --ego-to and --begin go with --scenario FILE.sumocfg"
        )
    return with_wishes(scenario, wishes)


def moment(text: str) -> float:
    """Return the time [s] that an option names: 65, 65s or 1:05.

    Raises:
        BadParameter: it names none, or one before the ride.
    """
    found = seconds_of(text)
    if found is None or found < 0.0:
        raise typer.BadParameter(f"{text!r} is no time of a ride; give one [s or m:ss]")
    return found


def to_json(value: object) -> str:
    """Return the value as one line of JSON."""
    import msgspec

    return msgspec.json.encode(value).decode()


def _name(value: Any) -> Any:
    for name in value if isinstance(value, list) else [value]:
        if name is not None and not re.fullmatch(NAME, name):
            raise typer.BadParameter(
                "a name has 1 to 64 letters, digits, dots, dashes, underscores"
            )
    return value


ScenarioName = Annotated[
    str, typer.Option("--scenario", help="A name, a folder, or a SUMO configuration (.sumocfg).")
]
EgoId = Annotated[
    str | None, typer.Option("--ego", metavar="ID", help="With a .sumocfg: the vehicle to drive.")
]
EgoFrom = Annotated[
    str | None, typer.Option("--ego-from", metavar="EDGE", help="With a .sumocfg: where to start.")
]
EgoTo = Annotated[
    str | None, typer.Option("--ego-to", metavar="EDGE", help="With --ego-from: where to go.")
]
Begin = Annotated[
    float | None,
    typer.Option(min=0.0, metavar="SECONDS", help="With --ego-from: when to start."),
]
Seed = Annotated[
    int | None,
    typer.Option(min=0, max=2**31 - 1, help="Seed of random numbers. Default: the scenario's."),
]
Duration = Annotated[float | None, typer.Option(min=0.1, help="Longest duration [s].")]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]
Control = Annotated[bool, typer.Option("--control", hidden=True)]
SessionName = Annotated[
    str | None,
    typer.Option(callback=_name, help="A conversation to begin or resume. Default: a new one."),
]
SpeedFactor = Annotated[
    float | None,
    typer.Option(min=0.0, max=1000.0, help="Simulated seconds per second; 0: as fast as possible."),
]
StoreFile = Annotated[
    Path | None,
    typer.Option(
        "--store",
        dir_okay=False,
        envvar="XAVI_STORE",
        help="File of conversations. Default: the user's.",
    ),
]
KeepDays = Annotated[
    int,
    typer.Option(
        min=0,
        max=36500,
        envvar="XAVI_KEEP_DAYS",
        help="Days until conversations are erased; 0: not stored.",
    ),
]
Vehicle = Annotated[
    str,
    typer.Option(
        callback=_name, envvar="XAVI_VEHICLE", metavar="NAME", help="Name of the car on the bus."
    ),
]
OwnVehicle = Annotated[
    str | None,
    typer.Option(
        "--vehicle",
        callback=_name,
        envvar="XAVI_VEHICLE",
        metavar="NAME",
        help="Name of the car on the bus. Default: that in its key, else car.",
    ),
]
PlayedVehicle = Annotated[
    str | None,
    typer.Option(
        "--vehicle",
        callback=_name,
        metavar="NAME",
        help="Name on the bus. Default: that in its key, else as recorded.",
    ),
]
Connect = Annotated[
    str | None,
    typer.Option(
        envvar="XAVI_CONNECT",
        metavar="ENDPOINT",
        help="Hub of a bus, such as tcp/127.0.0.1:7447.",
    ),
]
ZenohFile = Annotated[
    Path | None,
    typer.Option(
        "--zenoh",
        exists=True,
        dir_okay=False,
        envvar="XAVI_ZENOH",
        metavar="FILE",
        help="A Zenoh configuration, such as `xavi keys` writes.",
    ),
]
