"""Whether files of a SUMO configuration say anything of a vehicle, without running it.

A vehicle has the id that a file states, or one made of it: of a flow `flow.3`, of a person's trip
`person_0`.
"""

import gzip
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Final
from xml.sax.saxutils import escape

MADE: Final = re.compile(r"(.+?)[._]\d+$")  # an id made of another
INCLUDES: Final = "<include"  # a file that is part of another


def mentioned(name: str, files: Iterable[Path]) -> bool:
    """Tell whether a vehicle may be in some files; so it is where one cannot be read."""
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
