"""Keeping what stays for long out of the garbage collector's way."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def settled() -> Iterator[None]:
    """Spare what is loaded by now from collections, until the block ends.

    A collection of the oldest generation goes through modules, road network and grammars, which
    takes 75 ms and more in the midst of a decision; what is made since is little.
    """
    gc.collect()
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()
