"""A queue in front of the bus: a thread sends its messages, so that senders never wait.

If a reader is slow, the transport blocks on a message that must not be lost, for up to several
seconds if the hub hangs. Meanwhile other messages wait here. Beyond a bound, messages that may be
dropped are dropped first, from the oldest on, and then the oldest of the rest; all are counted.
"""

import logging
from collections import deque
from contextlib import suppress
from dataclasses import dataclass

from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Bus, Publisher, TransportError
from xavi_dialogue.runtime import system

SCENES = "scenes_dropped"  # counters of what was dropped
REPORTS = "reports_dropped"

_LOG = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Bounds:
    """The bounds of what may wait in the queue."""

    droppable: int = 20  # messages; two seconds of scenes
    messages: int = 1300  # as many as are kept for late joiners
    size: int = 64 * 1024 * 1024  # bytes


@dataclass(frozen=True, slots=True, eq=False)
class _QueuedMessage:
    publisher: Publisher
    payload: bytes
    may_drop: bool


@dataclass(frozen=True, slots=True)
class _Slot:
    """A publisher of one key that puts its messages into the outbox."""

    outbox: "Outbox"
    publisher: Publisher
    may_drop: bool

    def put(self, payload: bytes) -> None:
        self.outbox.take(_QueuedMessage(self.publisher, payload, self.may_drop))


class Outbox:
    """A queue of messages, and the thread that sends them."""

    def __init__(self, bus: Bus, alive: HealthReporter, bounds: Bounds | None = None) -> None:
        """Begin to send.

        Args:
            bus: to send on; close it after this.
            alive: counts what is dropped.
            bounds: how much may wait.
        """
        self._bus, self._alive, self._bounds = bus, alive, bounds or Bounds()
        self._waiting: deque[_QueuedMessage] = deque()
        self._droppable = self._size = 0  # waiting messages that may be dropped; waiting bytes
        self._sending = self._closing = False
        self._changed = system.condition()
        self._sender = system.start("outbox", self._send)

    def publisher(self, key: str, keep: int = 0) -> Publisher:
        """Return a publisher for a key; see Bus. Messages that are not kept may be dropped."""
        return _Slot(self, self._bus.publisher(key, keep), may_drop=not keep)

    def waiting(self) -> int:
        """Return the number of messages that are not sent yet."""
        with self._changed:
            return len(self._waiting) + self._sending

    def take(self, message: _QueuedMessage) -> None:
        """Queue a message for sending; returns at once."""
        with self._changed:
            if self._closing:
                self._count(message)
                return
            self._waiting.append(message)
            self._weigh(message, 1)
            while self._overfull():
                self._drop_one()
            self._changed.notify_all()

    def close(self, patience: float) -> bool:
        """Send the queue within `patience` [s], then stop; return whether all was sent."""
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
                message = self._waiting.popleft()
                self._weigh(message, -1)
                self._sending = True
            with suppress(TransportError):  # the bus is closed
                message.publisher.put(message.payload)

    def _overfull(self) -> bool:
        bounds = self._bounds
        return (
            self._droppable > bounds.droppable
            or len(self._waiting) > bounds.messages
            or self._size > bounds.size
        )

    def _drop_one(self) -> None:
        place = next((k for k, message in enumerate(self._waiting) if message.may_drop), 0)
        message = self._waiting[place]
        del self._waiting[place]
        self._weigh(message, -1)
        self._count(message)

    def _weigh(self, message: _QueuedMessage, sign: int) -> None:
        self._size += sign * len(message.payload)
        self._droppable += sign * message.may_drop

    def _count(self, message: _QueuedMessage) -> None:
        self._alive.count(SCENES if message.may_drop else REPORTS)
