"""Exclusion of long-lived objects from garbage collections."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def settled() -> Iterator[None]:
    """Exclude all present objects from collections, until the block ends.

    A collection of the oldest generation visits modules, road network and grammars, which takes
    75 ms and more in the middle of a decision; few objects are made after loading.
    """
    gc.collect()
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()
