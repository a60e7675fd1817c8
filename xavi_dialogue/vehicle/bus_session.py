"""The car among others: joined to the bus, alone under its name, and off the bus in time.

NameTaken   another car of this name is on the bus
Dismissed   told to quit before the ride began
"""

import logging
import threading
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from xavi_dialogue.bus.health import Alive
from xavi_dialogue.bus.interface import (
    Bus,
    BusError,
    HubUnreachable,
    Keys,
    NoAnswer,
    NobodyThere,
    TooLate,
    call,
)
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.zenoh_bus import ZenohBus, join
from xavi_dialogue.process.child_commands import Signals
from xavi_dialogue.vehicle.map_server import serve_roads
from xavi_dialogue.vehicle.node import COUNTERS, serve
from xavi_dialogue.vehicle.outbox import Outbox
from xavi_dialogue.vehicle.replanning import Replanner, workers
from xavi_dialogue.vehicle.worker_pool import WAITING

HUB_PATIENCE = 10.0  # [s] for the hub to come up
CHILD_PATIENCE = 90.0  # [s] the same where a parent has started both, and sees to it
GLANCE = 0.5  # [s] between looks at whether to quit
ANSWERED = 1.0  # [s] within which a car that is there says so
# [s] A car whose machine has gone is on the bus until its lease of 10 s ends.
VACATED = 12.0
CLOSING = 1.0  # [s] that leaving the bus may take

_LOG = logging.getLogger(__name__)


class NameTaken(BusError):
    """Another car of this name is on the bus."""


class Dismissed(Exception):
    """Told to quit before the ride began."""


@dataclass(frozen=True, slots=True)
class Staff:
    """Who plans again beside the driving."""

    workers: int = 1
    waiting: int = WAITING  # requests that may wait for one of them


@dataclass(frozen=True, slots=True)
class Company:
    """What a car has that is on the bus."""

    outbox: Outbox
    planning: Replanner
    alive: Alive


@contextmanager
def company(
    link: Link,
    keys: Keys,
    network: Path,
    staff: Staff,
    signals: Signals,
    patience: float = HUB_PATIENCE,
) -> Iterator[Company]:
    """Join the bus as a car, for as long as the context lasts.

    Args:
        link: to the hub.
        keys: of the car.
        network: the file that planning again needs.
        staff: who does that.
        signals: may tell to quit meanwhile.
        patience: [s] for the hub to come up.

    Raises:
        HubUnreachable: there is no hub.
        BadLink: the configuration of the link cannot be used.
        NameTaken: another car of this name is on the bus.
        Dismissed: told to quit before all was ready.
    """
    alive = Alive("car", COUNTERS)
    with ExitStack() as stack:
        bus = joined(link, signals, patience)
        stack.callback(_leave, bus)
        claim(bus, keys, signals)
        outbox = Outbox(bus, alive)
        stack.callback(outbox.close, 0.0)
        pool = stack.enter_context(workers(network, staff.workers, staff.waiting))
        alive.gauge("outbox", outbox.waiting)
        alive.gauge("workers", lambda: len(pool.pids))
        alive.gauge("workers_idle", lambda: pool.idle)
        planning = Replanner(pool, alive=alive)
        bus.watch(keys.of("alive/service"), Attendance(keys.vehicle))
        serve_roads(bus, keys, network)
        serve(bus, keys, planning, alive)
        yield Company(outbox, planning, alive)


def claim(bus: Bus, keys: Keys, signals: Signals, patience: float = VACATED) -> None:
    """Make sure that there is no other car of this name.

    A car that was killed may seem to be there for a while: up to `patience` [s].

    Raises:
        NameTaken: there is one.
        Dismissed: told to quit meanwhile.
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
    raise Dismissed


class Attendance:
    """Logs when the service is gone, and when it is back."""

    def __init__(self, vehicle: str) -> None:
        self._vehicle, self._lost = vehicle, False

    def __call__(self, _: str, there: bool) -> None:
        """Learn that the service is there, or not any more."""
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
        Dismissed: told to quit meanwhile.
    """
    give_up = time.monotonic() + patience
    while not signals.told:
        try:
            return join(link, GLANCE)
        except HubUnreachable:
            if time.monotonic() >= give_up:
                raise
    raise Dismissed


def _leave(bus: ZenohBus) -> None:
    """Close the connection; to a hub that hangs that takes long, and nothing is lost by it."""
    closing = threading.Thread(target=bus.close, name="leaving", daemon=True)
    closing.start()
    closing.join(CLOSING)
