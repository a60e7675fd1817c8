"""Costs: how the parser weighs what it hears, from `grammars/parse.toml`."""

from functools import cache

import msgspec

from xavi_dialogue.language.wordlists import load


class Outside(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What words before and behind the question cost."""

    before: float  # each
    after: float  # each
    before_limit: float
    after_limit: float
    subordinate: float  # a clause behind it that says when
    compound: float  # a second question behind it
    held: float  # each NOT and IF
    midway: float  # the question begins in the middle of a clause


class Boundary(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Terminals at which a question may begin and end."""

    begin_after: frozenset[str]
    begin_at: frozenset[str]
    end_before: frozenset[str]
    held: frozenset[str]  # never read past, whatever other senses the word has


class Loose(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What it costs to read past words where only the clauses are read."""

    skip: dict[str, float]  # by terminal
    take: dict[str, float]  # what it costs not to read past it, by terminal
    expletive: float  # the same for an "it" where no vehicle was spoken of
    other: float  # of any other terminal
    limit: float  # no reading may cost more
    base: float  # what such a reading costs beside one by the grammar of questions


class Weighing(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """How the grammar and the judge are weighed against one another."""

    judge: float  # cost of a unit of negative log probability
    kinds: int  # how many of the likeliest kinds are read loosely
    topic: float  # cost of declining where a word shows a topic that is declined
    talk: float  # and where none does
    unclear: float  # cost of asking back


class Limits(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """When a reading is believed."""

    cost: float  # no reading may cost more
    margin: float  # readings that lie closer together are rivals
    readings: int  # rivals shown
    offer: float  # readings that cost no more are offered where none is believed
    shorter: float  # a phrase that is not the longest at its place
    sense: float  # each likelier sense that a phrase has
    width: int  # hypotheses followed at each word
    found: int  # readings looked at, the cheapest
    steps: int  # taken for one text


class Costs(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """All of parse.toml."""

    skip: dict[str, float]  # by terminal; those not listed are never read past
    outside: Outside
    boundary: Boundary
    base: dict[str, float]  # by start rule
    limits: Limits
    loose: Loose
    weighing: Weighing


@cache
def costs() -> Costs:
    """The cost tables.

    Raises:
        msgspec.ValidationError: a key of parse.toml is missing, unknown or of the wrong type.
    """
    return msgspec.convert(load("parse.toml"), Costs)
