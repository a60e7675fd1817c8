"""Trends: "is the gap shrinking", "did the distance grow", "is the headway getting longer"."""

from typing import Any, cast

from xavi_dialogue.domain.terms import (
    Ago,
    Both,
    Compares,
    Ego,
    Event,
    Exists,
    Happens,
    Measured,
    Proposition,
    Quantity,
    Time,
    Unsaid,
)
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Measure, as_thing

SINCE = 3.0  # [s] ago, with which a value is compared that is said to change
_DIRECTIONS: dict[str, str] = {
    "shrink": "less", "decrease": "less", "drop": "less", "fall": "less", "narrow": "less",
    "reduce": "less", "grow": "more", "increase": "more", "rise": "more", "widen": "more",
    "big": "more", "high": "more", "long": "more", "far": "more", "wide": "more", "fast": "more",
    "jump": "more", "leap": "more", "shoot": "more", "go": "more", "move": "more",
    "up": "more", "down": "less",
    "small": "less", "low": "less", "close": "less", "slow": "less", "short": "less",
}  # fmt: skip


def trend(clause: Clause) -> Proposition | None:
    """Read that a measure changes as a comparison with what it was shortly before."""
    of = _shifting(clause)
    if of is None:
        return None
    words = [key for key, _ in (*clause.comparisons, *clause.adjectives)]
    words += [leaf.key for leaf in clause.particles]
    words += [clause.verb.key] if clause.verb is not None else []
    way = next((_DIRECTIONS[word] for word in words if word in _DIRECTIONS), None)
    changes = isinstance(clause.subject, Measure) and bool(_CHANGING.intersection(words))
    if way is None:
        return changed(of, clause.tense, clause.time) if changes else None
    return _compared(of, way, clause.tense, clause.time)


def as_slowing(of: Proposition | None) -> Proposition | None:
    """Read "our speed dropped" as slowing down, where the reason is asked for."""
    match of:
        case Compares(
            left=Measured(attribute="speed", thing=thing, tense=tense),
            comparator="less" | "more" as way,
            right=Measured(attribute="speed") | Quantity() as right,
        ) if tense in ("past", "perfect"):
            slower = way == "less"
            if isinstance(right, Measured) and right.thing == thing:
                return Happens(Event("slow-down" if slower else "speed-up", thing, tense=tense))
            if isinstance(right, Quantity) and slower:
                return Happens(Event("slow-down", thing, tense=tense))
    return of


_CHANGING = frozenset({"change", "vary", "alter"})


def changed(of: Measured, tense: str, time: Time) -> Proposition:
    """Ask of a measure whether it has become less or more: "has the gap changed?"."""
    return Both(tuple(_compared(of, way, tense, time) for way in ("less", "more")), "or")


def _compared(of: Measured, way: str, tense: str, time: Time) -> Proposition:
    at = "present" if tense == "perfect" else tense  # "has it been growing": it is more by now
    now = cast(Measured, with_fields(of, tense=cast(Any, at)))
    then = Ago(SINCE) if isinstance(time, Unsaid) else time
    if isinstance(then, Ago) and then.span:  # "over the last ten seconds": against their beginning
        then = Ago(then.seconds)
    return Compares(now, cast(Any, way), with_fields(of, time=then, tense="past"))


def _shifting(clause: Clause) -> Measured | None:
    """Tell what changes: a measure, or of a deed that is expected how probable it is."""
    sem = clause.subject
    if isinstance(sem, Measure):
        return sem.of
    if not isinstance(sem, Event) or clause.verb is None:
        return None
    if isinstance(sem.actor, Ego) and sem.object is not None:  # "exit-right for vehicle 1"
        sem = with_fields(sem, actor=sem.object, object=None)
    return Measured("probability", about=Happens(sem))


def believed(of: Measured) -> Proposition | None:
    """Tell of what a probability is."""
    if of.about is not None or of.event is not None:
        return of.about or Happens(cast(Event, of.event))
    return None if isinstance(of.thing, Ego) else Exists(of.thing)


def nearness(clause: Clause, left: Measured) -> Measured:
    """Tell to whom a distance is, and whether it is stated in metres or seconds."""
    if left.attribute != "distance":
        return left
    to = next((t for c in clause.complements if (t := as_thing(c.sem)) is not None), None)
    seconds = isinstance(clause.than, Quantity) and clause.than.unit == "s"
    fields: dict[str, Any] = {"to": to, "attribute": "headway" if seconds else "distance"}
    return cast(Measured, with_fields(left, **fields))
