"""Latency of understanding: times of single texts, independent of earlier texts.

Bounded caches of the modules that read texts hold results of earlier texts, so they are emptied
before a text is timed. Unbounded caches hold tables of grammar and word lists, and are kept.
"""

import time
from pathlib import Path

from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.nlu.grounding.ground import ground
from xavi_dialogue.nlu.grounding.result import Grounding
from xavi_dialogue.nlu.parse import Parser
from xavi_dialogue.process.caches import forget
from xavi_dialogue.storage import ride_file

RIDE = Path("transcripts/rides/s1-0.ride.jsonl.gz")


def record_of(path: Path) -> Record:
    """Return the record of a ride.

    Raises:
        RideFileError: it is no recorded ride.
    """
    known = ride_file.load(path.read_bytes())
    return Record(known.halt, tuple(known.traces), tuple(known.events), known.ended is not None)


def understood(text: str, record: Record, discourse: Discourse) -> Grounding:
    """Read a text and ground it in the world of a record."""
    return ground(Parser().read(text), World(Ride(record)), discourse)


def hearing_time(
    text: str, record: Record, discourse: Discourse | None = None, times: int = 1
) -> float:
    """Return the processor time [ms] to read and ground a text, after the tables are built.

    Args:
        text: the text.
        record: of the ride that it is grounded in.
        discourse: the earlier discourse; None: nothing was said yet.
        times: number of repeats; the fastest counts.
    """
    before = Discourse() if discourse is None else discourse
    return min(_timed(text, record, before) for _ in range(times))


def _timed(text: str, record: Record, discourse: Discourse) -> float:
    forget()
    began = time.process_time()
    understood(text, record, discourse)
    return 1000.0 * (time.process_time() - began)
