"""Check of whether files of a SUMO configuration mention a vehicle, without running it.

A vehicle has an id that a file states, or one made from it: `flow.3` from the flow `flow`,
`person_0` from the trip of `person`.
"""

import gzip
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Final
from xml.sax.saxutils import escape

MADE: Final = re.compile(r"(.+?)[._]\d+$")  # an id made from another
INCLUDES: Final = "<include"  # the element by which a file includes another


def mentioned(name: str, files: Iterable[Path]) -> bool:
    """Check whether some files may define a vehicle.

    True also if a file cannot be read, or includes another file.
    """
    stated = [name, *(found[1] for found in [MADE.match(name)] if found)]
    wanted = [INCLUDES, *(f"{q}{escape(x)}{q}" for x in stated for q in "\"'")]
    return any(_holds(file, wanted) for file in files)


def _holds(file: Path, wanted: Sequence[str]) -> bool:
    read = gzip.open if file.suffix == ".gz" else open
    try:
        with read(file, "rt", encoding="utf-8") as lines:
            return any(text in line for line in lines for text in wanted)
    except (OSError, EOFError, UnicodeDecodeError):
        return True
