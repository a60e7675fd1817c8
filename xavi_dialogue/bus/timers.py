"""Timers of a process: any number of them, on one thread."""

import heapq
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeAlias

Cancel: TypeAlias = Callable[[], None]
SPENT = 1000  # cancelled timers that may remain in the heap before they are removed


@dataclass(order=True)
class _Timer:
    due: float  # [s] on the monotonic clock
    number: int
    ring: Callable[[], None] | None = field(compare=False)  # None: cancelled


class Timers:
    """Timers that call functions after a delay."""

    def __init__(self) -> None:
        self._timers: list[_Timer] = []  # a heap
        self._changed = threading.Condition()
        self._thread: threading.Thread | None = None
        self._set = self._cancelled = 0

    def after(self, delay: float, ring: Callable[[], None]) -> Cancel:
        """Call a function after a delay, on the thread of the timers.

        Args:
            delay: [s] until then.
            ring: must return at once, and not fail.

        Returns:
            A function that cancels the call; it has no effect once the call was made.
        """
        with self._changed:
            self._set += 1
            timer = _Timer(time.monotonic() + delay, self._set, ring)
            heapq.heappush(self._timers, timer)
            if self._thread is None:
                self._thread = threading.Thread(target=self._run, name="timers", daemon=True)
                self._thread.start()
            elif self._timers[0] is timer:
                self._changed.notify()
        return lambda: self._cancel(timer)

    def _cancel(self, timer: _Timer) -> None:
        with self._changed:
            if timer.ring is None:
                return
            timer.ring = None
            self._cancelled += 1
            if self._cancelled > SPENT:
                self._timers = [one for one in self._timers if one.ring is not None]
                heapq.heapify(self._timers)
                self._cancelled = 0

    def _run(self) -> None:
        while True:
            ring = self._next()
            if ring is not None:
                ring()

    def _next(self) -> Callable[[], None] | None:
        """Return the function of the first timer if it is due; else wait a while and return None.

        The wait ends when the first timer is due, or when an earlier one was set.
        """
        with self._changed:
            if not self._timers:
                self._changed.wait()
            elif (wait := self._timers[0].due - time.monotonic()) > 0.0:
                self._changed.wait(wait)
            else:
                timer = heapq.heappop(self._timers)
                ring, timer.ring = timer.ring, None
                return ring
        return None
