"""Readings: parse trees -> queries, before the conversation is looked at.

One function per rule that needs one; all others share a table of what a clause means there.
A function that returns None rejects the reading: the grammar allows more than makes sense.
"""

from dataclasses import dataclass, replace
from typing import Any, cast

import lark

from xavi_dialogue.explain.query import Query, QueryType
from xavi_dialogue.language.beam import Parse
from xavi_dialogue.language.costs import costs
from xavi_dialogue.language.grammar import Tree
from xavi_dialogue.language.particulars import PARTICULARS, UNNAMED
from xavi_dialogue.language.rejections import rejected
from xavi_dialogue.language.slots import (
    ANAPHOR,
    Clause,
    clause,
    first,
    settle,
    side,
    terminals,
)
from xavi_dialogue.language.tense import tense_for
from xavi_dialogue.language.tokens import AUXILIARIES, WEAK, Token

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
_OTHERWISE = "otherwise"
_ELIDED = frozenset({"elided", "elided_not", _OTHERWISE})
_CLAUSES = ("incident", "said", "denied", "bare", "undone", "wanted", "contrast", "first", "second")
_DEFAULT_TENSE = {
    "what": "present",
    "how": "present",
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
    laid: bool = False  # "because of": the words lay it to somebody
    otherwise: bool = False  # "if you had decided otherwise": than was spoken of
    proposed: bool = False  # "what about stopping?"
    absent: bool = False  # "and without vehicle 1?": somebody is thought away


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
    if rule in PARTICULARS:
        heard = (*whole, *after) if rule == "smalltalk" else whole  # "I see. Now test me."
        fields |= PARTICULARS[rule](parse.tree, heard)
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
    _drop_bystanders(rule, fields, whole)
    query = Query(type=_type(rule), time=when or None, **fields)
    return Reading(
        rule=rule,
        query=query,
        cost=parse.cost + sum(_subject_lost(c, whole) for c in clauses),
        tensed=tense is not None,
        anaphoric=any(ANAPHOR in c.actions for c in clauses),
        elided=any(t.data in _ELIDED for t in _subtrees(parse.tree)),
        named_actor=named,
        otherwise=any(t.data == _OTHERWISE for t in _subtrees(parse.tree)),
        heading=_heading(parse.tree),
        laid=any(t.terminal in ("BECAUSE", "INVOLVED") for t in whole),
        proposed=any(t.terminal == "ABOUT" for t in whole),
        absent=_thinks_away(whole),
    )


def _drop_bystanders(rule: str, fields: dict[str, Any], whole: tuple[Token, ...]) -> None:
    """Leave out a pronoun that stands for what happened and for no vehicle.

    What is avoided or compared is a crash or an action, and "was that a lane change?" asks of one.
    """
    who = fields.get("actor")
    noun = any(t.terminal in ("CAR", "KIND") for t in whole)
    if rule in ("how_avoid", "compare"):
        if who in UNNAMED:
            del fields["actor"]
        if fields.get("factual") == ("continue",):
            del fields["factual"]
    elif rule == "what" and who == "vehicle:that" and fields.get("factual") and not noun:
        del fields["actor"]


def _thinks_away(whole: tuple[Token, ...]) -> bool:
    """Whether the words suppose that somebody were not there, whatever they were read as."""
    heard = frozenset(terminal for token in whole for terminal in token.terminals)
    denied, supposed = heard & {"NOT", "NO"}, "IF" in heard
    if "WITHOUT" in heard or (denied and "THERE" in heard):
        return True
    return supposed and bool(heard & {"NO", "GONE"})


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
    if first(tree, "actions") or "PASSIVE" in terminals(tree):
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
        if one.underspecified and not (at_junction and one.underspecified == "manoeuvre"):
            fields["underspecified"] = one.underspecified
    return fields


def _heading(tree: Tree) -> str | None:
    """The direction, where a question has no more of an action than that."""
    spoken = list(tree.find_data("action"))
    if len(spoken) == 1 and (alone := first(spoken[0], "heading")):
        return None if "LANE" in terminals(alone) else side(alone)
    return None
