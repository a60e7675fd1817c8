"""Rules: the grammar files as automata, one for each phrase.

lark reads and checks the files and spells out what is optional or repeated; the alternatives of
a phrase are laid into one automaton, shared beginnings merged. A rule's priority is its cost in
hundredths, negative priorities cost more. Direct left recursion becomes a loop.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib import resources
from typing import TypeAlias

import lark
from lark.grammar import Rule, Symbol

GRAMMAR_FILES = ("nlu_phrases.lark", "nlu_clauses.lark")
STEP = 0.01  # cost of one point of negative priority


Word: TypeAlias = tuple[int, str, int, float, int]
"""An edge to a word: bit of its class, its class, the next state, its cost, and the marks of what
must come behind it."""
Inner: TypeAlias = tuple[int, int, int, float, int, int]
"""An edge to a phrase: bits of the word classes that it may begin with, its number, the next
state, its cost, the marks of what must come behind it, and of what must come in or behind it."""
Edges: TypeAlias = tuple[tuple[Word, ...], tuple[Inner, ...]]
_REMEMBERED = 512  # sets of word classes for which a state keeps its edges


@dataclass(slots=True)
class State:
    """A state of an automaton: where symbols lead, and what is complete here."""

    terminals: list[Word] = field(default_factory=list)
    phrases: list[Inner] = field(default_factory=list)
    complete: list[tuple[str, float]] = field(default_factory=list)  # name of rule, cost
    needed: int = 0  # marks of what must still come
    following: int = 0  # bits of the word classes with which it can go on
    known: dict[int, Edges] = field(default_factory=dict)

    def edges(self, mask: int) -> Edges:
        """List the edges, to words and to phrases, that can be taken where some words stand.

        Args:
            mask: bits of the classes of these words, none outside `following`.
        """
        if len(self.known) >= _REMEMBERED:
            self.known.clear()
        found = self.known[mask] = (
            tuple(edge for edge in self.terminals if edge[0] & mask),
            tuple(edge for edge in self.phrases if edge[0] & mask),
        )
        return found


@dataclass(slots=True)
class Phrase:
    """A phrase of the grammar: its automaton, and the word classes at its ends."""

    name: str
    states: list[State]
    first: int = 0  # bits of word classes
    last: int = 0  # bits of the word classes that it can end with
    needed: int = 0  # marks of what must stand in it
    single: bool = False  # it always consists of one part


@dataclass(frozen=True, slots=True)
class Grammar:
    """All phrases, by number.

    `bits` gives each word class its bit, `marks` its bit and those of the groups that it is in:
    a group is what some phrase can begin or end with, so each such phrase needs one of it.
    """

    phrases: tuple[Phrase, ...]
    number: dict[str, int]
    bits: dict[str, int]
    marks: dict[str, int]


@cache
def grammar() -> Grammar:
    """Read the grammar files and build their automata."""
    text = "\n".join(
        resources.files("grammars").joinpath(name).read_text(encoding="utf-8")
        for name in GRAMMAR_FILES
    )
    built = lark.Lark(text, parser=None, lexer="basic", start=["utterance"])  # for its rules
    by_name: dict[str, list[Rule]] = {}
    for rule in built.rules:
        by_name.setdefault(str(rule.origin.name), []).append(rule)
    number = {name: index for index, name in enumerate(by_name)}
    terminals = sorted({str(s.name) for r in built.rules for s in r.expansion if s.is_term})
    bits = {name: 1 << index for index, name in enumerate(terminals)}
    builder = _Builder(number, bits, _choices(by_name))
    phrases = tuple(builder.phrase(name, rules) for name, rules in by_name.items())
    _find_ends(phrases)
    marks = _marks(bits, {group for one in phrases for group in (one.first, one.last)})
    _find_needed(phrases, marks)
    _link_needed(phrases)
    return Grammar(phrases, number, bits, marks)


Choice: TypeAlias = tuple[Symbol, float]  # a symbol and what it costs


def _choices(by_name: dict[str, list[Rule]]) -> dict[str, list[Choice]]:
    """Find the spliced phrases that are a choice of symbols, and the symbols of each."""
    plain = {
        name: [(rule.expansion[0], _cost(rule)) for rule in rules]
        for name, rules in by_name.items()
        if name[0] == "_" and name[1] != "_" and all(len(r.expansion) == 1 for r in rules)
    }

    def spelt(name: str) -> list[Choice]:
        return [
            (inner, cost + more)
            for symbol, cost in plain[name]
            for inner, more in (spelt(symbol.name) if symbol.name in plain else [(symbol, 0.0)])
        ]

    return {name: spelt(name) for name in plain}


def _cost(rule: Rule) -> float:
    return -STEP * (rule.options.priority or 0)


@dataclass(slots=True)
class _Builder:
    """Builds automata."""

    number: dict[str, int]
    bits: dict[str, int]
    choices: dict[str, list[Choice]]
    states: list[State] = field(default_factory=list)
    moves: dict[tuple[int, str], int] = field(default_factory=dict)

    def phrase(self, name: str, rules: list[Rule]) -> Phrase:
        """Build the automaton of a phrase."""
        self.states = [State()]
        self.moves = {}
        recursive = [r for r in rules if r.expansion[0].name == name]
        for rule in rules:
            if rule in recursive:
                continue
            end = self._lay(0, rule.expansion)
            made = str(rule.alias or rule.origin.name)
            self.states[end].complete.append((made, _cost(rule)))
        if recursive:
            self._loop(recursive)
        single = not any(state.terminals or state.phrases for state in self.states[1:])
        return Phrase(name, self.states, single=single)

    def _loop(self, rules: list[Rule]) -> None:
        """Let each complete state go on with what follows the phrase in its recursive rules."""
        ends = [index for index, state in enumerate(self.states) if state.complete]
        for rule in rules:
            rest = rule.expansion[1:]
            for end in ends:
                self._link(self._lay(end, rest[:-1]), rest[-1], end)

    def _lay(self, start: int, symbols: Sequence[Symbol]) -> int:
        here = start
        for symbol in symbols:
            key = (here, symbol.name)
            if key not in self.moves:
                self.moves[key] = len(self.states)
                self.states.append(State())
                self._link(here, symbol, self.moves[key])
            here = self.moves[key]
        return here

    def _link(self, start: int, symbol: Symbol, target: int) -> None:
        state = self.states[start]
        for one, cost in self.choices.get(symbol.name, [(symbol, 0.0)]):
            if one.is_term:
                word: Word = (self.bits[one.name], str(one.name), target, cost, 0)
                if word not in state.terminals:
                    state.terminals.append(word)
            else:
                inner: Inner = (0, self.number[one.name], target, cost, 0, 0)
                if inner not in state.phrases:
                    state.phrases.append(inner)


def _find_ends(phrases: tuple[Phrase, ...]) -> None:
    """Find the word classes that each phrase can begin and end with."""
    changed = True
    while changed:
        changed = False
        for phrase in phrases:
            first, last = phrase.first, phrase.last
            for index, state in enumerate(phrase.states):
                for bit, _, target, *_ in state.terminals:
                    first |= 0 if index else bit
                    last |= bit if phrase.states[target].complete else 0
                for _, other, target, *_ in state.phrases:
                    first |= 0 if index else phrases[other].first
                    last |= phrases[other].last if phrase.states[target].complete else 0
            changed |= (first, last) != (phrase.first, phrase.last)
            phrase.first, phrase.last = first, last


def _link_needed(phrases: tuple[Phrase, ...]) -> None:
    """Write on each edge what it can begin with, and what must come in and behind it."""
    for phrase in phrases:
        for state in phrase.states:
            state.terminals = [
                (bit, name, target, cost, phrase.states[target].needed)
                for bit, name, target, cost, _ in state.terminals
            ]
            state.phrases = [
                (phrases[other].first, other, target, cost, behind := phrase.states[target].needed,
                 behind | phrases[other].needed)
                for _, other, target, cost, *_ in state.phrases
            ]  # fmt: skip
            for bit, *_ in state.terminals:
                state.following |= bit
            for first, *_ in state.phrases:
                state.following |= first


def _marks(bits: dict[str, int], groups: set[int]) -> dict[str, int]:
    """Give each word class its bit, and a bit for each group that it is in."""
    marks = dict(bits)
    for rank, group in enumerate(sorted(groups), start=len(bits)):
        for name, bit in bits.items():
            if bit & group:
                marks[name] |= 1 << rank
    return marks


def _find_needed(phrases: tuple[Phrase, ...], marks: dict[str, int]) -> None:
    """Find for each state the word classes, and groups of them, of which some must still come."""
    everything = 0
    for mark in marks.values():
        everything |= mark
    for phrase in phrases:
        for state in phrase.states:
            state.needed = 0 if state.complete else everything
        phrase.needed = everything
    changed = True
    while changed:
        changed = False
        for phrase in phrases:
            for state in reversed(phrase.states):
                needed = state.needed
                for _, name, target, *_ in state.terminals:
                    needed &= marks[name] | phrase.states[target].needed
                for _, other, target, *_ in state.phrases:
                    needed &= phrases[other].needed | phrase.states[target].needed
                changed |= needed != state.needed
                state.needed = needed
            phrase.needed = phrase.states[0].needed
