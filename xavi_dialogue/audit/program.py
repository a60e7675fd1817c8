"""The program that an audit is run with, as a hash: results of another one are not taken over."""

import hashlib
from functools import lru_cache
from importlib import metadata
from pathlib import Path
from typing import Final

TOP: Final = Path(__file__).parents[2]
PACKAGES: Final = ("grammars", "planner", "sim", "xavi_dialogue")
ENDINGS: Final = (".py", ".lark", ".rules", ".toml", ".json", ".txt")
#: What computes rides and answers beside our own code.
LIBRARIES: Final = (
    "lark",
    "libsumo",
    "llvmlite",
    "msgspec",
    "numba",
    "numpy",
    "rapidfuzz",
    "scipy",
)
#: What only shows rides, or starts what works on them: it decides nothing about results.
APART: Final = (
    *("xavi_dialogue/__main__.py", "xavi_dialogue/audit/audit.py"),
    *("xavi_dialogue/audit/command.py", "xavi_dialogue/audit/report.py"),
    *("xavi_dialogue/audit/results", "xavi_dialogue/audit/running"),
    *("xavi_dialogue/audit/store.py", "xavi_dialogue/chat"),
    *("xavi_dialogue/cli", "xavi_dialogue/report", "xavi_dialogue/terminal"),
)
LENGTH: Final = 16  # hexadecimal digits that are kept of a hash


def digest(*parts: bytes) -> str:
    """Return a hash of several byte strings in order."""
    found = hashlib.sha256()
    for part in parts:
        found.update(len(part).to_bytes(8, "big"))
        found.update(part)
    return found.hexdigest()


@lru_cache(maxsize=1)
def program() -> str:
    """Return the hash of our code and grammars, and of the versions of LIBRARIES.

    Scenarios do not belong to it: each ride has the hash of its own. Nor does what stands apart.
    """
    parts = [f"{name} {metadata.version(name)}".encode() for name in LIBRARIES]
    for path in files():
        parts += [path.relative_to(TOP).as_posix().encode(), path.read_bytes()]
    return digest(*parts)[:LENGTH]


def files() -> list[Path]:
    """Return the files that belong to the hash, in order of their names."""
    scenarios = TOP / "sim" / "scenarios"
    apart = (scenarios, *(TOP / name for name in APART))
    return [
        path
        for package in PACKAGES
        for path in sorted((TOP / package).rglob("*"))
        if path.suffix in ENDINGS and not any(path.is_relative_to(one) for one in apart)
    ]
