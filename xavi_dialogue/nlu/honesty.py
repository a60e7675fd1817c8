"""Honesty: from what cost on a unit counts as not understood.

A unit costs what its rules, the words that are read past and its composition cost. Spelling does
not count, nor do words without a sense, which are named as unknown anyway. What costs too much is
made of leftovers: it yields no act, and its words are unknown.

The limits are fitted to 308 questions of two panels: they stop 3 of 35 readings that one reader
took for wrong, and none of the others. Cost alone does not tell most wrong readings from right.
"""

from xavi_dialogue.domain.meaning import Act, Claim, Elliptic, Feel
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Unknown
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.grammar.chart import Node

DEAR = 1.7  # cost of a unit
DEAR_WORD = 0.3  # cost of a unit for each of its words
FEWEST = 5  # words that a shorter unit counts as
_READ_PAST = frozenset({"SKIP", "FILLER"})


def well_typed(row: tuple[Act, ...]) -> tuple[Act, ...]:
    """Leave out what is stated or named in words that have no sense here."""
    return tuple(found for act in row if (found := _typed(act)) is not None)


def _typed(act: Act) -> Act | None:
    match act:
        case Feel():
            return act if is_well_typed(act) else Feel(act.feeling)
        case Claim() | Elliptic(form="same"):
            return act if is_well_typed(act) else None
    return act


def is_well_typed(value: object) -> bool:
    """Say whether nothing in a term lacks a sense."""
    return first(value, Unknown) is None


def is_dear(unit: Node, extra: float) -> bool:
    """Say whether a unit costs too much to be answered; `extra` is what composing it cost."""
    leaves = list(leaves_of(unit))
    words = {token for leaf in leaves for token in leaf.tokens}
    spelling = sum(leaf.cost for leaf in leaves if leaf.category not in _READ_PAST)
    cost = unit.cost + extra - spelling
    return cost > DEAR or cost > DEAR_WORD * max(len(words), FEWEST)
