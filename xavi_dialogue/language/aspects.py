"""Aspects: what a question asks for beyond its type, told from its words.

"How fast is vehicle 1?", "did you have to?", "what else could you have done?": the type stays as
the parser finds it, and `Query.event` says what is wanted. Patterns stand in
`grammars/aspects.toml`.
"""

import re
from dataclasses import dataclass
from functools import cache, lru_cache

import msgspec

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.beam import Budget, Prices, search
from xavi_dialogue.language.lattice import build
from xavi_dialogue.language.readings import read
from xavi_dialogue.language.wordlists import load

_OURS = re.compile(r"(?:we|you|us|i|our car|the car|your car)")
_STEPS = 100  # a name is short
_TALK = frozenset({"smalltalk", "help", "ambiguous"})
_ON = re.compile(r"(?:and|what about|how about)\b")  # begins what goes on with an aspect


@dataclass(frozen=True, slots=True)
class _Aspect:
    """One entry of the file."""

    name: str
    finds: tuple[re.Pattern[str], ...]
    types: frozenset[str]  # empty: any
    actor: str  # whose aspect: named, vehicle, ego, ours or theirs
    reason: str  # why it would be declined otherwise, if it would


def aspects() -> frozenset[str]:
    """The names of all aspects."""
    return frozenset(aspect.name for aspect in _aspects())


def with_aspect(query: Query, words: tuple[str, ...]) -> Query:
    """The query with what its words ask for beyond its type, and of whom."""
    text = " ".join(words)
    for aspect in _aspects():
        found = _applied(aspect, query, text)
        if found is not None:
            return found
    if query.event in aspects() and not _ON.match(text):
        return msgspec.structs.replace(query, event=None)  # taken over from the question before
    return query


@cache
def _aspects() -> tuple[_Aspect, ...]:
    data = load("aspects.toml")
    return tuple(
        _Aspect(
            one["name"],
            tuple(pattern(find) for find in one["find"]),
            frozenset(one.get("types", ())),
            one["actor"],
            one.get("reason", "perception"),
        )
        for one in data["aspect"]
    )


@cache
def pattern(find: str) -> re.Pattern[str]:
    """A pattern of `grammars/aspects.toml`, its shorthands written out."""
    for name, meaning in load("aspects.toml")["shorthands"].items():
        find = find.replace(f"<{name}>", meaning)
    return re.compile(find)


def _applied(aspect: _Aspect, query: Query, text: str) -> Query | None:
    """The query with an aspect; None where it has not that one."""
    if not _fits(aspect, query):
        return None
    match = next((m for find in aspect.finds if (m := find.fullmatch(text))), None)
    if match is None:
        return None
    if aspect.actor in ("ours", "theirs"):
        return msgspec.structs.replace(query, event=aspect.name, hypothesised_cause=None)
    if aspect.actor == "ego":
        return msgspec.structs.replace(_ours(query), event=aspect.name)
    who = _named(match["who"])
    if who is None or (who == "ego" and aspect.actor == "vehicle"):
        return None
    if who == "vehicle:it" and query.type == "when" and query.actor == "ego":
        return None  # "how far is it?" asks for the way that is left
    return msgspec.structs.replace(query, event=aspect.name, actor=_known(who, query))


def _fits(aspect: _Aspect, query: Query) -> bool:
    """Whether a query of that type, about that actor, may have an aspect."""
    if query.type in _TALK or (aspect.types and query.type not in aspect.types):
        return False
    if query.type == "out_of_scope" and query.reason != aspect.reason:
        return False
    if aspect.actor == "theirs":
        return query.actor != "ego"
    blames = (query.hypothesised_cause or "").removeprefix("vehicle:")
    return aspect.actor != "ours" or (query.actor == "ego" and not blames.isdecimal())


def _ours(query: Query) -> Query:
    """The query about us now, where it was taken for more of the question before it."""
    if not query.refers_to_previous:
        return query
    return Query(type=query.type, tense="present", refers_to_previous=True, reason=query.reason)


def _known(who: str, query: Query) -> str:
    """Whom a pronoun stands for, where the question before it says so."""
    resolved = who == "vehicle:it" and query.actor.startswith("vehicle:")
    return query.actor if resolved else who


@lru_cache(maxsize=256)
def _named(words: str) -> str | None:
    """Whom some words name; None where they name nobody."""
    if _OURS.fullmatch(words):
        return "ego"
    lattice = build(tuple(words.split()))
    prices = Prices({}, None, 0.5)
    end = frozenset({len(lattice.edges)})
    found = search("replace", lattice, 0, end, prices, Budget(_STEPS))
    reading = read(found[0].parse(), ()) if found else None
    if reading is None or not reading.named_actor or reading.query.factual:
        return None
    return reading.query.actor
