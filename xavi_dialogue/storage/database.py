"""One SQLite file, which is checked when opened, and from which erased data is purged."""

import contextlib
import os
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeAlias

from xavi_dialogue.runtime import system
from xavi_dialogue.storage.store_errors import (
    Damaged,
    Newer,
    NotStorable,
    StoreError,
    Unpurged,
    Unwritable,
    hint,
    mend,
    plain,
)

APPLICATION = 0x58415649  # "XAVI", in the file's header
PAUSE = 0.05  # [s] between attempts to open a file that another process is creating
PAGE = 4096  # bytes

Row: TypeAlias = tuple[Any, ...]
Writing: TypeAlias = sqlite3.Connection

_BROKEN = frozenset({sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB, sqlite3.SQLITE_ERROR})
_UNFIT = (OverflowError, UnicodeError, ValueError, sqlite3.DataError, sqlite3.InterfaceError)


class Disk:
    """The disk of this machine: the one door to files of SQLite; a simulation exchanges it."""

    def create(self, path: Path) -> None:
        """Create an empty file that only its owner may read.

        Raises:
            OSError: it exists, or cannot be created.
        """
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        # Only a file that did not exist is opened here: closing one that is in use would
        # release the locks that this process holds on it.
        os.close(os.open(path, os.O_CREAT | os.O_EXCL | os.O_RDWR, 0o600))

    def has(self, path: Path) -> bool:
        """Check whether a file is there; where that cannot be told, it may be."""
        try:
            return path.exists()
        except OSError:
            return True

    def connect(self, path: Path, patience: float) -> Writing:
        """Open a file as a database; wait up to `patience` [s] for others that write."""
        return sqlite3.connect(path, timeout=patience, isolation_level=None)

    def flush(self, path: Path) -> None:
        """Flush what was written to a file, so that it survives a power cut.

        Raises:
            OSError: the file is missing, or cannot be written.
        """
        file = os.open(path, os.O_RDONLY)
        try:
            os.fsync(file)
        finally:
            os.close(file)

    def protect(self, path: Path) -> None:
        """Let only the owner read a file; it may be another user's that we may write."""
        with contextlib.suppress(OSError):
            path.chmod(0o600)


_disk = Disk()


@contextlib.contextmanager
def on_disk(disk: Disk) -> Iterator[None]:
    """Use another disk within; for simulations."""
    global _disk
    before, _disk = _disk, disk
    try:
        yield
    finally:
        _disk = before


def is_there(path: Path) -> bool:
    """Check whether there is a file, as far as can be told."""
    return _disk.has(path)


