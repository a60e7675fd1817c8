"""Redirection of standard error, to keep a library's messages off the user's terminal."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def errors_to(file: Path) -> Iterator[None]:
    """Append the standard error of this process to a file while the context lasts.

    Libraries in C do not use `sys.stderr`, so the file descriptor is replaced.
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
    """Return the first error in a file of messages, without its prefix; None if there is none."""
    for line in file.read_text(encoding="utf-8", errors="replace").splitlines():
        if line.startswith("Error: "):
            return line.removeprefix("Error: ").strip()
    return None


def warnings_in(file: Path) -> list[str]:
    """Return the warnings in a file of messages, without repetition."""
    lines = file.read_text(encoding="utf-8", errors="replace").splitlines()
    told = (x.removeprefix("Warning: ").strip() for x in lines if x.startswith("Warning: "))
    return list(dict.fromkeys(told))
