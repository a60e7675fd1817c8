"""Joining: the sentences of several results as one short reply without repetition. Pure."""

import re
from collections.abc import Sequence
from typing import Final

from xavi_dialogue.nlg.context import Utterance

AT_MOST: Final = 3  # maximum of sentences of a reply to several acts
_CLAUSES: Final = re.compile(r"(: |; |, because |, though |, so )")
_MARKS: Final = re.compile(r"[().!?]")
_WORDS: Final = re.compile(r"\d+(?:[.:]\d+)?|[^\W\d_]+")
_ASIDE: Final = re.compile(r"\((?:vehicle )?\d+\)")
#: Words that carry no information by themselves.
_SMALL: Final = frozenset(
    ("yes", "actually", "that", "is", "was", "am", "are", "were", "be", "been", "you",
     "i", "we", "us", "our", "it", "its", "the", "a", "an", "this", "and", "or", "to", "of", "at",
     "in", "on", "for", "by", "will", "would", "has", "had", "have", "do", "did", "does", "put",
     "chance", "expect", "expected", "almost", "certainly", "probably", "because", "now", "just",
     "thought", "think", "may", "might", "well", "as", "so"),
)  # fmt: skip
#: Phrases in which "right" is not a side.
_NO_SIDE: Final = re.compile(r"\b(?:that is|you are) right\b|\bright(?= of way)")
#: Endings of verb forms.
_ENDINGS: Final = re.compile(r"(?:ing|ed|es|s|e)$")


def joined(utterances: Sequence[Utterance]) -> Utterance:
    """Join the sentences of several results, without those that were said before.

    Several results get `AT_MOST` sentences together, or one each if there are more results.
    """
    rows: list[tuple[str, ...]] = []
    known: set[str] = set()
    for one in utterances:
        row = tuple(dict.fromkeys(map(_once, sentences(one.text))))
        if not one.choices:
            row = tuple(new for said in row if (new := _new(said, known)))
        known.update(*map(_gist, row))
        rows.append(row)
    told = [said for row in _short(rows, utterances) for said in row]
    return Utterance(
        text=" ".join(told),
        mentioned=tuple(dict.fromkeys(v for one in utterances for v in one.mentioned)),
        choices=next((one.choices for one in utterances if one.choices), ()),
        suggestions=tuple(dict.fromkeys(s for one in utterances for s in one.suggestions)),
    )


def _once(sentence: str) -> str:
    """Return a sentence without a last clause that repeats the clause before it."""
    pieces = _CLAUSES.split(sentence.rstrip("."))
    if len(pieces) < 3 or pieces[-2] not in (": ", "; "):
        return sentence
    before, last = _gist(pieces[-3]), _gist(pieces[-1])
    return (
        "".join(pieces[:-2]) + "." if last and last <= before and "not" not in before else sentence
    )


def _new(sentence: str, known: set[str]) -> str:
    """Return a sentence without final clauses that repeat earlier ones; "" if all of it repeats."""
    pieces = _CLAUSES.split(sentence.rstrip("."))
    if not known or _gist(sentence) - {"no"} <= known:
        return "" if known else sentence
    kept = len(pieces)
    while kept > 1 and (gist := _gist(pieces[kept - 1])) and gist <= known:
        kept -= 2
    return sentence if kept == len(pieces) else "".join(pieces[:kept]) + "."


def _gist(text: str) -> set[str]:
    """Collect the words of a text that carry information, without their endings."""
    words = _WORDS.findall(_NO_SIDE.sub(" ", _ASIDE.sub(" ", text).casefold()))
    return {_ENDINGS.sub("", word) for word in words if word not in _SMALL}


def _short(
    rows: Sequence[tuple[str, ...]], utterances: Sequence[Utterance]
) -> list[tuple[str, ...]]:
    """Shorten the sentences of several results to the limit; choices stay whole."""
    if len(rows) < 2:
        return list(rows)
    spare = max(AT_MOST - sum(bool(row) for row in rows), 0)
    found: list[tuple[str, ...]] = []
    for row, one in zip(rows, utterances, strict=True):
        length = len(row) if one.choices else min(len(row), 1 + spare)
        spare = max(spare - max(length - 1, 0), 0)
        found.append(row[:length])
    return found


def sentences(text: str) -> tuple[str, ...]:
    """Split a text into sentences; a choice in brackets is not a sentence of its own."""
    found: list[str] = []
    begin = depth = 0
    for mark in _MARKS.finditer(text):
        depth += {"(": 1, ")": -1}.get(mark[0], 0)
        if mark[0] in ".!?" and depth == 0 and text[mark.end() : mark.end() + 1] in (" ", ""):
            found.append(text[begin : mark.end()].strip())
            begin = mark.end()
    rest = text[begin:].strip()
    return tuple(one for one in (*found, rest) if one)
