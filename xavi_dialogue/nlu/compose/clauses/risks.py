"""Risks: questions about the risk of something that the ego may do."""

from typing import Any, Final, cast

from msgspec.structs import replace

from xavi_dialogue.domain.meaning import Question, Whether, Which
from xavi_dialogue.domain.terms import Ego, Event, Is, Lane, Measured, Pronoun, Tense, Thing, Wanted
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Measure, Noun, Sem

_SIDES: Final = ("left", "right")
#: Actions that the ego may choose, each with a risk of its own.
_CHOSEN: Final = frozenset[ActionName](
    ("change-left", "change-right", "change-lane", "exit-left", "exit-right", "exit-straight",
     "turn", "stop", "continue", "continue-next-exit", "overtake", "pass", "merge", "keep-lane")
)  # fmt: skip


def is_danger(sem: object) -> bool:
    """Say whether a thing is called a danger or a risk: "who is the threat?"."""
    if isinstance(sem, Noun):
        return sem.key in ("problem", "danger")
    crash = sem.of.event if isinstance(sem, Measure) and sem.of.attribute == "probability" else None
    return crash is not None and crash.action == "collide" and crash.object is None


def who_endangers(clause: Clause) -> Question:
    """Read "who is the threat?" as the question who is dangerous."""
    state = Is("dangerous", Wanted(), time=clause.time, tense=cast(Any, clause.tense))
    return Which(Wanted(), state)


def risk_of(key: str, of: Sem | None, event: Event | None, side: str | None) -> Measure | None:
    """Read "the risk of stopping", "the risk on the left" as the risk of an action of the ego.

    A chance is a risk if it is that of a crash beside the ego. None if it is no such risk.
    """
    crash = event is not None and event.action == "collide" and event.object is None
    if key not in ("risk", "probability") or (key != "risk" and not crash):
        return None
    deed = _moving(of, side) if event is None or crash else event
    if deed is None or deed.actor != Ego() or deed.action not in _CHOSEN:
        return None
    return Measure(Measured("probability", about=Is("dangerous", event=deed)))


def risk_asked(measured: Measured, tense: Tense) -> Question | None:
    """Return the question how risky an action is; None if a measure is not the risk of one."""
    match measured.about:
        case Is(state="dangerous", event=Event() as deed):
            return _risk(replace(deed, tense=tense))
    return None


def moving_in(clause: Clause, thing: Thing | None) -> Event | None:
    """Return the change of lanes that is called risky: "the left lane is", "it is on the left"."""
    if thing is not None and not isinstance(thing, Lane) and thing != Pronoun("it"):
        return None
    lanes = [part.sem for part in clause.complements if isinstance(part.sem, Lane)]
    side = next((side for side, _ in clause.bearings), None)
    found = _moving(thing if isinstance(thing, Lane) else next(iter(lanes), None), side)
    return None if found is None else replace(found, tense=cast(Any, clause.tense))


def crash_beside(clause: Clause, deed: Event) -> Question | None:
    """Return the question how risky a change of lanes is: "how likely is a crash on the left?"."""
    crash = deed.action == "collide" and deed.object is None
    change = moving_in(clause, None) if crash else None
    return None if change is None else _risk(change)


def risk_beside(clause: Clause, sem: Sem | None) -> Question | None:
    """Return the question how risky a change of lanes is: "what is the risk on the left?"."""
    chance = isinstance(sem, Measure) and sem.of.attribute == "probability"
    crash = sem.of.event if chance and isinstance(sem, Measure) else None
    return None if crash is None else crash_beside(clause, crash)


def _risk(deed: Event) -> Question:
    return Whether(Is("dangerous", event=deed, tense=deed.tense), degree=True)


def _moving(where: Sem | None, side: str | None) -> Event | None:
    """Return the change of lanes that the lane beside the ego, or a side, stands for."""
    beside = where.which if isinstance(where, Lane) else side
    return Event(cast(Any, f"change-{beside}"), tense="present") if beside in _SIDES else None
