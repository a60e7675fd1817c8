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
    servers: dict[str, tuple[object, CallHandler]] = field(default_factory=dict)
    kept: dict[str, deque[bytes]] = field(default_factory=dict)
    alive: dict[str, object] = field(default_factory=dict)
    watchers: dict[str, list[tuple[object, Watcher]]] = field(
        default_factory=lambda: defaultdict(list)
    )

    def connect(self) -> "MemoryBus":
        """Return a new connection."""
        return MemoryBus(self)

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
        if self.hub.alive.get(self.key) is self.owner:
            del self.hub.alive[self.key]
            self.hub.tell(self.key, False)


@dataclass
class _MemoryCall:
    key: str
    payload: bytes
    done: Callable[[Outcome], None]

    def reply(self, payload: bytes) -> None:
        self.done(payload)

    def refuse(self, payload: bytes) -> None:
        self.done(Refused(payload))

    def drop(self) -> None:
        self.done(TooLate("no reply"))


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

    def subscribe(self, key: str, handler: Handler, *, kept: bool = False) -> None:
        """See Bus."""
        self._hub.subscribers[key].append((self, handler))
        for one, payloads in tuple(self._hub.kept.items()) if kept else ():
            for payload in tuple(payloads) if matches(key, one) else ():
                handler(one, payload)

    def serve(self, key: str, handler: CallHandler) -> None:
        """See Bus."""
        self._hub.servers[key] = (self, handler)

    def request(
        self, key: str, payload: bytes, timeout: float, done: Callable[[Outcome], None]
    ) -> None:
        """See Bus; the timeout is ignored."""
        servers = (one for pattern, one in self._hub.servers.items() if matches(pattern, key))
        server = next(servers, None)
        if server is None:
            done(NobodyThere(f"nobody serves {key}"))
        else:
            server[1](_MemoryCall(key, payload, done))

    def appear(self, key: str) -> Presence:
        """See Bus."""
        self._hub.alive[key] = self
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
        for key in [key for key, (owner, _) in hub.servers.items() if owner is self]:
            del hub.servers[key]
        for key in [key for key, owner in hub.alive.items() if owner is self]:
            del hub.alive[key]
            hub.tell(key, False)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()
