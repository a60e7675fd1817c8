"""What a passenger says to what was offered or told: "2", "another one", "and then?"."""

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib.resources import files


def chosen(text: str, count: int) -> int | None:
    """The index (from 0) of the choice that the text picks out of `count`, or None."""
    filler, numbers = _words()
    words = ["".join(filter(str.isalnum, word)) for word in text.casefold().split()]
    if words == ["one"]:
        words = ["first"]
    telling = [word for word in words if word and word not in filler]
    if len(telling) != 1:
        return None
    word = telling[0]
    number = int(word) if word.isdecimal() and len(word) <= 2 else numbers.get(word, 0)
    index = count - 1 if number == -1 else number - 1
    return index if 0 <= index < count else None


def is_number(text: str) -> bool:
    """Whether the text is a number and nothing else."""
    return "".join(filter(str.isalnum, text)).isdecimal()


def wants_another(text: str) -> bool:
    """Whether the text asks for one more of what there was before: "another one", "next"."""
    another, beside = _more()
    words = {"".join(filter(str.isalnum, word)) for word in text.casefold().split()} - {""}
    return bool(words & another) and words <= another | beside


def goes_on(text: str) -> bool:
    """Whether the text says that it goes on from what was spoken of: "and where was it going?"."""
    first = "".join(filter(str.isalnum, text.casefold().partition(" ")[0]))
    return first in _onward()


@cache
def _onward() -> frozenset[str]:
    data = tomllib.loads(files("grammars").joinpath("choices.toml").read_text(encoding="utf-8"))
    return frozenset(data["onward"])


@cache
def _more() -> tuple[frozenset[str], frozenset[str]]:
    data = tomllib.loads(files("grammars").joinpath("choices.toml").read_text(encoding="utf-8"))
    return frozenset(data["another"]), frozenset(data["beside"])


@cache
def _words() -> tuple[frozenset[str], Mapping[str, int]]:
    data = tomllib.loads(files("grammars").joinpath("choices.toml").read_text(encoding="utf-8"))
    return frozenset(data["filler"]), data["number"]
