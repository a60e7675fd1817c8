"""Ignored: clauses of a unit that make no difference to its acts.

A subordinate clause matters if the act would be different without it. So each one is left out and
the rest is composed again. If that gives the same acts, the clause was passed over.
"""

from collections.abc import Iterator
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
from xavi_dialogue.domain.terms import Described, Exists
from xavi_dialogue.nlu.compose.acts import Composer
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.grammar.chart import Budget, ChartLimitError, Node
from xavi_dialogue.nlu.segments import CLAUSES, RARE

PASSED_OVER: Final = 0.5  # cost of a clause that makes no difference
STEPS: Final = 400  # of composing again, for one clause
SUBORDINATE: Final = frozenset(
    ("when", "if_clause", "because", "contrast", "without", "relative", "infinitive",
     "that_clause", "wh_clause", "and_pred", "gerund", "finite", "lead_clause"),
)  # fmt: skip
_CONTENT: Final = frozenset(
    ("V", "VING", "GOING", "VED", "VPAST", "ADJ", "COMPAR", "SUPER", "KIND", "COLOUR", "SIZE",
     "NUM", "EVN", "ABS", "MEAS", "PLACEN", "RIDE", "BEARING", "NUMBERED"),
)  # fmt: skip
#: Phrases that stay well formed when a clause is left out.
_HOLDERS: Final = frozenset(("vp", "copular", "state", "np", *CLAUSES, *RARE))
#: Clauses that change what is asked, mostly; others repeat it, or say what it is set against.
_CHANGING: Final = frozenset(("when", "if_clause", "because", "without", "relative", "gerund",
                              "wh_clause"))  # fmt: skip
_TELLING: Final = 2  # [words of content] minimum for a clause to be informative
_SOONER: Final = frozenset(("when", "if_clause", "because", "contrast", "and_pred"))
TALK: Final = (AskHelp, Beyond, Feel, Quizzing, Repair, Social)  # of whatever was said with it


def ignored(unit: Node, acts: tuple[Act, ...], end_mark: str) -> tuple[Node, ...]:
    """List the outermost clauses of a unit without which its acts are the same."""
    if not acts or any(isinstance(act, TALK) for act in acts):
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


def changes(clause: Node) -> bool:
    """Check whether an answer has to own up to having passed over a clause."""
    return clause.name in _CHANGING


def asks_nothing(acts: tuple[Act, ...]) -> bool:
    """Check whether acts only ask if something of a bare kind exists at all."""
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
        if part.name in SUBORDINATE and node.name in _HOLDERS and len(node.parts) > 1:
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
