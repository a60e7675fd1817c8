"""The command `xavi bench plan`; what it measures is imported when it runs."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from benchmarks.figures import Report, Show


def of_planning(group: typer.Typer, show: "Show") -> None:
    """Add the command that times decisions."""

    @group.command("plan")
    def _plan(
        hours: Annotated[float, typer.Option(min=0.0, help="Simulated, for the memory.")] = 0.0,
        plot: Annotated[Path | None, typer.Option(help="Write growth there as SVG.")] = None,
        igp2: Annotated[
            Path | None,
            typer.Option(
                exists=True, file_okay=False, help="Checkout of IGP2, to put beside ours."
            ),
        ] = None,
        igp2_python: Annotated[
            Path | None,
            typer.Option(help="Python that has what IGP2 requires; default: the one of xavi."),
        ] = None,
        trees: Annotated[
            int,
            typer.Option(
                min=1, max=64, help="Above 1: decisions with so many search trees beside one."
            ),
        ] = 1,
        as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
    ) -> None:
        """Time per decision, how it grows, time to start, memory; IGP2's planner beside ours."""
        python = igp2_python or Path(sys.executable)
        show(lambda note: plan(hours, plot, (igp2, python), trees, note), as_json)


def plan(
    hours: float,
    plot: Path | None,
    rival: tuple[Path | None, Path],
    trees: int,
    note: Callable[[str], None],
) -> "Report":
    """Measure planning, and draw its growth.

    Args:
        hours: [h] of simulated driving, for the memory.
        plot: file for the drawing.
        rival: checkout of IGP2, if any, and the Python to run it with.
        trees: number of search trees to put beside one, if above 1.
        note: gets a line before each scenario of IGP2, and each ride with several trees.
    """
    from msgspec.structs import replace

    from benchmarks.igp2.beside import beside_igp2
    from benchmarks.planning.plan import measure
    from benchmarks.planning.several_trees import several_trees

    checkout, python = rival
    beside = () if checkout is None else beside_igp2(checkout, python, note)
    parallel = several_trees(trees, note) if trees > 1 else ()
    found = replace(measure(hours), igp2=beside, several_trees=parallel)
    if plot is not None:
        plot.write_text(found.plot(), encoding="utf-8")
    return found
