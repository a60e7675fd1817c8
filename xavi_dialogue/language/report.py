"""Report: what the parser understood, and why."""

from dataclasses import dataclass, field
from typing import Literal

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.grammar import Tree
from xavi_dialogue.language.tokens import Token

#: Why a text has no query. Those that begin with "no-" say what it lacks (see malformed.toml).
Cause = Literal[
    "empty",
    "too-long",
    "gibberish",
    "ambiguous",
    "no-question",
    "no-action",
    "no-condition",
    "no-alternative",
]


@dataclass(frozen=True, slots=True)
class NotUnderstood:
    """A text without a query."""

    cause: Cause
    readings: tuple[Query, ...] = ()  # what it may mean, likeliest first
    hints: tuple[str, ...] = ()  # words that were not known


@dataclass(frozen=True, slots=True)
class Scored:
    """A reading resolved against the conversation."""

    rule: str
    query: Query
    score: float  # cost by grammar and judge together: the lower, the likelier
    cost: float = 0.0  # by the grammar: 0 is a perfect fit
    loose: bool = False  # only its clauses were read by the grammar
    tree: Tree | None = field(default=None, compare=False, repr=False)  # what the grammar read


@dataclass(frozen=True, slots=True)
class Kind:
    """What the judge thinks a text to be."""

    name: str
    probability: float
    telling: tuple[str, ...]  # the features that speak most for it


@dataclass(frozen=True, slots=True)
class ParseReport:
    """Why the parser understood what it did."""

    tokens: tuple[Token, ...]
    corrections: tuple[tuple[str, str], ...]
    shortened: bool
    readings: tuple[Scored, ...]  # likeliest first
    result: Query | NotUnderstood
    kinds: tuple[Kind, ...] = ()  # the likeliest


def as_query(result: Query | NotUnderstood) -> Query:
    """A query in any case: what was not understood is an ambiguous one."""
    return result if isinstance(result, Query) else Query(type="ambiguous", tense="present")
