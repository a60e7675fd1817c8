"""Honesty: the cost above which a unit counts as not understood.

The cost of a unit is that of its rules, of the words that are skipped, and of its composition.
Spelling does not count, nor do words without a sense, which are reported as unknown anyway. A unit
that costs too much was put together from leftovers: it yields no act, and its words are unknown.

The limits are fitted to 308 questions from two panels. They reject 3 of the 35 readings that one
reader judged wrong, and none of the others. Cost alone cannot separate most wrong readings from
right ones.
"""

from xavi_dialogue.domain.meaning import Act, Ask, Claim, Elliptic, Feel, HowDecide
from xavi_dialogue.domain.rewriting import first
from xavi_dialogue.domain.terms import Unknown
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.plausible import ODD, oddity

DEAR = 1.7  # cost of a unit
DEAR_WORD = 0.3  # cost for each word of a unit
FEWEST = 5  # [words] a shorter unit is taken to have this many
_READ_PAST = frozenset({"SKIP", "FILLER"})


def well_typed(row: tuple[Act, ...]) -> tuple[Act, ...]:
    """Drop fragments without a sense, claims of what cannot be; keep feelings without them."""
    return tuple(found for act in row if (found := _typed(act)) is not None)


def _typed(act: Act) -> Act | None:
    match act:
        case Feel():
            return act if is_well_typed(act) else Feel(act.feeling)
        case Claim() | Elliptic(form="same"):
            return act if is_well_typed(act) and oddity(act) < ODD else None
        case Ask(question=HowDecide()):
            return act if is_well_typed(act) else None  # "how did you frobnicate?"
    return act


def is_well_typed(value: object) -> bool:
    """Check whether every part of a term has a sense."""
    return first(value, Unknown) is None


def is_dear(unit: Node, extra: float) -> bool:
    """Check whether a unit costs too much to be answered; `extra` is the cost of composing it."""
    leaves = list(leaves_of(unit))
    words = {token for leaf in leaves for token in leaf.tokens}
    spelling = sum(leaf.cost for leaf in leaves if leaf.category not in _READ_PAST)
    cost = unit.cost + extra - spelling
    return cost > DEAR or cost > DEAR_WORD * max(len(words), FEWEST)
