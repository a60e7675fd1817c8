"""Readings that make no sense: the grammar allows more than people mean.

Each function says whether a parse by one start rule is to be rejected.
"""

from collections.abc import Callable

from xavi_dialogue.language.grammar import Tree
from xavi_dialogue.language.slots import actor, first, terminals
from xavi_dialogue.language.tense import tense_of
from xavi_dialogue.language.tokens import Token


def rejected(rule: str, tree: Tree, whole: tuple[Token, ...]) -> bool:
    """Whether a parse by that start rule makes no sense.

    Args:
        rule: the start rule.
        tree: the parse tree.
        whole: the tokens it spans, those read past included.
    """
    check = _CHECKS.get(rule)
    return check is not None and check(tree, whole)


def _no_could(tree: Tree, whole: tuple[Token, ...]) -> bool:
    """Only with "could" does "how could you have stopped" ask how to get there."""
    return first(tree, "wanted") is not None and whole[1].terminal != "COULD"


def _advice(tree: Tree, whole: tuple[Token, ...]) -> bool:
    """Whether it tells the car what to do: "you should turn left", without "have"."""
    hindsight = any({"have", "had"} & set(t.text.split()) for t in whole)
    asks_why = {"WHY", "WONDER", "PREVENT", "EXPECT"} & set(terminals(tree))
    return any(t.terminal == "COULD" for t in whole) and not (hindsight or asks_why)


def _is_could(tree: Tree, whole: tuple[Token, ...]) -> bool:
    return "COULD" in terminals(tree)


def _not_imperative(tree: Tree, whole: tuple[Token, ...]) -> bool:
    """A command is an imperative, or asks the car itself to do something from now on."""
    if who := first(tree, "actor"):
        if "COULD" in terminals(tree) and whole[0].terminal == "EGO":
            return not _advice(tree, whole)
        asks = whole[0].text.split()[0] in ("can", "could", "will", "would")
        return not asks or actor(who) != "ego" or "have" in whole[0].text
    verb = next((t for t in whole if t.form), None)
    return verb is None or verb.form != "base" or tense_of(whole) is not None


def _request(tree: Tree, whole: tuple[Token, ...]) -> bool:
    """Whether it asks for something to be done: "could you turn left?", or which action it was."""
    own = first(tree, "actions") is not None
    if own and any(t.terminal == "WHAT" for t in whole):
        return True  # "what did you do": the action is asked, not said
    asks = whole[0].text.split()[0] in ("can", "could", "would", "should", "might")
    return own and (asks and "have" not in whole[0].text and whole[0].terminal != "WOULD")


def _laid(tree: Tree, whole: tuple[Token, ...]) -> bool:
    """Whether it lays something to somebody: that puts nobody into the question before."""
    return whole[0].text.startswith("because")


_CHECKS: dict[str, Callable[[Tree, tuple[Token, ...]], bool]] = {
    "how_avoid": _no_could,
    "why_not": _advice,
    "how": _is_could,
    "command": _not_imperative,
    "what": _request,
    "replace": _laid,
}
