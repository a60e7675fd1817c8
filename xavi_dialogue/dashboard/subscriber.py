"""A subscription to a car on the bus, which passes reports to the dashboard's event loop.

Handlers run on threads of the bus. What waits for the loop is bounded: beyond that, scenes are
left out, since newer ones follow, and then all else, which the bus can be asked for again.
"""

import threading
from collections.abc import Callable
from typing import TypeAlias

from xavi_dialogue.bus.errors import MessageError
from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import Bus, Keys
from xavi_dialogue.bus.messages import EventReport, SceneReport, TraceReport, unpack
from xavi_dialogue.dashboard.web.interfaces import Browsers
from xavi_dialogue.service.reorder_buffer import ReportOfRide

MAX_SCENES = 50  # scenes that may wait
MAX_REPORTS = 5000

OnHeard: TypeAlias = Callable[[ReportOfRide], None]
OnAlive: TypeAlias = Callable[[str, bool], None]  # component, whether it is present
_Kind: TypeAlias = type[SceneReport] | type[TraceReport] | type[EventReport]


class Subscriber:
    """A subscription to one car."""

    def __init__(self, clients: Browsers, alive: HealthReporter, hear: OnHeard) -> None:
        """Make a subscription that does not receive yet.

        Args:
            clients: with the event loop on which `hear` is called.
            alive: counts reports that are rejected, and scenes that are left out.
            hear: gets every report.
        """
        self._clients, self._alive, self._hear = clients, alive, hear
        self._waiting, self._lock = 0, threading.Lock()

    def open(self, bus: Bus, keys: Keys, there: OnAlive) -> None:
        """Begin to receive.

        Args:
            bus: of the car.
            keys: of the car.
            there: called on the loop when a component comes or goes.
        """
        for component in ("car", "service"):
            bus.watch(keys.of(f"alive/{component}"), self._watcher(component, there))
        bus.subscribe(keys.of("trace"), self._handler(TraceReport), kept=True)
        bus.subscribe(keys.of("event"), self._handler(EventReport), kept=True)
        bus.subscribe(keys.of("scene"), self._handler(SceneReport))

    def _watcher(self, component: str, there: OnAlive) -> Callable[[str, bool], None]:
        return lambda _, alive: self._clients.soon(there, component, alive)

    def _handler(self, kind: _Kind) -> Callable[[str, bytes], None]:
        limit = MAX_SCENES if kind is SceneReport else MAX_REPORTS

        def on_message(_: str, payload: bytes) -> None:
            try:
                report = unpack(payload, kind)
            except MessageError:
                self._alive.count("rejected")
                return
            with self._lock:
                if self._waiting >= limit:
                    self._alive.count("dropped")
                    return
                self._waiting += 1
            self._clients.soon(self._take, report)

        return on_message

    def _take(self, report: ReportOfRide) -> None:
        with self._lock:
            self._waiting -= 1
        self._hear(report)