class Database:
    """A connection to one file, for the thread that made it."""

    def __init__(
        self,
        path: Path,
        tables: str,
        version: int,
        migrations: Mapping[int, str] = MappingProxyType({}),
        *,
        patience: float,
    ) -> None:
        """Open the file; create it, readable by its owner only, if it does not exist.

        Args:
            path: the file.
            tables: SQL that makes them in an empty file.
            version: of the tables.
            migrations: SQL that brings tables of a version to the next.
            patience: [s] to wait for others that write.

        Raises:
            Damaged: it is no database, not of this program, or broken.
            Newer: its tables have a later version.
            Unwritable: it cannot be opened or created.
        """
        self.path, self._patience = path, patience
        self._within = False  # a transaction
        self._make()
        with self._translated():
            self._connection = _disk.connect(path, patience)
        # A damaged byte must spoil only its own value, not everything that is read with it.
        self._connection.text_factory = lambda text: text.decode(errors="surrogateescape")
        try:
            self._open({0: tables} | dict(migrations), version)
        except BaseException:
            self._connection.close()  # without a purge: it may belong to another program
            raise

    @contextlib.contextmanager
    def writing(self) -> Iterator[Writing]:
        """Write all that is written within, or nothing.

        Raises:
            StoreError: nothing was written.
        """
        with self._translated():
            self._roll_back()
            self._connection.execute("BEGIN IMMEDIATE")
            self._within = True
            try:
                yield self._connection
                self._connection.execute("COMMIT")
            except BaseException:
                self._roll_back()
                raise
            finally:
                self._within = False

    def rows(self, sql: str, arguments: Sequence[object] = ()) -> list[Row]:
        """Return the rows of a query.

        Raises:
            StoreError: the file cannot be read.
        """
        with self._translated():
            if not self._within:
                self._roll_back()
            return self._connection.execute(sql, arguments).fetchall()

    def _roll_back(self) -> None:
        """Roll back a transaction that failed; if that fails, too, it is done before the next."""
        if self._connection.in_transaction:  # on a full disk SQLite has ended it already
            self._connection.execute("ROLLBACK")

    def sync(self) -> None:
        """Flush all writes to disk, so that they survive a power cut.

        Raises:
            Unwritable: it cannot be written there.
        """
        # Only the log is flushed: after a checkpoint the next writer would wait for the disk.
        try:
            _disk.flush(self.path.with_name(f"{self.path.name}-wal"))
        except FileNotFoundError:
            return
        except OSError as error:
            raise Unwritable(hint(self.path, error.strerror or str(error))) from error

    def owe(self, file: Writing) -> None:
        """Mark in the file, within a deletion, that the files must be purged."""
        file.execute("CREATE TABLE IF NOT EXISTS owed (erased INTEGER, compacted INTEGER)")
        file.execute("INSERT INTO owed SELECT 0, 0 WHERE NOT EXISTS (SELECT 1 FROM owed)")
        file.execute("UPDATE owed SET erased = erased + 1")

    def purge(self) -> None:
        """Purge deleted data from the files, whichever process deleted it.

        The log is emptied in any case: after a power cut it may hold parts of what was lost.

        Raises:
            Unpurged: data is left, because another process reads, or the disk is full. The next
                process to open, purge or close the file purges it.
        """
        erased, compacted = self._owed() or (0, 0)
        try:
            if compacted < erased:  # else only the log is left; every VACUUM would make it grow
                self._compact(erased)
        except Unwritable as error:
            raise Unpurged(str(error)) from error
        finally:
            [(busy, _, _)] = self.rows("PRAGMA wal_checkpoint(TRUNCATE)")
        if busy:
            raise Unpurged(
                f"what was erased may still be in {self.path}-wal while another program reads it;"
                " end that program and erase again"
            )
        if not erased:
            return
        with self.writing() as file:
            if self._owed() == (erased, erased):  # nothing was deleted meanwhile
                file.execute("DROP TABLE owed")

    def _purge_in_passing(self) -> None:
        """Purge the files if necessary, unless that would have to wait for another process."""
        with contextlib.suppress(StoreError):
            self.rows("PRAGMA busy_timeout = 0")
            self.purge()

    def _compact(self, erased: int) -> None:
        with self._translated():
            self._connection.execute("VACUUM")
        with self.writing() as file:
            file.execute("UPDATE owed SET compacted = max(compacted, ?)", (erased,))

    def _owed(self) -> tuple[int, int] | None:
        """Return the number of deletions so far and when last compacted; None: nothing to purge."""
        if not self.rows("SELECT 1 FROM sqlite_master WHERE name = 'owed'"):
            return None
        rows = self.rows("SELECT erased, compacted FROM owed")
        return rows[0] if rows else None

    def cap(self, size: int) -> None:
        """Limit the size of the file to `size` bytes, or to its present size."""
        self.rows(f"PRAGMA max_page_count = {max(size // PAGE, 1)}")

    def close(self) -> None:
        """Close the file, after purging it if possible."""
        self._purge_in_passing()
        with self._translated():
            self._connection.close()

    def _make(self) -> None:
        try:
            _disk.create(self.path)
        except FileExistsError:
            pass
        except OSError as error:
            raise Unwritable(hint(self.path, error.strerror or str(error))) from error

    def _open(self, steps: Mapping[int, str], version: int) -> None:
        give_up = system.monotonic() + 2.0 * self._patience
        while True:
            try:
                self._version(version)  # before anything is changed in a file of another program
                self._set_up()
                break
            except Unwritable as error:
                # The process that creates the file takes its lock without waiting.
                if system.monotonic() > give_up or "locked" not in str(error):
                    raise
                system.sleep(PAUSE)
        _disk.protect(self.path)
        if self._version(version) < version:  # else it can be read whoever writes, or if it is full
            self._migrate(steps, version)
        if self.rows("PRAGMA quick_check(1)") != [("ok",)]:
            raise Damaged(mend(self.path, "it is damaged"))
        self._purge_in_passing()
        self.rows(f"PRAGMA busy_timeout = {round(self._patience * 1000.0)}")

    def _migrate(self, steps: Mapping[int, str], version: int) -> None:
        with self.writing() as file:
            held = self._version(version)
            if held < version:
                for step in range(held, version) if held else (0,):
                    for statement in filter(str.strip, steps[step].split(";")):
                        file.execute(statement)
                file.execute(f"PRAGMA application_id = {APPLICATION}")
                file.execute(f"PRAGMA user_version = {version}")

    def _set_up(self) -> None:
        self.rows("PRAGMA journal_mode = WAL")
        # Written data survives a crash of the process at once, and a power cut after `sync`.
        # Waiting for the disk at each write would take several milliseconds.
        self.rows("PRAGMA synchronous = NORMAL")
        self.rows("PRAGMA foreign_keys = ON")
        self.rows("PRAGMA secure_delete = ON")
        self.rows("PRAGMA temp_store = MEMORY")

    def _version(self, known: int) -> int:
        [(version,)] = self.rows("PRAGMA user_version")
        [(application,)] = self.rows("PRAGMA application_id")
        [(tables,)] = self.rows("SELECT count(*) FROM sqlite_master")
        if application != APPLICATION and (application or version or tables):
            raise Damaged(mend(self.path, "it is the database of another program"))
        if version > known:
            raise Newer(
                f"{self.path} was written by a later version of xavi (tables of version {version},"
                f" {known} is known here): use that version, or another file with --store"
            )
        return int(version)

    @contextlib.contextmanager
    def _translated(self) -> Iterator[None]:
        try:
            yield
        except _UNFIT as error:
            raise NotStorable(f"this cannot be kept in {self.path}: {plain(error)}") from error
        except sqlite3.Error as error:
            code = getattr(error, "sqlite_errorcode", sqlite3.SQLITE_MISUSE)
            if code & 0xFF in _BROKEN:
                raise Damaged(mend(self.path, plain(error))) from error
            raise Unwritable(hint(self.path, plain(error))) from error
