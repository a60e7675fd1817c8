"""The command `xavi reproduce`; what it needs is imported when it runs."""

import os
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated

import typer

from benchmarks.commands import AsJson, Jobs

if TYPE_CHECKING:
    from benchmarks.figures import Report, Show


def command(show: "Show") -> Callable[..., None]:
    """Return the command.

    Args:
        show: runs a measurement and prints what it found.
    """

    def reproduce(
        seeds: Annotated[int, typer.Option(min=1, help="How many of each story.")] = 10,
        jobs: Jobs = None,
        as_json: AsJson = False,
    ) -> None:
        """Say what the paper's Tables 1 to 3 say, beside their rows."""
        show(lambda note: _measured(seeds, jobs, note), as_json)

    return reproduce


def _measured(seeds: int, jobs: int | None, note: Callable[[str], None]) -> "Report":
    from benchmarks.reproduce.report import measure

    return measure(seeds, jobs or os.cpu_count() or 1, note)
