"""Evidence: whether the acts that a clause became still contain what its words say.

A rule of composition that passes over a part of its clause loses the words of that part without
notice. So numbers, units, colours, kinds, superlatives, lights and crossings are looked for in the
acts; a word that is not found there contributes nothing to them.
"""

from collections.abc import Iterator
from typing import Any, Final

import msgspec

from xavi_dialogue.domain.meaning import (
    Act,
    AskHelp,
    Beyond,
    Compare,
    HowMany,
    Peak,
    Quizzing,
    Request,
    Social,
)
from xavi_dialogue.domain.terms import Quantity
from xavi_dialogue.nlu.compose.clauses.tree import value_of
from xavi_dialogue.nlu.grammar.chart import Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

LOST: Final = 0.9  # cost of a word that left nothing in the acts
_TALK: Final = (AskHelp, Beyond, Quizzing, Social)  # stand for the whole unit
_EXTREMES: Final = frozenset(
    (Compare, Peak, "nearest", "farthest", "fastest", "slowest", "biggest", "highest", "lowest")
)
_INFORMING: Final = frozenset(("NUM", "COLOUR", "KIND", "UNIT"))
_NUMBERED: Final = frozenset(("numbered", "roll", "owner"))
_BOTH: Final = 2.0
_SCALES: Final = (1.0, 60.0, 3600.0)  # [s] per unit in which a time may be given
_PLACES: Final = frozenset(("light", "crossing"))  # words that nothing but themselves stands for
_OF_VEHICLES: Final = frozenset(("signal", "indicator", "brake-lights"))  # their lights
_VAGUE: Final = frozenset(("vehicle", "car"))  # kinds for which a vehicle or pronoun may stand


def missing(unit: Node, acts: tuple[Act, ...]) -> tuple[Leaf, ...]:
    """List the informative words of a unit that left nothing in its acts."""
    if not acts or any(isinstance(act, _TALK) for act in acts):
        return ()
    telling = tuple(_telling(unit))
    if not telling:
        return ()
    found = set(atoms(acts))
    if Request in found:
        found.add(Quantity)  # why a request is refused does not depend on its speed
    return tuple(leaf for leaf in telling if not _is_in(leaf, found))


def _telling(part: Part) -> Iterator[Leaf]:
    """Yield the words to look for; not the number in "truck 1", which names a vehicle."""
    if isinstance(part, Leaf):
        superlative = part.category == "FOCUS" and part.key == "superlative"
        place = part.category == "PLACEN" and part.key in _PLACES
        if superlative or place or part.category in _INFORMING:
            yield part
        return
    for inner in part.parts:
        if isinstance(inner, Node) or part.name not in _NUMBERED:
            yield from _telling(inner)


def _is_in(leaf: Leaf, found: set[Any]) -> bool:
    if leaf.category == "NUM":
        said = value_of(leaf)
        if said == _BOTH and "them-all" in found:
            return True  # "those two"
        return Quantity in found or any(said * scale in found for scale in _SCALES)
    if leaf.category == "UNIT":
        return HowMany not in found or Quantity in found  # metres are measured, not counted
    if leaf.category == "FOCUS":
        return not _EXTREMES.isdisjoint(found)
    if leaf.key == "light" and not _OF_VEHICLES.isdisjoint(found):
        return True  # "are his lights on?"
    if leaf.key == "crossing" and "cross" in found:
        return True  # "is anyone on the zebra crossing?"
    return leaf.key in _VAGUE or leaf.key in found


def atoms(value: Any) -> Iterator[Any]:
    """Yield the words and numbers in a term, and the types of its parts."""
    if isinstance(value, tuple):
        for part in value:
            yield from atoms(part)
    elif isinstance(value, msgspec.Struct):
        yield type(value)
        for name in value.__struct_fields__:
            yield from atoms(getattr(value, name))
    elif isinstance(value, str):
        yield value
        yield from value.split()
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield float(value)
