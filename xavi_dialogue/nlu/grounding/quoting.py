"""Quotation: the passenger's own words of which nothing was made, to be named in the reply."""

from collections.abc import Sequence
from typing import Final

from xavi_dialogue.domain.answers import NotUnderstood
from xavi_dialogue.domain.meaning import Reading, Unread

LONGEST: Final = 7  # words that are quoted
_LEADING: Final = frozenset(
    ("and", "but", "so", "or", "because", "cos", "then", "well", "oh", "now", "just", "also", "if",
     "please", "dear", "ok", "okay", "right"),
)  # fmt: skip


def words_of(reading: Reading, index: int) -> str:
    """Quote an act; "" where it is all that was said."""
    own = [share.text for share in reading.shares if share.act == index]
    return "" if len(own) == len(reading.shares) else _quote(own)


def phrases(reading: Reading, index: int, words: Sequence[str]) -> tuple[str, ...]:
    """Quote words of an act with those around them that go with them; strange ones alone."""
    own = [share for share in reading.shares if share.act == index]
    found: list[str] = []
    end = -1
    for rank, share in enumerate(own):
        if share.text not in words or rank <= end:
            continue
        begin = end = rank
        while begin and own[begin - 1].share == "grammar" and not share.strange:
            begin -= 1
        while end + 1 < len(own) and own[end + 1].text in words:
            end += 1
        found.append(" ".join(one.text for one in own[begin : end + 1][:LONGEST]))
    return tuple(dict.fromkeys(found))


def missed(reading: Reading, index: int, fatal: Sequence[str]) -> NotUnderstood:
    """Tell what was not understood of an act: the words without a sense, or all of it."""
    own = [share for share in reading.shares if share.act == index]
    lost = [rank for rank, share in enumerate(own) if share.text in fatal]
    quoted = own[lost[0] : lost[-1] + 1] if lost else own
    if len(quoted) > LONGEST and lost:
        quoted = [own[rank] for rank in lost]
    whole = len(quoted) == len(reading.shares)
    strange = tuple(dict.fromkeys(share.text for share in own if share.strange))
    quote = "" if whole else _quote([share.text for share in quoted])
    return NotUnderstood(words=strange, quote=quote)


def unread(reading: Reading, stretch: Unread) -> NotUnderstood:
    """Tell that nothing was made of a stretch of the text."""
    strange = tuple(word for word in stretch.words if word in reading.strange)
    whole = len(stretch.words) == len(reading.shares)
    return NotUnderstood(words=strange, quote="" if whole else _quote(stretch.words))


def _quote(words: Sequence[str]) -> str:
    """Give words as a quotation, without what leads in, and cut short where they are many."""
    kept = list(words)
    while len(kept) > 1 and kept[0] in _LEADING:
        kept.pop(0)
    return " ".join(kept[:LONGEST]) + (" ..." if len(kept) > LONGEST else "")
