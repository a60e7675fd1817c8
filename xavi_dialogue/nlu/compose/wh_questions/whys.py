"""Whys: questions after reasons that are no whole clause: "why so slow", "why didn't you?"."""

from typing import Any

from xavi_dialogue.domain.meaning import Act, Ask, Elliptic, Why
from xavi_dialogue.domain.terms import Compares, Ego, Event, Happens, Measured, Not, Quantity
from xavi_dialogue.nlu.compose.clauses.adoption import with_fields
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.nominal import propose
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Noun, as_speed, as_thing
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh
from xavi_dialogue.nlu.grammar.chart import Node

COST = 0.1  # of a question without a verb
RUN_ON = 0.6  # cost of taking a clause into such a question
SWALLOWED = 1.6  # cost of taking one for a state: "how long are we, going to sit here is dull"
#: How one brakes, by what is said of it.
_MANNERS: dict[str, Any] = {"hard": "hard", "sudden": "suddenly", "suddenly": "suddenly"}
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
        said = as_speed(sem) if isinstance(sem, Quantity) else None
        speed = Compares(Measured("speed"), "less" if limited else "more", said)
        return [((Ask(Why(speed)),), COST)]
    paced = any(manner in ("slowly", "fast") for manner in clause.manner)
    if clause.objects or clause.subject is not None:
        return None
    hard = [_MANNERS[key] for key, _ in clause.adjectives if key in _MANNERS]
    hard += [manner for manner in clause.manner if manner in _MANNERS.values()]
    paced |= any(key in ("slow", "fast") for key, _ in clause.adjectives)
    if hard and not paced:  # "why so hard all of a sudden?"
        hard = list(dict.fromkeys(hard))
        deed = Event("brake", manner=tuple(hard), tense="perfect", time=clause.time)
        return [((Ask(Why(Happens(deed))),), COST)]
    if not (clause.adjectives or paced):
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


def runs_on(unit: Node) -> bool:
    """Say whether a clause of its own follows: "why back to the right, we are faster here"."""
    clauses = [
        index for index, part in enumerate(unit.parts)
        if isinstance(part, Node) and part.name == "that_clause"
    ]  # fmt: skip
    return any(index > 1 for index in clauses)


def swallows(unit: Node) -> bool:
    """Say whether a clause stands where a state should: "how long are we (that) ..."."""
    states = [p for p in unit.parts if isinstance(p, Node) and p.name == "state"]
    firsts = [state.parts[0] for state in states if state.parts]
    return any(isinstance(part, Node) and part.name == "that_clause" for part in firsts)


def lacking(clause: Clause) -> Act | None:
    """Read "why didn't you?", "why did he?": why, or why not, of what was said before.

    A clause with a verb, or with one where its subject would stand, lacks nothing.
    """
    if clause.verb is not None or isinstance(clause.subject, Event):
        return None
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
            of = propose(phrase.sem) if isinstance(phrase.sem, Measure) else None
            if isinstance(of, Happens):
                return Why(Happens(with_fields(of.event, time=clause.time)))
    return None


def sided(side: str | None) -> Event | None:
    """Take a side that is named alone for the turn to it."""
    actions: dict[str, Any] = {
        "left": "exit-left",
        "right": "exit-right",
        "straight": "exit-straight",
    }
    return Event(actions[side]) if side in actions else None
