"""A cache of the decisions of a ride, compressed so that those of a whole ride fit into memory."""

import zlib
from collections import OrderedDict

from planner.record.trace import PlanTrace, encode
from planner.record.trace_reading import decode

MAX_BYTES = 96 * 1024 * 1024  # of packed traces; the oldest are dropped first
AT_HAND = 12  # traces that are also held unpacked
LEVEL = 1  # of compression; 1 is fast


class TraceCache:
    """A cache of plan traces by their id."""

    def __init__(self, room: int = MAX_BYTES) -> None:
        """Make an empty cache.

        Args:
            room: [bytes] of packed traces.
        """
        self._room, self._taken = room, 0
        self._packed: OrderedDict[str, bytes] = OrderedDict()
        self._at_hand: OrderedDict[str, PlanTrace] = OrderedDict()

    def put(self, trace: PlanTrace) -> None:
        """Add a trace, and drop the oldest ones if there is no room."""
        if trace.trace_id in self._packed:
            return
        packed = zlib.compress(encode(trace), LEVEL)
        self._packed[trace.trace_id] = packed
        self._taken += len(packed)
        while self._taken > self._room:
            name, oldest = self._packed.popitem(last=False)
            self._taken -= len(oldest)
            self._at_hand.pop(name, None)
        if trace.trace_id in self._packed:
            self._hold(trace)

    def get(self, name: str) -> PlanTrace | None:
        """Return the trace with an id; None if it was never here, or was dropped."""
        if name in self._at_hand:
            self._at_hand.move_to_end(name)
            return self._at_hand[name]
        packed = self._packed.get(name)
        if packed is None:
            return None
        trace = decode(zlib.decompress(packed))
        self._hold(trace)
        return trace

    def _hold(self, trace: PlanTrace) -> None:
        self._at_hand[trace.trace_id] = trace
        while len(self._at_hand) > AT_HAND:
            self._at_hand.popitem(last=False)
