"""Readings: parse trees -> queries, before the conversation is looked at.

One function per rule that needs one; all others share a table of what a clause means there.
A function that returns None rejects the reading: the grammar allows more than makes sense.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, cast

import lark

from xavi_dialogue.explain.query import Query, QueryType
from xavi_dialogue.language.beam import Parse
from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.grammar import Tree
from xavi_dialogue.language.rejections import rejected
from xavi_dialogue.language.slots import (
    ANAPHOR,
    Clause,
    actor,
    children,
    clause,
    first,
    settle,
    side,
    terminals,
    tokens_in,
)
from xavi_dialogue.language.tense import tense_for
from xavi_dialogue.language.tokens import AUXILIARIES, WEAK, Token

#: `Query.event` where it is asked what a vehicle had to do with it, rather than whether.
INFLUENCE = "influence"
#: `Query.event` of comparisons that name a measure, by the words for it.
MEASURES: dict[str, frozenset[str]] = {
    "safer": frozenset({"safer", "safest", "safe", "riskier", "risky", "dangerous"}),
    "smoother": frozenset({"smoother", "comfortable", "comfy", "jerky", "pleasant"}),
    "quicker": frozenset({"faster", "quicker", "slower", "sooner", "earlier", "longer", "time"}),
}
#: What the clauses of a question are, by start rule and clause rule.
_ROLES: dict[str, dict[str, str]] = {
    "why": {"said": "factual", "contrast": "counterfactual", "own": "factual"},
    "why_not": {
        "denied": "counterfactual",
        "said": "counterfactual",
        "bare": "counterfactual",
        "own": "counterfactual",
        "contrast": "factual",
    },
    "what_if": {
        "said": "counterfactual",
        "denied": "counterfactual",
        "bare": "counterfactual",
        "own": "counterfactual",
        "contrast": "factual",
    },
    "how_avoid": {
        "bare": "factual",
        "said": "factual",
        "denied": "factual",
        "undone": "factual",
        "wanted": "counterfactual",
    },
    "where_goal": {},
    "smalltalk": {},
    "help": {},
    "sensitivity": {"own": "factual", "said": "factual", "wanted": "counterfactual"},
    "compare": {"first": "factual", "second": "counterfactual"},
}
_ANY = {"said": "factual", "denied": "factual", "bare": "factual", "own": "factual"}
#: Rules in which "not" turns what is asked about; in others it is a way to ask.
_NEGATABLE = frozenset({"what_if", "confidence", "how", "when"})
_CLAUSES = ("incident", "said", "denied", "bare", "undone", "wanted", "contrast", "first", "second")
_DEFAULT_TENSE = {
    "what": "present",
    "where_goal": "present",
    "confidence": "present",
    "when": "future",
    "smalltalk": "present",
    "help": "present",
    "command": "present",
}


@dataclass(frozen=True, slots=True)
class Reading:
    """One way to understand a text."""

    rule: str  # the start rule
    query: Query
    cost: float  # the smaller, the likelier
    tensed: bool = True  # the words show a tense
    anaphoric: bool = False  # "do that": the actions stand in an earlier turn
    elided: bool = False  # "and if you hadn't?": likewise
    named_actor: bool = True  # the words name who acts
    heading: str | None = None  # "and left?": a direction alone


def read(parse: Parse, after: tuple[Token, ...], *, checked: bool = True) -> Reading | None:
    """What a parse means; None where it makes no sense.

    Args:
        parse: of a question, by the grammar or put together from clauses.
        after: the tokens behind it.
        checked: whether what the grammar allows and nobody means is rejected.
    """
    rule = parse.rule
    whole = parse.tokens
    clauses = _clauses(parse.tree)
    if checked and rejected(rule, parse.tree, whole):
        return None
    fields = _slots_of(rule, clauses, whole)
    if rule in _EXTRA:
        fields |= _EXTRA[rule](parse.tree, whole)
    focus = next((c for c in clauses if c.role not in ("contrast", "own", "incident")), None)
    scope = whole[focus.span[0] : focus.span[1] + 1] if focus else whole
    if rule in ("confidence", "how") and focus is None:
        scope = whole if any(c.role == "own" for c in clauses) else ()
    tense = tense_for(rule, scope, whole)
    fields["tense"] = tense or _DEFAULT_TENSE.get(rule, "past")
    when = " ".join(t.text for t in whole if t.terminal == "TIME")
    named = "actor" in fields
    if is_compound(after):
        fields["compound"] = True
    if rule == "what" and fields.get("actor") == "vehicle:that" and fields.get("factual"):
        del fields["actor"]  # "was that a lane change?"
    if rule in ("how_avoid", "compare"):
        _drop_bystanders(fields)
    query = Query(type=_type(rule), time=when or None, **fields)
    return Reading(
        rule=rule,
        query=query,
        cost=parse.cost + sum(_subject_lost(c, whole) for c in clauses),
        tensed=tense is not None,
        anaphoric=any(ANAPHOR in c.actions for c in clauses),
        elided=any(t.data in ("elided", "elided_not") for t in _subtrees(parse.tree)),
        named_actor=named,
        heading=_heading(parse.tree),
    )


def _drop_bystanders(fields: dict[str, Any]) -> None:
    """What is avoided or compared is a crash or an action: "that" and "it" are neither."""
    if fields.get("actor") in _UNNAMED:
        del fields["actor"]
    if fields.get("factual") == ("continue",):
        del fields["factual"]


def is_compound(after: tuple[Token, ...]) -> bool:
    """Whether a second question begins with the tokens behind the first."""
    heads = costs().boundary.begin_at | AUXILIARIES
    joined = [t.terminal in ("AND", "CONJ", "BREAK") for t in after[:2]]
    start = sum(joined[: 1 if joined != [True, True] else 2])
    return 0 < start < len(after) and after[start].terminal in heads


def _subject_lost(one: Clause, tokens: tuple[Token, ...]) -> float:
    """The cost of a clause whose subject is a word read past: "why did the chicken stop"."""
    begin, end = one.span
    inside = tokens[begin : end + 1]
    auxiliary = any(t.terminal in AUXILIARIES for t in inside)
    lost = any(t.terminal in WEAK or t.terminal == "UNKNOWN" for t in inside)
    return 1.5 if one.actor is None and auxiliary and lost else 0.0


def _type(rule: str) -> QueryType:
    kinds = {"command": "out_of_scope", "more": "why", "less": "why", "again": "why",
             "replace": "ambiguous", "correction": "ambiguous"}  # fmt: skip
    return cast(QueryType, kinds.get(rule, rule))


def _subtrees(tree: Tree) -> list[Tree]:
    return [c for c in tree.children if isinstance(c, lark.Tree)]


def _clauses(tree: Tree) -> tuple[Clause, ...]:
    """Clauses of the question; actions directly under the start rule are a clause "own"."""
    found = [clause(c) for c in _subtrees(tree) if c.data in _CLAUSES]
    if first(tree, "actions"):
        found.insert(0, replace(clause(tree), role="own"))
    return tuple(found)


def _slots_of(rule: str, clauses: tuple[Clause, ...], whole: tuple[Token, ...]) -> dict[str, Any]:
    """Actor, factual, counterfactual and negation, by the table of roles."""
    at_junction = any(t.terminal == "JUNCTION" or " the junction" in t.text for t in whole)
    fields: dict[str, Any] = {}
    roles = _ROLES.get(rule, _ANY)
    for one in clauses:
        slot = roles.get(one.role)
        if one.role == "incident":
            fields |= {"event": "crash"} | ({"actor": one.actor} if one.actor else {})
        if slot is None:
            if one.actor and one.role == "said":
                fields.setdefault("actor", one.actor)
            continue
        others = tuple(a for c in clauses if c is not one for a in c.actions)
        actions = settle(one.actions, others, at_junction)
        if actions:
            fields[slot] = actions
        if one.actor and (one.role != "contrast" or "actor" not in fields):
            fields.setdefault("actor", one.actor)
        if one.role == "denied" and rule in _NEGATABLE:
            fields["negated"] = True
        if one.underspecified:
            fields["underspecified"] = "direction"
    return fields


# --- what single rules add to that ---------------------------------------------------------------


def _actor_of(tree: Tree) -> dict[str, Any]:
    who = first(tree, "actor") or first(tree, "number") or first(tree, "pair")
    return {"actor": actor(who)} if who else {}


def _why(tree: Tree, _: tuple[Token, ...]) -> dict[str, Any]:
    fields: dict[str, Any] = {}
    because = first(tree, "because")
    if because and (cause := first(because, "actor")):
        fields["hypothesised_cause"] = actor(cause)
        if "WHY" in terminals(tree):
            fields["event"] = INFLUENCE
    if "INVOLVED" in terminals(tree):
        named = [name for c in children(tree, "actor") if (name := actor(c)) != "vehicle:it"]
        return {"event": INFLUENCE, "hypothesised_cause": named[-1] if named else "vehicle:it"}
    if "MADE" in terminals(tree):
        causes = [actor(c) for c in children(tree, "actor")]
        fields["hypothesised_cause"] = causes[-1]
        said = first(tree, "said")
        fields["actor"] = (clause(said).actor if said else None) or "ego"
    return fields


def _what_if(tree: Tree, whole: tuple[Token, ...]) -> dict[str, Any]:
    for rule in ("absent", "added", "elided", "elided_not"):
        if (part := first(tree, rule)) is None:
            continue
        fields = _actor_of(part)
        if rule == "absent":
            return fields | {"negated": True, "intervention": "remove"}
        if rule == "added":
            is_new = fields["actor"] in ("vehicle:other", "ego") or "THERE" in terminals(part)[:1]
            return fields | ({"actor": "vehicle:new"} if is_new else {}) | {"intervention": "add"}
        return fields | {"negated": rule == "elided_not"}
    if {"WITHOUT", "NO"} & set(terminals(tree)):
        *_, missing = children(tree, "actor")
        return {"actor": actor(missing)} | {"negated": True, "intervention": "remove"}
    return {}


def _what(tree: Tree, whole: tuple[Token, ...]) -> dict[str, Any]:
    if place := [str(t) for t in tokens_in(tree) if t.type == "PLACE" and t in tree.children]:
        return {"actor": f"vehicle:{place[0]}"}
    if "WHICHCAR" in terminals(tree):
        return {"actor": "vehicle:unknown"}
    return {} if first(tree, "said") else _actor_of(tree)


#: Actors that a comparison does not speak of: our own car, and pronouns for what is compared.
_UNNAMED = frozenset({"", "ego", "vehicle:it", "vehicle:that"})


def _comparison(tree: Tree, whole: tuple[Token, ...]) -> dict[str, Any]:
    """To ask "would X be better than Y" is to ask about X; "was X better" starts from X."""
    one, other = first(tree, "first"), first(tree, "second")
    at_junction = any(t.terminal == "JUNCTION" for t in whole)
    auxiliaries = (t.value.split() for t in whole if t.terminal in AUXILIARIES)
    aux = next(auxiliaries, [])
    said = clause(one).actions if one else ()
    against = clause(other).actions if other else ()
    if one and not other and len(said) == 2 and "COMPARE" in terminals(tree):
        said, against = said[:1], said[1:]
    mine, theirs = settle(said, against, at_junction), settle(against, said, at_junction)
    who = _actor_of(tree).get("actor", "")
    fields: dict[str, Any] = {} if who in _UNNAMED else {"actor": who}
    said_of = {word for t in whole if t.terminal == "BETTER" for word in t.text.split()}
    if measures := [name for name, words in MEASURES.items() if words & said_of]:
        fields["event"] = measures[0]
    supposed = any("IF" in t.terminals for t in whole)
    if "would" in aux or "could" in aux or supposed:
        return fields | {"counterfactual": mine or None, "factual": theirs or None}
    return fields | {"factual": mine or None, "counterfactual": theirs or None}


def _named(tree: Tree, _: tuple[Token, ...]) -> dict[str, Any]:
    return _actor_of(tree)


def _when(tree: Tree, _: tuple[Token, ...]) -> dict[str, Any]:
    """Who arrives; "when was that?" names nobody."""
    named = first(tree, "said") is None and {"THAT", "IT"}.isdisjoint(terminals(tree))
    return _actor_of(tree) if named else {}


def _avoidance(tree: Tree, _: tuple[Token, ...]) -> dict[str, Any]:
    """Who should have avoided it; "that" is what happened, and no vehicle."""
    who = {} if first(tree, "incident") else _actor_of(tree)
    named = {} if who.get("actor") in (None, "ego", "vehicle:that", "vehicle:it") else who
    return named | ({"event": "crash"} if "CRASH" in terminals(tree) else {})


def _sensitivity(tree: Tree, whole: tuple[Token, ...]) -> dict[str, Any]:
    condition = first(tree, "cond")
    if condition is None:
        return {}
    inside = [t.start_pos for t in tokens_in(condition) if t.start_pos is not None]
    if not inside:
        return {"condition": None}
    return {"condition": " ".join(t.text for t in whole[min(inside) : max(inside) + 1])}


def _detail(kind: str) -> Callable[[Tree, tuple[Token, ...]], dict[str, Any]]:
    return lambda _tree, _whole: {"detail": kind, "refers_to_previous": True}


def _command(_tree: Tree, _whole: tuple[Token, ...]) -> dict[str, Any]:
    return {"reason": "command", "factual": None}


def _leaning(tree: Tree, _: tuple[Token, ...]) -> dict[str, Any]:
    listed = first(tree, "actions")
    fields = _actor_of(tree) | {"refers_to_previous": True}
    if listed:
        fields["factual"] = settle(clause(tree).actions, (), at_junction=False)
    return fields


def _courtesy(whole: tuple[Token, ...]) -> str | None:
    """What kind of small talk it is: that which asks most for an answer."""
    said = {t.value for t in whole if t.terminal == "SMALL"}
    return next(
        (kind for kind in ("identity", "thanks", "greeting", "assent") if kind in said), None
    )


_EXTRA: dict[str, Callable[[Tree, tuple[Token, ...]], dict[str, Any]]] = {
    "why": _why,
    "what_if": _what_if,
    "what": _what,
    "how_avoid": _avoidance,
    "where_goal": _named,
    "confidence": _named,
    "when": _when,
    "compare": _comparison,
    "sensitivity": _sensitivity,
    "smalltalk": lambda _tree, whole: {"event": _courtesy(whole)},
    "more": _detail("more"),
    "less": _detail("less"),
    "again": lambda tree, _whole: _leaning(tree, ()) | {"negated": "NOT" in terminals(tree)},
    "replace": _leaning,
    "correction": _leaning,
    "command": _command,
}


def _heading(tree: Tree) -> str | None:
    """The direction, where a question has no more of an action than that."""
    spoken = list(tree.find_data("action"))
    if len(spoken) == 1 and (alone := first(spoken[0], "heading")):
        return None if "LANE" in terminals(alone) else side(alone)
    return None
