"""The disks of the simulated world: full, failing, and robbed of what was not flushed.

SQLite itself runs, on files in memory. A crash leaves what was written so far, to the byte: within
a commit any part of the log. A power cut leaves of the log no less than was flushed.
"""

import shutil
import sqlite3
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tests.simulated.scheduler import Process, Scheduler
from xavi_dialogue.storage.database import Disk

MEMORY = Path("/dev/shm")
HEADER = 32  # bytes of a log that change whenever it is begun anew
POLL = 0.01  # [s] between attempts on a file that is locked
LOCKED = (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED)
ENDS = ("COMMIT", "ROLLBACK")
WRITES = ("INSERT", "UPDATE", "DELETE", "CREATE", "ALTER", "DROP", "VACUUM", "COMMIT", "BEGIN")


@dataclass(eq=False)
class Volume:
    """One database file with its log, and what of it is safe."""

    folder: Path
    generation: int = 0
    full: bool = False
    failing: bool = False
    crashing: bool = False  # whether the process crashes that stores a turn next, once it has
    safe: tuple[bytes, int] = (b"", 0)  # header and length of the log when it was flushed
    open: list["Connection"] = field(default_factory=list)
    held: sqlite3.Connection | None = None  # of another program that reads, or writes
    flushed: list[float] = field(default_factory=list)  # [s]
    cuts: int = 0  # power cuts that took something

    @property
    def path(self) -> Path:
        """The file at present."""
        return self.folder / f"{self.generation}.sqlite3"

    @property
    def log(self) -> Path:
        """Its log at present."""
        return self.path.with_name(f"{self.path.name}-wal")

    def contents(self) -> bytes:
        """Return all bytes that somebody could find."""
        return b"".join(one.read_bytes() for one in (self.path, self.log) if one.exists())

    def renew(self, log: bytes | None) -> None:
        """Go on with a copy of the file as it is, and this log."""
        base = self.path.read_bytes() if self.path.exists() else None
        self.let_go()
        dead, self.open = self.open, []
        self.generation += 1
        if base is not None:
            self.path.write_bytes(base)
        if log:
            self.log.write_bytes(log)
        for one in dead:
            one.abandon()

    def written(self) -> bytes:
        """Return the log."""
        return self.log.read_bytes() if self.log.exists() else b""

    def hold(self, *, writing: bool) -> None:
        """Let another program read for a while, or write."""
        if self.held is None and self.path.exists():
            self.held = sqlite3.connect(self.path, timeout=0.0, isolation_level=None)
            with suppress(sqlite3.Error):
                self.held.execute("BEGIN IMMEDIATE" if writing else "BEGIN")
                self.held.execute("SELECT count(*) FROM sqlite_master").fetchall()

    def let_go(self) -> None:
        """End what the other program does."""
        if self.held is not None:
            with suppress(sqlite3.Error):
                self.held.execute("ROLLBACK")
            self.held.close()
            self.held = None


class SimulatedDisk(Disk):
    """The disks of all machines; a path belongs to one machine."""

    def __init__(self, scheduler: Scheduler) -> None:
        self.scheduler = scheduler
        place = MEMORY if MEMORY.is_dir() else None
        self._folder = Path(tempfile.mkdtemp(prefix="storm-", dir=place))
        self.volumes: dict[Path, Volume] = {}

    def close(self) -> None:
        """Remove everything."""
        for volume in self.volumes.values():
            volume.let_go()
            for one in volume.open:
                one.abandon()
        shutil.rmtree(self._folder)

    def volume(self, path: Path) -> Volume:
        """Return the volume of a file, or of its log."""
        plain = path.with_name(path.name.removesuffix("-wal"))
        if plain not in self.volumes:
            folder = self._folder / str(len(self.volumes))
            folder.mkdir()
            self.volumes[plain] = Volume(folder)
        return self.volumes[plain]

    def create(self, path: Path) -> None:
        self.scheduler.step()
        volume = self.volume(path)
        if volume.path.exists():
            raise FileExistsError
        if volume.full:
            raise OSError(28, "No space left on device")
        volume.path.touch()

    def has(self, path: Path) -> bool:
        self.scheduler.step()
        return self.volume(path).path.exists()

    def connect(self, path: Path, patience: float) -> Any:
        self.scheduler.step()
        process = self.scheduler.process
        assert process is not None
        volume = self.volume(path)
        if volume.failing:
            raise _error("unable to open database file", sqlite3.SQLITE_CANTOPEN)
        one = Connection(self.scheduler, volume, process, patience)
        process.ends.append(one.lose)
        return one

    def flush(self, path: Path) -> None:
        self.scheduler.step()
        volume = self.volume(path)
        if volume.failing:
            raise OSError(5, "Input/output error")
        if not volume.log.exists():
            raise FileNotFoundError
        written = volume.written()
        volume.safe = (written[:HEADER], len(written))
        volume.flushed.append(self.scheduler.now)

    def protect(self, path: Path) -> None:
        self.scheduler.step()

    def cut_power(self, path: Path) -> None:
        """Lose of a file what was not flushed, or some of it; all that had it open is dead."""
        volume, dice = self.volume(path), self.scheduler.dice
        written = volume.written()
        header, length = volume.safe
        least = length if written[:HEADER] == header else 0
        kept = dice.choice((least, len(written), dice.randint(least, max(least, len(written)))))
        left = bytearray(written[:kept])
        if kept > least and dice.random() < 0.5:  # a page in between that was not written
            at = dice.randrange(least, kept)
            left[at : at + 512] = bytes(len(left[at : at + 512]))
        volume.cuts += kept < len(written)
        volume.renew(bytes(left))
        volume.safe = (bytes(left[:HEADER]), len(left))


