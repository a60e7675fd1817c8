"""Orders to a child process over its standard input.

One order a line. The end of the input ends the process, so that none is left behind when its
parent is gone, however that came about.
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

SHOWN = 40  # characters of a line that is no order
PATIENCE = 5.0  # [s] that a process may take to end before it is killed


@dataclass(frozen=True, slots=True)
class Pause:
    """Halt where the ride is."""


@dataclass(frozen=True, slots=True)
class Resume:
    """Go on until further notice."""


@dataclass(frozen=True, slots=True)
class Speed:
    """Simulated seconds per second; 0 is as fast as possible."""

    factor: float


@dataclass(frozen=True, slots=True)
class Until:
    """Go on up to a time [s] and halt; None stands for the end of the first manoeuvre."""

    time: float | None


@dataclass(frozen=True, slots=True)
class Seek:
    """Go to a moment [s], also back; only a recording can."""

    time: float


@dataclass(frozen=True, slots=True)
class Quit:
    """End the process."""


Order: TypeAlias = Pause | Resume | Speed | Until | Seek | Quit
Orders: TypeAlias = "queue.SimpleQueue[Order]"


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
        f"{line.strip()[:SHOWN]!r} is no order, such as pause, resume or speed 2.0"
    )


def listen(stream: IO[str], orders: Orders, refuse: Callable[[str], None] | None = None) -> None:
    """Read commands into a queue, on a thread; at the end of the stream, Quit.

    The process is killed if it still runs some seconds after that.

    Args:
        stream: of lines.
        orders: the queue.
        refuse: gets what is wrong with a line that is none; a newer parent may know more
            orders, so that what it says is left at that.
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
    """SIGTERM and SIGINT, once `quit_on_signals` listens to them."""

    def __init__(self) -> None:
        self._number = 0
        self._came: queue.SimpleQueue[int] = queue.SimpleQueue()

    @property
    def told(self) -> bool:
        """Whether a signal arrived."""
        return self._number != 0

    @property
    def status(self) -> int:
        """The exit status of a process that ends for the one that came."""
        return 128 + self._number

    def listen(self, orders: Orders, patience: float | None = None) -> None:
        """Turn them into an order to quit.

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
        raise ChildCommandError(f"{text[:SHOWN]!r} is no number from 0 on")
    return number
