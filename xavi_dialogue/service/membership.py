"""A service among others: which cars it answers about, and where it is heard of.

See bus.shards. A service of one shard of several hears the cars of its shard alone, each by
subscriptions of its own; a service of all cars subscribes once.
"""

import logging
import threading
from collections.abc import Callable, Collection
from dataclasses import dataclass, field

from xavi_dialogue.bus.interface import (
    DEFAULT_VEHICLE,
    EVERY_CAR,
    Bus,
    CallHandler,
    Handler,
    Keys,
    Presence,
    Subscription,
)
from xavi_dialogue.bus.shards import CLAIMED, Claim, Shard, after
from xavi_dialogue.runtime import system

_LOG = logging.getLogger(__name__)
SETTLED = 1.0  # [s] to find the other services of a fleet
ALONE = "the service before this one is gone: this one answers for {shard} now"
SILENT = (
    "another service answers for {others}: this one, for {shard}, is silent about the same cars"
    " until that one is gone"
)


@dataclass(frozen=True, slots=True)
class Place:
    """Where a service stands in a fleet."""

    shard: Shard = field(default_factory=Shard)
    joins: bool = False  # whether there may be other services already, which have to be found


def _ignore(_: str) -> None:
    pass


@dataclass
class Membership:
    """The claim of a service, those of others, and what it shows and hears of its cars."""

    bus: Bus
    place: Place
    heard: tuple[tuple[str, Handler, bool], ...]  # ends of keys; handler; whether it is kept
    note: Callable[[str], None] = _ignore  # tells the operator
    claim: Claim | None = None
    _others: frozenset[Claim] = frozenset()
    _earlier: tuple[Claim, ...] = ()  # of others, to cars of this shard
    _told: tuple[Claim, ...] = ()  # of these the operator knows
    _lock: threading.Lock = field(default_factory=threading.Lock)
    _cars: set[str] = field(default_factory=set)  # of this shard, that are there or were
    _shown: dict[str, Presence] = field(default_factory=dict)  # signs of life, by car
    _subscribed: dict[str, list[Subscription]] = field(default_factory=dict)  # by car

    @property
    def shard(self) -> Shard:
        """The cars that this service answers about."""
        return self.place.shard

    def join(self, fares: CallHandler, changed: Callable[[], None]) -> None:
        """Claim the cars of the shard, after all services that are there already.

        Args:
            fares: answers how the service fares.
            changed: called on a thread of the bus when other services come or go.
        """

        def see(key: str, alive: bool) -> None:
            if self._see(key, alive=alive):
                changed()

        self.bus.watch(CLAIMED, see)
        if self.place.joins:
            system.sleep(SETTLED)
        with self._lock:
            self.claim = after(self._others, system.token(4), self.shard)
        self._rank()
        self.bus.serve(self.claim.key, fares)
        self.bus.appear(self.claim.key)
        if self.shard.of == 1:
            for tail, handler, kept in self.heard:
                self.bus.subscribe(EVERY_CAR.of(tail), handler, kept=kept)
        if self.shard.has(DEFAULT_VEHICLE):
            self._cars.add(DEFAULT_VEHICLE)
        self.refresh()

    def answers(self, vehicle: str | None) -> bool:
        """Check whether this service answers about a car; None: about no car in particular."""
        if vehicle is None:
            return True
        return self.shard.has(vehicle) and not any(one.shard.has(vehicle) for one in self._earlier)

    def follow(self, vehicle: str) -> None:
        """Hear a car of this shard, and show that it is answered about."""
        self._cars.add(vehicle)
        if self.shard.of > 1 and vehicle not in self._subscribed:
            self._subscribed[vehicle] = [
                self.bus.subscribe(Keys(vehicle).of(tail), handler, kept=kept)
                for tail, handler, kept in self.heard
            ]
        self._show(vehicle)

    def keep(self, vehicles: Collection[str]) -> None:
        """Forget all other cars."""
        if len(self._cars) <= len(vehicles):
            return
        for gone in self._cars.difference(vehicles, (DEFAULT_VEHICLE,)):
            self._cars.discard(gone)
            self._show(gone)
            for one in self._subscribed.pop(gone, ()):
                one.withdraw()

    def refresh(self) -> None:
        """Show at which cars this service answers now, and tell the operator what has changed."""
        for vehicle in self._cars:
            self._show(vehicle)
        earlier = self._earlier
        if earlier == self._told:
            return
        self._told = earlier
        others = ", ".join(sorted({_named(one.shard) for one in earlier}))
        text = (SILENT if earlier else ALONE).format(others=others, shard=_named(self.shard))
        _LOG.warning("other services have come or gone", extra={"count": len(earlier)})
        self.note(text)

    def _see(self, key: str, *, alive: bool) -> bool:
        """Take note of a claim; return whether it bears on this service's cars."""
        one = Claim.read(key)
        if one is None or one == self.claim:
            return False
        with self._lock:
            self._others = self._others | {one} if alive else self._others - {one}
        return self._rank()

    def _rank(self) -> bool:
        """Find out which claims come first; return whether that has changed."""
        with self._lock:
            own, before = self.claim, self._earlier
            if own is not None:
                wanted = (one for one in self._others if one < own and _meet(one.shard, own.shard))
                self._earlier = tuple(sorted(wanted))
            return self._earlier != before

    def _show(self, vehicle: str) -> None:
        there = vehicle in self._cars and self.answers(vehicle)
        if there and vehicle not in self._shown:
            self._shown[vehicle] = self.bus.appear(Keys(vehicle).of("alive/service"))
        elif not there and vehicle in self._shown:
            self._shown.pop(vehicle).withdraw()


def _meet(one: Shard, other: Shard) -> bool:
    """Check whether two shards may have cars in common."""
    return one.of != other.of or one.number == other.number


def _named(shard: Shard) -> str:
    return "every car" if shard.of == 1 else f"shard {shard}"
