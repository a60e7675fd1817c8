"""What a service keeps on disk of what is said and what happens, and gets back.

A turn is kept before its reply is sent. Where that fails the passenger is answered all the
same, and warned once; what was missed is made up for as soon as the file can be written again.
"""

import logging
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

from planner.record.events import Event
from xavi_dialogue.dialogue.state.turn import Turn
from xavi_dialogue.storage.conversations import New, NewEvent, NewTurn, RideName, Store, fits
from xavi_dialogue.storage.database import Damaged, StoreError, Unfit, Unpurged, Unwritable

MAX_PAST = 200  # turns of a session that are known of
_LOG = logging.getLogger(__name__)
NOBODY = "nobody"  # in place of the digest of an owner that cannot be read: no token has it
REST = 10.0  # times as long as an attempt took to fail, there is no other
PATIENCE = 0.25  # [s] for others that write: an answer has its deadline
MAX_MISSED = 5000  # turns and events that wait to be written; the oldest are lost first
EXPIRED_EVERY = 3600.0  # [s]
PURGED_EVERY = 10.0  # [s] as long as what was erased is still in the files


@dataclass(frozen=True)
class Keeping:
    """Where and how long what is said is kept."""

    path: Path
    days: int


def default_path() -> Path:
    """The file of this user's conversations."""
    # Deferred: it is needed by few of those who import this module.
    from platformdirs import user_data_path

    return user_data_path("xavi-dialogue") / "dialogue.sqlite3"


def _nobody(_: str) -> None:
    pass


@dataclass
class Memory:
    """The file, as long as it can be used; without one, nothing is kept."""

    keeping: Keeping | None = None
    warn: Callable[[str], None] = _nobody
    _store: Store | None = None
    _missed: list[New] = field(default_factory=list)  # not yet written
    _unforgotten: set[str] = field(default_factory=set)  # sessions that are still to be erased
    _unpurged: bool = False  # something is erased, and still in the files
    _purged: float = 0.0  # [s] wall time when that was last tried to be mended
    _failing: bool = False
    _again: float = 0.0  # [s] on the monotonic clock: when the file is tried again
    _unsynced: bool = False  # written, but not yet on the disk itself
    _expired: float = 0.0  # [s] wall time when what is too old was last erased

    def recall(self, session: str) -> tuple[Turn, ...]:
        """What was said in a session, oldest first; nothing where that cannot be read."""
        if self.keeping is None or session in self._unforgotten:
            return ()
        try:
            with self._reading(self.keeping) as store:
                return store.turns(session, MAX_PAST)
        except Damaged as error:
            self._regret("what was said before", error)
        except StoreError as error:
            self._fail(error)
        return ()

    def owner(self, session: str) -> str | None:
        """The digest of whom a session belongs to; None where it is open to all.

        Raises:
            StoreError: that cannot be read.
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
        """The turn with which a request was answered since a wall time [s]; None: it was not."""
        if self.keeping is None or session in self._unforgotten:
            return None
        for new in self._missed:
            if isinstance(new, NewTurn) and (new.session, new.request) == (session, request):
                return new.turn
        with suppress(StoreError), self._reading(self.keeping) as store:  # else answered anew
            return store.answered(session, request, since)
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
        """Keep a turn, and all that was missed; in the file when this returns, if at all."""
        if self.keeping is None:
            return
        if fits(turn):
            self._missed.append(NewTurn(session, ride, wall_time, turn, owner, request))
        else:
            self.warn(f"a turn of session {session} is too large to be kept")
        self._write(self.keeping)

    def hear(self, ride: RideName, seq: int, wall_time: float, event: Event) -> None:
        """Keep an event, with the next `tidy`."""
        if self.keeping is not None:
            self._missed.append(NewEvent(ride, seq, wall_time, event))
            del self._missed[:-MAX_MISSED]

    def tidy(self, now: float, *, idle: bool) -> None:
        """Write what was heard; now and then erase what is too old.

        Args:
            now: wall time [s].
            idle: nobody waits for an answer, so that there is time for the disk.
        """
        # A file that fails may take a while each time, for which nobody is to wait.
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

    def forget(self, session: str) -> int | None:
        """Erase a session; how many turns, None where some of it is left for the time being."""
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
        if idle and self._unsynced:
            self._unsynced = False
            store.sync()
        if now >= self._expired + EXPIRED_EVERY:
            self._expired = self._purged = now
            store.expire(days, now)
        if idle and self._unpurged and now >= self._purged + PURGED_EVERY:
            self._purged = now
            store.purge()
            self._unpurged = False

    @contextmanager
    def _reading(self, keeping: Keeping) -> Iterator[Store]:
        """The file, to be read: others that write do not stop that, once it is open.

        Raises:
            Unwritable: it cannot be opened, or is not tried yet.
        """
        if self._store is not None:
            yield self._store
        else:
            with self._using(keeping) as store:
                yield store

    @contextmanager
    def _using(self, keeping: Keeping) -> Iterator[Store]:
        """The file; after an attempt that took long to fail, none for ten times as long.

        Raises:
            Unwritable: it cannot be used, or is not tried yet.
        """
        began = time.monotonic()
        if began < self._again:
            raise Unwritable(f"{keeping.path} is not tried again yet")
        try:
            if self._store is None:
                self._store = Store(keeping.path, patience=PATIENCE)
            yield self._store
        except Unpurged:
            raise  # it works
        except Unwritable:
            ended = time.monotonic()
            self._again = ended + REST * (ended - began)
            raise

    def _regret(self, what: str, error: Damaged) -> bool:
        """Tell of damage; whether it is to one session, while others may be spoken with as ever."""
        if self._store is None:
            self._fail(error)
            return False
        self.warn(f"{what} is not known any more: {error}")
        return True

    def _write(self, keeping: Keeping) -> None:
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
            self._failing = False
            _LOG.warning("the store works again")
            self.warn("what is said is kept again, and what was missed as well")

    def _keep(self, store: Store) -> None:
        try:
            store.keep(self._missed)
        except Unfit:  # one of them, for which the others need not be lost
            for new in self._missed:
                try:
                    store.keep([new])
                except Unfit as error:
                    self.warn(str(error))

    def _erase(self, store: Store) -> int:
        erased = 0
        for session in sorted(self._unforgotten):
            try:
                erased += store.forget(session)
            except Unpurged:  # it is erased; what is still in the files must not hold up answers
                self._unpurged = True
            self._unforgotten.discard(session)
        return erased

    def _fail(self, error: StoreError) -> None:
        if not self._failing:
            _LOG.error("the store fails", extra={"problem": str(error)})
            self.warn(f"what is said is not kept until this is mended: {error}")
        self._failing = True
