"""The commands `xavi sessions` and `xavi forget`: list, export and erase conversations."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from textwrap import shorten
from typing import Protocol

from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.nlg.narration import clock
from xavi_dialogue.process.exit_status import UsageFault
from xavi_dialogue.storage.conversations import DAY, Store
from xavi_dialogue.storage.rows import Summary
from xavi_dialogue.storage.store_errors import Unwritable

WIDEST = 48  # characters of a question in the table
HEAD = ("session", "turns", "last spoken in", "ride", "the last question")


class InputHistoryFile(Protocol):
    """The lines typed at the terminal."""

    def sessions(self) -> frozenset[str]:
        """Return the sessions in which something was typed."""

    def erase(self, session: str | None, before: float | None) -> None:
        """Erase typed lines of a session, or of all, before a wall time [s], or all."""


@dataclass(frozen=True)
class ForgetOptions:
    """The choice of sessions to erase."""

    session: str | None
    everything: bool = False
    older_than: float | None = None  # [days]

    def check(self) -> None:
        """Check that it is clear what to erase.

        Raises:
            UsageFault: it is not.
        """
        if self.everything and (self.session is not None or self.older_than is not None):
            raise UsageFault("--all goes with neither a session nor --older-than")
        if not self.everything and self.session is None and self.older_than is None:
            raise UsageFault("name a session, or give --all, or --older-than DAYS")

    def words(self) -> str:
        """Describe what will be erased."""
        whose = "all conversations" if self.session is None else f"conversation {self.session}"
        if self.older_than is None:
            return whose
        return f"what was said in {whose} more than {self.older_than:g} days ago"


def kept(path: Path, name: str | None) -> tuple[Summary, ...]:
    """List the session of that name, or all; none without a file.

    Raises:
        StoreError: the file cannot be read.
        UsageFault: there is no such session; the message lists those there are.
    """
    if path.exists():
        with Store(path) as store:
            _check(name, store)
            return store.sessions(name)
    if name is not None:
        raise _unknown(name, ())
    return ()


def export(path: Path, name: str | None) -> Iterator[str]:
    """Yield one session, or all, as lines of JSON.

    Raises:
        StoreError: the file cannot be read.
        UsageFault: there is no such session.
    """
    if path.exists():
        with Store(path) as store:
            _check(name, store)
            yield from store.export(name)
    elif name is not None:
        raise _unknown(name, ())


def table(sessions: Sequence[Summary], zone: Callable[[float], datetime]) -> str:
    """Return the sessions as a table with one line for each.

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
    wanted: ForgetOptions,
    now: float,
    agreed: Callable[[str], bool],
    typed: InputHistoryFile,
) -> str:
    """Erase sessions, and say how many; nothing without the user's consent.

    Args:
        path: the file.
        wanted: what to erase.
        now: wall time [s].
        agreed: asks the user whether to erase.
        typed: the typed lines, of which the same are erased.

    Raises:
        StoreError: it cannot be erased.
        UsageFault: it is not clear what to erase, or there is no such session.
    """
    wanted.check()
    with Store(path) if path.exists() else nullcontext() as store:
        if wanted.session is not None:
            _know(wanted.session, store, typed)
        if not agreed(f"erase {wanted.words()}?"):
            return "Nothing was erased."
        before = None if wanted.older_than is None else now - wanted.older_than * DAY
        _erase(typed, wanted.session, before)
        if store is None:
            return "Nothing was kept."
        erased = store.forget(wanted.session, before)
    return f"{erased} turn{' was' if erased == 1 else 's were'} erased."


def _know(session: str, store: Store | None, typed: InputHistoryFile) -> None:
    """Check that a session is stored, or that nothing of it is left.

    Raises:
        UsageFault: it is not stored; the message lists those that are.
        StoreError: the file cannot be read, or erased data is still in it.
    """
    if session in typed.sessions():
        return
    if store is None:
        raise _unknown(session, ())
    if not store.holds(session):
        store.purge()
    _check(session, store)


def _check(name: str | None, store: Store) -> None:
    """Check that there is a session of that name, if any.

    Raises:
        UsageFault: there is none; the message lists those there are.
        StoreError: the file cannot be read.
    """
    if name is not None and not store.holds(name):
        raise _unknown(name, store.names())


def _erase(typed: InputHistoryFile, session: str | None, before: float | None) -> None:
    try:
        typed.erase(session, before)
    except OSError as error:
        raise Unwritable(f"what was typed cannot be erased: {error.strerror}") from error


def _unknown(name: str, others: Sequence[str]) -> UsageFault:
    known = ", ".join(others) or "none at all"
    return UsageFault(f"there is no conversation {name}; there are: {known}")


def _row(one: Summary, zone: Callable[[float], datetime]) -> tuple[str, ...]:
    ride = ""
    if one.scenario is not None and one.sim_time is not None:
        ride = f"{one_line(Path(one.scenario).name)} {one.seed} at {clock(one.sim_time)}"
    question = shorten(one_line(one.question), WIDEST, placeholder=" ...")
    return (one.name, str(one.turns), f"{zone(one.last):%Y-%m-%d %H:%M}", ride, question)
