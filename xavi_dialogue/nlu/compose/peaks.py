"""Peaks: "the hardest moment", "when were we slowest": what was at its most, and when."""

from typing import Any, cast

from msgspec import structs

from xavi_dialogue.domain.meaning import HowMuch, Peak
from xavi_dialogue.domain.terms import Described, Ego, Quantity, Wanted
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.sem import Measure, Moment, Noun, Sem, as_thing

#: What is at its most at a moment, by superlatives and adjectives.
_QUALITIES = {
    "nearest": "closeness", "slowest": "slowness", "fastest": "speed", "difficult": "difficulty",
    "dangerous": "danger", "highest": "difficulty", "lowest": "closeness", "important": "danger",
    "hard": "difficulty", "uncomfortable": "difficulty",
}  # fmt: skip


def quality_of(extreme: str | None, adjectives: list[str]) -> str:
    """Name what is at its most at a moment; "" for nothing."""
    named = [name for name in (extreme, *adjectives) if name in _QUALITIES]
    return _QUALITIES[named[0] or ""] if named else ""


def _most(sem: Sem) -> bool:
    """Say whether a noun phrase is "the most time"."""
    return getattr(sem, "extreme", None) == "highest" or getattr(sem, "unit", "") in ("s", "time")


_EXTREMES = {"slowest": "slowness", "fastest": "speed", "nearest": "closeness",
             "closest": "closeness", "longest": "waiting"}  # fmt: skip


def extreme_told(clause: Clause) -> HowMuch | None:
    """Read "the peak deceleration was about five" as asking for the peak, whatever it was."""
    subject = clause.subject
    if not isinstance(subject, Measure) or subject.extreme is None or clause.verb is not None:
        return None
    if not any(isinstance(sem, Quantity) for sem, _ in clause.objects):
        return None
    of = structs.replace(subject.of, time=clause.time, tense=cast(Any, clause.tense))
    return HowMuch(of, subject.extreme)


def peak_of(clause: Clause) -> Peak | None:
    """Read "when were we slowest", "who came closest to us", "where did you brake hardest"."""
    lost = any(isinstance(s, (Noun, Measure, Moment)) and _most(s) for s, _ in clause.objects)
    if lost and clause.verb is not None and clause.verb.key in ("lose", "waste", "spend", "wait"):
        return Peak("waiting", clause.time)
    words = clause.focus & {*_EXTREMES, "hardest"}
    verb = None if clause.verb is None else clause.verb.key
    if words and (verb is not None or isinstance(clause.subject, (Ego, Wanted))):
        of = "braking" if "hardest" in words else _EXTREMES[min(words)]
        return Peak(cast(Any, of), clause.time)
    objects = [as_thing(sem) for sem, _ in clause.objects]
    thing = objects[0] if verb is None and objects else None
    if not isinstance(thing, Described) or thing.extreme not in _EXTREMES:
        return None
    bare = thing == Described(extreme=thing.extreme, definite=thing.definite)
    ours = isinstance(clause.subject, Ego) and clause.tense != "present"
    return Peak(cast(Any, _EXTREMES[thing.extreme]), clause.time) if bare and ours else None
