"""The commands of `xavi bench`; what they measure is imported when they run."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from benchmarks.chosen import ours, processes, there
from benchmarks.fidelity.fidelity_commands import of_foils
from benchmarks.foreign.commands import of_networks
from benchmarks.planning.commands import of_planning

if TYPE_CHECKING:
    from benchmarks.figures import Report, Show
    from benchmarks.sufficiency.sufficiency import SufficiencyReport

AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]
Scenarios = Annotated[
    list[str] | None, typer.Option("--scenario", help="A name, or a folder; may be repeated.")
]
Jobs = Annotated[int | None, typer.Option(min=1, help="Processes; default: one per processor.")]
Rides = Annotated[
    Path, typer.Option(exists=True, file_okay=False, help="Folder of recorded rides.")
]
OneRide = Annotated[
    Path, typer.Option("--ride", exists=True, dir_okay=False, help="A recorded ride.")
]
RIDE = Path("transcripts/rides/s1-0.ride.jsonl.gz")
QUESTIONS = Path("tests/nlu/questions")
INTENTS = Path("tests/nlu/intents")
WEIGHTS = Path("grammars/intents.json")
Questions = Annotated[Path, typer.Option(help="Folder of the folders learn and blind.")]
Page = Annotated[
    Path | None,
    typer.Option(exists=True, dir_okay=False, help="Put the paper's figures into this page."),
]


def commands(show: "Show") -> typer.Typer:
    """Return the group of commands.

    Args:
        show: runs a measurement and prints its results.
    """
    group = typer.Typer(help="Measure.", no_args_is_help=True, rich_markup_mode=None)

    @group.command("drive")
    def _drive(
        scenario: Scenarios = None,
        runs: Annotated[int, typer.Option(min=1, help="How many in all.")] = 500,
        jobs: Jobs = None,
        as_json: AsJson = False,
    ) -> None:
        """Safety and speed of driving, beside SUMO's own driver in the same seeds."""
        show(lambda note: drive(scenario, runs, jobs, note), as_json)

    @group.command("recognise")
    def _recognise(
        scenario: Scenarios = None,
        seeds: Annotated[int, typer.Option(min=0, help="How many of each scenario.")] = 2,
        networks: Annotated[int, typer.Option(min=0, help="How many made at random.")] = 40,
        seed: Annotated[int, typer.Option(min=0, help="Of the first; the next one follows.")] = 100,
        constants: Annotated[
            int, typer.Option(min=0, help="In so many networks each constant is changed.")
        ] = 0,
        jobs: Jobs = None,
        as_json: AsJson = False,
    ) -> None:
        """How well it is known where others will go, and where they will be."""
        counts = (seeds, networks, seed, constants)
        show(lambda note: recognise(scenario, counts, jobs, note), as_json)

    of_planning(group, show)
    _of_answers(group, show)
    of_foils(group, show)
    of_networks(group, show)
    _of_parsing(group, show)
    return group


def _of_answers(group: typer.Typer, show: "Show") -> None:
    """Add the commands that judge answers."""

    @group.command("causes")
    def _causes(
        worlds: Annotated[int, typer.Option(min=1, help="How many.")] = 60,
        seed: Annotated[int, typer.Option(min=0, help="Of the first; the next one follows.")] = 0,
        roads: Annotated[Literal["straight", "bent"], typer.Option(help="Kind.")] = "straight",
        jobs: Jobs = None,
        keep: Annotated[Path | None, typer.Option(help="Leave their folders there.")] = None,
        as_json: AsJson = False,
    ) -> None:
        """Whether the deed vanishes without those named, in worlds drawn at random."""
        show(lambda note: causes(worlds, seed, roads, jobs, keep, note), as_json)

    @group.command("sufficiency")
    def _sufficiency(
        scenario: Scenarios = None,
        seeds: Annotated[int, typer.Option(min=1, help="How many of each scenario.")] = 3,
        seed: Annotated[int | None, typer.Option(min=0, help="Only this one.")] = None,
        every: Annotated[int, typer.Option(min=1, help="1: each decision; 2: every other.")] = 3,
        jobs: Jobs = None,
        as_json: AsJson = False,
    ) -> None:
        """Whether the reasons told carry the decision, read off the words alone."""
        chosen = range(seeds) if seed is None else (seed,)
        found: list[SufficiencyReport] = []

        def measured(note: Callable[[str], None]) -> "Report":
            found.append(sufficiency(scenario, chosen, every, jobs, note))
            return found[0]

        show(measured, as_json)
        if not found[0].met:
            raise typer.Exit(1)

    _of_time(group, show)


