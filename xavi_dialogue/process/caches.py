"""Caches of the modules that read texts."""

import sys
from collections.abc import Callable, Iterator

_READING = "xavi_dialogue.nlu."


def forget() -> None:
    """Empty every bounded cache of the modules that read texts."""
    for clear in _bounded():
        clear()


def _bounded() -> Iterator[Callable[[], None]]:
    for name, module in list(sys.modules.items()):
        if name.startswith(_READING):
            for held in list(vars(module).values()):
                parameters = getattr(held, "cache_parameters", None)
                if parameters is not None and parameters()["maxsize"] is not None:
                    yield held.cache_clear
