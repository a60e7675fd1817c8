"""What can go wrong with a file of conversations.

    StoreError
    ├── Damaged      not a database, not of this program, or broken
    ├── Newer        written by a later version of this program
    ├── Unwritable   no such place, no permission, disk full, locked: may work again later
    │   └── Unpurged erased data is still in the files
    └── NotStorable  too large, or a number or text that cannot be stored

Every message names the file and says how to repair it.
"""

from pathlib import Path

from xavi_dialogue.process.exit_status import RunFault


class StoreError(RunFault):
    """The file cannot be used."""


class Damaged(StoreError):
    """Not a database, not of this program, or broken."""


class Newer(StoreError):
    """Written by a later version of this program."""


class Unwritable(StoreError):
    """It cannot be opened or written now; that may work later."""


class Unpurged(Unwritable):
    """Erased data is still in the files, until they are next written without readers."""


class NotStorable(StoreError):
    """Too large, or a number or text that cannot be stored."""


def plain(error: Exception) -> str:
    """Return the text of an error, with unprintable characters escaped."""
    return str(error).encode(errors="backslashreplace").decode()


def mend(path: Path, problem: str) -> str:
    """Say that a file cannot be used, and what to do about it."""
    return (
        f"cannot use {path}: {problem}; move the file away to begin anew, put back a copy of it,"
        " or name another with --store"
    )


def hint(path: Path, problem: str) -> str:
    """Say that a file cannot be written at present, and what to see to."""
    return (
        f"cannot open or write {path}: {problem}; see to the disk's space and to permissions,"
        " or name another file with --store"
    )
