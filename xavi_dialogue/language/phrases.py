"""Phrases: the notation of the word lists, and one automaton that finds them all.

Errors::

    PhraseError   a phrase breaks the notation; says where

Notation: words in a row; `a|b` one of several words; `(a b|c)` one of several phrases; `?` after
a word or bracket: may be left out; `+`: may be repeated; `~x`: any inflection of the verb x.
The automaton is Glushkov's: one position per word of a phrase, with the positions that may
follow it (V. M. Glushkov, 1961). Sets of positions are made into states as they are met.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

_SYMBOLS = re.compile(r"[()?+]|[^\s()?+]+")
_BARE = re.compile(r"\S*\|\S*")
_BRACKETS = re.compile(r"\([^()]*\)")  # innermost


class PhraseError(ValueError):
    """A phrase breaks the notation."""


class Sense(NamedTuple):
    """What a phrase stands for: a terminal of the grammar, with a value."""

    terminal: str
    value: str


class _Part(NamedTuple):
    """A piece of a phrase: can it be empty, where can it begin and end."""

    nullable: bool
    first: frozenset[int]
    last: frozenset[int]


_EMPTY = _Part(True, frozenset(), frozenset())
_State = frozenset[int]
_NOWHERE: _State = frozenset()


@dataclass(slots=True)
class Automaton:
    """Finds the phrases that begin at a word; earlier phrases win ties."""

    expand: Callable[[str], frozenset[str]]  # the forms of a word written ~word
    accepts: list[frozenset[str]] = field(default_factory=list)  # words by position
    follow: list[set[int]] = field(default_factory=list)
    ends: dict[int, tuple[int, Sense]] = field(default_factory=dict)  # position -> phrase, sense
    first: dict[str, set[int]] = field(default_factory=dict)
    _steps: dict[tuple[_State, str], _State] = field(default_factory=dict)
    _senses: dict[_State, tuple[Sense, ...]] = field(default_factory=dict)
    _phrases: int = 0

    def add(self, phrase: str, sense: Sense) -> frozenset[str]:
        """Add a phrase; returns its words.

        Raises:
            PhraseError: unbalanced brackets, an empty word, a phrase that may be empty, or one
            in which it is unclear what a bar separates.
        """
        outside = phrase
        while (shorter := _BRACKETS.sub("", outside)) != outside:
            outside = shorter
        if len(_BARE.findall(outside)) > 1:
            raise PhraseError("two words with '|' outside brackets: bracket one of them")
        start = len(self.accepts)
        part, rest = self._sequence(_SYMBOLS.findall(phrase), nested=False)
        if rest or part.nullable:
            raise PhraseError(f"{phrase!r}: " + ("stray ')'" if rest else "may match nothing"))
        for position in part.last:
            self.ends[position] = (self._phrases, sense)
        for position in part.first:
            for word in self.accepts[position]:
                self.first.setdefault(word, set()).add(position)
        self._phrases += 1
        return frozenset().union(*self.accepts[start:])

    def all_from(self, words: tuple[str, ...], start: int) -> list[tuple[int, tuple[Sense, ...]]]:
        """Every phrase that begins at `start`, the shortest first: (where it ends, its senses)."""
        state = frozenset(self.first.get(words[start], ()))
        found: list[tuple[int, tuple[Sense, ...]]] = []
        position = start + 1
        while state:
            if senses := self._senses_at(state):
                found.append((position, senses))
            if position == len(words):
                break
            state = self._step(state, words[position])
            position += 1
        return found

    def _step(self, state: _State, word: str) -> _State:
        key = (state, word)
        if key not in self._steps:
            reached = {n for p in state for n in self.follow[p] if word in self.accepts[n]}
            if not reached:
                return _NOWHERE  # not kept: there are more unknown words than memory
            self._steps[key] = frozenset(reached)
        return self._steps[key]

    def _senses_at(self, state: _State) -> tuple[Sense, ...]:
        """What phrases end here mean: one sense for each terminal."""
        if state not in self._senses:
            senses: dict[str, Sense] = {}
            for _, sense in sorted(self.ends[p] for p in state if p in self.ends):
                senses.setdefault(sense.terminal, sense)
            self._senses[state] = tuple(senses.values())
        return self._senses[state]

    def _sequence(self, symbols: list[str], *, nested: bool) -> tuple[_Part, list[str]]:
        """Read up to the end, or to the bracket that closes this sequence."""
        alternatives: list[_Part] = []
        current = _EMPTY
        while symbols:
            symbol, *symbols = symbols
            if symbol == ")":
                if not nested:
                    return current, [")"]
                return self._either([*alternatives, current]), symbols
            if symbol in "?+":
                raise PhraseError(f"{symbol!r} follows nothing")
            if nested and "|" in symbol:
                pieces = symbol.split("|")
                for index, piece in enumerate(pieces):
                    if index:
                        alternatives.append(current)
                        current = _EMPTY
                    if piece:
                        last = index == len(pieces) - 1
                        part = self._word([piece])
                        part, symbols = self._marked(part, symbols) if last else (part, symbols)
                        current = self._then(current, part)
                continue
            if symbol == "(":
                part, symbols = self._sequence(symbols, nested=True)
            else:
                part = self._word(symbol.split("|"))
            part, symbols = self._marked(part, symbols)
            current = self._then(current, part)
        if nested:
            raise PhraseError("'(' is not closed")
        return current, []

    def _marked(self, part: _Part, symbols: list[str]) -> tuple[_Part, list[str]]:
        while symbols and symbols[0] in "?+":
            if symbols[0] == "+":
                for position in part.last:
                    self.follow[position] |= part.first
            else:
                part = part._replace(nullable=True)
            symbols = symbols[1:]
        return part, symbols

    def _word(self, alternatives: list[str]) -> _Part:
        if not all(alternatives):
            raise PhraseError(f"empty word in {'|'.join(alternatives)!r}")
        words: set[str] = set()
        for word in alternatives:
            words |= self.expand(word[1:]) if word.startswith("~") else {word}
        self.accepts.append(frozenset(words))
        self.follow.append(set())
        here = frozenset({len(self.accepts) - 1})
        return _Part(False, here, here)

    def _then(self, one: _Part, two: _Part) -> _Part:
        for position in one.last:
            self.follow[position] |= two.first
        return _Part(
            one.nullable and two.nullable,
            one.first | two.first if one.nullable else one.first,
            one.last | two.last if two.nullable else two.last,
        )

    @staticmethod
    def _either(parts: list[_Part]) -> _Part:
        return _Part(
            any(p.nullable for p in parts),
            frozenset().union(*(p.first for p in parts)),
            frozenset().union(*(p.last for p in parts)),
        )
