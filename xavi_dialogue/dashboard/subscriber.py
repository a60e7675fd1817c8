"""Hears a car on the bus, and hands what it hears to the event loop of the dashboard.

Handlers run on threads of the bus. What waits for the loop is bounded: beyond that, scenes are
left out, since newer ones follow, and then all else, which the bus can be asked for again.
"""

import threading
from collections.abc import Callable
from typing import TypeAlias

from xavi_dialogue.bus.health import Alive
from xavi_dialogue.bus.interface import Bus, Keys
from xavi_dialogue.bus.messages import EventReport, MessageError, SceneReport, TraceReport, unpack
from xavi_dialogue.dashboard.web.interfaces import Audience
from xavi_dialogue.service.reorder_buffer import Heard

MAX_SCENES = 50  # that wait
MAX_REPORTS = 5000

OnHeard: TypeAlias = Callable[[Heard], None]
OnAlive: TypeAlias = Callable[[str, bool], None]  # component, whether it is there
_Kind: TypeAlias = type[SceneReport] | type[TraceReport] | type[EventReport]


class Ear:
    """What is said about one car."""

    def __init__(self, audience: Audience, alive: Alive, hear: OnHeard) -> None:
        """Hear nothing yet.

        Args:
            audience: on whose event loop `hear` is called.
            alive: counts what is rejected, and scenes that are left out.
            hear: gets every report.
        """
        self._audience, self._alive, self._hear = audience, alive, hear
        self._waiting, self._lock = 0, threading.Lock()

    def open(self, bus: Bus, keys: Keys, there: OnAlive) -> None:
        """Begin to hear.

        Args:
            bus: of the car.
            keys: of the car.
            there: is told who comes and goes, on the loop.
        """
        for component in ("car", "service"):
            bus.watch(keys.of(f"alive/{component}"), self._watcher(component, there))
        bus.subscribe(keys.of("trace"), self._handler(TraceReport), kept=True)
        bus.subscribe(keys.of("event"), self._handler(EventReport), kept=True)
        bus.subscribe(keys.of("scene"), self._handler(SceneReport))

    def _watcher(self, component: str, there: OnAlive) -> Callable[[str, bool], None]:
        return lambda _, alive: self._audience.soon(there, component, alive)

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
            self._audience.soon(self._take, report)

        return on_message

    def _take(self, report: Heard) -> None:
        with self._lock:
            self._waiting -= 1
        self._hear(report)
