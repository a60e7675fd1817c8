"""The lines that a passenger typed, kept for the arrow keys, until they are to be forgotten."""

import os
import re
from collections.abc import Callable, Collection
from contextlib import suppress
from datetime import datetime
from pathlib import Path

from prompt_toolkit.history import FileHistory, InMemoryHistory

_ENTRIES = re.compile(rb"^(?=# )", re.MULTILINE)  # lines that were typed begin with a plus


class TypedLines(FileHistory):
    """Lines in a file that only its owner can read."""

    def __init__(self, file: Path) -> None:
        super().__init__(str(file))
        self._file = file
        self._mine: set[str] = set()  # typed in this conversation

    def store_string(self, string: str) -> None:
        """See History."""
        if not self._file.exists():
            self._file.touch(mode=0o600)
        self._mine.add(string)
        super().store_string(string)

    def forget(self, questions: Collection[str]) -> None:
        """Erase what was typed in this conversation, and wherever else a question was typed.

        Raises:
            OSError: the file cannot be written.
        """
        gone = {question.strip() for question in questions}

        def stays(entry: bytes) -> bool:
            typed = _typed(entry)
            return typed not in self._mine and not gone & {
                " ".join(line.split()) for line in typed.splitlines()
            }

        self._keep(stays)
        self._mine.clear()
        self._loaded_strings = [*self.load_history_strings()]

    def expire(self, before: datetime) -> None:
        """Erase what was typed before a moment of local time.

        Raises:
            OSError: the file cannot be written.
        """
        self._keep(lambda entry: not _older(entry, before))

    def _keep(self, stays: Callable[[bytes], bool]) -> None:
        """Write the file anew with the entries that stay, each with its time."""
        if not self._file.exists():
            return
        entries = _ENTRIES.split(self._file.read_bytes())
        kept = [entry for entry in entries if stays(entry)]
        if len(kept) < len(entries):
            new = self._file.with_name(f"{self._file.name}.{os.getpid()}")
            new.touch(mode=0o600)
            new.write_bytes(b"".join(kept))
            new.replace(self._file)


class UnkeptLines(InMemoryHistory):
    """Lines that are in no file."""

    def forget(self, _: Collection[str]) -> None:
        """Drop all of them."""
        self._storage.clear()
        self._loaded_strings = []


def _typed(entry: bytes) -> str:
    """What was typed, which may be several lines."""
    lines = entry.decode(errors="replace").split("\n")
    return "\n".join(line[1:] for line in lines if line.startswith("+"))


def _older(entry: bytes, before: datetime) -> bool:
    """Whether the time at the head of an entry is there, and before a moment."""
    head = entry.partition(b"\n")[0].removeprefix(b"# ").decode(errors="replace")
    with suppress(ValueError, TypeError):
        return datetime.fromisoformat(head.strip()) < before
    return False
