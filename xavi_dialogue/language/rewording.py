"""Rewording: what is said in short, or in words that mislead, is read in other words.

"How fast we going" lacks its verb, "anyone coming from the right" asks what a car there does. And
what nobody can tell from the record, as whether others see us, is declined by its words. Patterns
stand in `grammars/aspects.toml`.
"""

import re
from dataclasses import dataclass
from functools import cache

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.aspects import pattern
from xavi_dialogue.language.wordlists import load

_NONE = "none"  # where there is no question before


@dataclass(frozen=True, slots=True)
class _Rewording:
    """One entry of the file."""

    find: re.Pattern[str]
    put: str
    reason: str | None  # why it would be declined otherwise; None: whatever it was taken for
    after: frozenset[str]  # types of the question before, or "none"; empty: any
    spoken_of: str | None  # ego or vehicle: whom that was about


def reworded(result: object, words: tuple[str, ...], previous: Query | None) -> str | None:
    """What to read instead of a text; None where it stands as it is.

    Args:
        result: what it was taken for.
        words: of the text, spelling corrected.
        previous: the question before it.
    """
    text = " ".join(words)
    for one in _rewordings():
        if (match := one.find.fullmatch(text)) and _holds(one, result, previous):
            named = previous.actor.replace(":", " ") if previous else ""
            return match.expand(one.put).replace("<it>", named)
    return None


def declined(words: tuple[str, ...]) -> Query | None:
    """The query of what is always declined in these words; None for other texts."""
    text = " ".join(words)
    data = load("aspects.toml")
    for one in data["declined"]:
        if any(pattern(find).fullmatch(text) for find in one["find"]):
            return Query(type="out_of_scope", reason=one["reason"], tense="present")
    return None


@cache
def _rewordings() -> tuple[_Rewording, ...]:
    return tuple(
        _Rewording(
            pattern(one["find"]),
            one["put"],
            one.get("reason"),
            frozenset(one.get("after", ())),
            one.get("spoken_of"),
        )
        for one in load("aspects.toml")["reworded"]
    )


def _holds(one: _Rewording, result: object, previous: Query | None) -> bool:
    """Whether a rewording is meant for what a text was taken for, and for what it follows."""
    if one.reason is not None:
        declines = isinstance(result, Query) and result.type == "out_of_scope"
        return isinstance(result, Query) and declines and result.reason == one.reason
    if one.after and (_NONE if previous is None else previous.type) not in one.after:
        return False
    numbered = previous is not None and previous.actor.removeprefix("vehicle:").isdecimal()
    return one.spoken_of is None or (one.spoken_of == "vehicle") == numbered
