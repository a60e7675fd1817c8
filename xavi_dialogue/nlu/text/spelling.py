"""Spelling: a word that is none -> the words that may have been meant, each at a cost.

A word that is known is never touched here. Distances are optimal string alignment, in which one
transposition of neighbours is one error. Of words as near, the one in more phrases comes first.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache

from rapidfuzz.distance import OSA, Prefix
from rapidfuzz.process import extract

ERROR = 0.35  # cost of one error
SLIP = 0.27  # ... that is a transposition, a neighbouring key, or a letter doubled or not
RUN = 0.25  # cost of a space left out between words of many phrases
RANKED = 0.12  # cost of a word that is English and no more
RARE = 0.12  # cost of a word of one phrase; of more, the less
GUESSES = 4  # words offered for one that is none
COMMON = 6  # phrases from which on a word is one that passengers often use
_CANDIDATES = 24
_VOWELS = str.maketrans("", "", "aeiou")
_LONG = 4
_LONGER = 7  # letters of a word from which on two errors may lie in its consonants
_ROWS = ("qwertyuiop", "asdfghjkl", "zxcvbnm")

Guess = tuple[tuple[str, ...], float]


@dataclass(frozen=True)
class Vocabulary:
    """Every word there is, with a rank, and in how many phrases it is.

    0 means something here, 1 is English and no more, 2 is too rare to have been misspelt.
    """

    words: dict[str, int]
    uses: Mapping[str, int] = field(default_factory=dict)
    by_length: dict[int, tuple[str, ...]] = field(default_factory=dict)
    skeletons: dict[str, tuple[str, ...]] = field(default_factory=dict)

    @staticmethod
    def of(
        words: dict[str, int], uses: Mapping[str, int], shortened: tuple[str, ...] = ()
    ) -> "Vocabulary":
        """Index the words, and those run together as "dont" is, by length and by consonants."""
        lengths: dict[int, list[str]] = {}
        skeletons: dict[str, list[str]] = {}
        for word in sorted({*words, *shortened}):
            rank = words.get(word, 0)
            if rank > 1 or not (word.isascii() and word.isalpha() and len(word) > 1):
                continue
            for length in range(len(word) - 2, len(word) + 3):
                lengths.setdefault(length, []).append(word)
            if rank == 0 and len(word) > 2:
                skeletons.setdefault(skeleton(word), []).append(word)
        return Vocabulary(
            words,
            uses,
            {length: tuple(found) for length, found in lengths.items()},
            {key: tuple(found) for key, found in skeletons.items()},
        )

    def __hash__(self) -> int:
        return id(self)

    def is_common(self, word: str) -> bool:
        """Say whether a word is in many phrases."""
        return self.uses.get(word, 0) >= COMMON

    def rarity(self, word: str) -> float:
        """Say what a word costs for being seldom used."""
        rank = self.words.get(word, 0)
        return RANKED * rank + RARE / max(1, self.uses.get(word, COMMON if rank == 0 else 1))


def skeleton(word: str) -> str:
    """Drop the vowels but a leading one: "vehicle" -> vhcl; doubled letters count once."""
    return _undoubled(word[0] + word[1:].translate(_VOWELS))


def _undoubled(word: str) -> str:
    """Write doubled letters once."""
    return "".join(c for i, c in enumerate(word) if i == 0 or word[i - 1] != c)


def allowance(length: int) -> int:
    """Say how many errors a word of that many letters may have."""
    if length < 2:
        return 0
    return 1 if length < 6 else 2


@lru_cache(maxsize=8192)
def corrections(word: str, vocabulary: Vocabulary) -> tuple[Guess, ...]:
    """Guess what an unknown word was meant to be, likeliest first: words and cost."""
    known = vocabulary.words
    if len(word) > _LONG and known.get(word + "g") == 0:
        return (((word + "g",), ERROR / 2),)  # "stoppin"
    found = _near(word, vocabulary)
    if _is_short_of_vowels(word):
        fuller = vocabulary.skeletons.get(skeleton(word), ())
        found += [((full,), SLIP + vocabulary.rarity(full)) for full in fuller]
    found += _split(word, vocabulary)
    doubled = [entry for entry in found if _undoubled(entry[0][0]) == _undoubled(word)]
    if any(known.get(words[0]) == 0 for words, _ in doubled):
        return tuple(doubled)  # "stil" is "still" rather than "stall"
    found.sort(key=lambda entry: (entry[1], -Prefix.similarity(word, entry[0][0]), entry[0]))
    best: list[Guess] = []
    for guess, cost in found:
        if guess not in [other for other, _ in best]:
            best.append((guess, cost))
    return tuple(best[:GUESSES])


def _near(word: str, vocabulary: Vocabulary) -> list[Guess]:
    allowed = allowance(len(word))
    if allowed == 0 or not (word.isascii() and word.isalpha()):
        return []
    near = extract(
        word, vocabulary.by_length.get(len(word), ()), scorer=OSA.distance, score_cutoff=allowed,
        limit=None if len(word) < _LONG else _CANDIDATES,
    )  # fmt: skip
    found: list[Guess] = []
    for candidate, distance, _ in near:
        if len(word) <= 3 and not _is_likely_short(word, candidate, vocabulary):
            continue
        if distance > 1 and not _alike(word, candidate, vocabulary):
            continue
        first = SLIP if _is_slip(word, candidate) else ERROR
        cost = first + ERROR * (distance - 1) + vocabulary.rarity(candidate)
        swapped = sorted(word) == sorted(candidate)
        found.append(((candidate,), cost + (0.0 if swapped or word[0] == candidate[0] else 0.1)))
    return found


def _is_likely_short(word: str, candidate: str, vocabulary: Vocabulary) -> bool:
    """Say whether a word of two or three letters may be a slip for another."""
    if sorted(word) == sorted(candidate):
        return True
    if len(word) == 2:
        return vocabulary.is_common(candidate) and word[0] == candidate[0]
    if word[0] == candidate[0] and word[-1] == candidate[-1]:
        return len(candidate) > 2
    return vocabulary.is_common(candidate) and _is_slip(word, candidate)


def _is_slip(word: str, candidate: str) -> bool:
    """Say whether fingers slipped: letters swapped, a neighbouring key, a vowel left out."""
    if _undoubled(word) == _undoubled(candidate):
        return True
    if len(word) != len(candidate):
        return len(word) >= _LONG and skeleton(word) == skeleton(candidate)
    differ = [(a, b) for a, b in zip(word, candidate, strict=True) if a != b]
    return sorted(word) == sorted(candidate) or (len(differ) == 1 and _are_neighbours(*differ[0]))


def _are_neighbours(a: str, b: str) -> bool:
    """Say whether two letters are next to each other on a keyboard."""
    row, other = (next(r for r, keys in enumerate(_ROWS) if c in keys) for c in (a, b))
    apart = _ROWS[other].index(b) - _ROWS[row].index(a)
    return abs(apart) == 1 if row == other else abs(row - other) == 1 and apart in (0, row - other)


def _alike(word: str, candidate: str, vocabulary: Vocabulary) -> bool:
    """Say whether two errors may lie between words: they begin alike, consonants agree."""
    if word[0] != candidate[0] or vocabulary.words.get(candidate, 0) > 0:
        return False
    return OSA.distance(skeleton(word), skeleton(candidate)) <= (len(word) >= _LONGER)


def _is_short_of_vowels(word: str) -> bool:
    return len(word) > 1 and word.isalpha() and len(word.translate(_VOWELS)) >= len(word) - 1


def _split(word: str, vocabulary: Vocabulary) -> list[Guess]:
    """Cut a word in two that were run together; short ones have to be in many phrases."""
    found: list[Guess] = []
    for cut in range(1, len(word)):
        parts = (word[:cut], word[cut:])
        if any(vocabulary.words.get(part) != 0 for part in parts):
            continue
        common = [vocabulary.is_common(part) for part in parts]
        if len(word) >= _LONG and all(
            often or len(part) > 2 for often, part in zip(common, parts, strict=True)
        ):
            found.append((parts, RUN if all(common) else ERROR))
    return found
