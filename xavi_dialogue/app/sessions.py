"""The commands `xavi sessions` and `xavi forget`: what is kept of conversations, and erasing it."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from textwrap import shorten

from xavi_dialogue.app.narration import clock
from xavi_dialogue.transports.store import DAY, Store, Summary
from xavi_dialogue.transports.text import one_line

WIDEST = 48  # characters of a question in the table
HEAD = ("session", "turns", "last spoken in", "ride", "the last question")


class SessionUsageError(ValueError):
    """What is asked of the kept conversations makes no sense."""


@dataclass(frozen=True)
class Wanted:
    """What is to be forgotten."""

    session: str | None
    everything: bool = False
    older_than: float | None = None  # [days]

    def check(self) -> None:
        """Make sure that it is clear what goes.

        Raises:
            SessionUsageError: it is not.
        """
        if self.everything and (self.session is not None or self.older_than is not None):
            raise SessionUsageError("--all goes with neither a session nor --older-than")
        if not self.everything and self.session is None and self.older_than is None:
            raise SessionUsageError("name a session, or give --all, or --older-than DAYS")

    def words(self) -> str:
        """What goes, in words."""
        whose = "all conversations" if self.session is None else f"conversation {self.session}"
        if self.older_than is None:
            return whose
        return f"what was said in {whose} more than {self.older_than:g} days ago"


def kept(path: Path) -> tuple[Summary, ...]:
    """All sessions; none where there is no file.

    Raises:
        StoreError: the file cannot be read.
    """
    if not path.exists():
        return ()
    with Store(path) as store:
        return store.sessions()


def chosen(sessions: Sequence[Summary], name: str | None) -> tuple[Summary, ...]:
    """The sessions of that name, or all.

    Raises:
        SessionUsageError: there is none of that name; with the list of those there are.
    """
    found = tuple(one for one in sessions if name in (None, one.name))
    if name is not None and not found:
        known = ", ".join(one.name for one in sessions) or "none at all"
        raise SessionUsageError(f"there is no conversation {name}; there are: {known}")
    return found


def export(path: Path, name: str | None) -> Iterator[str]:
    """One session, or all, as lines of JSON.

    Raises:
        StoreError: the file cannot be read.
        SessionUsageError: there is none of that name.
    """
    chosen(kept(path), name)
    if path.exists():
        with Store(path) as store:
            yield from store.export(name)


def table(sessions: Sequence[Summary], zone: Callable[[float], datetime]) -> str:
    """The sessions, a line each under a head.

    Args:
        sessions: to list.
        zone: wall time [s] as local time.
    """
    if not sessions:
        return "No conversation is kept."
    rows = [HEAD, *(_row(one, zone) for one in sessions)]
    widths = [max(len(row[k]) for row in rows) for k in range(len(HEAD))]
    lines = ("  ".join(map(str.ljust, row, widths)).rstrip() for row in rows)
    return "\n".join(lines)


def forget(
    path: Path,
    wanted: Wanted,
    now: float,
    agreed: Callable[[str], bool],
    untype: Callable[[Sequence[str]], None],
) -> str:
    """Erase, and say how much; nothing where that is not agreed to.

    Args:
        path: the file.
        wanted: what goes.
        now: wall time [s].
        agreed: asks whether to erase what is described in words.
        untype: erases questions from what was typed, too.

    Raises:
        StoreError: it cannot be erased.
        SessionUsageError: it is not clear what goes, or there is no such session.
    """
    wanted.check()
    chosen(kept(path), wanted.session)
    if not agreed(f"erase {wanted.words()}?"):
        return "Nothing was erased."
    if not path.exists():
        return "Nothing was kept."
    before = None if wanted.older_than is None else now - wanted.older_than * DAY
    with Store(path) as store:
        questions = store.questions(wanted.session, before)
        erased = store.forget(wanted.session, before)
    untype(questions)
    return f"{erased} turn{' was' if erased == 1 else 's were'} erased."


def _row(one: Summary, zone: Callable[[float], datetime]) -> tuple[str, ...]:
    ride = ""
    if one.scenario is not None and one.sim_time is not None:
        ride = f"{Path(one.scenario).name} {one.seed} at {clock(one.sim_time)}"
    question = shorten(one_line(one.question), WIDEST, placeholder=" ...")
    return (one.name, str(one.turns), f"{zone(one.last):%Y-%m-%d %H:%M}", ride, question)
