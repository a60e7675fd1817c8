"""Spelling: an unknown word -> the word of the closed vocabulary that was meant, or None.

A known word is never touched. Distances are optimal string alignment (one transposition of
neighbours is one error); ties are broken by rules, never by order in memory.
"""

from functools import cache, lru_cache

from rapidfuzz.distance import OSA, Prefix
from rapidfuzz.process import extract

from xavi_dialogue.language.wordlists import PLAIN_RANK, WORD_FILES, english, vocabulary

_TALK_RANK = WORD_FILES.index("words_talk.toml")
_CANDIDATES = 12
_SHORT = 4  # contractions no longer than this are no correction of anything


@cache
def _choices() -> dict[int, tuple[str, ...]]:
    """Words by length: a correction differs by at most two letters in length."""
    by_length: dict[int, list[str]] = {}
    contracted = english()["contractions"]["words"]
    for word in sorted({*vocabulary().words, *(w for w in contracted if len(w) > _SHORT)}):
        if word.isascii() and word.isalpha() and len(word) > 1:
            for length in range(len(word) - 2, len(word) + 3):
                by_length.setdefault(length, []).append(word)
    return {length: tuple(words) for length, words in by_length.items()}


def allowance(length: int) -> int:
    """How many errors a word of that many letters may have."""
    if length < 3:
        return 0
    return 1 if length < 6 else 2


@lru_cache(maxsize=4096)
def correct(word: str) -> tuple[str, ...] | None:
    """What an unknown word was meant to be: one word, or two that ran together."""
    if len(word) > _SHORT and word + "g" in vocabulary().words:
        return (word + "g",)  # "stoppin"
    if len(word) > _SHORT and (parts := _split(word)):
        return parts
    allowed = allowance(len(word))
    if allowed == 0 or not word.isalpha():
        return None
    found = extract(
        word, _choices().get(len(word), ()), scorer=OSA.distance, score_cutoff=allowed,
        limit=_CANDIDATES,
    )  # fmt: skip
    ranked = sorted(
        (_rank(word, candidate, int(distance)), candidate) for candidate, distance, _ in found
    )
    ranked = [entry for entry in ranked if _plausible(word, entry[1], entry[0][0])]
    return (ranked[0][1],) if ranked else None


def _plausible(word: str, candidate: str, distance: int) -> bool:
    """Short words only by transposition: else every three letters are a typing error.

    Words of what the car does not do ask for a good reason: "hesitate" is not "levitate".
    """
    if distance > 1 and vocabulary().words.get(candidate) == _TALK_RANK:
        return False
    return len(word) > 3 or sorted(word) == sorted(candidate)


def _rank(word: str, candidate: str, distance: int) -> tuple[int, bool, int, int, int]:
    return (
        distance,
        sorted(word) != sorted(candidate),
        vocabulary().words.get(candidate, 0) // 3,
        -Prefix.similarity(word, candidate),
        -len(candidate),
    )


def _split(word: str) -> tuple[str, ...] | None:
    known = vocabulary().words
    for cut in range(2, len(word) - 1):
        parts = (word[:cut], word[cut:])
        if all(known.get(part, PLAIN_RANK) < PLAIN_RANK for part in parts):
            return parts
    return None