@dataclass(eq=False)
class Connection:
    """A connection to a file, as sqlite3.Connection."""

    scheduler: Scheduler
    volume: Volume
    process: Process
    patience: float
    storing: bool = False  # whether this transaction stores a turn
    torn: bytes | None = None  # the log as a crash within a commit left it

    def __post_init__(self) -> None:
        self._real = sqlite3.connect(self.volume.path, timeout=0.0, isolation_level=None)
        self.volume.open.append(self)

    @property
    def text_factory(self) -> object:
        return self._real.text_factory

    @text_factory.setter
    def text_factory(self, factory: Any) -> None:
        self._real.text_factory = factory

    @property
    def in_transaction(self) -> bool:
        return self._real.in_transaction

    def execute(self, sql: str, arguments: Sequence[object] = ()) -> Any:
        """Execute a statement; the process may crash before, within and after it."""
        self.scheduler.step()
        if sql.startswith("PRAGMA busy_timeout"):
            self.patience = float(sql.split("=")[1]) / 1000.0
            return self._real.execute("SELECT 1")
        self._fail(sql)
        before = self.volume.written() if sql == "COMMIT" else b""
        storing = self.storing
        found = self._patiently(sql, arguments)
        self.storing = "INTO turns" in sql or (self.storing and sql not in ENDS)
        if sql == "COMMIT" and storing and self.volume.crashing:
            self.volume.crashing = False
            self.process.crash_at = self.process.steps + 2  # not within the commit
        if sql == "COMMIT" and self.process.crash_at == self.process.steps + 1:
            self.torn = self._part(before, self.volume.written())
        self.scheduler.step()
        return found

    def close(self) -> None:
        self.scheduler.step()
        self._real.close()
        if self in self.volume.open:
            self.volume.open.remove(self)

    def lose(self) -> None:
        """Leave the file as it is, since the process is dead."""
        if self in self.volume.open:
            self.volume.renew(self.volume.written() if self.torn is None else self.torn)

    def abandon(self) -> None:
        """Close the file of which there is a copy."""
        with suppress(sqlite3.Error):
            self._real.close()

    def _part(self, before: bytes, after: bytes) -> bytes:
        if len(after) <= len(before) or after[:HEADER] != before[:HEADER]:
            return after
        return after[: self.scheduler.dice.randint(len(before), len(after))]

    def _fail(self, sql: str) -> None:
        writes = sql.lstrip().split(" ")[0].rstrip() in WRITES
        if self.volume.failing:
            raise _error("disk I/O error", sqlite3.SQLITE_IOERR)
        if self.volume.full and writes and not sql.startswith("BEGIN"):
            if self._real.in_transaction and self.scheduler.dice.random() < 0.5:
                self._real.execute("ROLLBACK")
            raise _error("database or disk is full", sqlite3.SQLITE_FULL)

    def _patiently(self, sql: str, arguments: Sequence[object]) -> Any:
        give_up = self.scheduler.now + self.patience
        while True:
            try:
                found = self._real.execute(sql, arguments)
                if not sql.startswith("PRAGMA wal_checkpoint"):
                    return found
                [row] = found.fetchall()
                if not row[0] or self.scheduler.now >= give_up:
                    return _Rows([row])
            except sqlite3.OperationalError as error:
                busy = error.sqlite_errorcode & 0xFF in LOCKED
                if not busy or self.scheduler.now >= give_up:
                    raise
            self.scheduler.sleep(POLL)


@dataclass
class _Rows:
    rows: list[tuple[Any, ...]]

    def fetchall(self) -> list[tuple[Any, ...]]:
        return self.rows


def _error(text: str, code: int) -> sqlite3.OperationalError:
    error = sqlite3.OperationalError(text)
    error.sqlite_errorcode = code
    return error
