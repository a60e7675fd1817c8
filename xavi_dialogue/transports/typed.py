"""The lines that a passenger typed, kept for the arrow keys, until they are to be forgotten."""

import os
from collections.abc import Collection
from pathlib import Path

from prompt_toolkit.history import FileHistory


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

        def stays(entry: str) -> bool:
            return entry not in self._mine and not gone & {
                " ".join(line.split()) for line in entry.splitlines()
            }

        kept = [entry for entry in self.load_history_strings() if stays(entry)]
        new = self._file.with_name(f"{self._file.name}.{os.getpid()}")
        new.touch(mode=0o600)
        rewritten = FileHistory(str(new))
        for entry in reversed(kept):
            rewritten.store_string(entry)
        new.replace(self._file)
        self._mine.clear()
        self._loaded_strings = kept
