"""The command line `xavi`.

Commands import what they need when they run, so that the small ones start fast.
"""

import contextlib
import re
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, NoReturn

import typer

from xavi_dialogue.app.bench.commands import Measure, commands
from xavi_dialogue.app.exit_status import ExitStatus
from xavi_dialogue.app.kernels import find_place
from xavi_dialogue.app.reproduce.command import command as reproduce
from xavi_dialogue.app.sessions_commands import (
    KEEP_DAYS,
    KeepDays,
    StoreFile,
    add,
    keeping_in,
    typed_file,
)

if TYPE_CHECKING:
    from sim.scenario import Scenario

app = typer.Typer(
    name="xavi",
    help="A car that drives in SUMO and answers its passengers.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


def _session_name(name: str | None) -> str | None:
    if name is not None and not re.fullmatch(r"[A-Za-z0-9_.-]{1,64}", name):
        raise typer.BadParameter("a name has 1 to 64 letters, digits, dots, dashes, underscores")
    return name


trace_app = typer.Typer(
    help="Look into recorded decisions.", no_args_is_help=True, rich_markup_mode=None
)
app.add_typer(trace_app, name="trace")

ScenarioName = Annotated[str, typer.Option("--scenario", help="A name, or a folder.")]
Seed = Annotated[int | None, typer.Option(min=0, max=2**31 - 1, help="Default: the scenario's.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]
Control = Annotated[bool, typer.Option("--control", hidden=True)]
SessionName = Annotated[
    str | None,
    typer.Option(
        callback=_session_name, help="A conversation to begin or go on with. Default: a new one."
    ),
]
SpeedFactor = Annotated[
    float | None,
    typer.Option(min=0.0, max=1000.0, help="Simulated seconds per second; 0: as fast as possible."),
]


@app.command()
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

    with _errors():
        keeping = keeping_in(store, keep_days)
        going = going_on.fresh(datetime.now().astimezone(), token_hex(2))
        if session is not None:
            going = going_on.find(keeping, session)
        loaded = _load(going.place(scenario))
        seed = going.seed(seed, loaded)
        at = going.moment(loaded, seed)
        _note(going.note(at, keeping))
        ride = Ride(str(loaded.folder), loaded.name, seed, going.session, keeping, at)
        if sys.stdin.isatty() and sys.stdout.isatty() and not as_json:
            pace = 1.0 if speed is None else speed
            at_terminal(ride, typed_file(), _note, speed=pace)
        else:
            through_pipe(ride, _lines(), _write, _note, speed=speed or 0.0, as_json=as_json)


@app.command()
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

    with _errors():
        loaded = _load(scenario)
        reply = ask_once(loaded, _seed(seed, loaded), text, at, style)
    _write(encode(reply) if as_json else reply.text)
    raise typer.Exit(status_of(reply))


@app.command()
def parse(
    text: Annotated[str | None, typer.Argument()] = None,
    jsonl: Annotated[bool, typer.Option("--jsonl", help="Read question lines.")] = False,
    vehicles: Annotated[str, typer.Option(help="Names there are, such as 0-5 or 0,2.")] = "0-5",
    explain: Annotated[bool, typer.Option("--explain", help="Show how.")] = False,
    as_json: AsJson = False,
) -> None:
    """Show the query that a question means."""
    from xavi_dialogue.app import parsing

    with _errors():
        names = parsing.vehicle_names(vehicles)
        if jsonl:
            for answer in parsing.parse_lines(_lines(), names, _note):
                _write(answer)
            return
        if text is None:
            raise parsing.ParseUsageError("a question is missing; or read lines with --jsonl")
        shown, understood = parsing.parse_text(text, names, explain=explain, as_json=as_json)
        _write(shown)
    if not understood:
        raise typer.Exit(ExitStatus.NOT_UNDERSTOOD)


@app.command()
def drive(
    scenario: ScenarioName = "s1",
    seed: Seed = None,
    duration: Annotated[float | None, typer.Option(min=0.1, help="At most so long [s].")] = None,
    speed: SpeedFactor = 0.0,
    connect: Annotated[str | None, typer.Option(help="Report to the hub at an endpoint.")] = None,
    save: Annotated[
        Path | None, typer.Option(help="Save the decisions, for `trace show`: FILE.ride.jsonl.gz.")
    ] = None,
    as_json: AsJson = False,
    control: Control = False,
) -> None:
    """Drive a scenario."""
    from xavi_dialogue.app.drive import Manner, drive
    from xavi_dialogue.app.narration import story

    with _errors():
        loaded = _load(scenario, told=control)
        manner = Manner(speed or 0.0, duration, connect, control, save)
        summary = drive(loaded, _seed(seed, loaded), manner)
    if not control:
        _write(_json(summary) if as_json else story(summary.events))
        if summary.ended is None:
            raise typer.Exit(ExitStatus.INTERRUPTED)


@app.command()
def serve(
    listen: Annotated[str, typer.Option(help="Endpoint.")] = "tcp/127.0.0.1:7447",
    store: StoreFile = None,
    keep_days: KeepDays = KEEP_DAYS,
    control: Control = False,
) -> None:
    """Run the dialogue service, and the hub that the others join."""
    from xavi_dialogue.app.hub import serve
    from xavi_dialogue.app.memory import Memory

    with _errors():
        _note(f"serving at {listen}")
        memory = Memory(keeping_in(store, keep_days), lambda text: _note(f"warning: {text}"))
        serve(listen, memory, controlled=control)


@app.command()
def scenarios(as_json: AsJson = False) -> None:
    """List the scenarios that come with the program."""
    from sim.scenario import descriptions

    with _errors():
        found = descriptions()
    if as_json:
        _write(_json([{"name": name, "description": text} for name, text in found.items()]))
    else:
        for name, text in found.items():
            _write(f"{name:12} {text}")


@app.command()
def transcripts(
    accept: Annotated[bool, typer.Option("--accept", help="Rewrite what differs.")] = False,
    covered: Annotated[
        bool, typer.Option("--coverage", help="Show what no conversation exercises.")
    ] = False,
    folder: Annotated[Path, typer.Option(help="Where the transcripts lie.")] = Path("transcripts"),
) -> None:
    """Replay the golden conversations in SUMO; show, or accept, what differs."""
    from xavi_dialogue.app.golden import replay_all, transcripts_in

    if covered:
        from xavi_dialogue.app.coverage import measure

        with _errors():
            coverage = measure(transcripts_in(folder))
        _write(coverage.table())
        raise typer.Exit(ExitStatus.FAILED if coverage.missing else ExitStatus.ANSWERED)
    with _errors():
        differing = replay_all(folder, accept=accept, note=_note)
    raise typer.Exit(ExitStatus.FAILED if differing and not accept else ExitStatus.ANSWERED)


@trace_app.command("show")
def trace_show(
    file: Annotated[str, typer.Argument(help="A trace or a ride, gzipped or not; - for stdin.")],
    decision: Annotated[int | None, typer.Option(min=0, help="Of a ride: its number.")] = None,
    at: Annotated[float | None, typer.Option(min=0.0, help="Of a ride: the latest by [s].")] = None,
    depth: Annotated[int, typer.Option(min=1, help="Actions in a row that are shown.")] = 2,
    everything: Annotated[bool, typer.Option("--all", help="Every branch and reason.")] = False,
) -> None:
    """Show the search tree of a decision; of a ride, first the list of its decisions."""
    from xavi_dialogue.app.debug import files, text

    with _errors():
        held = files.read(files.content(file))
        trace = files.choose(held, decision, at)
        extent = text.Extent(depth, everything)
        shown = text.listing(held.traces) if trace is None else text.show(trace, extent)
    _write(shown)


def _version(wanted: bool) -> None:
    if wanted:
        from importlib.metadata import version

        _write(f"xavi {version('xavi-dialogue')}")
        raise typer.Exit


@app.callback()
def _options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version.")
    ] = False,
) -> None:
    pass


def _measured(measure: Measure, as_json: bool) -> None:
    with _errors():
        found = measure(_note)
    _write(_json(found) if as_json else found.table())


app.add_typer(commands(_measured), name="bench")
app.command("reproduce")(reproduce(_measured))


@contextlib.contextmanager
def _errors() -> Iterator[None]:
    """What goes wrong as one clear line and an exit status; our own faults as they are."""
    try:
        yield
    except Exception as error:
        from xavi_dialogue.app.failures import failure

        known = failure(error)
        if known is None:
            raise
        _note(known.message)
        raise typer.Exit(known.status) from None


def _load(name: str, *, told: bool = False) -> "Scenario":
    """Load a scenario, and tell its warnings unless the process that started this one did."""
    from sim.scenario import load

    scenario = load(name)
    for warning in () if told else scenario.warnings:
        _note(f"warning: {warning}")
    return scenario


def _seed(asked: int | None, scenario: "Scenario") -> int:
    return scenario.seed if asked is None else asked


def _json(value: object) -> str:
    import msgspec

    return msgspec.json.encode(value).decode()


def _lines() -> Iterator[str]:
    """Lines of standard input, whatever bytes they hold."""
    sys.stdin.reconfigure(encoding="utf-8", errors="replace")  # type: ignore[union-attr]
    yield from iter(sys.stdin.readline, "")


def _write(text: str) -> None:
    print(text, flush=True)


def _note(text: str) -> None:
    line = f"xavi: {text}"
    if sys.stderr.isatty():
        from shutil import get_terminal_size

        from xavi_dialogue.transports.commands import wrapper

        line = wrapper(get_terminal_size().columns).fill(line)
    print(line, file=sys.stderr, flush=True)


add(app, _errors, _write)


def main() -> NoReturn:
    """Run the command line; SIGTERM ends it like an exception, so that all is cleaned up."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(ExitStatus.TERMINATED))
    find_place()
    app()
    sys.exit(ExitStatus.ANSWERED)


if __name__ == "__main__":
    main()
