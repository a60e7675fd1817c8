"""Keeps what a library writes to standard error from the user's terminal."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def errors_to(file: Path) -> Iterator[None]:
    """Let standard error of this process go to the end of a file meanwhile.

    Libraries write past `sys.stderr`, so its file descriptor is what is replaced.
    """
    sys.stderr.flush()
    before = os.dup(2)
    target = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o600)
    try:
        os.dup2(target, 2)
        yield
    finally:
        os.dup2(before, 2)
        os.close(before)
        os.close(target)


def first_error(file: Path) -> str | None:
    """Return the first line of a file of messages that tells of an error."""
    for line in file.read_text(encoding="utf-8", errors="replace").splitlines():
        if line.startswith("Error: "):
            return line.removeprefix("Error: ").strip()
    return None


def warnings_in(file: Path) -> list[str]:
    """Return the warnings in a file of messages, without repetition."""
    lines = file.read_text(encoding="utf-8", errors="replace").splitlines()
    told = (x.removeprefix("Warning: ").strip() for x in lines if x.startswith("Warning: "))
    return list(dict.fromkeys(told))
