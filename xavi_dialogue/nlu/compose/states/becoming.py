"""Becoming: "getting slower", "got close", "became free"."""

from collections.abc import Callable
from typing import Any, cast

from xavi_dialogue.domain.terms import Event, Happens, Is, Proposition
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.verbs.events import when
from xavi_dialogue.nlu.compose.verbs.trends import trend

_BECOMING = {"slow": "slow-down", "fast": "speed-up", "close": "approach"}
_STATES = frozenset({"stuck", "late", "busy", "free", "far", "dangerous", "visible", "hidden",
                     "lost", "sure"})  # fmt: skip


def become(special: Special, event: Callable[..., Event]) -> Proposition:
    """Read "getting slower", "got close", "became free"."""
    clause = special.clause
    changing = trend(clause)
    if changing is not None:
        return changing
    words = [k for k, _ in clause.adjectives] + [k for k, _ in clause.comparisons]
    words += [manner.removesuffix("ly") for manner in clause.manner]
    for word in words:
        if word in _BECOMING:
            return Happens(event(special, _BECOMING[word], None))
    state = next((word for word in words if word in _STATES), "right")
    deed = clause.subject if isinstance(clause.subject, Event) else None  # "has overtaking become"
    return Is(
        cast(Any, state),
        special.subject if deed is None else None,
        deed,
        time=when(clause, special.match),
        tense=cast(
            Any, "present" if deed is not None and clause.tense == "perfect" else clause.tense
        ),
    )
