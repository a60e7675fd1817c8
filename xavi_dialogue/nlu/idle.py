"""Idle words: words of a question that make no difference to what was made of it.

A word of content has a part in an act if the act would be another one with another word in its
place. So each one is put in turn as a word that means nothing, and as things of other types, and
the rest is composed again: where that gives the same acts, the word has no part in them.
Words at the core of a unit are tested. Beside it, only named places are: adjectives, verbs and
places of the road there mostly repeat what is known.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final

from xavi_dialogue.domain.meaning import Act, Ask, Elliptic, HowSure
from xavi_dialogue.domain.terms import (
    Compares,
    Destination,
    Exit,
    Feature,
    Junction,
    Lane,
    Measured,
    Road,
)
from xavi_dialogue.nlu.compose.acts import Composer
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.evidence import atoms
from xavi_dialogue.nlu.grammar.chart import Budget, ChartLimitError, Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf
from xavi_dialogue.nlu.ignored import STEPS, SUBORDINATE, TALK

#: Classes of words that have to make a difference to what is asked.
_BEARING: Final = frozenset(("V", "VING", "VED", "VPAST", "ADJ", "KIND", "COLOUR", "ABS", "MEAS",
                             "PLACEN"))  # fmt: skip
#: Keys of words that say little more than the clause that they stand in.
_NAMED: Final = frozenset(
    ("vehicle", "car", "trip", "ride", "time", "reason", "difference", "start", "rude", "law",
     "option", "value", "road", "decision", "prediction"),
)  # fmt: skip
_NUMBERED: Final = frozenset(("numbered", "owner"))
_PLACE: Final = "building"  # "the village": a place that the road network does not name
_LIGHT: Final = frozenset(("go", "come", "do", "get", "take", "make", "have", "be", "let"))
#: What says as much as a word of a class: any measure, any place.
_PLACES: Final = (Junction, Exit, Road, Lane, Feature, Destination, "turn")
_ALIKE: Final[dict[str, frozenset[Any]]] = {
    "MEAS": frozenset((Measured, Compares, HowSure)), "PLACEN": frozenset(_PLACES),
    "brake": frozenset(("deceleration", "braking")), "space": frozenset(("keep-distance",)),
}  # fmt: skip
#: Phrases in which a word is said beside what is asked, and those in which it is one of several.
_BESIDE: Final = SUBORDINATE | {"pp", "then", "purpose", "participle", "adjective"}
_SEVERAL: Final = frozenset(("group", "or_state", "between"))
#: Class and key of words to try: one that means nothing, and things of other types.
_OTHERS: Final = (("", "\0"), ("PLACEN", "building"), ("KIND", "truck"))


Leaves = tuple[Leaf, ...]


def idle(unit: Node, rows: Sequence[tuple[Act, ...]], end_mark: str) -> list[tuple[Leaves, Leaves]]:
    """List for each row of acts of a unit the words without a part in it: at its core, beside."""
    found: list[list[Leaf]] = [[] for _ in rows]
    asking = [k for k, acts in enumerate(rows) if any(isinstance(act, Ask) for act in acts)]
    asking = [k for k in asking if not any(isinstance(act, TALK) for act in rows[k])]
    said = [frozenset(atoms(acts)) for acts in rows]
    for leaf in leaves_of(unit) if asking else ():
        if leaf.category not in _BEARING or leaf.key in _NAMED | _LIGHT:
            continue
        if _is_numbered(unit, leaf):
            continue
        if leaf.key != _PLACE and not _is_core(unit, leaf):
            continue
        again = (_composed_with(unit, leaf, other, end_mark) for other in _OTHERS)
        same = {leaf.key, *_ALIKE.get(leaf.category, ()), *_ALIKE.get(leaf.key, ())}
        left = [k for k in asking if same.isdisjoint(said[k])]
        while left and (acts := next(again, None)) is not None:
            left = [k for k in left if rows[k] in acts]
        for k in left:
            found[k].append(leaf)
    core = [tuple(leaf for leaf in leaves if _is_core(unit, leaf)) for leaves in found]
    bearing = tuple(leaf for leaf in leaves_of(unit) if leaf.category in _BEARING)
    if len(bearing) > 1:  # nothing of it is in an act that names nothing
        core = [bearing if acts == (Elliptic(),) else c for acts, c in zip(rows, core, strict=True)]
    return [
        (main, tuple(leaf for leaf in leaves if leaf not in main))
        for main, leaves in zip(core, found, strict=True)
    ]


def _is_numbered(node: Node, leaf: Leaf) -> bool:
    """Say whether a word is the kind of a road user that its number names: "pedestrian 3"."""
    if leaf in node.parts:
        return node.name in _NUMBERED
    return any(
        isinstance(p, Node) and leaf in p.leaves and _is_numbered(p, leaf) for p in node.parts
    )


def _is_core(node: Node, leaf: Leaf) -> bool:
    """Say whether a word is in no adjunct or clause of a phrase, or one of several names."""
    inner = next(p for p in node.parts if (isinstance(p, Node) and leaf in p.leaves) or p is leaf)
    if isinstance(inner, Leaf) or inner.name in _SEVERAL:
        return True
    return inner.name not in _BESIDE and _is_core(inner, leaf)


def _composed_with(
    unit: Node, leaf: Leaf, other: tuple[str, str], end_mark: str
) -> list[tuple[Act, ...]]:
    """Compose a unit with another word, of a class and key, in the place of one."""
    category, key = other
    word = replace(leaf, category=category or leaf.category, key=key, words=(key,))
    try:
        found = Composer(Budget(STEPS), end_mark).compose(_with(unit, leaf, word))
    except (ChartLimitError, LookupError):
        return []
    return [acts for acts, _ in found]


def _with(node: Node, leaf: Leaf, other: Leaf) -> Node:
    """Give a phrase with another word in the place of one."""
    parts = (
        other if part is leaf
        else _with(part, leaf, other) if isinstance(part, Node) and leaf in part.leaves
        else part
        for part in node.parts
    )  # fmt: skip
    return replace(node, parts=tuple(parts))
