"""Causing: what somebody is made or let do: "made you slow down", "let it pass"."""

from typing import Any, Final, cast

from xavi_dialogue.domain.terms import Event
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of
from xavi_dialogue.nlu.grammar.chart import Node, Part
from xavi_dialogue.nlu.grammar.lexicon import Leaf

CAUSATIVE: Final = frozenset({"make", "let", "help", "see", "force"})
_LET: Final = 2  # objects of "let": who, and a deed that is also a noun


def slowed(clause: Clause) -> None:
    """Read "made you slow down" as the verb, not as the adjective and a particle."""
    causing = clause.verb is not None and clause.verb.key in CAUSATIVE | {"get", "cause"}
    slow = "slowly" in clause.manner or ("slow", "") in clause.adjectives
    downs = [leaf for leaf in clause.particles if leaf.key in ("down", "up")]
    if not (causing and slow and downs and clause.objects):
        return
    verb = cast(Any, clause.verb)
    leaf = Leaf("V", "slow", "base", ("slow",), (), verb.start, verb.end, 0.0)
    clause.bare = Clause(subject=clause.objects[0][0], verb=leaf, particles=downs,
                         complements=clause.complements, chained=clause.chained)  # fmt: skip
    clause.adjectives, clause.complements, clause.chained = [], [], []
    clause.manner = [manner for manner in clause.manner if manner != "slowly"]
    clause.particles = [leaf for leaf in clause.particles if leaf not in downs]


def let_do(clause: Clause) -> None:
    """Read "let it pass", "let him turn left" as the verb, not as the noun of the deed."""
    if clause.verb is None or clause.verb.key != "let" or len(clause.objects) != _LET:
        return
    deed, node = clause.objects[1]
    leaves = tuple(leaves_of(node))
    if not isinstance(deed, Event) or len(leaves) != 1 or leaves[0].form == "plural":
        return
    leaf = leaves[0]
    verb = Leaf("V", leaf.words[-1], "base", leaf.words, (), leaf.start, leaf.end, 0.0)
    clause.bare = Clause(subject=clause.objects[0][0], verb=verb, side=clause.side,
                         complements=clause.complements)  # fmt: skip
    clause.complements, clause.side = [], None
    del clause.objects[1]


def let_apart(node: Node, clause: Clause) -> tuple[Node, ...]:
    """Part "the bus pass" behind "let" into who it is and the deed."""
    core = node.parts[0]
    if clause.verb is None or clause.verb.key != "let" or len(node.parts) != 1:
        return (node,)
    if not isinstance(core, Node) or core.name != "described":
        return (node,)
    *who, deed = core.parts
    last = who[-1] if who else None
    if not isinstance(deed, Leaf) or deed.category != "EVN" or deed.form == "plural":
        return (node,)
    if not isinstance(last, Leaf) or last.category != "KIND":
        return (node,)
    return _phrase(node, tuple(who)), _phrase(node, (deed,))


def _phrase(node: Node, parts: tuple[Part, ...]) -> Node:
    core = Node("described", parts, parts[0].start, parts[-1].end, 0.0)
    return Node(node.name, (core,), core.start, core.end, 0.0)
