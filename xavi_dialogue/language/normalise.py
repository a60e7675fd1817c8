"""Normalise: what was typed -> plain lower-case English words and clause marks.

Nothing here knows of questions: Unicode, terminal escapes, contractions, digits glued to words.
"""

import re
import unicodedata
from dataclasses import dataclass
from functools import cache

from xavi_dialogue.language.wordlists import english

MAX_CHARACTERS = 256  # read of any input: the end of a longer one, where the question stands
MAX_WORDS = 48
MAX_INPUT = 1024  # [characters] longer input is not read at all

_ESCAPES = re.compile(r"\x1b(?:\[[0-9;:?<=>]*[a-zA-Z@-~]|\][^\x07\x1b]*(?:\x07|\x1b\\)?|.)")
_QUOTES = str.maketrans({"’": "'", "‘": "'", "`": "'", "´": "'", "ʼ": "'", "“": " ", "”": " "})
_CLOCK = re.compile(r"\d{1,3}:\d{2}")
_PIECES = re.compile(r"[^\W\d_]+(?:['-][^\W\d_]+)*|(?<!\d)\d{1,3}:\d{2}(?!\d)|\d+|[.,;:!?…–—()-]")
_MARKS = frozenset(".,;:!?…–—()-")
_MODALS = frozenset({"could", "would", "should", "might", "must"})
_SUBJECTS = frozenset({"i", "you", "he", "she", "it", "we", "they"})
BREAK = ","  # how every clause mark is written from here on


@dataclass(frozen=True, slots=True)
class Normalised:
    """The words of an input, in order; a clause mark is `BREAK`, a time of the ride one word."""

    words: tuple[str, ...]
    shortened: bool = False  # only the end was read
    marks: str = ""  # clause marks as typed, in order


def is_clock(word: str) -> bool:
    """Whether a word is a time of the ride: "0:05"."""
    return _CLOCK.fullmatch(word) is not None


def clean(text: str) -> str:
    """NFKC, no terminal escapes or control characters, lower case, single spaces."""
    text = _ESCAPES.sub(" ", text)
    text = unicodedata.normalize("NFKC", text).translate(_QUOTES)
    kept = (c if unicodedata.category(c)[0] != "C" else " " for c in text)
    return " ".join("".join(kept).lower().split())


def normalise(text: str) -> Normalised:
    """Words of the text, contractions spelt out; at most `MAX_WORDS` of them, the last ones."""
    cleaned = clean(text)
    shortened = len(cleaned) > MAX_CHARACTERS
    if shortened:
        cleaned = cleaned[-MAX_CHARACTERS:].partition(" ")[2] or cleaned[-MAX_CHARACTERS:]
    pieces = _PIECES.findall(cleaned)
    words: list[str] = []
    for piece in pieces:
        if piece in _MARKS:
            if words and words[-1] != BREAK:
                words.append(BREAK)
        else:
            words.extend(expand(piece))
            _mend(words)
    while words and words[-1] == BREAK:
        words.pop()
    if "if" in words:
        words = _supposing(words, pieces)
    if len(words) > MAX_WORDS:
        words, shortened = words[-MAX_WORDS:], True
    return Normalised(tuple(words), shortened, "".join(p for p in pieces if p in _MARKS))


def _supposing(words: list[str], pieces: list[str]) -> list[str]:
    """Read "what'd you do if" as "what would you do if"."""
    short = {piece for piece in pieces if piece in ("what'd", "how'd")}
    heads = {piece.removesuffix("'d") for piece in short}
    pairs = zip(["", *words], words, strict=False)
    return ["would" if word == "did" and before in heads else word for before, word in pairs]


def _mend(words: list[str]) -> None:
    """Put "could of" and "you had have" right, in which an "have" and a "would" were misheard.

    So, too, "would we of".
    """
    if words[-1] == "of" and words[-2:-1]:
        asked = words[-2] in _SUBJECTS and words[-3:-2] and words[-3] in _MODALS
        if words[-2] in _MODALS or asked:
            words[-1] = "have"
    if words[-2:] == ["had", "have"]:
        words[-2] = "would"


@cache
def _whole_words() -> dict[str, tuple[str, ...]]:
    table = english()["contractions"]["words"]
    return {short: tuple(full.split()) for short, full in table.items()}


def expand(word: str) -> tuple[str, ...]:
    """Spell a contraction out: "why'd" -> why did; other words stand as they are."""
    if word in _whole_words():
        return _whole_words()[word]
    if "'" not in word:
        return (word,)
    table = english()["contractions"]
    for suffix, full in table.items():
        if isinstance(full, str) and word.endswith(suffix) and len(word) > len(suffix):
            return (*expand(word.removesuffix(suffix)), full)
    if word.endswith("'d"):
        head = word.removesuffix("'d")
        return (*expand(head), table["d"].get(head, "had"))
    if word.endswith(("n't", "'t")):
        return (*expand(word.replace("'", "")),)
    return tuple(part for part in word.split("'") if part)
