"""Ignored: clauses and words of a unit that make no difference to its acts.

A subordinate clause has a part in an act if the act would be another one without it. So each one is
left out and the rest is composed again: where that gives the same acts, the clause was passed over.
Likewise each word of content is put in the place of one that means nothing.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

from xavi_dialogue.domain.meaning import (
    Act,
    Ask,
    AskHelp,
    Beyond,
    Feel,
    Quizzing,
    Repair,
    Social,
    Whether,
)
from xavi_dialogue.domain.terms import (
    Compares,
    Described,
    Destination,
    Exists,
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
from xavi_dialogue.nlu.segments import CLAUSES, RARE

PASSED_OVER: Final = 0.5  # cost of a clause that makes no difference
STEPS: Final = 400  # of composing again, for one clause
_CLAUSES: Final = frozenset(
    ("when", "if_clause", "because", "contrast", "without", "relative", "infinitive",
     "that_clause", "wh_clause", "and_pred", "gerund", "finite", "lead_clause"),
)  # fmt: skip
_CONTENT: Final = frozenset(
    ("V", "VING", "GOING", "VED", "VPAST", "ADJ", "COMPAR", "SUPER", "KIND", "COLOUR", "SIZE",
     "NUM", "EVN", "ABS", "MEAS", "PLACEN", "RIDE", "BEARING", "NUMBERED"),
)  # fmt: skip
#: Phrases that are as well formed without a clause.
_HOLDERS: Final = frozenset(("vp", "copular", "state", "np", *CLAUSES, *RARE))
_TELLING: Final = 2  # words of content from which on a clause tells something
_SOONER: Final = frozenset(("when", "if_clause", "because", "contrast", "and_pred"))
#: Classes of words that have to make a difference to what is asked.
_BEARING: Final = frozenset(("V", "VING", "VED", "VPAST", "ADJ", "KIND", "COLOUR", "SIZE", "ABS",
                             "MEAS", "PLACEN"))  # fmt: skip
_NAMED: Final = frozenset(("vehicle", "car", "trip", "ride", "time", "poor"))  # they say little
_LIGHT: Final = frozenset(("go", "come", "do", "get", "take", "make", "have", "be", "let"))
#: What says as much as a word of a class: any measure, any place.
_ALIKE: Final = {"MEAS": frozenset((Measured, Compares)),
                 "PLACEN": frozenset((Junction, Exit, Road, Lane, Feature, Destination, "turn"))}  # fmt: skip
_NOBODY: Final = "\0"  # a key that no word has
_TALK: Final = (AskHelp, Beyond, Feel, Quizzing, Repair, Social)  # of whatever was said with it


def ignored(unit: Node, acts: tuple[Act, ...], end_mark: str) -> tuple[Node, ...]:
    """List the outermost clauses of a unit without which its acts are the same."""
    if not acts or any(isinstance(act, _TALK) for act in acts):
        return ()
    found: list[Node] = []
    for clause, rest in _without(unit):
        inner = any(clause in tuple(_nodes(outer)) for outer in found)
        if inner or not _is_telling(clause):
            continue
        try:
            again = Composer(Budget(STEPS), end_mark).compose(rest)
        except ChartLimitError:
            continue
        if any(other == acts for other, _ in again):
            found.append(clause)
    return tuple(found)


def idle(unit: Node, rows: Sequence[tuple[Act, ...]], end_mark: str) -> list[tuple[Leaf, ...]]:
    """List for each row of acts of a unit the words that make no difference to it."""
    found: list[list[Leaf]] = [[] for _ in rows]
    asking = [k for k, acts in enumerate(rows) if any(isinstance(act, Ask) for act in acts)]
    asking = [k for k in asking if not any(isinstance(act, _TALK) for act in rows[k])]
    said = [frozenset(atoms(acts)) for acts in rows]
    for leaf in leaves_of(unit) if asking else ():
        if leaf.category not in _BEARING or leaf.key in _NAMED | _LIGHT:
            continue
        other = replace(leaf, key=_NOBODY, words=(_NOBODY,))
        try:
            again = Composer(Budget(STEPS), end_mark).compose(_with(unit, leaf, other))
        except (ChartLimitError, LookupError):
            continue
        for k in asking:
            same = {leaf.key} | _ALIKE.get(leaf.category, frozenset())
            if same.isdisjoint(said[k]) and any(acts == rows[k] for acts, _ in again):
                found[k].append(leaf)
    return [tuple(leaves) for leaves in found]


def _with(node: Node, leaf: Leaf, other: Leaf) -> Node:
    """Give a phrase with another word in the place of one."""
    parts = (
        other if part is leaf else _with(part, leaf, other) if leaf in leaves_of(part) else part
        for part in node.parts
    )
    return replace(node, parts=tuple(parts))  # type: ignore[arg-type]


def asks_nothing(acts: tuple[Act, ...]) -> bool:
    """Say whether no more is asked than whether there is anything at all."""
    match acts:
        case (Ask(question=Whether(that=Exists(thing=Described() as thing))),):
            return thing == Described(thing.kind, plural=thing.plural, definite=thing.definite)
    return False


def _without(node: Node) -> Iterator[tuple[Node, Node]]:
    """Yield each clause in a phrase, with the phrase without it."""
    for index, part in enumerate(node.parts):
        if not isinstance(part, Node):
            continue
        before, behind = node.parts[:index], node.parts[index + 1 :]
        if part.name in _CLAUSES and node.name in _HOLDERS and len(node.parts) > 1:
            yield part, replace(node, parts=(*before, *behind))
        for clause, rest in _without(part):
            yield clause, replace(node, parts=(*before, rest, *behind))


def _nodes(node: Node) -> Iterator[Node]:
    yield node
    for part in node.parts:
        if isinstance(part, Node):
            yield from _nodes(part)


def _is_telling(clause: Node) -> bool:
    words = [leaf for leaf in leaves_of(clause) if leaf.category in _CONTENT]
    return len(words) >= (1 if clause.name in _SOONER else _TELLING)
