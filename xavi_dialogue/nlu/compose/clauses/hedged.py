"""Hedged clauses: whether "if" or "when" supposes something, gives a time, or asks."""

from xavi_dialogue.domain.meaning import Act, Ask, Elliptic, When
from xavi_dialogue.domain.terms import Event, Happens, Relative
from xavi_dialogue.nlu.compose.clauses.tree import leaf_of, node_of
from xavi_dialogue.nlu.grammar.chart import Node
from xavi_dialogue.nlu.grammar.lexicon import Leaf


def supposing(unit: Node) -> bool:
    """Check whether "if" opens a clause, and no word introduces it as a question."""
    asked = node_of(unit, "asked_whether")
    word = None if asked is None else leaf_of(asked, "WHETHER")
    told = any(isinstance(p, Leaf) and p.category == "HEDGE" and _ASKING & {*p.words}
               for p in unit.parts)  # fmt: skip
    return word is not None and word.words == ("if",) and not told


_ASKING = frozenset({"idea", "clue", "know", "question", "wonder", "wondered", "ask", "remind",
                     "curious", "asking"})  # fmt: skip


def as_when(act: Act) -> Act:
    """Turn "when you will stop?" into the question when."""
    match act:
        case Elliptic(time=Relative(relation="during", anchor=Event(tense="future") as event)):
            return Ask(When(Happens(event)))
    return act
