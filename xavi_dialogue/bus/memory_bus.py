"""The bus within one process, for tests and demonstrations: no sockets, no waiting.

Messages are handled in the thread that sends them. A server may keep a call, and reply to it later.
"""

from collections import defaultdict, deque
from collections.abc import Callable
from dataclasses import dataclass, field
from types import TracebackType
from typing import Self

from xavi_dialogue.bus.interface import (
    CallHandler,
    Handler,
    NobodyThere,
    Outcome,
    Presence,
    Publisher,
    Refused,
    Subscription,
    TooLate,
    Watcher,
    matches,
)


@dataclass
class MemoryHub:
    """The state that the buses of one process share."""

    subscribers: dict[str, list[tuple[object, Handler]]] = field(
        default_factory=lambda: defaultdict(list)
    )
    servers: dict[str, list[tuple[object, CallHandler]]] = field(default_factory=dict)
    kept: dict[str, deque[bytes]] = field(default_factory=dict)
    alive: dict[str, list[object]] = field(default_factory=dict)  # who shows a key
    watchers: dict[str, list[tuple[object, Watcher]]] = field(
        default_factory=lambda: defaultdict(list)
    )

    def connect(self) -> "MemoryBus":
        """Return a new connection."""
        return MemoryBus(self)

    def hide(self, key: str, owner: object) -> None:
        """End a sign of life; it is gone with the last one that shows the key."""
        owners = self.alive.get(key, [])
        if owner in owners:
            owners.remove(owner)
            if not owners:
                del self.alive[key]
                self.tell(key, False)

    def tell(self, key: str, alive: bool) -> None:
        """Notify the watchers of a key."""
        for pattern, watchers in tuple(self.watchers.items()):
            for _, watcher in tuple(watchers) if matches(pattern, key) else ():
                watcher(key, alive)


@dataclass(frozen=True)
class _MemoryPublisher:
    hub: MemoryHub
    key: str
    keep: int

    def put(self, payload: bytes) -> None:
        if self.keep:
            self.hub.kept.setdefault(self.key, deque(maxlen=self.keep)).append(payload)
        for pattern, handlers in tuple(self.hub.subscribers.items()):
            for _, handler in tuple(handlers) if matches(pattern, self.key) else ():
                handler(self.key, payload)


@dataclass(frozen=True)
class _MemoryPresence:
    hub: MemoryHub
    key: str
    owner: object

    def withdraw(self) -> None:
        self.hub.hide(self.key, self.owner)


@dataclass(frozen=True)
class _MemorySubscription:
    rows: list[tuple[object, Handler]]
    row: tuple[object, Handler]

    def withdraw(self) -> None:
        if self.row in self.rows:
            self.rows.remove(self.row)


@dataclass
class _Asked:
    """A request to one server or several: the first reply counts."""

    servers: int
    done: Callable[[Outcome], None]
    over: bool = False

    def end(self, outcome: Outcome | None) -> None:
        self.servers -= 1
        if not self.over and (outcome is not None or not self.servers):
            self.over = True
            self.done(TooLate("no reply") if outcome is None else outcome)


@dataclass
class _MemoryCall:
    key: str
    payload: bytes
    asked: _Asked

    def reply(self, payload: bytes) -> None:
        self.asked.end(payload)

    def refuse(self, payload: bytes) -> None:
        self.asked.end(Refused(payload))

    def drop(self) -> None:
        self.asked.end(None)


class MemoryBus:
    """One connection to a MemoryHub."""

    linked = True

    def __init__(self, hub: MemoryHub) -> None:
        self._hub = hub

    def publisher(self, key: str, keep: int = 0) -> Publisher:
        """See Bus."""
        return _MemoryPublisher(self._hub, key, keep)

    def send(self, key: str, payload: bytes) -> None:
        """See Bus."""
        _MemoryPublisher(self._hub, key, 0).put(payload)

    def subscribe(self, key: str, handler: Handler, *, kept: bool = False) -> Subscription:
        """See Bus."""
        row = (self, handler)
        self._hub.subscribers[key].append(row)
        for one, payloads in tuple(self._hub.kept.items()) if kept else ():
            for payload in tuple(payloads) if matches(key, one) else ():
                handler(one, payload)
        return _MemorySubscription(self._hub.subscribers[key], row)

    def serve(self, key: str, handler: CallHandler) -> None:
        """See Bus."""
        self._hub.servers.setdefault(key, []).append((self, handler))

    def request(
        self, key: str, payload: bytes, timeout: float, done: Callable[[Outcome], None]
    ) -> None:
        """See Bus; the timeout is ignored."""
        servers = [
            handler
            for pattern, rows in tuple(self._hub.servers.items())
            for _, handler in (rows if matches(pattern, key) else ())
        ]
        if not servers:
            done(NobodyThere(f"nobody serves {key}"))
        asked = _Asked(len(servers), done)
        for handler in servers:
            handler(_MemoryCall(key, payload, asked))

    def appear(self, key: str) -> Presence:
        """See Bus."""
        owners = self._hub.alive.setdefault(key, [])
        owners.append(self)
        if len(owners) == 1:
            self._hub.tell(key, True)
        return _MemoryPresence(self._hub, key, self)

    def watch(self, key: str, watcher: Watcher) -> None:
        """See Bus."""
        self._hub.watchers[key].append((self, watcher))
        for one in tuple(self._hub.alive):
            if matches(key, one):
                watcher(one, True)

    def close(self) -> None:
        """Withdraw all that was declared here."""
        hub = self._hub
        for handlers in hub.subscribers.values():
            handlers[:] = [one for one in handlers if one[0] is not self]
        for watchers in hub.watchers.values():
            watchers[:] = [one for one in watchers if one[0] is not self]
        for key, rows in tuple(hub.servers.items()):
            rows[:] = [one for one in rows if one[0] is not self]
            if not rows:
                del hub.servers[key]
        for key in [key for key, owners in hub.alive.items() if self in owners]:
            hub.hide(key, self)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()
