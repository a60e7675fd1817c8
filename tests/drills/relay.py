"""A relay that is up to no good: a program between the hub of a car and that of a service.

    python -m tests.drills.relay CAR_HUB SERVICE_HUB FAULTS

What becomes of a message follows from the seed, its key and its number alone, so that the same
ride suffers the same whenever it is driven.
"""

import heapq
import queue
import random
import sys
import time
from functools import partial

import msgspec

from xavi_dialogue.bus.interface import Bus, Call, Keys, Outcome, Presence, Refused, TransportError
from xavi_dialogue.bus.link import Link
from xavi_dialogue.bus.messages import WhatIfRequest, unpack
from xavi_dialogue.bus.zenoh_bus import join
from xavi_dialogue.process import child_commands
from xavi_dialogue.vehicle.telemetry import KEPT_EVENTS, KEPT_TRACES

LATEST = 0.6  # [s] that a message is held back at most
KEYS = Keys()
KEPT = {"scene": 0, "trace": KEPT_TRACES, "event": KEPT_EVENTS}
READY = "ready"


class Faults(msgspec.Struct, frozen=True):
    """What goes wrong, and how often; shares are of 1."""

    seed: int = 0
    dropped: float = 0.0  # scenes that do not arrive
    twice: float = 0.0  # messages that come again, somewhat later
    held: float = 0.0  # messages that are held back, so that later ones overtake them
    lost: dict[str, tuple[int, ...]] = {}  # numbers that never arrive, by the last part of the key


class _Numbered(msgspec.Struct):
    seq: int


class Relay:
    """Passes on what a car reports, and what it is asked."""

    def __init__(self, here: Bus, there: Bus, faults: Faults) -> None:
        self._here, self._there, self._faults = here, there, faults
        self._came: queue.SimpleQueue[tuple[str, bytes]] = queue.SimpleQueue()
        self._due: list[tuple[float, int, str, bytes]] = []  # a heap
        self._taken = 0
        self._present: Presence | None = None
        self._out = {tail: there.publisher(KEYS.of(tail), keep) for tail, keep in KEPT.items()}

    def open(self) -> None:
        for tail, keep in KEPT.items():
            hear = partial(self._hear, tail)
            self._here.subscribe(KEYS.of(tail), hear, kept=bool(keep))
        self._there.serve(KEYS.of("@rpc/whatif"), self._ask)
        self._here.watch(KEYS.of("alive/car"), self._see)

    def work(self, patience: float) -> None:
        """Pass on what is due, and take what comes within `patience` [s]."""
        now = time.monotonic()
        while self._due and self._due[0][0] <= now:
            _, _, tail, payload = heapq.heappop(self._due)
            self._out[tail].put(payload)
        if self._due:
            patience = min(patience, self._due[0][0] - now)
        try:
            tail, payload = self._came.get(timeout=patience)
        except queue.Empty:
            return
        for delay in self.fate(tail, msgspec.json.decode(payload, type=_Numbered).seq):
            self._taken += 1
            heapq.heappush(self._due, (time.monotonic() + delay, self._taken, tail, payload))

    def fate(self, tail: str, seq: int) -> list[float]:
        """After how long [s] a message is passed on, each time that it is."""
        faults, dice = self._faults, random.Random(f"{self._faults.seed}/{tail}/{seq}")
        if seq in faults.lost.get(tail, ()) or (tail == "scene" and dice.random() < faults.dropped):
            return []
        delays = [dice.uniform(0.0, LATEST) if dice.random() < faults.held else 0.0]
        if dice.random() < faults.twice:
            delays.append(delays[0] + dice.uniform(0.0, LATEST))
        return delays

    def _hear(self, tail: str, _: str, payload: bytes) -> None:
        self._came.put((tail, payload))

    def _see(self, key: str, alive: bool) -> None:
        if alive:
            self._present = self._there.appear(key)
        elif self._present is not None:
            self._present.withdraw()

    def _ask(self, call: Call) -> None:
        wanted = unpack(call.payload, WhatIfRequest)

        def settle(outcome: Outcome) -> None:
            match outcome:
                case bytes():
                    call.reply(outcome)
                case Refused(payload=payload):
                    call.refuse(payload)
                case TransportError():
                    call.drop()

        self._here.request(call.key, call.payload, wanted.deadline_ms / 1000.0, settle)


def main() -> None:
    here, there, faults = sys.argv[1:]
    orders: child_commands.Orders = queue.SimpleQueue()
    child_commands.quit_on_signals(orders)
    with join(Link.to_hub(here)) as car, join(Link.to_hub(there)) as service:
        relay = Relay(car, service, msgspec.json.decode(faults, type=Faults))
        relay.open()
        sys.stdout.write(f"{READY}\n")
        sys.stdout.flush()
        while orders.empty():
            relay.work(0.1)


if __name__ == "__main__":
    main()
