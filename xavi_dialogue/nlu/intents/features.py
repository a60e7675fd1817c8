"""Features of a text: its words, their neighbours, and what the grammar made of it.

The part that asks counts once more by itself, so that what is stated beside it does not drown it.
"""

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Final

from xavi_dialogue.domain.meaning import Reading, TokenShare
from xavi_dialogue.nlu.intents.signature import signature
from xavi_dialogue.nlu.joining.sentences import sentences
from xavi_dialogue.nlu.text.tokens import tokenise

ENDING: Final = 4  # words at the end that count once more
BEGINNING: Final = 3  # words at the start of what is asked, taken together
SHORT: Final = 3  # words
STEP: Final = 0.5  # of cost
STEPS: Final = 5
_VEHICLES: Final = frozenset(("kind", "colour", "numbered"))
_FIGURES: Final = frozenset(("num", "clock"))
_VERBS: Final = frozenset(("v", "ving", "ved", "vpast"))
_OPENERS: Final = frozenset(
    ("why", "what", "how", "who", "which", "where", "when", "whose", "is", "are", "was", "were",
     "do", "does", "did", "will", "would", "can", "could", "should", "have", "has", "had", "so"),
)  # fmt: skip
_START, _END, _VEHICLE, _FIGURE = "<", ">", "VEHICLE", "NUMBER"


def features(text: str, reading: Reading) -> frozenset[str]:
    """List the features of a text, with the grammar's best reading of it."""
    words = _words(reading.shares)
    asked = _words(asking(text, reading.shares))
    found = {f"typed:{word}" for word in re.findall(r"[a-z']+", text.lower())}
    found |= {mark for mark in "?!" if mark in text}
    found |= {f"word:{word}" for word in words}
    found |= {f"end:{word}" for word in words[-ENDING:]}
    found |= set(_pairs("", words)) | set(_around(words))
    found |= {f"asked:{word}" for word in asked} | set(_pairs("asked ", asked))
    found |= {f"begin:{' '.join(asked[:length])}" for length in range(1, BEGINNING + 1)}
    if len(words) <= SHORT:
        found.add("short")
    return frozenset(found | set(_grammatical(reading)))


def asking(text: str, shares: Sequence[TokenShare]) -> Sequence[TokenShare]:
    """Give the words of the sentences that ask; of a text without a mark, the last clause's."""
    rows: list[tuple[str, Sequence[TokenShare]]] = []
    at = 0
    for sentence in sentences(tokenise(text)):
        size = len(sentence.tokens)
        rows.append((sentence.end, shares[at : at + size]))
        at += size
    asked = [share for end, row in rows if end == "?" for share in row]
    if asked or not rows:
        return asked
    last = rows[-1][1]
    starts = [k for k, share in enumerate(last) if share.read.partition(" ")[0] in _OPENERS]
    return last[starts[-1] :] if starts else last


def _words(shares: Sequence[TokenShare]) -> list[str]:
    """List the words as read: verbs by their lemma, a vehicle's colour and kind as one."""
    found: list[str] = []
    before: tuple[str, str] | None = None
    for share in shares:
        if (share.read, share.part) == before and " " in share.read:
            continue  # a phrase of several words stands once
        before = (share.read, share.part)
        for word in _senses(share):
            if word != _VEHICLE or found[-1:] != [_VEHICLE]:
                found.append(word)
    return found


def _senses(share: TokenShare) -> list[str]:
    sort, _, key = share.part.partition(":")
    if sort in _VEHICLES:
        return [_VEHICLE]
    if sort in _FIGURES or share.text[:1].isdigit():
        return [_FIGURE]
    if sort in _VERBS and " " not in share.part:
        return [key]
    return (share.read or share.text).lower().split()


def _pairs(sort: str, words: Sequence[str]) -> Iterator[str]:
    for one, two in pairwise((_START, *words, _END)):
        yield f"{sort}pair:{one} {two}"


def _around(words: Sequence[str]) -> Iterator[str]:
    row = (_START, *words, _END)
    for one, two in zip(row, row[2:], strict=False):
        yield f"around:{one} {two}"


def _grammatical(reading: Reading) -> Iterator[str]:
    for act in reading.acts:
        yield from shape(signature(act))
    if reading.unread:
        yield "unread"
    if reading.unknown:
        yield "unknown"
    steps = int(reading.cost / (STEP * max(1, len(reading.acts))))
    yield f"cost:{min(STEPS, steps)}"
    yield f"acts:{len(reading.acts)}"


def shape(words: str) -> Iterator[str]:
    """List the features of the signature of an act: each beginning of it, and the whole."""
    row = words.split()
    for length in range(1, len(row) + 1):
        yield f"act:{' '.join(row[:length])}"
    yield f"all:{words}"
