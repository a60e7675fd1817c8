"""The command `xavi bench foreign`; what it measures is imported when it runs."""

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from benchmarks.chosen import processes

if TYPE_CHECKING:
    from benchmarks.figures import Report, Show


def of_networks(group: typer.Typer, show: "Show") -> None:
    """Add the command that drives on networks of others."""

    @group.command("foreign")
    def _foreign(
        networks: Annotated[
            list[Path] | None,
            typer.Option(
                exists=True,
                file_okay=False,
                help="Folder of .sumocfg, .net.xml and .xodr; may be repeated. Without it: SUMO's.",
            ),
        ] = None,
        site: Annotated[
            list[str] | None, typer.Option(help="Only this network; may be repeated.")
        ] = None,
        seeds: Annotated[int, typer.Option(min=1, help="Rides on each network.")] = 5,
        seed: Annotated[int, typer.Option(min=0, help="Of the first; the next one follows.")] = 0,
        results: Annotated[
            Path | None,
            typer.Option(dir_okay=False, help="Adds rides to this file; skips those it holds."),
        ] = None,
        keep: Annotated[
            Path | None, typer.Option(file_okay=False, help="Leave traffic made up there.")
        ] = None,
        jobs: Annotated[
            int | None, typer.Option(min=1, help="Processes; default: one per processor.")
        ] = None,
        as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    ) -> None:
        """Driving on networks from elsewhere, compared with SUMO's own driver."""
        wanted = (networks or [], site or [], range(seed, seed + seeds))
        show(lambda note: foreign(wanted, (results, keep), jobs, note), as_json)


def foreign(
    wanted: tuple[list[Path], list[str], range],
    files: tuple[Path | None, Path | None],
    jobs: int | None,
    note: Callable[[str], None],
) -> "Report":
    """Measure driving on foreign networks.

    Args:
        wanted: folders to look in, names of networks, and seeds.
        files: file of results, and folder for traffic that is made up.
        jobs: number of parallel processes.
        note: is called with notes on progress.
    """
    from benchmarks.foreign.measure import measure

    return measure(*wanted, *files, processes(jobs), note)
