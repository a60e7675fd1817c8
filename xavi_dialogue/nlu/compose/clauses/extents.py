"""Extents: superlatives with a clause: "the fastest we went", "who is closest"."""

from typing import Any, cast

from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Measured,
    Pronoun,
    Related,
    Vehicle,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Measure
from xavi_dialogue.nlu.compose.clauses.traits import Traits
from xavi_dialogue.nlu.compose.clauses.tree import leaves_of

_EXTENTS: dict[str, tuple[str, str]] = {
    "fastest": ("speed", "highest"), "slowest": ("speed", "lowest"),
    "nearest": ("distance", "lowest"), "farthest": ("distance", "highest"),
    "highest": ("deceleration", "highest"), "lowest": ("deceleration", "lowest"),
}  # fmt: skip
_PACES = ("fastest", "slowest")
_GOING = frozenset({"go", "move", "do"})
SLOWING = frozenset({"brake", "slow-down", "stop"})


def extent_of(traits: Traits) -> Measure | None:
    """Read "the fastest we went", "the closest it came to us" as the extreme of a measure."""
    event, extreme = traits.event, traits.extreme or ""
    match traits.clause:
        case Related("same-as", Ego(), Wanted(), time=time, tense=tense) if extreme in _PACES:
            of = Measured("speed", Ego(), time=time, tense=tense)  # "the fastest we have been"
            return Measure(of, cast(Any, _EXTENTS[extreme][1]))
    if event is None or isinstance(event.actor, Wanted):
        return None
    if extreme == "difficult" and event.action in SLOWING:
        extreme = "highest"  # "the hardest it braked"
    if extreme in ("fastest", "highest") and event.action in _GOING and _may(event, traits):
        return Measure(Measured("limit"))
    if extreme not in _EXTENTS:
        return None
    attribute, which = _EXTENTS[extreme]
    if (attribute == "deceleration") != (event.action in SLOWING):
        return None
    other = event.object if isinstance(event.object, (Ego, Described, Vehicle, Pronoun)) else None
    if other is None and not isinstance(event.actor, Ego):
        other = Ego()
    of = Measured(cast(Any, attribute), event.actor, other if attribute == "distance" else None,
                  time=event.time, tense=event.tense)  # fmt: skip
    return Measure(of, cast(Any, which))


def _may(event: Event, traits: Traits) -> bool:
    """Check whether a relative clause says what is allowed: "the most you may do"."""
    able = event.modal in ("can", "could", "should", "might") and event.tense == "present"
    inner = () if traits.gerund is None else leaves_of(traits.gerund)
    return able or any((leaf.category, leaf.key) == ("SEMI", "allowed") for leaf in inner)


def extreme_of(clause: Clause) -> str | None:
    """Return by what one of several stands out: "who is closest?"."""
    for sem, _ in clause.objects:
        extreme = getattr(sem, "extreme", None)
        if extreme in ("nearest", "farthest", "fastest", "slowest", "biggest"):
            return cast(str, extreme)
    told = (_OUTSTANDING.get(word) for word in sorted(clause.focus))
    return next((extreme for extreme in told if extreme), None)


_OUTSTANDING = {"fastest": "fastest", "quickest": "fastest", "slowest": "slowest",
                "nearest": "nearest", "closest": "nearest", "furthest": "farthest",
                "farthest": "farthest", "biggest": "biggest", "largest": "biggest"}  # fmt: skip
