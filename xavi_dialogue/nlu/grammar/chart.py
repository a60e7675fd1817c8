"""Chart: the cheapest way to read each stretch of a lattice as each phrase.

Top down with a table: a phrase is tried at a node only where one of the word classes that it can
begin with stands, and only once. Of the readings of a phrase over one stretch the cheapest is kept.
"""

from dataclasses import dataclass, field
from typing import TypeAlias

from xavi_dialogue.errors import XaviError
from xavi_dialogue.nlu.grammar.lexicon import Leaf
from xavi_dialogue.nlu.grammar.rules import Edges, Grammar, State


@dataclass(frozen=True, slots=True, eq=False)
class Node:
    """A phrase over a stretch of the lattice: the rule that made it, its parts, their leaves."""

    name: str
    parts: tuple["Part", ...]
    start: int
    end: int
    cost: float
    leaves: tuple[Leaf, ...] = field(init=False)

    def __post_init__(self) -> None:
        """Gather the leaves."""
        found: list[Leaf] = []
        for part in self.parts:
            if isinstance(part, Leaf):
                found.append(part)
            else:
                found += part.leaves
        object.__setattr__(self, "leaves", tuple(found))


Part: TypeAlias = Node | Leaf
#: Trees by name, cost and parts.
Nodes: TypeAlias = dict[tuple[str, float, tuple[Part, ...]], Node]
#: What was read so far, last part first: the chain before it, and a leaf or an entry.
Chain: TypeAlias = "tuple[Chain, Leaf | Entry] | None"
#: A phrase in the table: its cost, its rule, its parts.
Entry: TypeAlias = "tuple[float, str, Chain]"
Pending: TypeAlias = dict[int, dict[int, tuple[float, Chain]]]  # by node and state
Leaves: TypeAlias = list[dict[str, list[Leaf]]]

_TIE = 1e-6
_BEAM = 1.6  # what costs this much more than the best at its node is given up
_DEEPEST = 60  # phrases within one another; no sentence that people say comes near


