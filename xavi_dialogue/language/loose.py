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

_WHO = frozenset({"what", "where_goal", "when", "how", "confidence", "replace"})  # or nobody
_SEEN = frozenset({"what", "where_goal"})  # of a vehicle that may be pointed at: "that"
_SAYS_NOTHING = frozenset({"smalltalk", "help", "more", "less"})  # whatever else is said
_ASKED = frozenset({"WHAT", "PLAN", "HAPPENED"})  # what was done is asked, not said
_ALIKE = {"unsaid": "denied", "missing": "absent"}
_COMPARED = {"said": "first", "denied": "first", "contrast": "second"}


def clauses(lattice: Lattice, budget: Budget, *, spoken_of: bool) -> Parse | None:
    """The clauses of a text, parsed as `clauses` of the grammar; None where there is none.

    Args:
        lattice: the text.
        budget: steps that are left for it.
        spoken_of: a vehicle was spoken of before, so that "it" may be one.
    """
    loose = costs().loose
    end = len(lattice.edges)
    take = loose.take if spoken_of else {**loose.take, "IT": loose.expletive}
    prices = Prices(loose.skip, loose.other, loose.limit, take)
    found = search(CLAUSES, lattice, 0, frozenset({end}), prices, budget)
    return min(found, key=lambda f: f.cost).parse() if found else None


def as_question(rule: str, parse: Parse | None, tokens: tuple[Token, ...]) -> Parse | None:
    """The clauses as a parse by a start rule; None where they cannot be meant so.

    Args:
        rule: the start rule.
        parse: the clauses; None: the question has none.
        tokens: all tokens of the text.
    """
    if parse is None or rule in _SAYS_NOTHING:
        return Parse(rule, lark.Tree(rule, []), tokens, 0, 0, 0.0)
    if _misleads(rule, _trees(parse.tree)):
        return None
    seen = frozenset(t.terminal for t in tokens)
    if rule == "replace" and "CRASH" in seen:
        return None  # that is another matter
    placed = _placed(rule, _trees(parse.tree), seen)
    shaped = [piece for part in placed for piece in _shape(rule, part, seen)]
    return Parse(rule, lark.Tree(rule, list(shaped)), parse.tokens, 0, parse.end, parse.cost)


def _misleads(rule: str, parts: list[Tree]) -> bool:
    """Whether a "not" stands where the question would lose it, or take it from a condition."""
    kinds = {part.data for part in parts}
    if rule == "compare":
        return "unsaid" in kinds
    if rule == "replace":
        laid = any(part.data == "given" and "because" in part.children for part in parts)
        return laid or any(_is_whole(part) for part in parts)
    given = [clause.data for part in parts if part.data == "given" for clause in _trees(part)]
    return rule == "why_not" and "said" in kinds and bool({"denied", "unsaid"} & set(given))


def _is_whole(part: Tree) -> bool:
    """Whether a clause says of a vehicle what it does, did or will do: that replaces nothing."""
    pieces = [child.data for child in _trees(part)]
    finite = any(isinstance(child, lark.Token) for child in part.children)
    return part.data == "said" and finite and {"actor", "actions"} <= set(pieces)


def _placed(rule: str, parts: list[Tree], seen: frozenset[str]) -> list[Tree]:
    """The clauses that a question of that rule is about, a condition as it takes one."""
    given = next((part for part in parts if part.data == "given"), None)
    others = [part for part in parts if part is not given]
    if given is None:
        if rule == "why_not" and [part.data for part in parts] == ["contrast"]:
            return [lark.Tree("said", parts[0].children)]  # "and not right?"
        if rule == "sensitivity" and _asks_what_it_takes(seen):
            return [lark.Tree("wanted", p.children) if p.data == "said" else p for p in parts]
        return parts
    if rule == "why" and any(t == "because" for t in given.children):
        return [*others, _because(given)]
    if all(part.data == "lone" for part in others):
        return [_supposed(given)]  # "you must have had a reason when you stopped"
    match rule:
        case "where_goal":
            return [_supposed(given)]  # "stop that and tell me where it is going"
        case "when" if not any(part.data == "said" for part in others):
            return [_supposed(given)]
        case "what_if":
            return [_supposed(given), *(p for p in others if p.data == "contrast")]
        case "compare":
            return [lark.Tree("first", _supposed(given).children)]
        case "sensitivity":
            return [*others, lark.Tree("cond", given.children)]
    return others


def _asks_what_it_takes(seen: frozenset[str]) -> bool:
    """Whether it asks what would make the car do something, not whether it still would."""
    asked = bool({"WHAT", "WHEN", "HOW"} & seen) and "WOULD" in seen
    return "STILL" not in seen and ("REQUIRE" in seen or asked)


def _supposed(given: Tree) -> Tree:
    """The clause of a condition; "without" takes away a vehicle, or denies an action."""
    (clause,) = _trees(given)
    if clause.data == "actor":
        return lark.Tree("absent", [clause])
    return lark.Tree("denied", clause.children) if clause.data == "bare" else clause


def _because(given: Tree) -> Tree:
    """What is laid to somebody: an actor, or what he did."""
    (clause,) = _trees(given)
    return lark.Tree("because", clause.children if clause.data == "lone" else [clause])


def _shape(rule: str, part: Tree, seen: frozenset[str]) -> list[Tree]:
    """A clause in the shape that the rule gives it."""
    part = lark.Tree(_ALIKE.get(part.data, part.data), part.children)
    if part.data == "lone":
        return _alone(rule, part)
    if rule == "compare" and part.data in _COMPARED:
        return [lark.Tree(_COMPARED[part.data], part.children)]
    if rule == "replace":
        return _trees(next((c for c in _trees(part) if c.data == "bare"), part))
    if rule == "what" and part.data == "said" and _ASKED & seen:
        return [c for c in _trees(part) if c.data == "actor"]
    return [part]


def _alone(rule: str, part: Tree) -> list[Tree]:
    """An actor without an action."""
    auxiliaries = [t.type for t in part.children if isinstance(t, lark.Token)]
    if rule == "what_if" and auxiliaries:
        return [lark.Tree("elided_not" if "NOT" in auxiliaries else "elided", part.children)]
    (who,) = _trees(part)
    pointing = [t.type for t in who.children if isinstance(t, lark.Token)] == ["THAT"]
    if (pointing and rule not in _SEEN) or rule == "sensitivity":
        return []
    return [who] if rule in _WHO else [lark.Tree("said", part.children)]


def _trees(tree: Tree) -> list[Tree]:
    return [child for child in tree.children if isinstance(child, lark.Tree)]
