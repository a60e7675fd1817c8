"""A progress bar of an audit on standard error."""

from collections.abc import Iterator
from contextlib import contextmanager

from xavi_dialogue.audit.audit import Progress
from xavi_dialogue.audit.errors import needing

with needing("audit", "pip install rich"):
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        SpinnerColumn,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )
    from rich.progress import Progress as Bar


@contextmanager
def bar() -> Iterator[Progress]:
    """Show a bar while an audit runs; nothing but its end where no terminal is."""
    columns = (
        SpinnerColumn(), TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(),
        TimeElapsedColumn(), TimeRemainingColumn(), TextColumn("{task.fields[note]}"),
    )  # fmt: skip
    with Bar(*columns, console=Console(stderr=True)) as shown:
        row = shown.add_task("rides", total=None, note="")
        dead = 0

        def begin(count: int, known: int) -> None:
            shown.update(row, total=count, completed=known)

        def lost() -> None:
            nonlocal dead
            dead += 1
            shown.update(row, note=f"workers replaced: {dead}")

        yield Progress(begin, lambda: shown.advance(row), lost)
