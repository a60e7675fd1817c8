"""The car on the bus: how it joins, ensures that its name is unique, and leaves in time.

NameTaken        another car of this name is on the bus
QuitBeforeRide   asked to quit before the ride began
"""

import logging
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from xavi_dialogue.bus.health import HealthReporter
from xavi_dialogue.bus.interface import (
    Bus,
    HubUnreachable,
    Keys,
    NoAnswer,
    NobodyThere,
    TooLate,
    TransportError,
    call,
)
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import ZenohBus, join
from xavi_dialogue.errors import XaviError
from xavi_dialogue.process.child_commands import Signals
from xavi_dialogue.vehicle.map_server import serve_roads
from xavi_dialogue.vehicle.node import COUNTERS, serve
from xavi_dialogue.vehicle.outbox import Outbox
from xavi_dialogue.vehicle.replanning import Replanner, workers
from xavi_dialogue.vehicle.worker_pool import WAITING

HUB_PATIENCE = 10.0  # [s] for the hub to come up
CHILD_PATIENCE = 90.0  # [s] the same if a parent process has started both
GLANCE = 0.5  # [s] between checks of whether to quit
ANSWERED = 1.0  # [s] within which a car that is on the bus answers
# [s] A car whose machine has failed stays visible on the bus until its lease of 10 s ends.
VACATED = 12.0
CLOSING = 1.0  # [s] that leaving the bus may take

_LOG = logging.getLogger(__name__)


class NameTaken(TransportError):
    """Another car of this name is on the bus."""


class QuitBeforeRide(XaviError):
    """The process was asked to quit before the ride began."""


@dataclass(frozen=True, slots=True)
class ReplanningOptions:
    """The number of workers that plan again, and of requests that may wait for them."""

    workers: int = 1
    waiting: int = WAITING  # requests that may wait for one of them


@dataclass(frozen=True, slots=True)
class BusSession:
    """The parts of a car on the bus: outbox, replanning, and health reports."""

    outbox: Outbox
    planning: Replanner
    alive: HealthReporter


@contextmanager
def join_bus(
    link: Link,
    keys: Keys,
    network: Path,
    replanning: ReplanningOptions,
    signals: Signals,
    patience: float = HUB_PATIENCE,
) -> Iterator[BusSession]:
    """Join the bus as a car while the context lasts.

    Args:
        link: to the hub.
        keys: of the car.
        network: the road network's file, for planning again.
        replanning: options of planning again.
        signals: may ask to quit meanwhile.
        patience: [s] to wait for the hub.

    Raises:
        HubUnreachable: there is no hub.
        BadLink: the configuration of the link cannot be used.
        NameTaken: another car of this name is on the bus.
        QuitBeforeRide: asked to quit before everything was ready.
    """
    alive = HealthReporter("car", COUNTERS)
    with ExitStack() as stack:
        bus = joined(link, signals, patience)
        stack.callback(_leave, bus)
        claim(bus, keys, signals)
        outbox = Outbox(bus, alive)
        stack.callback(outbox.close, 0.0)
        pool = stack.enter_context(workers(network, replanning.workers, replanning.waiting))
        alive.gauge("outbox", outbox.waiting)
        alive.gauge("workers", lambda: len(pool.pids))
        alive.gauge("workers_idle", lambda: pool.idle)
        planning = Replanner(pool, alive=alive)
        bus.watch(keys.of("alive/service"), ServiceMonitor(keys.vehicle))
        serve_roads(bus, keys, network)
        serve(bus, keys, planning, alive)
        yield BusSession(outbox, planning, alive)


def claim(bus: Bus, keys: Keys, signals: Signals, patience: float = VACATED) -> None:
    """Check that no other car has this name.

    A car that was killed may stay visible for a while: up to `patience` [s].

    Raises:
        NameTaken: another car has it.
        QuitBeforeRide: asked to quit meanwhile.
    """
    give_up = time.monotonic() + patience
    while not signals.told:
        try:
            call(bus, keys.of("alive/car"), b"", ANSWERED)
        except NobodyThere:
            return
        except TooLate:
            if time.monotonic() < give_up:
                continue
        except NoAnswer:
            pass
        raise NameTaken(
            f"there is a car named {keys.vehicle!r} on this bus already;"
            " end it, or name this one otherwise: --vehicle NAME"
        )
    raise QuitBeforeRide


class ServiceMonitor:
    """A watcher that logs when the service disappears and when it comes back."""

    def __init__(self, vehicle: str) -> None:
        self._vehicle, self._lost = vehicle, False

    def __call__(self, _: str, there: bool) -> None:
        """Record that the service is present or absent."""
        if not there:
            _LOG.warning("service lost; driving on", extra={"vehicle": self._vehicle})
        elif self._lost:
            _LOG.warning("service back", extra={"vehicle": self._vehicle})
        self._lost = not there


def joined(link: Link, signals: Signals, patience: float = HUB_PATIENCE) -> ZenohBus:
    """Join the bus, waiting up to `patience` [s] for its hub.

    Raises:
        HubUnreachable: there is no hub.
        BadLink: the configuration of the link cannot be used.
        QuitBeforeRide: asked to quit meanwhile.
    """
    give_up = time.monotonic() + patience
    while not signals.told:
        try:
            return join(link, GLANCE)
        except HubUnreachable:
            if time.monotonic() >= give_up:
                raise
    raise QuitBeforeRide


def _leave(bus: ZenohBus) -> None:
    """Close the connection; wait for at most CLOSING [s], as the hub may hang."""
    closing = threading.Thread(target=bus.close, name="leaving", daemon=True)
    closing.start()
    closing.join(CLOSING)
