"""Chart: the cheapest way to read each stretch of a lattice as each phrase.

Top down with a table: a phrase is tried at a node only where one of the word classes that it can
begin with stands, and only once. Of the readings of a phrase over one stretch the cheapest is kept.
"""

from dataclasses import dataclass
from typing import TypeAlias

from xavi_dialogue.nlu.grammar.lexicon import Leaf
from xavi_dialogue.nlu.grammar.rules import Grammar, State


@dataclass(frozen=True, slots=True, eq=False)
class Node:
    """A phrase over a stretch of the lattice: the rule that made it, and its parts."""

    name: str
    parts: tuple["Part", ...]
    start: int
    end: int
    cost: float


Part: TypeAlias = Node | Leaf
#: What was read so far, last part first: the chain before it, and a leaf or an entry.
Chain: TypeAlias = "tuple[Chain, Leaf | Entry] | None"
#: A phrase in the table: its cost, its rule, its parts.
Entry: TypeAlias = "tuple[float, str, Chain]"
Leaves: TypeAlias = list[dict[str, list[Leaf]]]

_TIE = 1e-6
_BEAM = 3.0  # what costs this much more than the best at its node is given up
_DEEPEST = 60  # phrases within one another; no sentence that people say comes near


class ChartLimitError(Exception):
    """More steps than a text may take."""


@dataclass(slots=True)
class Budget:
    """The steps that a text may still take."""

    steps: int

    def spend(self, steps: int) -> None:
        """Take steps."""
        self.steps -= steps
        if self.steps < 0:
            raise ChartLimitError


class Chart:
    """One text against the grammar."""

    def __init__(self, grammar: Grammar, leaves: Leaves, budget: Budget) -> None:
        self.grammar = grammar
        self.leaves = leaves
        self.budget = budget
        self.table: dict[int, dict[int, Entry]] = {}
        bits = grammar.bits
        self.masks = [sum(bits[name] for name in found if name in bits) for found in leaves]
        self.masks.append(0)
        self.width = len(leaves) + 1
        self.depth = 0

    def read(self, name: str, start: int) -> dict[int, Entry]:
        """Find the phrases of that name that begin at a node, by the node where they end."""
        number = self.grammar.number[name]
        if start >= self.width or not self.grammar.phrases[number].first & self.masks[start]:
            return {}
        return self._find(number, start)

    def _find(self, number: int, start: int) -> dict[int, Entry]:
        key = number * self.width + start
        found = self.table.get(key)
        if found is None:
            if self.depth >= _DEEPEST:
                return {}
            self.table[key] = {}
            self.depth += 1
            found = self.table[key] = self._run(number, start)
            self.depth -= 1
        return found

    def _run(self, number: int, start: int) -> dict[int, Entry]:
        states = self.grammar.phrases[number].states
        found: dict[int, Entry] = {}
        pending: list[dict[int, tuple[float, Chain]] | None] = [None] * (self.width + 1)
        pending[start] = {0: (0.0, None)}
        last = start
        here = start
        while here <= last:
            active = pending[here]
            if active:
                bound = min([item[0] for item in active.values()]) + _BEAM
                for index, (cost, chain) in active.items():
                    if cost <= bound:
                        state = states[index]
                        if state.complete and here > start:
                            _complete(state, found, here, cost, chain)
                        reached = self._step(state, here, cost, chain, pending)
                        if reached > last:
                            last = reached
            here += 1
        return found

    def _step(
        self, state: State, here: int, cost: float, chain: Chain,
        pending: list[dict[int, tuple[float, Chain]] | None],
    ) -> int:  # fmt: skip
        """Go on from a state in every way; give the farthest node that was reached."""
        mask = self.masks[here]
        self.budget.steps -= 1
        if self.budget.steps < 0:
            raise ChartLimitError
        reached = 0
        if not mask:
            return reached
        leaves, phrases, find = self.leaves[here], self.grammar.phrases, self._find
        for name, target in state.terminals:
            if name in leaves:
                for leaf in leaves[name]:
                    _relax(pending, leaf.end, target, cost + leaf.cost, chain, leaf)
                    if leaf.end > reached:
                        reached = leaf.end
        for other, target in state.phrases:
            if phrases[other].first & mask:
                for end, entry in find(other, here).items():
                    _relax(pending, end, target, cost + entry[0], chain, entry)
                    if end > reached:
                        reached = end
        return reached


def _relax(
    pending: list[dict[int, tuple[float, Chain]] | None], end: int, state: int, cost: float,
    chain: Chain, part: "Leaf | Entry",
) -> None:  # fmt: skip
    row = pending[end]
    if row is None:
        pending[end] = {state: (cost, (chain, part))}
        return
    known = row.get(state)
    if known is None or cost < known[0] - _TIE:
        row[state] = (cost, (chain, part))


def _complete(state: State, found: dict[int, Entry], end: int, cost: float, chain: Chain) -> None:
    for rule, extra in state.complete:
        known = found.get(end)
        if known is None or cost + extra < known[0] - _TIE:
            found[end] = (cost + extra, rule, chain)


def tree(entry: Entry) -> Node:
    """Build the tree of an entry; phrases whose name begins with "_" give their parts away."""
    cost, name, chain = entry
    parts: list[Part] = []
    while chain is not None:
        chain, part = chain
        if isinstance(part, Leaf):
            parts.append(part)
            continue
        node = tree(part)
        if node.name.startswith("_"):
            parts.extend(reversed(node.parts))
        else:
            parts.append(node)
    parts.reverse()
    return Node(name, tuple(parts), parts[0].start, parts[-1].end, cost)
