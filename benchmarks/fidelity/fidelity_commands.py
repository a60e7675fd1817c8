"""The command `xavi bench fidelity`; what it measures is imported when it runs."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from benchmarks.chosen import ours, processes, there

if TYPE_CHECKING:
    from benchmarks.figures import Report, Show


def of_foils(group: typer.Typer, show: "Show") -> None:
    """Add the command that compares foils with what SUMO makes of them."""

    @group.command("fidelity")
    def _fidelity(
        scenario: Annotated[
            list[str] | None,
            typer.Option(help="A name, or a folder; may be repeated."),
        ] = None,
        seeds: Annotated[int, typer.Option(min=0, help="How many of each scenario.")] = 2,
        networks: Annotated[int, typer.Option(min=0, help="How many made at random.")] = 20,
        seed: Annotated[
            int | None, typer.Option(min=0, help="Only this one; or the first.")
        ] = None,
        every: Annotated[int, typer.Option(min=1, help="1: each decision; 2: every other.")] = 1,
        learn: Annotated[
            Path | None, typer.Option(help="Learn ranges on other networks, and write them there.")
        ] = None,
        jobs: Annotated[
            int | None, typer.Option(min=1, help="Processes; default: one per processor.")
        ] = None,
        as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    ) -> None:
        """What is said of foils, beside what SUMO makes of them from the same state."""
        first = seed or 0
        numbers = range(first, first + networks)
        if learn is not None:
            show(lambda note: ranges(learn, numbers, every, jobs, note), as_json)
            return
        chosen = range(seeds) if seed is None else range(first, first + min(seeds, 1))
        show(lambda note: fidelity(scenario, (chosen, numbers), every, jobs, note), as_json)


def fidelity(
    scenarios: list[str] | None,
    seeds: tuple[Sequence[int], Sequence[int]],
    every: int,
    jobs: int | None,
    note: Callable[[str], None],
) -> "Report":
    """Measure statements about foils in scenarios and in random networks.

    Args:
        scenarios: names or folders; None: those of the package.
        seeds: of each, and the numbers of networks.
        every: 1 for each decision, 2 for every other one, ...
        jobs: number of parallel processes.
        note: is called with notes on progress.
    """
    from msgspec.structs import replace

    from benchmarks.fidelity.fidelity import measure, tasks

    chosen, left_out = (there(scenarios), ()) if scenarios else ours(note)
    asked = tasks(chosen, *seeds, every)
    return replace(measure(asked, processes(jobs), note), left_out=left_out)


def ranges(
    target: Path, networks: Sequence[int], every: int, jobs: int | None, note: Callable[[str], None]
) -> "Report":
    """Learn the ranges that answers give, and write them into a file."""
    import msgspec

    from benchmarks.fidelity.fidelity import learnt

    found = learnt(networks, every, processes(jobs), note)
    target.write_bytes(msgspec.json.format(msgspec.json.encode(found.ranges)) + b"\n")
    return found
