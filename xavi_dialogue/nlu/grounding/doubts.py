"""Doubts: what words without a sense do to the acts of a reading.

Decided by what such a word could have been: where the verb, the thing asked for or a main noun
should stand, nothing is left to answer; an adverb, adjective or aside leaves a doubt.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

from xavi_dialogue.domain.meaning import Reading, TokenShare

Words: TypeAlias = dict[int | None, tuple[str, ...]]  # by the act that they belong to
_SUBJECTS: Final = frozenset(
    ("i", "you", "we", "he", "she", "it", "they", "that", "this", "one", "who", "u", "everybody",
     "everyone", "somebody", "someone", "nobody", "anybody", "car", "driver", "us", "there"),
)  # fmt: skip
_AUXILIARIES: Final = frozenset(
    ("do", "does", "did", "will", "would", "can", "could", "should", "must", "may", "might",
     "have", "has", "had", "is", "are", "was", "were", "am", "shall", "to", "not", "n't",
     "gonna", "'re", "'s", "'ll", "'d"),
)  # fmt: skip
_DETERMINERS: Final = frozenset(("the", "a", "an", "any", "some", "our", "my", "your", "his", "no"))
_ASKING: Final = frozenset(("how", "what", "which", "whose"))
_PREPOSITIONS: Final = frozenset(
    ("with", "like", "for", "at", "in", "on", "by", "of", "from", "as", "about", "because",
     "despite", "during", "after", "before", "near", "under", "over", "through"),
)  # fmt: skip
_ASIDE: Final = frozenset(("politeness", "hedge", "address"))
#: How `TokenShare.part` begins for words that can be the predicate of a clause, and for nouns.
PREDICATES: Final = ("event", "action", "verb", "state", "relation", "attribute", "predicate")
NOUNS: Final = ("thing", "kind", "noun", "vehicle", "place")


@dataclass(frozen=True, slots=True)
class Doubts:
    """The unknown words of a reading, by the act that they belong to."""

    fatal: Words
    open: Words

    def kills(self, index: int, count: int) -> tuple[str, ...]:
        """List the words for which an act cannot be answered."""
        return self._of(self.fatal, index, count)

    def leaves(self, index: int, count: int) -> tuple[str, ...]:
        """List the words that an answer has to own up to."""
        return self._of(self.open, index, count)

    def _of(
        self, words: dict[int | None, tuple[str, ...]], index: int, count: int
    ) -> tuple[str, ...]:
        loose = words.get(None, ())
        own = words.get(index, ())
        return (*own, *loose) if index == count - 1 or count == 1 else own


def judge(reading: Reading) -> Doubts:
    """Judge each unknown word of a reading by its place."""
    kept = [s for s in reading.shares if s.share not in _ASIDE]
    fatal: Words = {}
    left: Words = {}
    for share in kept:
        if share.share == "unknown":
            clause = [s for s in kept if s.act in (None, share.act) or share.act is None]
            index = next(i for i, other in enumerate(clause) if other is share)
            found = fatal if _is_main(clause, index) else left
            found[share.act] = (*found.get(share.act, ()), share.text)
    return Doubts(fatal, left)


def _is_main(shares: Sequence[TokenShare], index: int) -> bool:
    word = shares[index].read
    before = [s.read for s in shares[:index]]
    behind = shares[index + 1 :]
    last = before[-1] if before else ""
    if word.endswith("ly") or (behind and behind[0].share == "unknown" and len(behind) > 1):
        return False
    if last in _ASKING:
        return not (behind and _is(behind[0], (*PREDICATES, *NOUNS)))
    if last in _DETERMINERS:
        if behind and _is(behind[0], NOUNS):
            return False
        return len(before) < 2 or before[-2] not in _PREPOSITIONS
    subject = last in _SUBJECTS or (bool(before) and _is(shares[index - 1], NOUNS))
    if last in _AUXILIARIES or (subject and any(b in _AUXILIARIES for b in before)):
        return not any(_is(s, PREDICATES) for s in behind)
    return not any(_is(s, PREDICATES) for s in (*shares[:index], *behind))


def _is(share: TokenShare, sorts: tuple[str, ...]) -> bool:
    return share.share == "meaning" and share.part.lower().startswith(sorts)


def glosses(reading: Reading) -> tuple[str, ...]:
    """List the words of a reading that were understood."""
    return tuple(share.read for share in reading.shares if share.share == "meaning")
