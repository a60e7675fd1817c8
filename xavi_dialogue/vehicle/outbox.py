"""What is to be put on the bus, put there from a thread of its own: who sends never waits.

A message that must not be lost waits at the carrier for as long as a reader is slow, up to several
seconds where a hub hangs. Meanwhile the others wait here. Beyond a bound, what may drop is
dropped first, the oldest of it, and then the oldest of the rest; all of it is counted.
"""

import logging
import threading
from collections import deque
from contextlib import suppress
from dataclasses import dataclass

from xavi_dialogue.bus.health import Alive
from xavi_dialogue.bus.interface import Bus, BusError, Publisher

SCENES = "scenes_dropped"  # counters of what was dropped
REPORTS = "reports_dropped"

_LOG = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Bounds:
    """How much may wait."""

    droppable: int = 20  # messages; two seconds of scenes
    messages: int = 1300  # as many as are kept for late joiners
    size: int = 64 * 1024 * 1024  # bytes


@dataclass(frozen=True, slots=True, eq=False)
class _Letter:
    publisher: Publisher
    payload: bytes
    may_drop: bool


@dataclass(frozen=True, slots=True)
class _Slot:
    """Puts messages of one key into the outbox."""

    outbox: "Outbox"
    publisher: Publisher
    may_drop: bool

    def put(self, payload: bytes) -> None:
        self.outbox.take(_Letter(self.publisher, payload, self.may_drop))


class Outbox:
    """Stands between those who send and a bus."""

    def __init__(self, bus: Bus, alive: Alive, bounds: Bounds | None = None) -> None:
        """Begin to send.

        Args:
            bus: to send on; close it after this.
            alive: counts what is dropped.
            bounds: how much may wait.
        """
        self._bus, self._alive, self._bounds = bus, alive, bounds or Bounds()
        self._waiting: deque[_Letter] = deque()
        self._droppable = self._size = 0  # messages, bytes of those waiting
        self._sending = self._closing = False
        self._changed = threading.Condition()
        self._sender = threading.Thread(target=self._send, name="outbox", daemon=True)
        self._sender.start()

    def publisher(self, key: str, keep: int = 0) -> Publisher:
        """Send under a key; see Bus. What is not kept may drop."""
        return _Slot(self, self._bus.publisher(key, keep), may_drop=not keep)

    def waiting(self) -> int:
        """How many messages are not sent yet."""
        with self._changed:
            return len(self._waiting) + self._sending

    def take(self, letter: _Letter) -> None:
        """Send a message as soon as it can be; returns at once."""
        with self._changed:
            if self._closing:
                self._count(letter)
                return
            self._waiting.append(letter)
            self._weigh(letter, 1)
            while self._overfull():
                self._drop_one()
            self._changed.notify_all()

    def close(self, patience: float) -> bool:
        """Send what waits, for up to `patience` [s], and take no more; whether all was sent."""
        with self._changed:
            if self._closing:
                return not self._sending
            self._changed.wait_for(lambda: not (self._waiting or self._sending), patience)
            self._closing = True
            unsent = len(self._waiting) + self._sending
            while self._waiting:
                self._drop_one()
            self._changed.notify_all()
        if unsent:
            _LOG.warning("messages not sent", extra={"messages": unsent})
        else:
            self._sender.join()
        return not unsent

    def _send(self) -> None:
        while True:
            with self._changed:
                self._sending = False
                self._changed.notify_all()
                self._changed.wait_for(lambda: self._waiting or self._closing)
                if not self._waiting:
                    return
                letter = self._waiting.popleft()
                self._weigh(letter, -1)
                self._sending = True
            with suppress(BusError):  # the bus is closed
                letter.publisher.put(letter.payload)

    def _overfull(self) -> bool:
        bounds = self._bounds
        return (
            self._droppable > bounds.droppable
            or len(self._waiting) > bounds.messages
            or self._size > bounds.size
        )

    def _drop_one(self) -> None:
        place = next((k for k, letter in enumerate(self._waiting) if letter.may_drop), 0)
        letter = self._waiting[place]
        del self._waiting[place]
        self._weigh(letter, -1)
        self._count(letter)

    def _weigh(self, letter: _Letter, sign: int) -> None:
        self._size += sign * len(letter.payload)
        self._droppable += sign * letter.may_drop

    def _count(self, letter: _Letter) -> None:
        self._alive.count(SCENES if letter.may_drop else REPORTS)
