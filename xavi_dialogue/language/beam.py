"""Beam: the cheapest ways to read a lattice as a question of one kind.

Every way cuts the text into phrases, takes each in one of its senses, and reads past some of
them at the prices of `grammars/parse.toml`. At each word only the cheapest few are followed, and
no more steps are taken for a text than its budget allows, whatever the text.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import lark

from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.grammar import Stack, Tree, beginning, is_sentence, shift, tree_of
from xavi_dialogue.language.lattice import Edge, Lattice
from xavi_dialogue.language.tokens import AUXILIARIES, Token, merged


@dataclass(slots=True)
class Budget:
    """Steps left for one text, so that no text takes long."""

    steps: int


@dataclass(frozen=True, slots=True)
class Parse:
    """One way to read the words `begin:end` as a question."""

    rule: str  # the start rule
    tree: Tree
    tokens: tuple[Token, ...]  # as they were cut, those read past included, noise left out
    begin: int  # positions of words
    end: int
    cost: float  # of what was read past, and of unlikely cuts


class _Chain(NamedTuple):
    """A list that hypotheses share: its last element, and what is before it."""

    before: "_Chain | None"
    token: Token
    sense: tuple[str, str] | None  # as what it was shifted; None: read past


class _Hypothesis(NamedTuple):
    """How the words so far may be read."""

    cost: float
    rank: int  # order of discovery: settles ties
    stack: Stack
    path: _Chain | None


@dataclass(frozen=True, slots=True)
class Found:
    """A complete reading, before its tree is built."""

    rule: str
    begin: int
    end: int
    cost: float
    path: _Chain

    def parse(self) -> Parse:
        """The reading with its tree."""
        chain: _Chain | None = self.path
        links: list[_Chain] = []
        while chain is not None:
            links.append(chain)
            chain = chain.before
        links.reverse()
        fed = (
            lark.Token(*link.sense, start_pos=position)
            for position, link in enumerate(links)
            if link.sense is not None
        )
        tokens = tuple(link.token for link in links)
        return Parse(self.rule, tree_of(self.rule, fed), tokens, self.begin, self.end, self.cost)


@dataclass(frozen=True, slots=True)
class Prices:
    """What it costs to read past a word, and what no reading may exceed."""

    by_terminal: dict[str, float]
    other: float | None  # of terminals not listed; None: they are never read past
    limit: float
    take: dict[str, float] = field(default_factory=dict)  # extra, for not reading past it

    def of(self, token: Token) -> float | None:
        """The price of a token: of its cheapest sense, or of its dearest where all have one."""
        if self.other is None and token.terminal in costs().boundary.held:
            return None
        listed = [self.by_terminal[t] for t in token.terminals if t in self.by_terminal]
        if self.other is None:
            return min(listed, default=None)
        return max(listed, default=self.other)


def search(
    rule: str, lattice: Lattice, begin: int, ends: frozenset[int], prices: Prices, budget: Budget
) -> list[Found]:
    """The cheapest readings by one start rule from a word to each of `ends`.

    Args:
        rule: the start rule.
        lattice: the text.
        begin: position of the word at which the question begins.
        ends: positions at which it may end.
        prices: of the words read past.
        budget: steps that are left for this text; what is taken is taken from it.
    """
    width = costs().limits.width
    waiting: list[list[_Hypothesis]] = [[] for _ in range(len(lattice.edges) + 1)]
    waiting[begin].append(_Hypothesis(0.0, 0, beginning(rule), None))
    found: list[Found] = []
    rank = 0
    last = max(ends, default=begin)
    for position in range(begin, last + 1):
        followed = _best(waiting[position], width)
        waiting[position] = []
        if position in ends:
            found += _complete(rule, begin, position, followed)
        if position == last:
            break
        for hypothesis in followed:
            for edge in lattice.edges[position]:
                if budget.steps <= 0:
                    return found
                budget.steps -= 1
                for cost, stack, path in _steps(hypothesis, edge, prices):
                    if cost <= prices.limit:
                        rank += 1
                        waiting[edge.end].append(_Hypothesis(cost, rank, stack, path))
    return found


def _best(hypotheses: list[_Hypothesis], width: int) -> list[_Hypothesis]:
    """The cheapest few, one for each stack."""
    if len(hypotheses) < 2:
        return hypotheses
    hypotheses.sort(key=lambda h: (h.cost, h.rank))
    kept: dict[Stack, _Hypothesis] = {}
    for one in hypotheses:
        if one.stack not in kept:
            kept[one.stack] = one
            if len(kept) == width:
                break
    return list(kept.values())


def _complete(rule: str, begin: int, end: int, followed: list[_Hypothesis]) -> list[Found]:
    return [
        Found(rule, begin, end, h.cost, h.path)
        for h in followed
        if h.path is not None and is_sentence(rule, h.stack)
    ]


def _steps(
    now: _Hypothesis, edge: Edge, prices: Prices
) -> list[tuple[float, Stack, _Chain | None]]:
    """What may be made of the next phrase: take it in one of its senses, or read past it."""
    limits = costs().limits
    token = edge.token
    cost = now.cost if edge.longest else now.cost + limits.shorter
    if edge.is_noise:
        return [(cost, now.stack, now.path)]
    path = now.path
    if path is not None and token.terminal in AUXILIARIES and path.token.terminal in AUXILIARIES:
        joined = path._replace(token=merged(path.token, token))
        return [(cost, now.stack, joined)]
    steps: list[tuple[float, Stack, _Chain | None]] = []
    for index, sense in enumerate(token.senses):
        stack = shift(now.stack, sense[0])
        if stack is not None:
            taken = cost + limits.sense * index + prices.take.get(sense[0], 0.0)
            steps.append((taken, stack, _Chain(path, token, sense)))
    if (price := prices.of(token)) is not None:
        steps.append((cost + max(price, limits.sense), now.stack, _Chain(path, token, None)))
    return steps
