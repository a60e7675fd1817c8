"""Rules: the grammar files as automata, one for each phrase.

lark reads and checks the files and spells out what is optional or repeated; the alternatives of
a phrase are laid into one automaton, shared beginnings merged. A rule's priority is its cost in
hundredths, negative priorities cost more. Direct left recursion becomes a loop.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib import resources

import lark
from lark.grammar import Rule, Symbol

GRAMMAR_FILES = ("nlu_phrases.lark", "nlu_clauses.lark")
STEP = 0.01  # cost of one point of negative priority


@dataclass(slots=True)
class State:
    """A state of an automaton: where symbols lead, and what is complete here."""

    terminals: list[tuple[str, int]] = field(default_factory=list)
    phrases: list[tuple[int, int]] = field(default_factory=list)  # number of phrase, next state
    complete: list[tuple[str, float]] = field(default_factory=list)  # name of rule, cost


@dataclass(slots=True)
class Phrase:
    """A phrase of the grammar: its automaton, and the word classes that it can begin with."""

    name: str
    states: list[State]
    first: int = 0  # bits of word classes
    splices: bool = False  # its parts belong to the phrase around it


@dataclass(frozen=True, slots=True)
class Grammar:
    """All phrases, by number; `bits` gives each word class its bit."""

    phrases: tuple[Phrase, ...]
    number: dict[str, int]
    bits: dict[str, int]


@cache
def grammar() -> Grammar:
    """Read the grammar files and build their automata."""
    text = "\n".join(
        resources.files("grammars").joinpath(name).read_text(encoding="utf-8")
        for name in GRAMMAR_FILES
    )
    built = lark.Lark(text, parser="earley", lexer="basic", start=["utterance"])
    by_name: dict[str, list[Rule]] = {}
    for rule in built.rules:
        by_name.setdefault(rule.origin.name, []).append(rule)
    number = {name: index for index, name in enumerate(by_name)}
    terminals = sorted({s.name for r in built.rules for s in r.expansion if s.is_term})
    bits = {name: 1 << index for index, name in enumerate(terminals)}
    phrases = tuple(_phrase(name, rules, number) for name, rules in by_name.items())
    _find_first(phrases, bits)
    return Grammar(phrases, number, bits)


def _phrase(name: str, rules: list[Rule], number: dict[str, int]) -> Phrase:
    states = [State()]
    moves: dict[tuple[int, str], int] = {}
    recursive = [r for r in rules if r.expansion[0].name == name]
    for rule in rules:
        if rule in recursive:
            continue
        end = _lay(rule, 0, rule.expansion, states, moves, number)
        _finish(rule, end, states)
    if recursive:
        _loop(recursive, states, number, moves)
    return Phrase(name, states, splices=name.startswith("_"))


def _finish(rule: Rule, end: int, states: list[State]) -> None:
    cost = -STEP * (rule.options.priority or 0)
    states[end].complete.append((rule.alias or rule.origin.name, cost))


def _loop(
    rules: list[Rule],
    states: list[State],
    number: dict[str, int],
    moves: dict[tuple[int, str], int],
) -> None:
    """Let each complete state go on with what follows the phrase in its recursive rules."""
    ends = [index for index, state in enumerate(states) if state.complete]
    for rule in rules:
        rest = rule.expansion[1:]
        for end in ends:
            last = _lay(rule, end, rest[:-1], states, moves, number)
            name = rest[-1].name
            if not any(name in (t,) for t, _ in states[last].terminals):
                _link(states[last], rest[-1].is_term, name, end, number)


def _lay(
    rule: Rule, start: int, symbols: Sequence[Symbol], states: list[State],
    moves: dict[tuple[int, str], int], number: dict[str, int],
) -> int:  # fmt: skip
    here = start
    for symbol in symbols:
        key = (here, symbol.name)
        if key not in moves:
            moves[key] = len(states)
            states.append(State())
            _link(states[here], symbol.is_term, symbol.name, moves[key], number)
        here = moves[key]
    return here


def _link(state: State, is_term: bool, name: str, target: int, number: dict[str, int]) -> None:
    if is_term:
        if (name, target) not in state.terminals:
            state.terminals.append((name, target))
    elif (number[name], target) not in state.phrases:
        state.phrases.append((number[name], target))


def _find_first(phrases: tuple[Phrase, ...], bits: dict[str, int]) -> None:
    changed = True
    while changed:
        changed = False
        for phrase in phrases:
            begin = phrase.states[0]
            found = phrase.first
            for name, _ in begin.terminals:
                found |= bits[name]
            for other, _ in begin.phrases:
                found |= phrases[other].first
            if found != phrase.first:
                phrase.first = found
                changed = True
