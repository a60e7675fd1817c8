"""Quotation: the passenger's own words of which nothing was made, to be named in the reply."""

from collections.abc import Sequence
from itertools import groupby
from typing import Final

from xavi_dialogue.domain.answers import NotUnderstood
from xavi_dialogue.domain.meaning import Reading, TokenShare, Unread
from xavi_dialogue.nlu.grounding.doubts import SMALL

LONGEST: Final = 4  # words that are quoted
#: How `TokenShare.part` begins for words of time, courtesy and hedging, which tell nothing.
_IDLE: Final = ("timeadv:", "focus:", "again:", "adv:", "filler:", "please:", "hedge:", "interj:",
                "abs:time", "abs:prediction")  # fmt: skip
_ASKING: Final = frozenset(("what", "who", "whom", "whose", "which", "where", "when", "why", "how"))
_LITTLE: Final = (_ASKING | SMALL - {"car", "driver"}) | frozenset(
    ("and", "but", "so", "or", "cos", "then", "well", "oh", "now", "just", "also", "if", "please",
     "dear", "ok", "okay", "again", "finally", "still", "even", "time", "times", "r", "be", "been",
     "too", "very", "really", "only", "its", "their", "these", "those", "than", "while"),
)  # fmt: skip


def words_of(reading: Reading, index: int) -> str:
    """Quote an act; "" where it is all that was said."""
    own = [share for share in reading.shares if share.act == index]
    return "" if len(own) == len(reading.shares) else _quote(own)


def phrases(reading: Reading, index: int, words: Sequence[str]) -> tuple[str, ...]:
    """Quote words of an act, those that stand together as one; without those that tell nothing.

    Words in no vocabulary that belong to no act may be quoted with any.
    """
    own = [s for s in reading.shares if s.act == index or (s.act is None and s.strange)]
    runs = groupby(own, lambda share: share.text in words)
    found = (_quote([one for one in run if _bears(one)]) for lost, run in runs if lost)
    return tuple(dict.fromkeys(one for one in found if one))


def missed(reading: Reading, index: int, fatal: Sequence[str]) -> NotUnderstood:
    """Tell what was not understood of an act: the words without a sense, or all of it."""
    own = [share for share in reading.shares if share.act == index]
    lost = [rank for rank, share in enumerate(own) if share.text in fatal]
    quoted = own[lost[0] : lost[-1] + 1] if lost else own
    whole = len(quoted) == len(reading.shares)
    strange = tuple(dict.fromkeys(share.text for share in own if share.strange))
    return NotUnderstood(words=strange, quote="" if whole else _quote(quoted))


def unread(reading: Reading, stretch: Unread) -> NotUnderstood:
    """Tell that nothing was made of a stretch of the text."""
    strange = tuple(word for word in stretch.words if word in reading.strange)
    whole = len(stretch.words) == len(reading.shares)
    shares = {share.text: share for share in reading.shares}
    quoted = [shares.get(word, TokenShare(word, word, "unknown")) for word in stretch.words]
    return NotUnderstood(words=strange, quote="" if whole else _quote(quoted))


def _quote(said: Sequence[TokenShare]) -> str:
    """Give the words that bear content; what asks, all of it; "" where nothing is told."""
    words = [share.text for share in said if _bears(share)]
    if not words and any(share.text in _ASKING for share in said):
        words = [share.text for share in said]
    return " ".join(words[:LONGEST]) + (" ..." if len(words) > LONGEST else "")


def _bears(share: TokenShare) -> bool:
    """Say whether a word bears content that can be missed."""
    if share.strange or share.share == "idle":
        return True
    idle = share.share in ("politeness", "hedge", "address") or share.part.startswith(_IDLE)
    return not idle and share.text not in _LITTLE
