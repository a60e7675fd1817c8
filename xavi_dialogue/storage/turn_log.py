"""The service's store of turns and events on disk.

A turn is stored before its reply is sent. If that fails, the passenger still gets the answer
and one warning; the missing turns are stored as soon as the file can be written again.
"""

import logging
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from planner.record.events import Event
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.runtime import system
from xavi_dialogue.storage.conversations import New, NewEvent, NewTurn, RideName, Store, fits
from xavi_dialogue.storage.database import is_there
from xavi_dialogue.storage.store_errors import (
    Damaged,
    NotStorable,
    StoreError,
    Unpurged,
    Unwritable,
)

MAX_PAST = 200  # latest turns of a session that are loaded
_LOG = logging.getLogger(__name__)
NOBODY = "nobody"  # stands for the digest of an owner that cannot be read: no token has it
REST = 10.0  # pause after a failed attempt, as a multiple of its time ...
LONGEST = 10.0  # [s] ... but no longer: the whole process may have been stopped meanwhile
# A disk takes 5 to 30 ms: after each answer that would hold up the next one.
FLUSHED_EVERY = 0.25  # [s] while no passenger waits
OVERDUE = 1.0  # [s] after which it is flushed even if one does
PATIENCE = 0.25  # [s] to wait for other writers, as answers have a deadline
MAX_MISSED = 5000  # turns and events that wait to be written; the oldest are dropped first
EXPIRED_EVERY = 3600.0  # [s]
PURGED_EVERY = 10.0  # [s] while erased data is still in the files


@dataclass(frozen=True)
class Retention:
    """The file in which turns are stored, and for how many days."""

    path: Path
    days: int


def default_path() -> Path:
    """Return the file of this user's conversations."""
    # Imported late, since few importers of this module need it.
    from platformdirs import user_data_path

    return user_data_path("xavi-dialogue") / "dialogue.sqlite3"


def _nobody(_: str) -> None:
    pass


