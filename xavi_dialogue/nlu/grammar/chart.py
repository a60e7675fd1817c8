"""Chart: the cheapest way to read each stretch of a lattice as each phrase.

Top down with a table: a phrase is tried at a node only where one of the word classes that it can
begin with stands, and only once. Of the readings of a phrase over one stretch the cheapest is kept.
"""

from dataclasses import dataclass
from typing import TypeAlias

from xavi_dialogue.nlu.grammar.lexicon import Leaf
from xavi_dialogue.nlu.grammar.rules import Edges, Grammar, State


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
Pending: TypeAlias = dict[int, dict[int, tuple[float, Chain]]]  # by node and state
Leaves: TypeAlias = list[dict[str, list[Leaf]]]

_TIE = 1e-6
_BEAM = 1.6  # what costs this much more than the best at its node is given up
_DEEPEST = 60  # phrases within one another; no sentence that people say comes near


class ChartLimitError(Exception):
    """More steps than a text may take."""


@dataclass(slots=True)
class Budget:
    """The steps that a text may still take; some are reserved for what comes later."""

    steps: int
    reserve: int = 0

    def spend(self, steps: int) -> None:
        """Take steps."""
        self.steps -= steps
        if self.steps < self.reserve:
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
        self.lacking = _lacking(grammar, leaves)
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
            if self.grammar.phrases[number].needed & self.lacking[start]:
                self.table[key] = {}
                return {}
            self.table[key] = {}
            self.depth += 1
            found = self.table[key] = self._run(number, start)
            self.depth -= 1
        return found

    def _run(self, number: int, start: int) -> dict[int, Entry]:
        states, budget = self.grammar.phrases[number].states, self.budget
        found: dict[int, Entry] = {}
        pending: Pending = {start: {0: (0.0, None)}}
        here = start
        while pending:
            active = pending.pop(here, None)
            if active is not None:
                bound = _BEAM + (min([c for c, _ in active.values()]) if len(active) > 1 else 99.0)
                mask = self.masks[here]
                for index, (cost, chain) in active.items():
                    if cost > bound:
                        continue
                    budget.steps -= 1
                    state = states[index]
                    if state.complete and here > start:
                        _complete(state, found, here, cost, chain)
                    if mask:
                        edges = state.known.get(mask) or state.edges(mask)
                        self._step(states, edges, here, cost, chain, pending)
                if budget.steps < budget.reserve:
                    raise ChartLimitError
            here += 1
        return found

    def _step(
        self, states: list[State], edges: Edges, here: int, cost: float, chain: Chain,
        pending: Pending,
    ) -> None:  # fmt: skip
        """Go on from a state in every way."""
        lacking = self.lacking
        for _, name, target, price in edges[0]:
            needed = states[target].needed
            for leaf in self.leaves[here][name]:  # type: ignore[index]
                end = leaf.end
                if not needed & lacking[end]:
                    _relax(pending, end, target, cost + price + leaf.cost, chain, leaf)
        for _, other, target, price in edges[1]:
            found = self.table.get(other * self.width + here)  # type: ignore[operator]
            if found is None:
                found = self._find(other, here)  # type: ignore[arg-type]
            if found:
                needed = states[target].needed
                for end, entry in found.items():
                    if not needed & lacking[end]:
                        _relax(pending, end, target, cost + price + entry[0], chain, entry)


def _lacking(grammar: Grammar, leaves: Leaves) -> list[int]:
    """List for each node the marks of which no word stands there or later."""
    found = [-1]
    for at in reversed(leaves):
        present = found[-1]
        for name in at:
            present &= ~grammar.marks.get(name, 0)
        found.append(present)
    found.reverse()
    return found


def _relax(
    pending: Pending, end: int, state: int, cost: float, chain: Chain, part: "Leaf | Entry"
) -> None:
    row = pending.get(end)
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
