"""Health of components: liveness on the bus, and counters on request."""

import os
import threading
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path

from xavi_dialogue import __version__
from xavi_dialogue.bus.interface import Bus, Call, Keys, Presence, TransportError
from xavi_dialogue.bus.messages import AliveReport, pack
from xavi_dialogue.runtime import system

MEMORY = "resident_bytes"  # a counter of every component, if the system reports it
STATM = Path("/proc/self/statm")  # in pages; see proc(5)


class HealthReporter:
    """Counters of what a component does, with reports of them; thread-safe."""

    def __init__(
        self,
        component: str,
        counters: Iterable[str] = (),
        *,
        clock: Callable[[], float] = system.monotonic,
    ) -> None:
        """Begin to count.

        Args:
            component: car, service, dashboard or recorder.
            counters: names of those that are reported from the start, with 0.
            clock: [s], monotonic.
        """
        self._component, self._clock, self._began = component, clock, clock()
        self._counters = dict.fromkeys(counters, 0.0)
        self._gauges: dict[str, Callable[[], float]] = {}
        self._lock = threading.Lock()
        self._reports = 0
        self._sim_time = 0.0

    def count(self, name: str, by: float = 1) -> None:
        """Add to a counter."""
        with self._lock:
            self._counters[name] = self._counters.get(name, 0.0) + by

    def counted(self, name: str) -> float:
        """Return a counter; 0 if nothing was counted."""
        with self._lock:
            return self._counters.get(name, 0.0)

    def gauge(self, name: str, read: Callable[[], float]) -> None:
        """Include the result of `read` in reports; it is called on a thread of the bus."""
        with self._lock:
            self._gauges[name] = read

    def at(self, sim_time: float) -> None:
        """Update the latest simulation time [s]."""
        self._sim_time = max(self._sim_time, sim_time)

    def report(self) -> AliveReport:
        """Return the present health report."""
        with self._lock:
            counters, gauges = dict(self._counters), dict(self._gauges)
            number, self._reports = self._reports, self._reports + 1
        counters.update({name: float(read()) for name, read in gauges.items()})
        with suppress(OSError):
            counters[MEMORY] = float(resident_bytes())
        return AliveReport(
            component=self._component,
            version=__version__,
            seq=number,
            sim_time=self._sim_time,
            wall_time=system.wall(),
            uptime_s=round(self._clock() - self._began, 3),
            counters=dict(sorted(counters.items())),
        )

    def serve(self, bus: Bus, keys: Keys) -> Presence:
        """Serve `alive/<component>`, and announce there that the component is alive."""
        key = keys.of(f"alive/{self._component}")
        bus.serve(key, self.answer)
        return bus.appear(key)

    def answer(self, call: Call) -> None:
        """Answer one request."""
        with suppress(TransportError):  # the client has disconnected
            call.reply(pack(self.report()))


def resident_bytes() -> int:
    """Return the memory of this process that is in use [bytes].

    Raises:
        OSError: the system does not report it.
    """
    return int(STATM.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
