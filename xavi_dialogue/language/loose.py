"""Loose reading: who did what in a text, whatever words frame the question.

Where the grammar of questions does not fit, the judge may still know what kind of question it
is. Then only the clauses are parsed, reading past everything else, and put where that kind of
question has them.
"""

import lark

from xavi_dialogue.language.beam import Budget, Parse, Prices, search
from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.grammar import CLAUSES, Tree
from xavi_dialogue.language.lattice import Lattice
from xavi_dialogue.language.tokens import Token

_ABOUT_GIVEN = frozenset({"what_if"})  # asks about the condition, where there is one
_WHO = frozenset({"what", "where_goal", "when", "how", "confidence"})  # of a vehicle alone
_SEEN = frozenset({"what", "where_goal"})  # of a vehicle that may be pointed at: "that"
_ASKED = frozenset({"WHAT", "PLAN", "HAPPENED"})  # what was done is asked, not said
_SAYS_NOTHING = frozenset({"smalltalk", "help", "more", "less"})  # whatever else is said
_ALIKE = {"unsaid": "denied", "missing": "absent"}
_COMPARED = {"said": "first", "denied": "first", "contrast": "second"}


def clauses(lattice: Lattice, budget: Budget) -> Parse | None:
    """The clauses of a text, parsed as `clauses` of the grammar; None where there is none."""
    loose = costs().loose
    end = len(lattice.edges)
    prices = Prices(loose.skip, loose.other, loose.limit, loose.take)
    found = search(CLAUSES, lattice, 0, frozenset({end}), prices, budget)
    return min(found, key=lambda f: f.cost).parse() if found else None


def as_question(rule: str, parse: Parse | None, tokens: tuple[Token, ...]) -> Parse:
    """The clauses as a parse by a start rule.

    Args:
        rule: the start rule.
        parse: the clauses; None: the question has none.
        tokens: all tokens of the text.
    """
    if parse is None or rule in _SAYS_NOTHING:
        return Parse(rule, lark.Tree(rule, []), tokens, 0, 0, 0.0)
    given = _first(parse.tree, "given")
    parts = list(parse.tree.children)
    if given is not None and rule == "why" and _token(given, "BECAUSE"):
        parts = [*(c for c in parts if c is not given), _because(given)]
        given = None
    if given is not None and parts == [given]:
        parts, given = [_supposed(given)], None
    if given is not None and rule in _ABOUT_GIVEN:
        kept = [c for c in parts if isinstance(c, lark.Tree) and c.data == "contrast"]
        parts = [_supposed(given), *kept]
    elif given is not None and rule == "compare":
        parts = [lark.Tree("first", _supposed(given).children)]
    elif given is not None:
        parts = [c for c in parts if c is not given]
        if rule == "sensitivity":
            parts.append(lark.Tree("cond", given.children))
    shaped = [piece for part in parts for piece in _shape(rule, part)]
    if rule == "what" and any(t.terminal in _ASKED for t in tokens):
        shaped = [piece for p in shaped for piece in (_actor_only(p) if _is(p, "said") else [p])]
    if rule == "sensitivity" and given is None and _asks_what_it_takes(tokens):
        shaped = [lark.Tree("wanted", p.children) if _is(p, "said") else p for p in shaped]
    return Parse(rule, lark.Tree(rule, shaped), parse.tokens, 0, parse.end, parse.cost)


def _supposed(given: Tree) -> Tree:
    """The clause of a condition; "without" takes away a vehicle, or denies an action."""
    (clause,) = (c for c in given.children if isinstance(c, lark.Tree))
    if clause.data == "actor":
        return lark.Tree("absent", [clause])
    return lark.Tree("denied", clause.children) if clause.data == "bare" else clause


def _actor_only(part: lark.Token | Tree) -> list[lark.Token | Tree]:
    assert isinstance(part, lark.Tree)
    return [c for c in part.children if isinstance(c, lark.Tree) and c.data == "actor"]


def _because(given: Tree) -> Tree:
    """What is laid to somebody: an actor, or what he did."""
    inner = _supposed(given)
    who = _first(inner, "actor")
    return lark.Tree("because", [who] if who and _is(inner, "lone") else [inner])


def _asks_what_it_takes(tokens: tuple[Token, ...]) -> bool:
    """Whether it asks what would make the car do something, not whether it still would."""
    seen = {t.terminal for t in tokens}
    asked = bool({"WHAT", "WHEN", "HOW"} & seen) and "WOULD" in seen
    return "STILL" not in seen and ("REQUIRE" in seen or asked)


def _is(part: lark.Token | Tree, rule: str) -> bool:
    return isinstance(part, lark.Tree) and part.data == rule


def _token(tree: Tree, terminal: str) -> bool:
    return any(isinstance(c, lark.Token) and c.type == terminal for c in tree.children)


def _shape(rule: str, part: lark.Token | Tree) -> list[lark.Token | Tree]:
    """A clause in the shape that the rule gives it."""
    if not isinstance(part, lark.Tree):
        return [part]
    if part.data in _ALIKE:
        part = lark.Tree(_ALIKE[part.data], part.children)
    if part.data == "lone":
        return _alone(rule, part)
    if rule == "compare" and part.data in _COMPARED:
        return [lark.Tree(_COMPARED[part.data], part.children)]
    if rule == "replace":
        inner = _first(part, "bare") or part
        return [c for c in inner.children if isinstance(c, lark.Tree)]
    return [part]


def _alone(rule: str, part: Tree) -> list[lark.Token | Tree]:
    """An actor without an action."""
    if rule == "what_if":
        negated = any(isinstance(c, lark.Token) and c.type == "NOT" for c in part.children)
        auxiliary = any(isinstance(c, lark.Token) and c.type != "NOT" for c in part.children)
        if negated or auxiliary:
            return [lark.Tree("elided_not" if negated else "elided", part.children)]
    (who,) = (c for c in part.children if isinstance(c, lark.Tree))
    said = [t.type for t in who.children if isinstance(t, lark.Token)]
    if (said == ["THAT"] and rule not in _SEEN) or rule == "sensitivity":
        return []
    if rule in _WHO or rule == "replace":
        return [c for c in part.children if isinstance(c, lark.Tree)]
    return [lark.Tree("said", part.children)]


def _first(tree: Tree, rule: str) -> Tree | None:
    return next((c for c in tree.children if isinstance(c, lark.Tree) and c.data == rule), None)
