"""Amounts: pairs of numbers that stand for a change."""

from typing import Final

from xavi_dialogue.domain.terms import Quantity
from xavi_dialogue.nlu.compose.clauses.tree import number_of
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf

_SPEEDS: Final = {"kmh": 1 / 3.6, "mph": 0.44704, "ms": 1.0}


def speeds_of(node: Node) -> tuple[Quantity, Quantity] | None:
    """Read from which to which speed, without a unit in km/h; None: it is of no speeds."""
    leaves = [part for part in node.parts if isinstance(part, Leaf)]
    numbers = [number_of(part) for part in node.parts if isinstance(part, Node)]
    backwards = leaves[0].category == "SPANTO"
    scales = [_SPEEDS.get(leaf.key) for leaf in leaves if leaf.category == "UNIT"] or [1 / 3.6]
    scale = scales[-1]
    if len(numbers) != 2 or scale is None:
        return None
    if backwards:
        numbers.reverse()
    first, last = (Quantity(round(one * scale, 3), "m/s") for one in numbers)
    return first, last
