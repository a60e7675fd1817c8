"""Exclusion of long-lived objects from garbage collections."""

import gc
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

EVERY = 1.0  # [s] between collections at least
SHARE = 0.02  # of the time, that collections may take
YOUNG = 300  # objects, for which a collection is not worth while
REVISED_EVERY = 3600.0  # [s]
QUIET = 60.0  # [s] without work, after which there is time to look at everything


@contextmanager
def settled() -> Iterator[None]:
    """Exclude all present objects from collections, until the block ends.

    A collection of the oldest generation visits modules, road network and grammars, which takes
    75 ms and more in the middle of a decision; few objects are made after loading.
    """
    _settle()
    try:
        yield
    finally:
        gc.unfreeze()


@dataclass
class Sweeper:
    """Collection at idle moments, of what is new since the last one.

    What a service remembers of conversations grows to millions of objects. Each automatic
    collection of all of them would take seconds, in the middle of an answer. So what a collection
    leaves is excluded from later ones; only in quiet hours everything is looked at again.
    """

    _next: float = 0.0  # [s] on the monotonic clock
    _worked: float = 0.0  # [s] when there was last something new
    _revised: float = 0.0  # [s] when everything was last looked at

    def sweep(self) -> None:
        """Collect what is new, or in quiet hours everything, if it is time to."""
        now = time.monotonic()
        young, middle, old = gc.get_count()
        if young > YOUNG or middle or old:
            self._worked = now
            if now >= self._next:
                _settle()
                ended = time.monotonic()
                self._next = ended + max(EVERY, (ended - now) / SHARE)
        elif now >= max(self._worked + QUIET, self._revised + REVISED_EVERY):
            self._revised = now
            gc.unfreeze()
            _settle()


def _settle() -> None:
    """Collect, and exclude what is left from later collections."""
    gc.collect()
    gc.freeze()
