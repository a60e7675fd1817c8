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


class Limits(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """When a reading is believed."""

    cost: float  # no reading may cost more
    decline: float  # nor more than this, where the words show a topic that is declined
    margin: float  # readings that lie closer together are rivals
    readings: int  # rivals shown


class Costs(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """All of parse.toml."""

    skip: dict[str, float]  # by terminal; those not listed are never read past
    outside: Outside
    boundary: Boundary
    base: dict[str, float]  # by start rule
    limits: Limits


@cache
def costs() -> Costs:
    """The cost tables.

    Raises:
        msgspec.ValidationError: a key of parse.toml is missing, unknown or of the wrong type.
    """
    return msgspec.convert(load("parse.toml"), Costs)