@dataclass
class TurnLog:
    """The store of turns; what cannot be written waits, and without a file nothing is stored."""

    keeping: Retention | None = None
    warn: Callable[[str], None] = _nobody
    _store: Store | None = None
    _missed: list[New] = field(default_factory=list)  # not yet written
    _unforgotten: set[str] = field(default_factory=set)  # sessions that are still to be erased
    _unpurged: bool = False  # something is erased, and still in the files
    _purged: float = float("-inf")  # [s] on the monotonic clock: the latest attempt to purge
    _failing: bool = False
    _unread: bool = False  # reading has failed, too
    _again: float = 0.0  # [s] on the monotonic clock: when the file is tried again
    _unsynced: bool = False  # written, but not yet on the disk itself
    _synced: float = float("-inf")  # [s] on the monotonic clock, when it was last flushed
    _expired: float = float("-inf")  # [s] on the monotonic clock: old turns were last erased

    def recall(self, session: str) -> tuple[Turn, ...]:
        """Return the turns of a session, oldest first; none if they can never be read again.

        Raises:
            Unwritable: they cannot be read now.
        """
        if self.keeping is None or session in self._unforgotten:
            return ()
        missed = tuple(
            new.turn for new in self._missed if isinstance(new, NewTurn) and new.session == session
        )
        try:
            with self._reading(self.keeping) as store:
                return (*store.turns(session, MAX_PAST), *missed)[-MAX_PAST:]
        except Damaged as error:
            self._regret("what was said before", error)
        except StoreError as error:
            self._cannot_read(self.keeping, error)
        return missed

    def owner(self, session: str) -> str | None:
        """Return the digest of a session's owner; None if it is open to all.

        Raises:
            StoreError: the owner cannot be read.
        """
        if self.keeping is None or session in self._unforgotten:
            return None
        missed = (n.owner for n in self._missed if isinstance(n, NewTurn) and n.session == session)
        try:
            with self._reading(self.keeping) as store:
                return store.owner(session) or next(missed, None)
        except Damaged as error:
            if self._regret("whose conversation it was", error):
                return NOBODY
            raise
        except StoreError as error:
            self._fail(error)
            raise

    def answered(self, session: str, request: str, since: float) -> Turn | None:
        """Return the turn that answered a request since a wall time [s]; None if there is none.

        Raises:
            Unwritable: that cannot be read now.
        """
        if self.keeping is None or session in self._unforgotten:
            return None
        for new in self._missed:
            if isinstance(new, NewTurn) and (new.session, new.request) == (session, request):
                return new.turn
        try:
            with self._reading(self.keeping) as store:
                return store.answered(session, request, since)
        except Damaged:
            return None  # it is answered again, as if nothing had been said
        except StoreError as error:
            self._cannot_read(self.keeping, error)
        return None

    def keep(
        self,
        session: str,
        ride: RideName | None,
        wall_time: float,
        turn: Turn,
        owner: str | None = None,
        request: str | None = None,
    ) -> None:
        """Write a turn to the file, and all that waits; if that fails, it is tried again later."""
        if self.keeping is None:
            return
        if fits(turn):
            self._missed.append(NewTurn(session, ride, wall_time, turn, owner, request))
        else:
            self.warn(f"a turn of session {session} is too large to be kept")
        self._write(self.keeping)

    def hear(self, ride: RideName, seq: int, wall_time: float, event: Event) -> None:
        """Add an event, which the next `tidy` writes."""
        if self.keeping is not None:
            self._missed.append(NewEvent(ride, seq, wall_time, event))
            del self._missed[:-MAX_MISSED]

    def tidy(self, now: float, *, idle: bool) -> None:
        """Write pending turns and events; sometimes erase old ones.

        Args:
            now: wall time [s].
            idle: no passenger waits for an answer, so there is time for the disk.
        """
        # Each attempt on a failing file may take a while; passengers must not wait for it.
        if self.keeping is None or (self._failing and not idle):
            return
        if self._missed or self._failing:
            self._write(self.keeping)
        try:
            with self._using(self.keeping) as store:
                self._tidy(store, self.keeping.days, now, idle)
        except Unpurged:
            self._unpurged = True
        except StoreError as error:
            self._fail(error)

    def flush(self) -> None:
        """Flush what was written, if that is overdue; for a service that has no idle moment."""
        if self.keeping is None or self._failing or not self._is_due(OVERDUE):
            return
        try:
            with self._using(self.keeping) as store:
                self._flush(store)
        except StoreError as error:
            self._fail(error)

    def forget(self, session: str) -> int | None:
        """Erase a session; return the number of turns, or None if data is left for now."""
        self._missed = [
            new for new in self._missed if isinstance(new, NewEvent) or new.session != session
        ]
        if self.keeping is None:
            return 0
        self._unforgotten.add(session)
        try:
            with self._using(self.keeping) as store:
                erased = self._erase(store)
                if self._unpurged:
                    store.purge()
                    self._unpurged = False
        except Unpurged:
            return None
        except StoreError as error:
            self._fail(error)
            return None
        return erased

    def close(self) -> None:
        """Close the file."""
        if self._store is not None:
            self._store.close()
            self._store = None

    def _tidy(self, store: Store, days: int, now: float, idle: bool) -> None:
        if self._is_due(FLUSHED_EVERY if idle else OVERDUE):
            self._flush(store)
        # The wall clock may be set back; then nothing would be erased for as long.
        passed = system.monotonic()
        if passed >= self._expired + EXPIRED_EVERY:
            self._expired = self._purged = passed
            store.expire(days, now)
        if idle and self._unpurged and passed >= self._purged + PURGED_EVERY:
            self._purged = passed
            store.purge()
            self._unpurged = False

    def _is_due(self, every: float) -> bool:
        return self._unsynced and system.monotonic() >= self._synced + every

    def _flush(self, store: Store) -> None:
        self._unsynced = False
        self._synced = system.monotonic()
        store.sync()

    @contextmanager
    def _reading(self, keeping: Retention) -> Iterator[Store]:
        """Open the file for reading; once it is open, other writers do not block this.

        Raises:
            Unwritable: it cannot be opened, or it is too early to try again.
        """
        if self._store is not None:
            yield self._store
        else:
            with self._using(keeping) as store:
                yield store

    @contextmanager
    def _using(self, keeping: Retention) -> Iterator[Store]:
        """Open the file; after an attempt that took long to fail, pause before the next one.

        Raises:
            Unwritable: it cannot be used, or it is too early to try again.
        """
        began = system.monotonic()
        if began < self._again:
            raise Unwritable(f"{keeping.path} is not tried again yet")
        try:
            if self._store is None:
                self._store = Store(keeping.path, patience=PATIENCE)
            yield self._store
        except Unpurged:
            raise  # the file works
        except Unwritable:
            ended = system.monotonic()
            self._again = ended + min(REST * (ended - began), LONGEST)
            raise

    def _regret(self, what: str, error: Damaged) -> bool:
        """Report damage; return whether it is limited to one session."""
        if self._store is None:
            self._fail(error)
            return False
        self.warn(f"{what} is not known any more: {error}")
        return True

    def _write(self, keeping: Retention) -> None:
        del self._missed[:-MAX_MISSED]
        try:
            with self._using(keeping) as store:
                self._erase(store)
                self._keep(store)
        except StoreError as error:
            self._fail(error)
            return
        self._missed.clear()
        self._unsynced = True
        if self._failing:
            self._failing = self._unread = False
            _LOG.warning("the store works again")
            self.warn("what is said is kept again, and what was missed as well")

    def _keep(self, store: Store) -> None:
        try:
            store.keep(self._missed)
        except NotStorable:  # one of them; the others need not be lost
            for new in self._missed:
                try:
                    store.keep([new])
                except NotStorable as error:
                    self.warn(str(error))

    def _erase(self, store: Store) -> int:
        erased = 0
        for session in sorted(self._unforgotten):
            try:
                erased += store.forget(session)
            except Unpurged:  # it is erased; purging the files must not delay answers
                self._unpurged = True
            self._unforgotten.discard(session)
        return erased

    def _cannot_read(self, keeping: Retention, error: StoreError) -> None:
        """Take note that the file cannot be read.

        Raises:
            Unwritable: that may work later, and the file holds what must be known until then.
        """
        self._fail(error)
        if not isinstance(error, Unwritable) or not is_there(keeping.path):
            return
        if not self._unread:
            self._unread = True
            _LOG.error("the store cannot be read", extra={"problem": str(error)})
            self.warn("questions are refused until what was said before can be read again")
        raise error

    def _fail(self, error: StoreError) -> None:
        if not self._failing:
            _LOG.error("the store fails", extra={"problem": str(error)})
            self.warn(f"what is said is not kept until this is solved: {error}")
        self._failing = True
