"""The lines that passengers typed, kept for the arrow keys until they are erased.

Each line is stored with its time and session, so that it can be erased with the session, even if
it led to no turn. A line of an unknown session is erased with any session.
"""

import os
import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from prompt_toolkit.history import FileHistory, InMemoryHistory

_ENTRIES = re.compile(rb"^(?=# )", re.MULTILINE)  # the head; typed lines begin with a plus


@dataclass(frozen=True, slots=True)
class _Entry:
    raw: bytes
    time: datetime | None  # local; None: not known
    session: str | None  # None: not known

    def within(self, session: str | None, before: datetime | None) -> bool:
        """Check whether it was typed in a session and before a time; None: any."""
        if session is not None and self.session not in (None, session):
            return False
        return before is None or (self.time is not None and self.time < before)


class InputHistory(FileHistory):
    """Lines in a file that only its owner can read."""

    def __init__(self, file: Path, session: str) -> None:
        super().__init__(str(file))
        self._file, self._session = file, session

    def store_string(self, string: str) -> None:
        """See History."""
        lines = "".join(f"+{line}\n" for line in string.split("\n"))
        entry = f"\n# {datetime.now()} {self._session}\n{lines}"
        flags = os.O_WRONLY | os.O_CREAT | os.O_APPEND
        with os.fdopen(os.open(self._file, flags, 0o600), "ab") as file:
            file.write(entry.encode(errors="replace"))

    def forget(self) -> None:
        """Erase what was typed in this session.

        Raises:
            OSError: the file cannot be written.
        """
        erase(self._file, self._session)
        self._loaded_strings = [*self.load_history_strings()]


class UnsavedInputHistory(InMemoryHistory):
    """Lines that are kept in memory only."""

    def forget(self) -> None:
        """Drop all of them."""
        self._storage.clear()
        self._loaded_strings = []


def sessions(file: Path) -> frozenset[str]:
    """Return the sessions in which something was typed, as far as they are known.

    Raises:
        OSError: the file cannot be read.
    """
    return frozenset(entry.session for entry in _entries(file) if entry.session is not None)


def erase(file: Path, session: str | None = None, before: datetime | None = None) -> None:
    """Erase what was typed.

    Args:
        file: the file; there may be none.
        session: the session to erase; None: all.
        before: local time; None: all.

    Raises:
        OSError: the file cannot be written.
    """
    if session is None and before is None:
        _write(file, lambda _: False)
    else:
        _write(file, lambda entry: not entry.within(session, before))


def _write(file: Path, stays: Callable[[_Entry], bool]) -> None:
    """Write the file anew with the entries that stay, as they are."""
    entries = [*_entries(file)]
    kept = [entry.raw for entry in entries if stays(entry)]
    if len(kept) < len(entries):
        new = file.with_name(f"{file.name}.{os.getpid()}")
        new.touch(mode=0o600)
        new.write_bytes(b"".join(kept))
        new.replace(file)


def _entries(file: Path) -> Iterator[_Entry]:
    if file.exists():
        for raw in filter(None, _ENTRIES.split(file.read_bytes())):
            yield _read(raw)


def _read(raw: bytes) -> _Entry:
    """Parse an entry; its head is like `# 2026-11-21 16:42:10.5 sunday`, or lacks the session."""
    head = raw.partition(b"\n")[0].decode(errors="replace").split()
    day, hour, session, *_ = [*head[1:], "", "", ""]
    with suppress(ValueError):
        return _Entry(raw, datetime.fromisoformat(f"{day} {hour}"), session or None)
    return _Entry(raw, None, None)
