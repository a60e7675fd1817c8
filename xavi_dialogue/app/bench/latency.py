"""Latency of parsing: times of single texts, none of which profits from texts before it.

Caches of the language modules that are bounded hold what texts brought along; they are emptied
before a text is timed. Unbounded ones hold the tables of grammar and word lists, and stay.
"""

import sys
import time
from collections.abc import Callable, Iterator

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.parse import explained

_LANGUAGE = "xavi_dialogue.language."


def forget() -> None:
    """Empty every bounded cache of the language modules."""
    for clear in _bounded():
        clear()


def _bounded() -> Iterator[Callable[[], None]]:
    for name, module in list(sys.modules.items()):
        if name.startswith(_LANGUAGE):
            for held in list(vars(module).values()):
                parameters = getattr(held, "cache_parameters", None)
                if parameters is not None and parameters()["maxsize"] is not None:
                    yield held.cache_clear


def parse_time(text: str, previous: Query | None = None, times: int = 1) -> float:
    """The processor time [ms] to parse a text once the tables are built.

    Args:
        text: what is parsed.
        previous: the question before it.
        times: how often it is timed; the fastest counts.
    """
    return min(_timed(text, previous) for _ in range(times))


def _timed(text: str, previous: Query | None) -> float:
    forget()
    began = time.process_time()
    explained(text, previous)
    return 1000.0 * (time.process_time() - began)