class ChartLimitError(XaviError):
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
    """One text against the grammar.

    Charts that are given the same `nodes` have the same phrases over the same leaves in common.
    """

    def __init__(
        self, grammar: Grammar, leaves: Leaves, budget: Budget, nodes: Nodes | None = None
    ) -> None:
        self.grammar = grammar
        self.leaves = leaves
        self.budget = budget
        self.table: list[dict[int, dict[int, Entry]]] = [{} for _ in range(len(leaves) + 1)]
        bits = grammar.bits
        self.masks = [sum(bits[name] for name in found if name in bits) for found in leaves]
        self.masks.append(0)
        self.lacking = _lacking(grammar, leaves)
        self.depth = 0
        self.nodes: Nodes = {} if nodes is None else nodes
        self.trees: dict[int, Node] = {}  # by the id of the entry, which the table keeps

    def read(self, name: str, start: int) -> dict[int, Entry]:
        """Find the phrases of that name that begin at a node, by the node where they end."""
        number = self.grammar.number[name]
        phrase = self.grammar.phrases[number]
        if not phrase.first & self.masks[start] or phrase.needed & self.lacking[start]:
            return {}
        return self._find(number, start)

    def _find(self, number: int, start: int) -> dict[int, Entry]:
        """Give what is in the table, once it was tried; nothing while it is."""
        row = self.table[start]
        found = row.get(number)
        if found is None:
            if self.depth >= _DEEPEST:
                return {}
            row[number] = {}
            phrase = self.grammar.phrases[number]
            self.depth += 1
            run = self._run_single if phrase.single else self._run
            found = row[number] = run(phrase.states, start)
            self.depth -= 1
        return found

    def _run(self, states: list[State], start: int) -> dict[int, Entry]:
        """Take an automaton from a node as far as it goes."""
        budget, masks = self.budget, self.masks
        found: dict[int, Entry] = {}
        pending: Pending = {}
        begin = states[0]
        present = begin.following & masks[start]
        edges = begin.known.get(present) or begin.edges(present)
        self._step(edges, start, 0.0, None, pending)
        budget.spend(1)
        here = start + 1
        while pending:
            active = pending.pop(here, None)
            if active is not None:
                bound = _BEAM + (min([c for c, _ in active.values()]) if len(active) > 1 else 99.0)
                mask = masks[here]
                for index, (cost, chain) in active.items():
                    if cost > bound:
                        continue
                    budget.steps -= 1
                    state = states[index]
                    for rule, extra in state.complete:
                        known = found.get(here)
                        if known is None or cost + extra < known[0] - _TIE:
                            found[here] = (cost + extra, rule, chain)
                    present = state.following & mask
                    if present:
                        edges = state.known.get(present) or state.edges(present)
                        self._step(edges, here, cost, chain, pending)
                if budget.steps < budget.reserve:
                    raise ChartLimitError
            here += 1
        return found

    def _step(
        self, edges: Edges, here: int, cost: float, chain: Chain, pending: Pending
    ) -> None:  # fmt: skip
        """Go on from a state in every way."""
        lacking, row = self.lacking, self.table[here]
        for _, name, target, price, behind in edges[0]:
            for leaf in self.leaves[here][name]:
                end = leaf.end
                if not behind & lacking[end]:
                    _relax(pending, end, target, cost + price + leaf.cost, chain, leaf)
        lack = lacking[here]
        for _, other, target, price, behind, needed in edges[1]:
            if needed & lack:
                continue
            found = row.get(other)
            if found is None:
                found = self._find(other, here)
            if not found:
                continue
            price += cost
            for end, entry in found.items():
                if not behind & lacking[end]:
                    total = price + entry[0]
                    reached = pending.get(end)
                    if reached is None:
                        pending[end] = {target: (total, (chain, entry))}
                    else:
                        known = reached.get(target)
                        if known is None or total < known[0] - _TIE:
                            reached[target] = (total, (chain, entry))

    def _run_single(self, states: list[State], start: int) -> dict[int, Entry]:
        """Find the phrases of one part: what `_run` finds, without keeping states."""
        lacking = self.lacking[start]
        begin = states[0]
        found: dict[int, Entry] = {}
        present = begin.following & self.masks[start]
        words, phrases = begin.known.get(present) or begin.edges(present)
        for _, name, target, price, _ in words:
            for leaf in self.leaves[start][name]:
                _complete(states[target], found, leaf.end, price + leaf.cost, leaf)
        for _, other, target, price, _, needed in phrases:
            if not needed & lacking:
                for end, entry in self._find(other, start).items():
                    _complete(states[target], found, end, price + entry[0], entry)
        self.budget.spend(1 + len(found))
        return dict(sorted(found.items())) if len(words) + len(phrases) > 1 else found

    def tree(self, entry: Entry) -> Node:
        """Build the tree of an entry; phrases whose name begins with "_" give their parts away."""
        known = self.trees.get(id(entry))
        if known is None:
            cost, name, chain = entry
            found: list[Part] = []
            self._gather(chain, found)
            found.reverse()
            parts = tuple(found)
            key = (name, cost, parts)
            known = self.nodes.get(key)
            if known is None:
                known = Node(name, parts, parts[0].start, parts[-1].end, cost)
                self.nodes[key] = known
            self.trees[id(entry)] = known
        return known

    def _gather(self, chain: Chain, found: list[Part]) -> None:
        """List the parts of a phrase, the last first."""
        while chain is not None:
            chain, part = chain
            if isinstance(part, Leaf):
                found.append(part)
            elif part[1][0] == "_":
                self._gather(part[2], found)
            else:
                found.append(self.tree(part))


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


def _complete(
    state: State, found: dict[int, Entry], end: int, cost: float, part: "Leaf | Entry"
) -> None:
    for rule, extra in state.complete:
        known = found.get(end)
        if known is None or cost + extra < known[0] - _TIE:
            found[end] = (cost + extra, rule, (None, part))
