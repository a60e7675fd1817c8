"""Pacing: how fast somebody is said to go, beside a number or the limit."""

from typing import Any

from msgspec import structs

from xavi_dialogue.domain.terms import (
    Both,
    Compares,
    Ego,
    Happens,
    Measured,
    Not,
    Proposition,
    Quantity,
    Unsaid,
    WholeRide,
)
from xavi_dialogue.nlu.compose.clauses.candidates import Special
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Measure, as_speed
from xavi_dialogue.nlu.compose.clauses.tree import words_of
from xavi_dialogue.nlu.compose.verbs.deeds import tense_of, time_of

_ABOVE = frozenset({"over", "above", "more", "beyond"})
_BELOW = frozenset({"under", "below", "less", "down", "down to"})
_PACED = frozenset({"speed-up", "slow-down", "brake", "stand", "continue", "come", "go", "move",
                    "approach", "keep-lane", "enter", "cross", "pass", "overtake"})  # fmt: skip
_TO_PACE = frozenset({"into", "at"})


def exceed(special: Special) -> Proposition:
    """Read "do sixty", "drive over the limit": our speed beside a number, or the limit."""
    time, tense = time_of(special), tense_of(special)
    if "ever" in special.clause.focus and isinstance(time, Unsaid) and tense != "present":
        time = WholeRide()  # "did we ever get above 60?"
    speed = Measured("speed", special.subject, time=time, tense=tense)
    limit = Measured("limit", special.subject)
    beside = next((special.match.phrases[key] for key in ("over", "into", "bearing-behind")
                   if key in special.match.phrases), None)  # fmt: skip
    said = beside if isinstance(beside, Quantity) else special.object
    if isinstance(said, Quantity):
        said = as_speed(said)
        nodes = [node for _, node in special.clause.objects]
        nodes += [phrase.node for phrase in special.clause.complements if phrase.sem == beside]
        words = {word for node in nodes for word in words_of(node).split()}
        more = special.clause.verb is None or special.clause.verb.key not in ("do", "go", "drive")
        below = "over" in special.match.phrases and bool(words & _BELOW)  # "stay below 40"
        more = (more or bool(words & _ABOVE)) and not below
        less: Any = "less" if words & _BELOW else "same"
        return Compares(speed, "more" if more else less, said)
    return Compares(speed, "more", limit)


def pace_said(clause: Clause) -> Quantity | None:
    """Find the speed that a clause tells with a preposition: "to 40", "at 60 km/h"."""
    for phrase in clause.complements:
        sem = phrase.sem
        if phrase.key in _TO_PACE and isinstance(sem, Quantity) and sem.unit in ("count", "m/s"):
            return as_speed(sem)
    return None


def at_pace(clause: Clause, of: Proposition) -> Proposition:
    """Read "if it had sped up to 40", "if it came at 60" as how fast it would have been."""
    if isinstance(of, Not):
        return Not(at_pace(clause, of.content))
    said = pace_said(clause)
    if said is None or not isinstance(of, Happens) or of.event.action not in _PACED:
        return of
    event = of.event
    return Compares(
        Measured("speed", event.actor, time=event.time, tense=event.tense), "same", said
    )


def is_by_the_law(clause: Clause) -> bool:
    """Tell whether a clause asks if we did something "by the book", whatever it was."""
    ours = isinstance(clause.subject, Ego) and clause.verb is not None and clause.that is None
    return ours and any(key == "allowed" for key, _ in clause.adjectives) and not clause.has("be")


def kept_to(special: Special) -> Proposition | None:
    """Read "are we keeping to the limit?"; None where it is the law that is kept."""
    clause = special.clause
    kept = [*(sem for sem, _ in clause.objects), *(phrase.sem for phrase in clause.complements)]
    if not any(isinstance(sem, Measure) and sem.of.attribute == "limit" for sem in kept):
        return None
    speed = Measured("speed", special.subject, time=time_of(special), tense=tense_of(special))
    limit = Measured("limit", special.subject)
    within = Compares(speed, "at-most", limit)
    return Not(within) if clause.negated else within


_PERMITTED = frozenset(
    {"safe", "allowed", "right", "possible", "fast", "better", "safely"}
)  # what a speed is said to be


def permitted(clause: Clause) -> Proposition | None:
    """Read "is 50 ok here", "is 80 too fast": whether the limit is as high as that."""
    speed = clause.subject
    said = [*(key for key, _ in clause.adjectives), *clause.manner]
    if clause.verb is not None or not isinstance(speed, Quantity) or not said:
        return None
    speed = as_speed(speed)
    key = said[0]
    if speed.unit != "m/s" or key not in _PERMITTED:
        return None
    lower = key == "fast"
    return Compares(Measured("limit", time=clause.time), "less" if lower else "at-least", speed)


def not_rather(clause: Clause, of: Proposition, propositions: Any) -> Proposition:
    """Take "he turns off and does not just stop" for which of the two he does."""
    denied = [c for join, c in clause.chained if join in ("and", "but") and c.negated]
    if not denied or not isinstance(of, Happens) or isinstance(of.event.actor, Ego):
        return of
    if of.event.tense in ("past", "perfect"):
        return of
    other = propositions.plain(denied[0])
    if not isinstance(other, Not) or not isinstance(other.content, Happens):
        return of
    propositions.notes.taken.add(id(denied[0]))
    rival = structs.replace(other.content.event, actor=of.event.actor, tense=of.event.tense)
    return Both((of, Happens(rival)), "or")
