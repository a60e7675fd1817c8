"""Particulars: what single rules add to the actors and actions of a question.

Each function takes the parse tree and all tokens it spans, and gives fields of the query.
"""

from collections.abc import Callable
from typing import Any

from xavi_dialogue.explain.blame import INFLUENCE
from xavi_dialogue.explain.timing import ARRIVAL
from xavi_dialogue.language.grammar import Tree
from xavi_dialogue.language.slots import (
    actor,
    children,
    clause,
    first,
    settle,
    terminals,
    tokens_in,
)
from xavi_dialogue.language.tokens import AUXILIARIES, Token

#: `Query.event` where it is asked how we decide.
DECIDED = "decided"
#: `Query.event` of comparisons that name a measure, by the words for it.
MEASURES: dict[str, frozenset[str]] = {
    "safer": frozenset({"safer", "safest", "safe", "riskier", "risky", "dangerous"}),
    "smoother": frozenset({"smoother", "comfortable", "comfy", "jerky", "pleasant"}),
    "quicker": frozenset({"faster", "quicker", "slower", "sooner", "earlier", "longer", "time"}),
}
#: `Query.event` of small talk, that which asks most for an answer first.
COURTESIES = (
    *("quiz", "repeat", "recall-first", "recall", "identity", "farewell", "thanks", "greeting"),
    *("dissent", "assent"),
)
#: Actors that a comparison does not speak of: our own car, and pronouns for what is compared.
UNNAMED = frozenset({"", "ego", "vehicle:it", "vehicle:that"})


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
    elif because and (said := first(because, "said")):  # "because vehicle 1 slowed down"
        name = clause(said).actor
        fields["hypothesised_cause"] = None if name == "ego" else name
    if "INVOLVED" in terminals(tree):
        named = [name for c in children(tree, "actor") if (name := actor(c)) != "vehicle:it"]
        return {"event": INFLUENCE, "hypothesised_cause": named[-1] if named else "vehicle:it"}
    pointed = list(children(tree, "actor"))
    if because is None and len(pointed) == 2 and "MADE" not in terminals(tree):
        return {"hypothesised_cause": actor(pointed[1])}  # "was it vehicle 2?"
    if "MADE" in terminals(tree):
        causes = [actor(c) for c in children(tree, "actor")]
        fields["hypothesised_cause"] = causes[-1]
        said = first(tree, "said")
        fields["actor"] = (clause(said).actor if said else None) or "ego"
    return fields


def _what_if(tree: Tree, whole: tuple[Token, ...]) -> dict[str, Any]:
    for rule in ("absent", "added", "elided", "elided_not", "otherwise"):
        if (part := first(tree, rule)) is None:
            continue
        fields = _actor_of(part) or {"actor": "vehicle:both"}  # "if there was nobody else"
        if rule == "absent":
            return fields | {"negated": True, "intervention": "remove"}
        if rule == "added":
            is_new = fields["actor"] in ("vehicle:other", "ego") or "THERE" in terminals(part)[:1]
            return fields | ({"actor": "vehicle:new"} if is_new else {}) | {"intervention": "add"}
        return fields | {"negated": rule == "elided_not"}
    contrast = first(tree, "contrast")
    if contrast and contrast.children[0] == "without":
        return {"factual": None}  # "turned left without stopping" is no contrast
    if any(t == "unless" for t in tree.children):
        return {"negated": first(tree, "denied") is None}
    if {"WITHOUT", "NO"} & set(terminals(tree)):
        *_, missing = children(tree, "actor")
        return {"actor": actor(missing)} | {"negated": True, "intervention": "remove"}
    return {}


def _what(tree: Tree, whole: tuple[Token, ...]) -> dict[str, Any]:
    if place := [str(t) for t in tokens_in(tree) if t.type == "PLACE" and t in tree.children]:
        return {"actor": f"vehicle:{place[0]}"}
    if "WHICHCAR" in terminals(tree):
        return {"actor": "vehicle:unknown"}
    known = first(tree, "said") is not None or "PASSIVE" in terminals(tree)
    if not known and any(t.terminal == "ARRIVE" for t in whole):
        return _actor_of(tree) | {"event": ARRIVAL}
    return {} if known else _actor_of(tree)


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
    fields: dict[str, Any] = {} if who in UNNAMED else {"actor": who}
    said_of = {word for t in whole if t.terminal == "BETTER" for word in t.text.split()}
    if measures := [name for name, words in MEASURES.items() if words & said_of]:
        fields["event"] = measures[0]
    supposed = any("IF" in t.terminals for t in whole)
    if "would" in aux or "could" in aux or supposed:
        return fields | {"counterfactual": mine or None, "factual": theirs or None}
    return fields | {"factual": mine or None, "counterfactual": theirs or None}


def _named(tree: Tree, _: tuple[Token, ...]) -> dict[str, Any]:
    return _actor_of(tree)


def _confidence(tree: Tree, _: tuple[Token, ...]) -> dict[str, Any]:
    """Of whom; "how sure are you that we get there?" asks of the arrival."""
    return _actor_of(tree) | ({"event": ARRIVAL} if "ARRIVE" in terminals(tree) else {})


def _method(tree: Tree, _: tuple[Token, ...]) -> dict[str, Any]:
    """That it is asked how we decide, and not how we knew."""
    return {"event": DECIDED} if "DECIDE" in terminals(tree) else {}


def _when(tree: Tree, _: tuple[Token, ...]) -> dict[str, Any]:
    """Who arrives; "when was that?" names nobody."""
    if terminals(tree) == ("ARRIVE",):
        return {"actor": "ego", "event": ARRIVAL}  # "ETA?"
    if "ARRIVE" in terminals(tree):
        return _actor_of(tree) | {"event": ARRIVAL}
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
        ours = any(t.terminal == "FACTOR" and "your" in t.text.split() for t in whole)
        return {"actor": "ego"} if ours else {}
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


def _again(tree: Tree, _: tuple[Token, ...]) -> dict[str, Any]:
    """A bare "why?"; "because of vehicle 2?" says what the reason may be."""
    fields = _leaning(tree, ()) | {"negated": "NOT" in terminals(tree)}
    because = first(tree, "because")
    cause = first(because, "actor") if because else None
    return fields | ({"hypothesised_cause": actor(cause)} if cause else {})


def _courtesy(whole: tuple[Token, ...]) -> str | None:
    """What kind of small talk it is: that which asks most for an answer."""
    said = {value for t in whole for terminal, value in t.senses if terminal == "SMALL"}
    return next((kind for kind in COURTESIES if kind in said), None)


PARTICULARS: dict[str, Callable[[Tree, tuple[Token, ...]], dict[str, Any]]] = {
    "why": _why,
    "what_if": _what_if,
    "what": _what,
    "how_avoid": _avoidance,
    "where_goal": _named,
    "confidence": _confidence,
    "how": _method,
    "when": _when,
    "compare": _comparison,
    "sensitivity": _sensitivity,
    "smalltalk": lambda _tree, whole: {"event": _courtesy(whole)},
    "more": _detail("more"),
    "less": _detail("less"),
    "again": _again,
    "replace": _leaning,
    "correction": _leaning,
    "command": _command,
}
