"""Conversations on disk, with every turn and the events of the rides.

This module reads no clock; wall times are arguments, in seconds since 1970.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Self, TypeAlias

import msgspec

from planner.record.events import Event
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.storage.database import Database, Writing
from xavi_dialogue.storage.rows import Line, Summary, checked, decoded, decoded_owner, known
from xavi_dialogue.storage.store_errors import NotStorable

VERSION = 3
SCHEMA = "xavi.memory/2"  # of exported lines
RECENT = 10  # latest turns that are searched for a repeated request
MAX_TURN = 256 * 1024  # bytes
PATIENCE = 5.0  # [s] to wait for others that write
DAY = 86400.0  # [s]

_TABLES = """
CREATE TABLE rides (
    id TEXT PRIMARY KEY, begun REAL NOT NULL, scenario TEXT, seed INTEGER
);
CREATE TABLE turns (
    session TEXT NOT NULL, number INTEGER NOT NULL, ride TEXT REFERENCES rides,
    sim_time REAL NOT NULL, wall_time REAL NOT NULL, turn TEXT NOT NULL, request TEXT,
    PRIMARY KEY (session, number)
);
CREATE TABLE events (
    ride TEXT NOT NULL REFERENCES rides ON DELETE CASCADE, seq INTEGER NOT NULL,
    sim_time REAL NOT NULL, event TEXT NOT NULL,
    PRIMARY KEY (ride, seq)
);
CREATE INDEX turns_by_ride ON turns (ride);
CREATE TABLE owners (session TEXT PRIMARY KEY, digest TEXT NOT NULL)
"""
# Migrations of the tables from each version to the next.
_MIGRATIONS = {
    1: "CREATE TABLE owners (session TEXT PRIMARY KEY, digest TEXT NOT NULL);"
    " ALTER TABLE turns ADD COLUMN request TEXT",
    # The form of what was understood has changed; only text and reply of a turn are kept.
    2: "UPDATE turns SET turn = json_object("
    "'text', json_extract(turn, '$.text'), 'reply', json_object("
    "'text', json_extract(turn, '$.reply.text'), 'kind', json_extract(turn, '$.reply.kind'),"
    " 'reason', json_extract(turn, '$.reply.reason'),"
    " 'sim_time', json_extract(turn, '$.reply.sim_time'))) WHERE json_valid(turn)",
}


@dataclass(frozen=True, slots=True)
class RideName:
    """A ride, with scenario and seed to drive it again."""

    id: str  # changes with every start of the car
    scenario: str | None = None  # name or folder; None: not known yet
    seed: int | None = None


@dataclass(frozen=True, slots=True)
class NewTurn:
    """A turn to store."""

    session: str
    ride: RideName | None  # None: before the first car
    wall_time: float  # [s]
    turn: Turn
    owner: str | None = None  # digest of the owner's token; None: open to all
    request: str | None = None  # name of the request that it answered


@dataclass(frozen=True, slots=True)
class NewEvent:
    """An event of a ride, to store."""

    ride: RideName
    seq: int  # of the ride's events, from 0
    wall_time: float  # [s]
    event: Event


New: TypeAlias = NewTurn | NewEvent


class Store:
    """The file of all conversations of one user; several processes may use it at once.

    Every method raises StoreError if the file cannot be used; then it has changed nothing. If
    only one session is unreadable, the error is Damaged and says how to forget the session, which
    is possible without reading it.
    """

    def __init__(self, path: Path, *, patience: float = PATIENCE) -> None:
        """Open the file; create it if it does not exist.

        Args:
            path: the file.
            patience: [s] to wait for other processes that write.
        """
        self.path = path
        self._file = Database(path, _TABLES, VERSION, _MIGRATIONS, patience=patience)

    def keep(self, news: Iterable[New]) -> None:
        """Store all of these, or none; an event that is already stored stays as it is.

        Raises:
            NotStorable: a turn has more than 256 KiB, or a text or number cannot be stored.
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
        """Return the latest turns of a session, oldest first."""
        sql = "SELECT turn FROM turns WHERE session = ? ORDER BY number DESC LIMIT ?"
        rows = self._file.rows(sql, (session, limit))
        return tuple(decoded(self.path, session, turn, Turn) for (turn,) in reversed(rows))

    def owner(self, session: str) -> str | None:
        """Return the digest of a session's owner; None if it is open to all."""
        rows = self._file.rows("SELECT digest FROM owners WHERE session = ?", (session,))
        return decoded_owner(self.path, session, rows[0][0]) if rows else None

    def answered(self, session: str, request: str, since: float) -> Turn | None:
        """Return the turn, among the latest of a session, with which a request was answered.

        Args:
            session: name of the session.
            request: name of the request.
            since: [s] wall time; earlier turns answered another request of that name.
        """
        sql = (
            "SELECT request, turn FROM turns WHERE session = ? AND wall_time >= ?"
            " ORDER BY number DESC LIMIT ?"
        )
        rows = self._file.rows(sql, (session, since, RECENT))
        found = (decoded(self.path, session, turn, Turn) for name, turn in rows if name == request)
        return next(found, None)

    def holds(self, session: str) -> bool:
        """Check whether anything of a session is stored, even if its owner cannot be read."""
        return bool(self._file.rows("SELECT 1 FROM turns WHERE session = ? LIMIT 1", (session,)))

    def names(self) -> tuple[str, ...]:
        """Return the names of all sessions, without reading their turns."""
        rows = self._file.rows("SELECT DISTINCT session FROM turns ORDER BY session")
        return tuple(known(self.path, name) for (name,) in rows)

    def sessions(self, name: str | None = None) -> tuple[Summary, ...]:
        """Return all sessions, or the one of a name, ordered by the time of the latest turn."""
        rows = self._file.rows(
            "SELECT name, count, first, last, scenario, seed, driven.sim_time, said.turn FROM"
            " (SELECT session AS name, count(*) AS count, min(wall_time) AS first,"
            " max(wall_time) AS last, max(number) AS latest,"
            " max(CASE WHEN ride IS NOT NULL THEN number END) AS riding"
            " FROM turns WHERE ?1 IS NULL OR session = ?1 GROUP BY session)"
            " JOIN turns AS said ON said.session = name AND said.number = latest"
            " LEFT JOIN turns AS driven ON driven.session = name AND driven.number = riding"
            " LEFT JOIN rides ON id = driven.ride ORDER BY last, name",
            (name,),
        )
        return tuple(Summary.of(self.path, row) for row in rows)

    def forget(self, session: str | None = None, before: float | None = None) -> int:
        """Erase turns, and the rides that no turn refers to any more.

        Args:
            session: erase turns of this session; None: of all.
            before: [s] wall time; None: all.

        Returns:
            The number of turns that were erased. The files no longer contain them, nor any that
            were erased before.

        Raises:
            Unpurged: they are erased, but still in the files; call again.
        """
        whose, when = "session = ?", "wall_time < ?"
        limits = {whose: session, when: before}
        given = {limit: value for limit, value in limits.items() if value is not None}
        chosen = " AND ".join(given) or "true"
        with self._file.writing() as file:
            spoken = (
                "SELECT DISTINCT rides.rowid FROM rides JOIN turns ON turns.ride = rides.id"
                f" WHERE {chosen}"
            )
            rides = {row for (row,) in file.execute(spoken, [*given.values()])}
            erased = file.execute(f"DELETE FROM turns WHERE {chosen}", [*given.values()]).rowcount
            if session is None:
                sql = "SELECT rowid FROM rides WHERE ?1 IS NULL OR begun < ?1"
                rides |= {row for (row,) in file.execute(sql, (before,))}
            silent = (
                "DELETE FROM rides"
                " WHERE rowid = ? AND NOT EXISTS (SELECT 1 FROM turns WHERE turns.ride = rides.id)"
            )
            gone = sum(file.execute(silent, (row,)).rowcount for row in sorted(rides))
            if erased or gone:
                self._file.owe(file)
                file.execute("DELETE FROM owners WHERE session NOT IN (SELECT session FROM turns)")
        self._file.purge()
        return erased

    def purge(self) -> None:
        """Purge erased data from the files, whichever process erased it.

        Raises:
            Unpurged: data is left.
        """
        self._file.purge()

    def expire(self, days: float, now: float) -> int:
        """Erase turns that are older than a number of days; return how many were erased."""
        return self.forget(before=now - days * DAY)

    def export(self, session: str | None = None) -> Iterator[str]:
        """Yield turns, and the events of their rides, as lines of JSON; of one session, or all."""
        chosen, given = ("true", ()) if session is None else ("session = ?", (session,))
        sql = (
            "SELECT session, number, ride, wall_time, turn FROM turns"
            f" WHERE {chosen} ORDER BY session, number"
        )
        for name, number, ride, wall_time, turn in self._file.rows(sql, given):
            fields = {"number": number, "ride": ride, "wall_time": wall_time}
            yield self._line(name, {"session": name, **fields}, "turn", turn)
        sql = (
            "SELECT ride, seq, event,"
            " (SELECT min(session) FROM turns WHERE turns.ride = events.ride)"
            f" FROM events WHERE ride IN (SELECT ride FROM turns WHERE {chosen}) ORDER BY ride, seq"
        )
        for ride, seq, event, name in self._file.rows(sql, given):
            yield self._line(name, {"ride": ride, "seq": seq}, "event", event)

    def _line(self, name: object, fields: dict[str, object], kind: str, text: object) -> str:
        session = known(self.path, name)
        held = decoded(self.path, session, text, dict[str, Any])
        return _json(checked(self.path, session, {"schema": SCHEMA, **fields, kind: held}, Line))

    def sync(self) -> None:
        """Flush to disk, so that data survives a power cut; it survives a crash anyway."""
        self._file.sync()

    def cap(self, size: int) -> None:
        """Limit the size of the file to `size` bytes, or to its present size."""
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
            raise NotStorable(
                f"a turn of {size} bytes is not kept in {self.path}: at most {MAX_TURN}"
            )
        ride = None if new.ride is None else new.ride.id
        found = file.execute("SELECT digest FROM owners WHERE session = ?", (new.session,))
        if (owner := found.fetchone()) is not None and owner[0] != new.owner:
            raise NotStorable(f"a turn of session {new.session} that belongs to somebody else")
        if new.owner is not None:
            claim = "INSERT OR IGNORE INTO owners VALUES (?, ?)"
            file.execute(claim, (new.session, new.owner))
        times = (new.turn.reply.sim_time, new.wall_time)
        row = (new.session, ride, *times, text, new.request, new.session)
        file.execute(
            "INSERT INTO turns SELECT ?, coalesce(max(number), 0) + 1, ?, ?, ?, ?, ?"
            " FROM turns WHERE session = ?",
            row,
        )


def fits(turn: Turn) -> bool:
    """Check whether a turn is small enough to store."""
    return len(_json(turn).encode()) <= MAX_TURN


def _keep_ride(file: Writing, ride: RideName, wall_time: float) -> None:
    file.execute(
        "INSERT INTO rides VALUES (?, ?, ?, ?) ON CONFLICT (id) DO UPDATE SET"
        " scenario = coalesce(scenario, excluded.scenario), seed = coalesce(seed, excluded.seed)",
        (ride.id, wall_time, ride.scenario, ride.seed),
    )


def _json(value: object) -> str:
    return msgspec.json.encode(value).decode()