def _of_time(group: typer.Typer, show: "Show") -> None:
    """Add the commands that time answers and the dashboard."""

    @group.command("explain")
    def _explain(
        rides: Rides = Path("transcripts/rides"),
        write: Page = None,
        as_json: AsJson = False,
    ) -> None:
        """Time from a recorded decision to its explanation, and other networks beside ours."""
        show(lambda note: explain(rides, write, note), as_json)

    @group.command("dialogue")
    def _dialogue(
        sessions: Annotated[int, typer.Option(min=1, help="Passengers at once.")] = 1000,
        seconds: Annotated[float, typer.Option(min=1.0, help="At each rate.")] = 20.0,
        as_json: AsJson = False,
    ) -> None:
        """How long answers take, to one passenger and to many at once."""
        show(lambda note: dialogue(sessions, seconds, note), as_json)

    @group.command("dashboard")
    def _dashboard(
        seconds: Annotated[
            float, typer.Option(min=1.0, help="With each number of vehicles.")
        ] = 20.0,
        minutes: Annotated[float, typer.Option(min=0.1, help="For the memory.")] = 10.0,
        as_json: AsJson = False,
    ) -> None:
        """From a scene on the bus to pixels in a browser; frames, and memory over some time."""
        show(lambda note: dashboard(seconds, minutes, note), as_json)


def _of_parsing(group: typer.Typer, show: "Show") -> None:
    """Add the commands that judge understanding."""

    @group.command("parse")
    def _parse(
        questions: Questions = QUESTIONS, ride: OneRide = RIDE, as_json: AsJson = False
    ) -> None:
        """How often questions are understood, and how long that takes, hostile texts included."""
        show(lambda note: parse(questions, ride, note), as_json)

    @group.command("intents")
    def _intents(
        texts: Annotated[
            Path, typer.Option(exists=True, file_okay=False, help="Folder of annotated texts.")
        ] = INTENTS,
        learn: Annotated[
            bool, typer.Option("--learn", help="Learn from all of them and keep the weights.")
        ] = False,
        as_json: AsJson = False,
    ) -> None:
        """How often the intent of a text is recognised."""
        keep = WEIGHTS if learn else None
        show(lambda note: intents(texts, keep, note), as_json)

    @group.command("unknown")
    def _unknown(
        number: Annotated[int, typer.Option("--number", min=1, help="How many.")] = 200,
        seed: Annotated[int, typer.Option(min=0, help="Of questions and words.")] = 0,
        questions: Questions = QUESTIONS,
        ride: OneRide = RIDE,
        as_json: AsJson = False,
    ) -> None:
        """Whether an unknown word in a question is ignored."""
        show(lambda note: unknown(questions, ride, number, seed, note), as_json)

    @group.command("fuzz")
    def _fuzz(
        runs: Annotated[int, typer.Option(min=1, help="Texts that are tried.")] = 200_000,
        seed: Annotated[int, typer.Option(min=0, help="Of the texts.")] = 0,
        jobs: Jobs = None,
        questions: Questions = QUESTIONS,
        ride: OneRide = RIDE,
        as_json: AsJson = False,
    ) -> None:
        """Whether any text makes reading or grounding fail, or takes long."""
        show(lambda note: fuzz(questions, ride, runs, seed, jobs, note), as_json)


