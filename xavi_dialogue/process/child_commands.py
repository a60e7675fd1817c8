"""Orders to a child process over its standard input.

Each line is one order. The end of the input ends the process, so that a child never outlives its
parent.
"""

import math
import os
import queue
import signal
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import IO, TypeAlias

from xavi_dialogue.errors import XaviError
from xavi_dialogue.process import scratch
from xavi_dialogue.runtime import system

SHOWN = 40  # characters of a line that is no order
PATIENCE = 5.0  # [s] after the end of the input, when the process is ended by force


@dataclass(frozen=True, slots=True)
class Pause:
    """Halt the ride now."""


@dataclass(frozen=True, slots=True)
class Resume:
    """Continue the ride until another order."""


@dataclass(frozen=True, slots=True)
class Speed:
    """Set the speed in simulated seconds per second; 0 is as fast as possible."""

    factor: float


@dataclass(frozen=True, slots=True)
class Until:
    """Continue up to a time [s] and halt; None stands for the end of the first manoeuvre."""

    time: float | None


@dataclass(frozen=True, slots=True)
class Seek:
    """Go to a moment [s], also an earlier one; only recordings can."""

    time: float


@dataclass(frozen=True, slots=True)
class Quit:
    """End the process."""


Order: TypeAlias = Pause | Resume | Speed | Until | Seek | Quit
Orders: TypeAlias = system.Queue[Order]


class ChildCommandError(XaviError, ValueError):
    """A line that is no order."""


def write(order: Order) -> str:
    """Return the order as a line."""
    match order:
        case Speed(factor):
            return f"speed {factor!r}"
        case Until(time):
            return "until default" if time is None else f"until {time!r}"
        case Seek(time):
            return f"seek {time!r}"
        case _:
            return type(order).__name__.lower()


def read(line: str) -> Order:
    """Return the order in a line.

    Raises:
        ChildCommandError: the line is no order.
    """
    match line.split():
        case ["pause"]:
            return Pause()
        case ["resume"]:
            return Resume()
        case ["quit"]:
            return Quit()
        case ["speed", factor]:
            return Speed(_number(factor))
        case ["until", "default"]:
            return Until(None)
        case ["until", time]:
            return Until(_number(time))
        case ["seek", time]:
            return Seek(_number(time))
    raise ChildCommandError(
        f"{line.strip()[:SHOWN]!r} is not a command; write one such as pause, resume or speed 2.0"
    )


def listen(stream: IO[str], orders: Orders, refuse: Callable[[str], None] | None = None) -> None:
    """Read commands into a queue, on a thread; at the end of the stream, Quit.

    The process is killed if it still runs some seconds after that.

    Args:
        stream: of lines.
        orders: the queue.
        refuse: is called with the fault of a line that is no order; the line is skipped, as a
            newer parent may know more orders.
    """

    def follow() -> None:
        for line in stream:
            try:
                orders.put(read(line))
            except ChildCommandError as error:
                if refuse is not None and line.strip():
                    refuse(str(error))
        orders.put(Quit())
        threading.Event().wait(PATIENCE)
        scratch.delete_own()
        os._exit(os.EX_TEMPFAIL)

    scratch.delete_at_exit()
    threading.Thread(target=follow, name="orders", daemon=True).start()


class Signals:
    """The signals SIGTERM and SIGINT, after a call of `listen`."""

    def __init__(self) -> None:
        self._number = 0
        self._came: queue.SimpleQueue[int] = queue.SimpleQueue()

    @property
    def told(self) -> bool:
        """Whether a signal arrived."""
        return self._number != 0

    @property
    def status(self) -> int:
        """The exit status of a process that ends because of the signal that arrived."""
        return 128 + self._number

    def listen(self, orders: Orders, patience: float | None = None) -> None:
        """Turn the signals into an order to quit.

        Args:
            orders: to this process.
            patience: [s] after which the process ends by force; None: never.
        """

        def come(number: int, _: object) -> None:
            # This takes no lock: it may interrupt any line, even itself.
            self._number = self._number or number
            orders.put(Quit())
            self._came.put(number)

        for number in (signal.SIGTERM, signal.SIGINT):
            signal.signal(number, come)
        if patience is not None:
            threading.Thread(target=self._enforce, args=(patience,), daemon=True).start()

    def _enforce(self, patience: float) -> None:
        self._came.get()
        threading.Event().wait(patience)
        os._exit(self.status)


def quit_on_signals(orders: Orders) -> None:
    """Turn SIGTERM and SIGINT into an order to quit."""
    Signals().listen(orders)


def _number(text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not 0.0 <= number < math.inf:
        raise ChildCommandError(f"{text[:SHOWN]!r} is not a number of 0 or more")
    return number
