"""Explaining with a memory: what was found out of a record need not be found out again.

The same query and record give the same result, with a memory or without one. Several passengers
may ask about the same moment, and before something is suggested it is tried.
"""

from dataclasses import dataclass, field
from typing import TypeAlias

from xavi_dialogue.explain.engine import explain_ride
from xavi_dialogue.explain.explanation import Explanation, NeedRollout, NoExplanation
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.record import Record
from xavi_dialogue.explain.ride import Ride

MAX_RIDES = 16  # records that are remembered; that which was used longest ago is forgotten first
MAX_RESULTS = 256  # of one record

Result: TypeAlias = Explanation | NoExplanation | NeedRollout
_Key: TypeAlias = tuple[object, ...]


@dataclass
class _Known:
    """One record, read, and what was explained from it."""

    record: Record  # kept, for it is known by the identity of what is in it
    ride: Ride
    results: dict[Query, Result] = field(default_factory=dict)


@dataclass
class Recollection:
    """Explains from the latest records; in the place of `engine.explain`. For one thread."""

    _known: dict[_Key, _Known] = field(default_factory=dict)  # used latest at the end

    def explain(self, query: Query, record: Record) -> Result:
        """See engine.explain."""
        key = _key(record)
        known = self._known.pop(key, None) or _Known(record, Ride(record))
        self._known[key] = known
        if len(self._known) > MAX_RIDES:
            del self._known[next(iter(self._known))]
        if query not in known.results:
            if len(known.results) >= MAX_RESULTS:
                known.results.clear()
            known.results[query] = explain_ride(query, known.ride)
        return known.results[query]


def _key(record: Record) -> _Key:
    """What tells a record from all that are remembered: comparing its traces would take long."""
    return (
        *(record.now, record.ended, record.focus, record.refused),
        *(tuple(map(id, part)) for part in (record.traces, record.events, record.extra)),
    )
