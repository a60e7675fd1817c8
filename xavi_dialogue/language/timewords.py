"""Time words: the words of a text with its numbers read, and the phrases of time among them."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache

from xavi_dialogue.language.normalise import BREAK, Normalised, clean, is_clock, normalise
from xavi_dialogue.language.phrases import Automaton, Sense
from xavi_dialogue.language.wordlists import inflections, load
from xavi_dialogue.language.words import hear, is_number

NUMBER, TIME_OF_RIDE = "#", "#:"
MINUTE = 60.0  # [s]
MAX_SECONDS = 86400.0  # [s] what is longer is no time of a ride

_DECIMALS = re.compile(r"(?<![\d.])(\d+)[.](\d+)(?![\d.])")


@dataclass(frozen=True, slots=True)
class Piece:
    """A word; a number is written `NUMBER`, a time of the ride `TIME_OF_RIDE`."""

    word: str
    typed: str
    value: float = 0.0


@dataclass(frozen=True, slots=True)
class Mark:
    """A phrase of some kind at its place."""

    key: str
    end: int  # position of the word behind it
    value: float  # of the number in it


Marks = Sequence[Mapping[str, Mark]]  # by position and kind


@cache
def lists() -> dict[str, frozenset[str]]:
    """The sets of words that the patterns rest on."""
    return {name: frozenset(words.split()) for name, words in load("times.toml")["lists"].items()}


@cache
def _automaton() -> Automaton:
    automaton = Automaton(lambda verb: frozenset(inflections(verb)))
    for kind, values in load("times.toml").items():
        if kind.isupper():
            for value, phrases in values.items():
                for phrase in phrases:
                    automaton.add(phrase, Sense(kind, value))
    return automaton


def pieces_of(text: str) -> tuple[Piece, ...]:
    """The words of a text, spelling corrected, with its numbers and times of the ride."""
    cleaned = clean(text)
    decimals = {(int(a), int(b)): float(f"{a}.{b}") for a, b in _DECIMALS.findall(cleaned)}
    aliases = load("times.toml")["aliases"]
    meant = tuple(aliases.get(word, word) for word in normalise(text).words)
    words = hear(Normalised(meant), frozenset()).words
    pieces: list[Piece] = []
    position = 0
    while position < len(words):
        word = words[position]
        value = _value(word)
        glued = words[position + 1 : position + 2] == (BREAK,) and position + 2 < len(words)
        behind = _value(words[position + 2]) if glued else None
        pair = None if value is None or behind is None else (int(value), int(behind))
        if is_clock(word):
            minutes, _, seconds = word.partition(":")
            pieces.append(Piece(TIME_OF_RIDE, word, MINUTE * int(minutes) + int(seconds)))
        elif pair is not None and pair in decimals:
            pieces.append(Piece(NUMBER, word, decimals[pair]))
        else:
            pieces.append(Piece(word, word) if value is None else Piece(NUMBER, word, value))
        position += 3 if pair in decimals else 1
    return tuple(pieces)


def _value(word: str) -> float | None:
    return float(word) if is_number(word) and float(word) <= MAX_SECONDS else None


def marks_in(pieces: Sequence[Piece]) -> Marks:
    """The longest phrase of each kind, by the word that it begins at."""
    words = tuple(piece.word for piece in pieces)
    return [_marks_at(pieces, words, start) for start in range(len(words))]


def _marks_at(pieces: Sequence[Piece], words: tuple[str, ...], start: int) -> dict[str, Mark]:
    """The longest phrase of each kind that begins at a word."""
    found: dict[str, Mark] = {}
    for end, senses in _automaton().all_from(words, start):
        value = next((p.value for p in pieces[start:end] if p.word in (NUMBER, TIME_OF_RIDE)), 1.0)
        for sense in senses:
            found[sense.terminal] = Mark(sense.value, end, value)
    return found


def in_a_row(marks: Marks, start: int, *kinds: str) -> tuple[list[tuple[str, Mark]], int] | None:
    """Phrases of the given kinds in a row, each with its kind, and where they end.

    A kind may be one of several (`A|B`), or be left out (`A?`); then it is not among those found.
    """
    found: list[tuple[str, Mark]] = []
    for kind in kinds:
        here = marks[start] if start < len(marks) else {}
        known = [(name, here[name]) for name in kind.rstrip("?").split("|") if name in here]
        if known:
            best = max(known, key=lambda pair: pair[1].end)
            found.append(best)
            start = best[1].end
        elif not kind.endswith("?"):
            return None
    return found, start


def stands_alone(pieces: Sequence[Piece], end: int) -> bool:
    """Whether a phrase stands by itself: nothing follows that would be part of it."""
    if end >= len(pieces) or pieces[end].word == BREAK:
        return True
    return pieces[end].word in lists()["questions"] | lists()["auxiliaries"] | lists()["follows"]
