"""Tables: word lists for answers, read from `grammars/*.toml`.

Errors:
    WordingError    a file is at fault, or lacks a word that is asked for
"""

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files
from typing import Any

from xavi_dialogue.errors import XaviError


class WordingError(XaviError, ValueError):
    """A file of words that cannot be used, or a word that it lacks."""


@cache
def table(name: str) -> Mapping[str, Any]:
    """Return the contents of `grammars/<name>.toml`.

    Raises:
        WordingError: the file is not TOML.
    """
    text = (files("grammars") / f"{name}.toml").read_text(encoding="utf-8")
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise WordingError(f"{name}.toml: {error}") from error


def word(name: str, section: str, key: str) -> str:
    """Return the entry `key` of a section of `grammars/<name>.toml`.

    Raises:
        WordingError: there is none.
    """
    found = table(name).get(section, {}).get(key)
    if not isinstance(found, str):
        raise WordingError(f"{name}.toml: [{section}] lacks {key!r}")
    return found


def afoot(phrase: str) -> str:
    """Return a verb phrase as it is said of people on foot."""
    found = table("doings")["on-foot"].get(phrase, phrase)
    return str(found)
