"""Spelling: a word that is none -> the words that may have been meant, each at a cost.

A word that is known is never touched here. Distances are optimal string alignment, in which one
transposition of neighbours is one error.
"""

from dataclasses import dataclass, field
from functools import lru_cache

from rapidfuzz.distance import OSA, Prefix
from rapidfuzz.process import extract

ERROR = 0.35  # cost of one error
RANKED = 0.12  # cost of a word that is English and no more
GUESSES = 3  # words offered for one that is none
_CANDIDATES = 16
_VOWELS = str.maketrans("", "", "aeiou")
_LONG = 4


@dataclass(frozen=True)
class Vocabulary:
    """Every word there is, with a rank.

    0 means something here, 1 is English and no more, 2 is too rare to have been misspelt.
    """

    words: dict[str, int]
    by_length: dict[int, tuple[str, ...]] = field(default_factory=dict)
    skeletons: dict[str, tuple[str, ...]] = field(default_factory=dict)

    @staticmethod
    def of(words: dict[str, int]) -> "Vocabulary":
        """Index the words by length and by consonants."""
        lengths: dict[int, list[str]] = {}
        skeletons: dict[str, list[str]] = {}
        for word in sorted(words):
            if words[word] > 1 or not (word.isascii() and word.isalpha() and len(word) > 1):
                continue
            for length in range(len(word) - 2, len(word) + 3):
                lengths.setdefault(length, []).append(word)
            if words[word] == 0 and len(word) > 2:
                skeletons.setdefault(skeleton(word), []).append(word)
        return Vocabulary(
            words,
            {length: tuple(found) for length, found in lengths.items()},
            {key: tuple(found) for key, found in skeletons.items()},
        )

    def __hash__(self) -> int:
        return id(self)


def skeleton(word: str) -> str:
    """Drop the vowels but a leading one: "vehicle" -> vhcl; doubled letters count once."""
    return _undoubled(word[0] + word[1:].translate(_VOWELS))


def _undoubled(word: str) -> str:
    """Write doubled letters once."""
    return "".join(c for i, c in enumerate(word) if i == 0 or word[i - 1] != c)


def allowance(length: int) -> int:
    """Say how many errors a word of that many letters may have."""
    if length < 3:
        return 0
    return 1 if length < 6 else 2


@lru_cache(maxsize=8192)
def corrections(word: str, vocabulary: Vocabulary) -> tuple[tuple[tuple[str, ...], float], ...]:
    """Guess what an unknown word was meant to be, likeliest first: words and cost."""
    known = vocabulary.words
    if len(word) > _LONG and known.get(word + "g") == 0:
        return (((word + "g",), ERROR / 2),)  # "stoppin"
    found = _near(word, vocabulary)
    if _is_short_of_vowels(word):
        found += [((full,), ERROR) for full in vocabulary.skeletons.get(skeleton(word), ())]
    if len(word) > _LONG and (parts := _split(word, vocabulary)):
        found.append((parts, ERROR))
    doubled = [entry for entry in found if _undoubled(entry[0][0]) == _undoubled(word)]
    if any(known[words[0]] == 0 for words, _ in doubled):
        return tuple(doubled)  # "stil" is "still" rather than "stall"
    found.sort(key=lambda entry: (entry[1], -Prefix.similarity(word, entry[0][0]), entry[0]))
    best: list[tuple[tuple[str, ...], float]] = []
    for guess, cost in found:
        if guess not in [other for other, _ in best]:
            best.append((guess, cost))
    return tuple(best[:GUESSES])


def _near(word: str, vocabulary: Vocabulary) -> list[tuple[tuple[str, ...], float]]:
    allowed = allowance(len(word))
    if allowed == 0 or not (word.isascii() and word.isalpha()):
        return []
    near = extract(
        word, vocabulary.by_length.get(len(word), ()), scorer=OSA.distance, score_cutoff=allowed,
        limit=_CANDIDATES,
    )  # fmt: skip
    found: list[tuple[tuple[str, ...], float]] = []
    for candidate, distance, _ in near:
        swapped = sorted(word) == sorted(candidate)
        if len(word) <= 3 and not swapped and not _same_ends(word, candidate):
            continue
        if distance > 1 and not _alike(word, candidate, vocabulary):
            continue
        cost = ERROR * distance + RANKED * vocabulary.words[candidate] - (0.1 if swapped else 0.0)
        found.append(((candidate,), cost + (0.0 if word[0] == candidate[0] else 0.1)))
    return found


def _alike(word: str, candidate: str, vocabulary: Vocabulary) -> bool:
    """Say whether two errors may lie between words: they begin alike, consonants agree."""
    if word[0] != candidate[0] or vocabulary.words[candidate] > 0:
        return False
    return OSA.distance(skeleton(word), skeleton(candidate), score_cutoff=1) <= 1


def _same_ends(word: str, candidate: str) -> bool:
    return word[0] == candidate[0] and word[-1] == candidate[-1] and len(candidate) > 2


def _is_short_of_vowels(word: str) -> bool:
    return len(word) > 1 and word.isalpha() and len(word.translate(_VOWELS)) >= len(word) - 1


def _split(word: str, vocabulary: Vocabulary) -> tuple[str, ...] | None:
    known = vocabulary.words
    for cut in range(2, len(word) - 1):
        parts = (word[:cut], word[cut:])
        if all(known.get(part, 9) == 0 and (len(part) > 2 or part in _TINY) for part in parts):
            return parts
    return None


_TINY = frozenset({"to", "in", "on", "at", "it", "we", "us", "he", "is", "do", "go", "of", "my"})
