"""Trends: "is the gap shrinking", "did the distance grow", "is the headway getting longer"."""

from typing import Any, cast

from xavi_dialogue.domain.terms import Ago, Compares, Measured, Proposition, Quantity, Unsaid
from xavi_dialogue.nlu.compose.adoption import with_fields
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.sem import Measure, as_thing

SINCE = 3.0  # [s] ago, with which a value is compared that is said to change
_DIRECTIONS: dict[str, str] = {
    "shrink": "less", "decrease": "less", "drop": "less", "fall": "less", "narrow": "less",
    "reduce": "less", "grow": "more", "increase": "more", "rise": "more", "widen": "more",
    "big": "more", "high": "more", "long": "more", "far": "more", "wide": "more", "fast": "more",
    "small": "less", "low": "less", "close": "less", "slow": "less", "short": "less",
}  # fmt: skip


def trend(clause: Clause) -> Proposition | None:
    """Read that a measure changes as a comparison with what it was shortly before."""
    if not isinstance(clause.subject, Measure):
        return None
    words = [key for key, _ in (*clause.comparisons, *clause.adjectives)]
    words += [clause.verb.key] if clause.verb is not None else []
    way = next((_DIRECTIONS[word] for word in words if word in _DIRECTIONS), None)
    if way is None:
        return None
    of = clause.subject.of
    now = with_fields(of, tense=cast(Any, clause.tense))
    then = clause.time if not isinstance(clause.time, Unsaid) else Ago(SINCE)
    return Compares(now, cast(Any, way), with_fields(of, time=then, tense="past"))


def nearness(clause: Clause, left: Measured) -> Measured:
    """Tell to whom a distance is, and whether it is told in metres or seconds."""
    if left.attribute != "distance":
        return left
    to = next((t for c in clause.complements if (t := as_thing(c.sem)) is not None), None)
    seconds = isinstance(clause.than, Quantity) and clause.than.unit == "s"
    fields: dict[str, Any] = {"to": to, "attribute": "headway" if seconds else "distance"}
    return cast(Measured, with_fields(left, **fields))
