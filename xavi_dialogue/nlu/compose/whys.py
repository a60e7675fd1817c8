"""Whys: questions after reasons that are no whole clause: "why so slow", "why didn't you?"."""

from typing import Any

from xavi_dialogue.domain.meaning import Act, Ask, Elliptic, Why
from xavi_dialogue.domain.terms import (
    Compares,
    Ego,
    Event,
    Happens,
    Measured,
    Not,
    Quantity,
)
from xavi_dialogue.nlu.compose.clause import Clause
from xavi_dialogue.nlu.compose.sem import Measure, Noun, as_thing
from xavi_dialogue.nlu.compose.wh import Wh

COST = 0.1  # of a question without a verb
_CHANGES: dict[str, Any] = {"deceleration": "slow-down", "acceleration": "speed-up"}
SPEEDS = 20  # from which a bare number may be a speed in km/h


def pace_asked(composer: Any, clause: Clause) -> list[tuple[tuple[Act, ...], float]] | None:
    """Read what stands after "why" as a pace or state of ours; None where it is none."""
    if clause.verb is not None or clause.bare is not None or clause.gerund is not None:
        return None
    sem = clause.objects[0][0] if len(clause.objects) == 1 else None
    if isinstance(sem, Measure) and sem.of.attribute in ("delay", "waiting-time"):
        return [((Ask(Why(Compares(Measured("delay"), "more"))),), COST)]
    limited = bool(clause.focus & {"only", "just", "merely"})
    bare = isinstance(sem, Quantity) and sem.unit == "count"
    number = isinstance(sem, Quantity) and bare and (limited or _is_speed(sem.value))
    limited = limited or bare
    if number or (isinstance(sem, Quantity) and sem.unit == "m/s"):
        speed = Compares(Measured("speed"), "less" if limited else "more")
        return [((Ask(Why(speed)),), COST)]
    paced = any(manner in ("slowly", "fast") for manner in clause.manner)
    if clause.objects or clause.subject is not None or not (clause.adjectives or paced):
        return None
    if clause.adjectives:
        clause.subject = Ego()
        found = composer.questions.of(Wh("why"), clause)
        return [((Ask(question),), cost + COST) for question, cost in found] or None
    event = Happens(Event("move", manner=tuple(clause.manner), time=clause.time, tense="present"))
    return [((Ask(Why(Not(event) if clause.negated else event)),), COST)]


def _is_speed(number: float) -> bool:
    """Say whether a bare number is one that limits have, and few vehicles."""
    return number >= SPEEDS and number % 10 == 0


def lacking(clause: Clause) -> Act:
    """Read "why didn't you?", "why did he?": why, or why not, of what was said before."""
    subject = as_thing(clause.subject)
    thing = None if isinstance(subject, Ego) else subject
    form: Any = "why-not" if clause.negated else "why"
    return Elliptic(thing, negated=clause.negated, form=form)


def reason_for(sem: Measure | Noun, clause: Clause) -> Why | None:
    """Read "the reason for the lane change?", "reason for the deceleration?"."""
    if not isinstance(sem, Noun) or sem.key != "reason" or sem.plural:
        return None
    for phrase in clause.complements:
        if phrase.key in ("for", "behind") and phrase.sem is not None:
            if isinstance(phrase.sem, Event):
                return Why(Happens(phrase.sem))
            if isinstance(phrase.sem, Measure) and phrase.sem.of.attribute in _CHANGES:
                return Why(Happens(Event(_CHANGES[phrase.sem.of.attribute], time=clause.time)))
    return None


def sided(side: str | None) -> Event | None:
    """Take a side that is named alone for the turn to it."""
    actions: dict[str, Any] = {
        "left": "exit-left",
        "right": "exit-right",
        "straight": "exit-straight",
    }
    return Event(actions[side]) if side in actions else None
