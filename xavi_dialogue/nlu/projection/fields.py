"""Fields: a question as flat fields, see docs/language.md."""

from typing import Literal, TypeAlias

import msgspec

QueryType: TypeAlias = Literal[
    "why",
    "why_not",
    "what_if",
    "what",
    "how",
    "how_avoid",
    "where_goal",
    "when",
    "confidence",
    "compare",
    "sensitivity",
    "smalltalk",
    "help",
    "out_of_scope",
    "ambiguous",
]
FieldTense: TypeAlias = Literal["past", "present", "future"]
#: The macro actions, and the manoeuvres beside them that the fields tell apart.
FieldAction: TypeAlias = Literal[
    "continue",
    "change-left",
    "change-right",
    "exit-left",
    "exit-right",
    "exit-straight",
    "continue-next-exit",
    "stop",
    "give-way",
    "slow-down",
    "speed-up",
    "overtake",
]
FieldActions: TypeAlias = tuple[FieldAction, ...]


class QueryFields(msgspec.Struct, frozen=True, kw_only=True):
    """What a question asks, as flat fields: a projection of its first act, for scoring alone."""

    type: QueryType
    actor: str = "ego"  # "ego", "vehicle:N", or described: "vehicle:front"
    factual: FieldActions | None = None  # said to have happened
    counterfactual: FieldActions | None = None  # asked about instead
    negated: bool = False  # the counterfactual had not happened, or the vehicle were not there
    tense: FieldTense = "past"
    time: str | None = None  # the words that say when
    detail: Literal["more", "less"] | None = None
    refers_to_previous: bool = False
    reason: str | None = None  # with out_of_scope: why it is declined
    event: str | None = None  # what is asked about beside the actions
    hypothesised_cause: str | None = None
    intervention: str | None = None
    condition: str | None = None
    compound: bool | None = None
    underspecified: str | None = None


TALK: frozenset[QueryType] = frozenset(("smalltalk", "help", "out_of_scope", "ambiguous"))
