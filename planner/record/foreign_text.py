"""Check of texts that come from outside: what would act on a screen instead of being shown there.

Names, colours and reasons of a record are shown to people, on terminals and on pages. A control
character in them could move the cursor; an invisible one could turn the order of letters round.
"""

import re
import unicodedata
from collections.abc import Iterator
from typing import Any, Final

import msgspec

# JSON holds other characters in these forms only; most records hold none.
_SUSPECT: Final = re.compile(rb'\\[^"\\/]|[\x7f-\xff]')


def unprintable(data: bytes) -> str | None:
    """Return where JSON holds a control or invisible character, if anywhere.

    Raises:
        MsgspecError: it is not JSON.
        RecursionError: it is nested too deeply.
    """
    if _SUSPECT.search(data) is None:
        return None
    for place, text in _texts(msgspec.json.decode(data)):
        for character in text:
            if unicodedata.category(character).startswith("C"):
                where = f"`{'.'.join(place)}` holds" if place else "it holds"
                return f"{where} the character U+{ord(character):04X}, which cannot be printed"
    return None


def _texts(value: Any) -> Iterator[tuple[tuple[str, ...], str]]:
    """Yield all texts with their places; a name of a field stands for the place of its owner."""
    waiting: list[tuple[tuple[str, ...], Any]] = [((), value)]
    while waiting:
        place, found = waiting.pop()
        if isinstance(found, str):
            yield place, found
        elif isinstance(found, dict):
            yield from ((place, name) for name in found)
            waiting += [((*place, name), one) for name, one in found.items()]
        elif isinstance(found, list):
            waiting += [((*place, str(k)), one) for k, one in enumerate(found)]
