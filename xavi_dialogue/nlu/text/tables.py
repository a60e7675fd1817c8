"""Tables: the data files of the language side, read once from the package `grammars`."""

import tomllib
from functools import cache
from importlib import resources
from typing import Any


@cache
def load(name: str) -> dict[str, Any]:
    """Read one TOML file of the package `grammars`."""
    return tomllib.loads(resources.files("grammars").joinpath(name).read_text(encoding="utf-8"))


@cache
def english() -> tuple[str, ...]:
    """Read the list of English words."""
    text = resources.files("grammars").joinpath("english.txt").read_text(encoding="utf-8")
    lines = (line for line in text.splitlines() if not line.startswith("#"))
    return tuple(word for line in lines for word in line.split())


@cache
def homophones() -> dict[str, tuple[str, ...]]:
    """Read which words sound like a word of ours."""
    text = resources.files("grammars").joinpath("homophones.txt").read_text(encoding="utf-8")
    rows = (line.split() for line in text.splitlines() if not line.startswith("#"))
    return {heard: tuple(meant) for heard, *meant in rows}


@cache
def apart() -> dict[str, tuple[tuple[str, ...], ...]]:
    """Work out what a word is without its apostrophe: "well" for "we'll"."""
    found: dict[str, tuple[tuple[str, ...], ...]] = {}
    for short, full in _SHORT.items():
        for pronoun in _PRONOUNS:
            found[pronoun + short] = tuple((pronoun, word) for word in full)
    return found


_SHORT = {"re": ("are",), "ll": ("will",), "d": ("had", "would")}
_PRONOUNS = ("i", "we", "he", "she", "they", "you", "it", "that", "there", "who")


def phrases(listed: str) -> list[tuple[str, ...]]:
    """Split "a b, c" into phrases, each a tuple of words."""
    return [tuple(phrase.split()) for phrase in listed.split(",") if phrase.strip()]