def drive(
    scenarios: list[str] | None, runs: int, jobs: int | None, note: Callable[[str], None]
) -> "Report":
    """Measure driving in scenarios, by default in all of the package."""
    from msgspec.structs import replace

    from benchmarks.drive.drive import measure

    chosen, left_out = (there(scenarios), ()) if scenarios else ours(note)
    found = measure(chosen, runs, processes(jobs), note)
    return replace(found, left_out=left_out)


def recognise(
    scenarios: list[str] | None,
    counts: tuple[int, int, int, int],
    jobs: int | None,
    note: Callable[[str], None],
) -> "Report":
    """Measure recognition in scenarios where others have a choice, and in random networks.

    Args:
        scenarios: names or folders; None: those of the package.
        counts: seeds of each, networks, number of the first, networks with constants changed.
        jobs: number of parallel processes.
        note: is called with notes on progress.
    """
    from benchmarks.prediction.recognise import SCENARIOS, measure, tasks
    from benchmarks.prediction.recognise_report import report

    asked = tasks(there(scenarios or list(SCENARIOS)), *counts)
    return report(measure(asked, processes(jobs), note))


def causes(
    worlds: int,
    seed: int,
    roads: Literal["straight", "bent"],
    jobs: int | None,
    keep: Path | None,
    note: Callable[[str], None],
) -> "Report":
    """Measure causes in worlds where some were planted."""
    from benchmarks.causes.causes import measure

    return measure(worlds, seed, roads, processes(jobs), keep, note)


def sufficiency(
    scenarios: list[str] | None,
    seeds: Sequence[int],
    every: int,
    jobs: int | None,
    note: Callable[[str], None],
) -> "SufficiencyReport":
    """Judge the stated reasons in scenarios, by default in all of the package."""
    from benchmarks.sufficiency.sufficiency import measure

    chosen, left_out = (there(scenarios), ()) if scenarios else ours(note)
    return measure(chosen, seeds, every, processes(jobs), note, left_out)


def explain(rides: Path, write: Path | None, note: Callable[[str], None]) -> "Report":
    """Measure explaining, and write the paper's figures into a page."""
    from benchmarks.explain.explain import measure
    from benchmarks.explain.factorisations import written

    found = measure(rides, note)
    if write is not None:
        write.write_text(written(write.read_text(encoding="utf-8"), found.paper), encoding="utf-8")
    return found


def dialogue(sessions: int, seconds: float, note: Callable[[str], None]) -> "Report":
    """Measure answers."""
    from benchmarks.service.dialogue import measure

    return measure(sessions, seconds, note)


def dashboard(seconds: float, minutes: float, note: Callable[[str], None]) -> "Report":
    """Measure the dashboard."""
    from benchmarks.service.dashboard import measure

    return measure(seconds, minutes, note)


def parse(questions: Path, ride: Path, note: Callable[[str], None]) -> "Report":
    """Measure understanding."""
    from benchmarks.language.parse import measure

    return measure(questions, ride, note)


def intents(texts: Path, keep: Path | None, note: Callable[[str], None]) -> "Report":
    """Measure the recognition of intents, and learn it."""
    from benchmarks.language.intents import measure

    return measure(texts, keep, note)


def unknown(
    questions: Path, ride: Path, number: int, seed: int, note: Callable[[str], None]
) -> "Report":
    """Ask questions with unknown words."""
    from benchmarks.language.unknown import measure

    return measure(questions, ride, number, seed, note)


def fuzz(
    questions: Path,
    ride: Path,
    runs: int,
    seed: int,
    jobs: int | None,
    note: Callable[[str], None],
) -> "Report":
    """Try random texts."""
    from benchmarks.language.fuzz import measure

    return measure(questions, ride, runs, seed, processes(jobs), note)
