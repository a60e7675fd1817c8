"""Query: what a passenger wants to know, independent of how it was worded."""

from typing import Literal

import msgspec

QueryType = Literal[
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
Tense = Literal["past", "present", "future"]
Detail = Literal["more", "less"]

#: What passengers call actions: the macro actions, and descriptions that map onto them.
QueryAction = Literal[
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


class Query(msgspec.Struct, frozen=True, kw_only=True):
    """One question, resolved against conversation and scene as far as the words allow.

    `actor` is "ego", "vehicle:N", or a description such as "vehicle:front" that is resolved
    against the scene later.
    """

    type: QueryType
    actor: str = "ego"
    factual: tuple[QueryAction, ...] | None = None  # said to have happened
    counterfactual: tuple[QueryAction, ...] | None = None  # asked about instead
    negated: bool = False  # the counterfactual had not happened, or the vehicle was not there
    tense: Tense = "past"
    time: str | None = None  # the phrase that says when
    detail: Detail | None = None
    refers_to_previous: bool = False
    reason: str | None = None  # with out_of_scope: not-an-action, off-topic, command, ...
    event: str | None = None
    hypothesised_cause: str | None = None
    intervention: str | None = None
    condition: str | None = None
    compound: bool | None = None
    underspecified: str | None = None
