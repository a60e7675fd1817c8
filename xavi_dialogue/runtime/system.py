"""Clock, waiting, threads and random names: the one door to them of what runs on a bus.

Service, car, clients, dashboard and store reach the clock and other threads through the functions
of this module. A simulation exchanges what is behind the door, and runs the same code on a clock
of its own.
"""

import queue
import secrets
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import TracebackType
from typing import Any, Protocol, TypeVar

T = TypeVar("T")


class Queue(Protocol[T]):
    """A queue between threads, as `queue.SimpleQueue`; raises `queue.Empty`."""

    def put(self, item: T) -> None: ...

    def get(self, block: bool = True, timeout: float | None = None) -> T: ...

    def get_nowait(self) -> T: ...

    def qsize(self) -> int: ...

    def empty(self) -> bool: ...


class Condition(Protocol):
    """A condition with its lock, as `threading.Condition`."""

    def __enter__(self) -> bool: ...

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
        /,
    ) -> None: ...

    def wait(self, timeout: float | None = None) -> bool: ...

    def wait_for(self, predicate: Callable[[], object], timeout: float | None = None) -> object: ...

    def notify_all(self) -> None: ...


class Event(Protocol):
    """A flag that threads wait for, as `threading.Event`."""

    def is_set(self) -> bool: ...

    def set(self) -> None: ...

    def wait(self, timeout: float | None = None) -> bool: ...


class Thread(Protocol):
    """A thread that runs."""

    def join(self, timeout: float | None = None) -> None: ...


class System:
    """The clock and the threads of this process."""

    def monotonic(self) -> float:
        """Return the time [s] on a clock that never jumps."""
        return time.monotonic()

    def wall(self) -> float:
        """Return the time [s] since 1970; it jumps when the clock is set."""
        return time.time()

    def sleep(self, delay: float) -> None:
        """Wait for a time [s]."""
        time.sleep(delay)

    def queue(self) -> Queue[Any]:
        """Return an empty queue."""
        return queue.SimpleQueue()

    def condition(self) -> Condition:
        """Return a condition."""
        return threading.Condition()

    def event(self) -> Event:
        """Return an event that is not set."""
        return threading.Event()

    def start(self, name: str, run: Callable[[], None]) -> Thread:
        """Start a thread that does not keep the process alive."""
        thread = threading.Thread(target=run, name=name, daemon=True)
        thread.start()
        return thread

    def token(self, size: int) -> str:
        """Return a random name of `size` bytes in hexadecimal."""
        return secrets.token_hex(size)


_system = System()


@contextmanager
def behind_the_door(system: System) -> Iterator[None]:
    """Use another system within; for simulations."""
    global _system
    before, _system = _system, system
    try:
        yield
    finally:
        _system = before


def monotonic() -> float:
    """See System."""
    return _system.monotonic()


def wall() -> float:
    """See System."""
    return _system.wall()


def sleep(delay: float) -> None:
    """See System."""
    _system.sleep(delay)


def new_queue() -> Queue[Any]:
    """See System."""
    return _system.queue()


def condition() -> Condition:
    """See System."""
    return _system.condition()


def event() -> Event:
    """See System."""
    return _system.event()


def start(name: str, run: Callable[[], None]) -> Thread:
    """See System."""
    return _system.start(name, run)


def token(size: int) -> str:
    """See System."""
    return _system.token(size)
