"""Documents for browsers: roads, decisions and evidence, made on request and cached."""

import asyncio
import logging
from collections import OrderedDict
from collections.abc import Callable
from contextlib import suppress
from functools import partial

import msgspec

from planner.record.trace import PlanTrace
from sim.roads.netfile import NetworkError
from sim.roads.network import Network
from xavi_dialogue.dashboard.bus_client import BusClient, Unanswered
from xavi_dialogue.dashboard.conversation import Conversation
from xavi_dialogue.dashboard.ride_state import RideState
from xavi_dialogue.dashboard.views import map as roads
from xavi_dialogue.dashboard.views.decision import whole
from xavi_dialogue.dashboard.views.evidence import has_evidence, of_turn, traces_of
from xavi_dialogue.runtime import system
from xavi_dialogue.vehicle.map_server import NETWORK

_LOG = logging.getLogger(__name__)
PATIENCE = 10.0  # [s] for a car to send its roads
AGAIN = 5.0  # [s] after which they are requested again
MAX_KEPT = 64  # documents that are kept


class DocumentCache:
    """Documents about the present ride."""

    def __init__(
        self,
        record: RideState,
        conversation: Conversation,
        roads_known: Callable[[], None],
    ) -> None:
        """Make an empty cache.

        Args:
            record: of the ride.
            conversation: whose turns have evidence.
            roads_known: called when the roads have arrived.
        """
        self._record, self._conversation = record, conversation
        self._roads_known = roads_known
        self._bus_client: BusClient | None = None
        self._network: Network | None = None
        self._roads: dict[str, bytes] = {}
        self._made: OrderedDict[tuple[str, str | int], bytes] = OrderedDict()
        self._asked: float | None = None  # [s] on the monotonic clock, of the request for roads
        self._reading: asyncio.Task[None] | None = None  # fetches the roads

    def join(self, asking: BusClient) -> None:
        """Send requests to others from now on."""
        self._bus_client = asking

    def begin_anew(self) -> None:
        """Begin another ride."""
        self._made.clear()
        self._roads.clear()
        self._network = self._asked = None

    def look(self) -> None:
        """Request the roads of the ride until they are known."""
        ride, now = self._record.ride, system.monotonic()
        due = self._asked is None or now > self._asked + AGAIN
        if self._bus_client is None or ride is None or self._network is not None or not due:
            return
        self._asked = now
        self._reading = asyncio.get_running_loop().create_task(self._learn(ride.ride))

    def roads(self, name: str) -> bytes | None:
        """Return the roads with this hash."""
        return self._roads.get(name)

    def decision(self, name: str) -> bytes | None:
        """Return a decision as a document; None if it is not in the record."""
        trace = self._record.trace_cache.get(name)
        if trace is None:
            return None
        return self._kept(("decision", name), lambda: whole(trace, self._network))

    async def evidence(self, n: int) -> bytes | None:
        """Return the evidence of a turn; None if there is no such turn, or no evidence."""
        turn = self._conversation.turn(n)
        if turn is None or not has_evidence(turn.reply):
            return None
        found = {name: await self._trace(name) for name in traces_of(turn.reply)}
        known = {name: trace for name, trace in found.items() if trace is not None}
        taken = (self._record.up_to(trace.sim_time) for trace in known.values())
        decided = {trace.trace_id: trace for trace in taken if trace is not None}
        make = partial(of_turn, n, turn.reply, decided | known)
        if len(known) == len(found):
            return self._kept(("evidence", n), make)
        shown = make()  # missing parts may still arrive
        return None if shown is None else msgspec.json.encode(shown)

    async def _trace(self, name: str) -> PlanTrace | None:
        """Return a decision of the record, or a replanned one from the service."""
        trace = self._record.trace_cache.get(name)
        if trace is not None or self._bus_client is None:
            return trace
        with suppress(Unanswered):
            return await self._bus_client.evidence(name)
        return None

    async def _learn(self, ride: str) -> None:
        assert self._bus_client is not None
        try:
            packed = await self._bus_client.request(NETWORK, b"", PATIENCE)
        except Unanswered:
            return
        found = await asyncio.to_thread(_read, packed)
        current = self._record.ride
        if found is None or current is None or current.ride != ride:
            return
        network, document = found
        self._network = network
        self._roads[network.hash] = document
        self._record.roads = network.hash
        self._made.clear()  # documents made without the roads
        self._roads_known()

    def _kept(self, key: tuple[str, str | int], make: Callable[[], object | None]) -> bytes | None:
        if key not in self._made:
            shown = make()
            if shown is None:
                return None
            self._made[key] = msgspec.json.encode(shown)
        self._made.move_to_end(key)
        while len(self._made) > MAX_KEPT:
            self._made.popitem(last=False)
        return self._made[key]


def _read(packed: bytes) -> tuple[Network, bytes] | None:
    """Fetch and convert the roads of a car; None if they cannot be read."""
    try:
        network, outlines = roads.read(packed)
    except NetworkError as error:
        _LOG.warning("roads that cannot be read", extra={"problem": str(error)})
        return None
    return network, msgspec.json.encode(roads.shown(network, outlines))
