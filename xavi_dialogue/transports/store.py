"""What is kept of conversations on disk: every turn, and what happened on the rides.

Nothing here knows a clock; wall times are given, in seconds since 1970.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Self, TypeAlias

import msgspec

from planner.events import Event
from xavi_dialogue.dialogue.turn import Turn
from xavi_dialogue.transports.database import Damaged, Database, TooLarge, Writing

VERSION = 1
SCHEMA = "xavi.memory/1"  # of exported lines
MAX_TURN = 256 * 1024  # bytes
PATIENCE = 5.0  # [s] to wait for others that write
DAY = 86400.0  # [s]

_TABLES = """
CREATE TABLE rides (
    id TEXT PRIMARY KEY, begun REAL NOT NULL, scenario TEXT, seed INTEGER
);
CREATE TABLE turns (
    session TEXT NOT NULL, number INTEGER NOT NULL, ride TEXT REFERENCES rides,
    sim_time REAL NOT NULL, wall_time REAL NOT NULL, turn TEXT NOT NULL,
    PRIMARY KEY (session, number)
);
CREATE TABLE events (
    ride TEXT NOT NULL REFERENCES rides ON DELETE CASCADE, seq INTEGER NOT NULL,
    sim_time REAL NOT NULL, event TEXT NOT NULL,
    PRIMARY KEY (ride, seq)
);
CREATE INDEX turns_by_ride ON turns (ride)
"""


@dataclass(frozen=True, slots=True)
class RideName:
    """A ride, and how to drive it again."""

    id: str  # changes with every start of the car
    scenario: str | None = None  # name or folder; None: not known yet
    seed: int | None = None


@dataclass(frozen=True, slots=True)
class NewTurn:
    """A turn to be kept."""

    session: str
    ride: RideName | None  # None: no car had been heard of
    wall_time: float  # [s]
    turn: Turn


@dataclass(frozen=True, slots=True)
class NewEvent:
    """Something that happened on a ride, to be kept."""

    ride: RideName
    seq: int  # of the ride's events, from 0
    wall_time: float  # [s]
    event: Event


New: TypeAlias = NewTurn | NewEvent


class Summary(msgspec.Struct, frozen=True):
    """One session, as `xavi sessions` lists it."""

    name: str
    turns: int
    first: float  # [s] wall time of the first turn that is kept
    last: float  # [s] of the last
    scenario: str | None  # of the last turn on a ride
    seed: int | None
    sim_time: float | None  # [s] at which that turn's question was asked
    question: str  # of the last turn


class _Line(msgspec.Struct, omit_defaults=True):
    """One exported line: a turn, or an event."""

    schema: str
    session: str | msgspec.UnsetType = msgspec.UNSET
    number: int | msgspec.UnsetType = msgspec.UNSET
    ride: str | msgspec.UnsetType = msgspec.UNSET
    seq: int | msgspec.UnsetType = msgspec.UNSET
    wall_time: float | msgspec.UnsetType = msgspec.UNSET
    turn: msgspec.Raw | msgspec.UnsetType = msgspec.UNSET
    event: msgspec.Raw | msgspec.UnsetType = msgspec.UNSET


class _Asked(msgspec.Struct):
    text: str


class Store:
    """The file of all conversations of one user; several processes may use it at once.

    Every method raises StoreError where the file cannot be used; then it has changed nothing.
    """

    def __init__(self, path: Path, *, patience: float = PATIENCE) -> None:
        """Open the file, and make it where there is none.

        Args:
            path: the file.
            patience: [s] to wait for other processes that write.
        """
        self.path = path
        self._file = Database(path, _TABLES, VERSION, patience=patience)

    def keep(self, news: Iterable[New]) -> None:
        """Keep all of these, or none; an event that is there already stays as it is.

        Raises:
            TooLarge: a turn has more than 256 KiB.
        """
        with self._file.writing() as file:
            for new in news:
                if new.ride is not None:
                    _keep_ride(file, new.ride, new.wall_time)
                match new:
                    case NewTurn():
                        self._keep_turn(file, new)
                    case NewEvent(ride, seq, _, event):
                        row = (ride.id, seq, event.sim_time, _json(event))
                        file.execute("INSERT OR IGNORE INTO events VALUES (?, ?, ?, ?)", row)

    def turns(self, session: str, limit: int) -> tuple[Turn, ...]:
        """The latest turns of a session, oldest first."""
        sql = "SELECT turn FROM turns WHERE session = ? ORDER BY number DESC LIMIT ?"
        rows = self._file.rows(sql, (session, limit))
        try:
            return tuple(msgspec.json.decode(turn, type=Turn) for (turn,) in reversed(rows))
        except (msgspec.MsgspecError, UnicodeDecodeError) as error:
            raise Damaged(
                f"a turn of session {session} in {self.path} cannot be read ({error});"
                f" `xavi forget {session}` erases the session"
            ) from error

    def sessions(self) -> tuple[Summary, ...]:
        """All sessions, the one that was spoken in last at the end."""
        rows = self._file.rows(
            "SELECT name, count, first, last, scenario, seed, driven.sim_time, said.turn FROM"
            " (SELECT session AS name, count(*) AS count, min(wall_time) AS first,"
            " max(wall_time) AS last, max(number) AS latest,"
            " max(CASE WHEN ride IS NOT NULL THEN number END) AS riding"
            " FROM turns GROUP BY session)"
            " JOIN turns AS said ON said.session = name AND said.number = latest"
            " LEFT JOIN turns AS driven ON driven.session = name AND driven.number = riding"
            " LEFT JOIN rides ON id = driven.ride ORDER BY last, name"
        )
        return tuple(Summary(*(*row[:-1], _question(row[-1]))) for row in rows)

    def forget(self, session: str | None = None, before: float | None = None) -> int:
        """Erase turns, and the rides that nobody speaks of any more.

        Args:
            session: whose; None: everybody's.
            before: [s] wall time; None: all.

        Returns:
            How many turns were erased.
        """
        whose, when = "session = ?", "wall_time < ?"
        limits = {whose: session, when: before}
        given = {limit: value for limit, value in limits.items() if value is not None}
        chosen = " AND ".join(given) or "true"
        with self._file.writing() as file:
            spoken = file.execute(
                f"SELECT DISTINCT ride FROM turns WHERE {chosen}", [*given.values()]
            )
            rides = {ride for (ride,) in spoken if ride is not None}
            erased = file.execute(f"DELETE FROM turns WHERE {chosen}", [*given.values()]).rowcount
            if session is None:
                sql = "SELECT id FROM rides WHERE ? IS NULL OR begun < ?"
                rides |= {ride for (ride,) in file.execute(sql, (before, before))}
            silent = (
                "DELETE FROM rides"
                " WHERE id = ? AND NOT EXISTS (SELECT 1 FROM turns WHERE turns.ride = rides.id)"
            )
            gone = sum(file.execute(silent, (ride,)).rowcount for ride in sorted(rides))
        if erased or gone:
            self._file.purge()
        return erased

    def questions(self, session: str | None = None, before: float | None = None) -> tuple[str, ...]:
        """The questions of the turns that `forget` would erase."""
        sql = (
            "SELECT turn FROM turns WHERE (?1 IS NULL OR session = ?1)"
            " AND (?2 IS NULL OR wall_time < ?2)"
        )
        return tuple(_question(turn) for (turn,) in self._file.rows(sql, (session, before)))

    def expire(self, days: float, now: float) -> int:
        """Erase what is older than so many days; how many turns that were."""
        return self.forget(before=now - days * DAY)

    def export(self, session: str | None = None) -> Iterator[str]:
        """Turns and the events of their rides as lines of JSON; of one session, or all."""
        chosen, given = ("true", ()) if session is None else ("session = ?", (session,))
        sql = (
            "SELECT session, number, ride, wall_time, turn FROM turns"
            f" WHERE {chosen} ORDER BY session, number"
        )
        for name, number, ride, wall_time, turn in self._file.rows(sql, given):
            yield _json(_Line(SCHEMA, name, number, ride, wall_time=wall_time, turn=_raw(turn)))
        sql = (
            "SELECT ride, seq, event FROM events"
            f" WHERE ride IN (SELECT ride FROM turns WHERE {chosen}) ORDER BY ride, seq"
        )
        for ride, seq, event in self._file.rows(sql, given):
            yield _json(_Line(SCHEMA, ride=ride, seq=seq, event=_raw(event)))

    def sync(self) -> None:
        """Wait until what is kept outlives a power cut, too; a process that dies it does anyway."""
        self._file.sync()

    def cap(self, size: int) -> None:
        """Let the file grow to no more than `size` bytes, or than it has."""
        self._file.cap(size)

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def _keep_turn(self, file: Writing, new: NewTurn) -> None:
        text = _json(new.turn)
        size = len(text.encode())
        if size > MAX_TURN:
            raise TooLarge(f"a turn of {size} bytes is not kept in {self.path}: at most {MAX_TURN}")
        ride = None if new.ride is None else new.ride.id
        row = (new.session, ride, new.turn.reply.sim_time, new.wall_time, text, new.session)
        file.execute(
            "INSERT INTO turns SELECT ?, coalesce(max(number), 0) + 1, ?, ?, ?, ?"
            " FROM turns WHERE session = ?",
            row,
        )


def fits(turn: Turn) -> bool:
    """Whether a turn is small enough to be kept."""
    return len(_json(turn).encode()) <= MAX_TURN


def _keep_ride(file: Writing, ride: RideName, wall_time: float) -> None:
    file.execute(
        "INSERT INTO rides VALUES (?, ?, ?, ?) ON CONFLICT (id) DO UPDATE SET"
        " scenario = coalesce(scenario, excluded.scenario), seed = coalesce(seed, excluded.seed)",
        (ride.id, wall_time, ride.scenario, ride.seed),
    )


def _question(turn: str) -> str:
    try:
        return msgspec.json.decode(turn, type=_Asked).text
    except (msgspec.MsgspecError, UnicodeDecodeError):
        return ""


def _raw(text: str) -> msgspec.Raw:
    return msgspec.Raw(text.encode())


def _json(value: object) -> str:
    return msgspec.json.encode(value).decode()
