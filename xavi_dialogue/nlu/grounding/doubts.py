"""Doubts: what words without a sense do to the acts of a reading.

Decided by what such a word could have been: with an adverb, an adjective before a noun or the noun
of a place, the rest is answered; with any other word, nothing is left to answer. The answer owns up
to a word that is in no vocabulary, and to a named place that makes no difference.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

from xavi_dialogue.domain.meaning import Beyond, Reading, TokenShare

EXCLAMATION: Final = 3  # words, at most

Words: TypeAlias = dict[int | None, tuple[str, ...]]  # by the act that they belong to
_SUBJECTS: Final = frozenset(
    ("i", "you", "we", "he", "she", "it", "they", "that", "this", "one", "who", "u", "everybody",
     "everyone", "somebody", "someone", "nobody", "anybody", "car", "driver", "us", "there",
     "me", "him", "her", "them", "itself", "himself", "herself", "themselves", "myself",
     "yourself", "ourselves"),
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
SMALL: Final = _SUBJECTS | _AUXILIARIES | _DETERMINERS | _PREPOSITIONS
_ASIDE: Final = frozenset(("politeness", "hedge", "address"))
#: How `TokenShare.part` begins for words that can be the predicate of a clause, and for nouns.
PREDICATES: Final = ("event", "action", "verb", "state", "relation", "attribute", "predicate",
                     "v:", "vpast:", "ved:", "ving:", "adj:", "meas:", "evn:", "abs:")  # fmt: skip
NOUNS: Final = ("thing", "kind", "noun", "vehicle", "place", "numbered:", "ride:")
_NOMINAL: Final = (*NOUNS, "colour:", "size:")


@dataclass(frozen=True, slots=True)
class Doubts:
    """The words without a part in the acts of a reading, by the act that they belong to."""

    fatal: Words
    open: Words

    def kills(self, index: int) -> tuple[str, ...]:
        """List the words for which an act cannot be answered."""
        return self.fatal.get(index, ())

    def leaves(self, index: int) -> tuple[str, ...]:
        """List the words that an answer has to own up to."""
        return self.open.get(index, ())


def judge(reading: Reading) -> Doubts:
    """Judge each unknown word of a reading by its place."""
    kept = [s for s in reading.shares if s.share not in _ASIDE]
    fatal: Words = {}
    left: Words = {}
    if reading.acts and (strange := (*_in_asides(reading), *_nowhere(reading))):
        left[len(reading.acts) - 1] = strange
    for share in kept:
        small = not share.strange and share.read in SMALL
        if share.share == "idle":
            left[share.act] = (*left.get(share.act, ()), share.text)
        elif share.share == "unknown" and share.act is not None and not small:
            clause = [s for s in kept if s.act in (None, share.act)]
            index = next(i for i, other in enumerate(clause) if other is share)
            if _is_main(clause, index):
                fatal[share.act] = (*fatal.get(share.act, ()), share.text)
            elif share.strange:
                left[share.act] = (*left.get(share.act, ()), share.text)
    return Doubts(fatal, left)


def _in_asides(reading: Reading) -> tuple[str, ...]:
    """List the words in no vocabulary of asides that are more than an exclamation."""
    asides = (unread.words for unread in reading.unread if not unread.asks)
    words = [word for aside in asides if len(aside) > EXCLAMATION for word in aside]
    return tuple(word for word in words if word in reading.strange)


def _nowhere(reading: Reading) -> tuple[str, ...]:
    """List the words in no vocabulary that belong to no act and no aside."""
    if any(isinstance(act, Beyond) for act in reading.acts):
        return ()  # such as another language
    aside = {word for one in reading.unread for word in one.words}
    lost = (s for s in reading.shares if s.strange and s.act is None and s.share == "unknown")
    return tuple(share.text for share in lost if share.text not in aside)


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
        if behind and _is(behind[0], _NOMINAL):
            return False
        return len(before) < 2 or before[-2] not in _PREPOSITIONS
    subject = last in _SUBJECTS or (bool(before) and _is(shares[index - 1], NOUNS))
    if last in _AUXILIARIES or (subject and any(b in _AUXILIARIES for b in before)):
        return not any(_is(s, PREDICATES) for s in behind)
    return not (behind and _is(behind[0], _NOMINAL))


def _is(share: TokenShare, sorts: tuple[str, ...]) -> bool:
    return share.share == "meaning" and share.part.lower().startswith(sorts)
