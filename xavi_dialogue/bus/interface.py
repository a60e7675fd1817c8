"""The bus: messages between processes, independent of the transport.

`zenoh_bus` carries it between processes, `memory_bus` within one. Handlers run on threads of
the bus and must return at once.

    TransportError
    ├── HubUnreachable   there is no hub at the endpoint
    ├── EndpointTaken    the hub's endpoint is in use
    ├── BadLink          the configuration of the link cannot be used
    ├── BusFailed        the transport failed in another way
    └── NoAnswer
        ├── NobodyThere  no process serves the key, or the client has no permission
        ├── TooLate      no reply within the time given
        └── Refused      the reply is a failure
"""

import queue
import re
from collections.abc import Callable
from dataclasses import dataclass
from types import TracebackType
from typing import Protocol, Self, TypeAlias

from xavi_dialogue.bus.errors import BusError
from xavi_dialogue.runtime import system

ROOT = "xavi/v1"
DEFAULT_ENDPOINT = "tcp/127.0.0.1:7447"
DEFAULT_VEHICLE = "car"
VEHICLE_NAME = r"[A-Za-z0-9_.-]{1,64}"


class TransportError(BusError):
    """A request to the bus failed."""


class HubUnreachable(TransportError):
    """There is no hub at the endpoint."""


class EndpointTaken(TransportError):
    """The hub's endpoint is in use."""


class BadLink(TransportError):
    """The configuration of the link cannot be used."""


class BusFailed(TransportError):
    """The transport failed."""


class NoAnswer(TransportError):
    """A request without a reply."""


class NobodyThere(NoAnswer):
    """Nobody serves the key."""


class TooLate(NoAnswer):
    """No reply within the time given."""


class Refused(NoAnswer):
    """The reply is a failure; `payload` is its message."""

    def __init__(self, payload: bytes) -> None:
        super().__init__("the request was refused")
        self.payload = payload


@dataclass(frozen=True, slots=True)
class Keys:
    """The keys of one car, or of every car."""

    vehicle: str = DEFAULT_VEHICLE

    def of(self, tail: str) -> str:
        """Return the key that ends with `tail`, such as `scene` or `@rpc/ask`."""
        return f"{ROOT}/{self.vehicle}/{tail}"


EVERY_CAR = Keys("*")  # a pattern for the keys of every car
FLEET = Keys("@fleet")  # the keys of what belongs to no car; no pattern of cars matches them


def vehicle_in(key: str) -> str | None:
    """Return the car that a key belongs to; None if it names no car."""
    parts = key.split("/", 3)
    if "/".join(parts[:2]) != ROOT or len(parts) < 4 or not re.fullmatch(VEHICLE_NAME, parts[2]):
        return None
    return parts[2]


def matches(pattern: str, key: str) -> bool:
    """Check whether a key matches a pattern; `*` is any one part that does not begin with `@`."""
    parts, given = pattern.split("/"), key.split("/")
    return len(parts) == len(given) and all(
        want == have or (want == "*" and not have.startswith("@"))
        for want, have in zip(parts, given, strict=True)
    )


class Publisher(Protocol):
    """Sends messages under one key."""

    def put(self, payload: bytes) -> None:
        """Send a message.

        Raises:
            BusFailed: the bus is closed.
        """


class Call(Protocol):
    """A request that came in; exactly one of its methods is called, once."""

    @property
    def key(self) -> str:
        """The key that was asked; never a pattern."""

    @property
    def payload(self) -> bytes: ...

    def reply(self, payload: bytes) -> None:
        """Reply.

        Raises:
            BusFailed: the reply could not be sent.
        """

    def refuse(self, payload: bytes) -> None:
        """Reply with a failure.

        Raises:
            BusFailed: it could not be sent.
        """

    def drop(self) -> None:
        """Leave the request without a reply."""


class Presence(Protocol):
    """A sign of life under a key."""

    def withdraw(self) -> None:
        """End the sign of life; doing so twice has no effect."""


class Subscription(Protocol):
    """What receives the messages of a key."""

    def withdraw(self) -> None:
        """Receive no more; doing so twice has no effect."""


Handler: TypeAlias = Callable[[str, bytes], None]  # key, payload
CallHandler: TypeAlias = Callable[[Call], None]
Watcher: TypeAlias = Callable[[str, bool], None]  # key, whether it is alive
Outcome: TypeAlias = bytes | NoAnswer


class Bus(Protocol):
    """One process's connection to the others; `close` ends all that was declared on it.

    The keys that it receives, serves and watches may be patterns: `*` stands for any one part.
    """

    @property
    def linked(self) -> bool:
        """Check whether there is a connection."""

    def publisher(self, key: str, keep: int = 0) -> Publisher:
        """Return a publisher that sends under a key.

        Args:
            key: of the messages.
            keep: number of messages kept for late joiners; none is dropped then. With 0, messages
                may be dropped.
        """

    def send(self, key: str, payload: bytes) -> None:
        """Send one message under a rarely used key; it may be dropped."""

    def subscribe(self, key: str, handler: Handler, *, kept: bool = False) -> Subscription:
        """Receive the messages of a key; with `kept` also those kept for late joiners."""

    def serve(self, key: str, handler: CallHandler) -> None:
        """Answer requests to a key."""

    def request(
        self, key: str, payload: bytes, timeout: float, done: Callable[[Outcome], None]
    ) -> None:
        """Send a request; `done` is called once, with the reply or an error.

        Args:
            key: of the service.
            payload: the request.
            timeout: [s] after which `done` gets TooLate.
            done: runs on a thread of the bus.
        """

    def appear(self, key: str) -> Presence:
        """Show under a key that this process is alive, until it ends, or withdraws."""

    def watch(self, key: str, watcher: Watcher) -> None:
        """Watch which components are alive under a key, now and from now on."""

    def close(self) -> None: ...

    def __enter__(self) -> Self: ...

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None: ...


def call(bus: Bus, key: str, payload: bytes, timeout: float) -> bytes:
    """Send a request and wait for its reply.

    Raises:
        NobodyThere: no process serves the key, or this one has no permission.
        TooLate: no reply within `timeout` [s].
        Refused: the reply is a failure.
    """
    outcomes: system.Queue[Outcome] = system.new_queue()
    bus.request(key, payload, timeout, outcomes.put)
    try:
        outcome = outcomes.get(timeout=timeout)
    except queue.Empty:
        raise TooLate(f"no reply from {key} within {timeout:g} s") from None
    if isinstance(outcome, NoAnswer):
        raise outcome
    return outcome
