"""Recollection: a cache of what was found from a record.

The same act and record give the same result, with or without the cache. It helps when several
passengers ask about the same moment.
"""

from dataclasses import dataclass, field
from typing import TypeAlias

from xavi_dialogue.domain.answers import Answer, NeedRollout, Refusal
from xavi_dialogue.domain.discourse import Discourse, GroundedAct
from xavi_dialogue.domain.meaning import Reading
from xavi_dialogue.explain.answers.engine import explain_in
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.nlg.context import Looks
from xavi_dialogue.nlu.grounding.ground import ground
from xavi_dialogue.nlu.grounding.result import Grounding

# Maximum of records that are remembered; the least recently used is forgotten. Many passengers ask
# about some forty moments, each known with and without plans made again; a record takes 40 kB.
MAX_RIDES = 256
MAX_RESULTS = 256  # maximum for one record

Result: TypeAlias = Answer | Refusal | NeedRollout
_Key: TypeAlias = tuple[object, ...]


@dataclass
class _Known:
    """A record as ride and world, and the results from it."""

    record: Record  # kept alive, because the key consists of identities of its parts
    ride: Ride
    world: World
    results: dict[GroundedAct, Result] = field(default_factory=dict)


@dataclass
class Recollection:
    """A cached way to ground in, explain from and look at the latest records. For one thread."""

    _known: dict[_Key, _Known] = field(default_factory=dict)  # most recently used last

    def __reduce__(self) -> tuple[type["Recollection"], tuple[()]]:
        """Copy it empty: its keys are identities, which copies of records do not share."""
        return Recollection, ()

    def ground(
        self, readings: tuple[Reading, ...], record: Record, discourse: Discourse
    ) -> Grounding:
        """Ground readings in the world of a record."""
        return ground(readings, self._of(record).world, discourse)

    def explain(self, act: GroundedAct, record: Record) -> Result:
        """Answer an act from a record; see `engine.explain`."""
        known = self._of(record)
        if act not in known.results:
            if len(known.results) >= MAX_RESULTS:
                known.results.clear()
            known.results[act] = explain_in(act, known.ride, known.world)
        return known.results[act]

    def see(self, record: Record) -> Looks:
        """Return how vehicles look in a record, by vehicle and time."""
        return self._of(record).world.look

    def _of(self, record: Record) -> _Known:
        key = _key(record)
        known = self._known.pop(key, None)
        if known is None:
            ride = Ride(record)
            known = _Known(record, ride, World(ride))
        self._known[key] = known
        if len(self._known) > MAX_RIDES:
            oldest = self._known.pop(next(iter(self._known)))
            oldest.ride.notes.clear()  # which refer to the ride: it would have to be collected
        return known


def _key(record: Record) -> _Key:
    """Return a key that identifies a record; comparing its traces would take too long."""
    return (
        *(record.now, record.ended, record.refused, record.gaps),
        *(tuple(map(id, part)) for part in (record.traces, record.events, record.extra)),
        id(record.scene),
    )
