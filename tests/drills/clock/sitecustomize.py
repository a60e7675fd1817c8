"""Shifts the wall clock of a program by what a file says; see test_clock.py.

The monotonic clock goes on as it does. On a path for modules, Python loads this by itself.
"""

import datetime
import os
import time
from pathlib import Path

_FILE = Path(os.environ["DRILL_CLOCK"])
_TIME, _TIME_NS = time.time, time.time_ns


def _shift() -> int:
    """Seconds."""
    return int(_FILE.read_text() or "0")


class _Shifted(datetime.datetime):
    """A moment; its now is shifted."""

    @classmethod
    def now(cls, tz: datetime.tzinfo | None = None) -> "_Shifted":
        return cls.fromtimestamp(time.time(), tz)


time.time = lambda: _TIME() + _shift()
time.time_ns = lambda: _TIME_NS() + _shift() * 1_000_000_000
datetime.datetime = _Shifted  # type: ignore[misc]
