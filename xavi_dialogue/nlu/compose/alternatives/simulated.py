"""Simulated: how many simulations or options a decision had, and how they ended."""

from typing import Any, cast

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import HowMany, HowMuch
from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Happens,
    Lane,
    Measured,
    Proposition,
    Tense,
    Wanted,
)
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.risks import moving_in
from xavi_dialogue.nlu.compose.clauses.sem import Group, Noun, Sem
from xavi_dialogue.nlu.compose.wh_questions.wh import Wh

_COUNTED = {"rollout": "simulations", "option": "options"}
#: Verbs of making simulations, and of having options.
_MADE = frozenset({"run", "do", "make", "have", "get", "use", "try", "consider", "weigh", "look",
                   "compare", "evaluate", "explore", "check", "think", "play", "go", "see", "take",
                   "draw", "test", "examine", "calculate", "simulate", "choose", "plan", "perform",
                   "drive", "assess", "rate", "score"})  # fmt: skip
_ENDING = frozenset({"end", "finish", "result", "lead", "come", "conclude", "terminate"})
_MANY = Described(plural=True, definite=False)  # "how many ended in a crash"
_ENDS = frozenset({"collide", "arrive"})


def simulated(wh: Wh, clause: Clause, value: Any) -> HowMuch | HowMany | None:
    """Ask how many simulations or options there were: "how many rollouts ended in a crash?"."""
    bare = wh.kind == "grade" and wh.key == "many" and clause.subject is None
    if (bare or wh.sem == _MANY) and (ended := _ending_in(clause)) is not None:
        return HowMany(replace(_MANY, doing=replace(ended, actor=Wanted())))
    noun = wh.sem if isinstance(wh.sem, Noun) and wh.kind == "count" else None
    noun = noun or _counted(clause.subject, wh)
    if noun is None or noun.key not in _COUNTED:
        return None
    ending = _ending(wh, clause, value)
    if ending is None and clause.verb is not None and clause.verb.key not in _MADE:
        return None
    about = _option(noun, clause) if noun.key == "rollout" else None
    attribute = cast(Any, _COUNTED[noun.key])
    tense: Tense = "perfect" if clause.tense == "perfect" else "past"
    return HowMuch(Measured(attribute, Ego(), None, ending, about, clause.time, tense))


def _counted(subject: Sem | None, wh: Wh) -> Noun | None:
    return (
        subject if isinstance(subject, Noun) and wh.kind == "grade" and wh.key == "many" else None
    )


def _ending(wh: Wh, clause: Clause, value: Any) -> Event | None:
    """Find the event that a simulation ended in."""
    if (ended := _ending_in(clause)) is not None or clause.adjectives:
        return ended
    event = value.event if isinstance(value, Happens) else None
    if event is None or (isinstance(event.actor, Ego) and wh.preposition != "in"):
        return None
    if clause.verb is not None and clause.verb.key in _MADE and event.action not in _ENDS:
        return None
    return Event(event.action, tense="past")


def _ending_in(clause: Clause) -> Event | None:
    """Read "ended in a crash"."""
    over = any(key == "over" for key, _ in clause.adjectives)  # "ended" is read so, too
    if not over and (clause.verb is None or clause.verb.key not in _ENDING):
        return None
    found = (p.sem for p in clause.complements if p.key in ("in", "with", "at", "to", "by"))
    return next((sem for sem in found if isinstance(sem, Event)), None)


def _option(noun: Noun, clause: Clause) -> Proposition | None:
    """Find the option that the simulations are of: "rollouts of stopping"."""
    said = [noun.of, noun.about, *(p.sem for p in clause.complements if p.key in ("of", "for"))]
    flat = [one for sem in said for one in (sem.members if isinstance(sem, Group) else (sem,))]
    deeds = (sem if isinstance(sem, Event) else _lane(clause, sem) for sem in flat)
    return next((Happens(deed) for deed in deeds if deed is not None), None)


def _lane(clause: Clause, sem: Sem | None) -> Event | None:
    """Read a lane as the change to it: "simulations of the left lane"."""
    return moving_in(clause, sem) if isinstance(sem, Lane) else None
