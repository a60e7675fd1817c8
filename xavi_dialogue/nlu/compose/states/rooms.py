"""Rooms: "is there enough room to get past him", "had we space between us and the bus"."""

from collections.abc import Mapping
from typing import Any, Final, Literal, TypeGuard, cast

from xavi_dialogue.domain.terms import (
    Described,
    Ego,
    Event,
    Is,
    Lane,
    Passenger,
    Pronoun,
    Proposition,
    Relative,
    Thing,
    Time,
    Unsaid,
    Vehicle,
)
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.nlu.compose.clauses.clause import Clause
from xavi_dialogue.nlu.compose.clauses.sem import Group, Measure, Sem, as_thing

_OTHERS = (Vehicle, Described, Pronoun, Lane)
#: Lane changes, with the side that they tell by themselves.
_CHANGES: Final[Mapping[ActionName, Literal["left", "right"] | None]] = {
    "change-lane": None, "change-left": "left", "change-right": "right",
}  # fmt: skip


def roomy(clause: Clause, time: Time) -> Proposition:
    """Read a clause that says that there is room, with the vehicle or lane that it is about."""
    named = [as_thing(sem) for phrase in clause.complements for sem in _members(phrase.sem)]
    named += [sem.of.to for sem, _ in clause.objects if isinstance(sem, Measure)]
    inner = clause.inner
    if inner is not None:
        named += [inner.object, inner.actor]
    deed: Event | None = None
    if isinstance(clause.time, Relative):  # "before the red car gets here"
        anchor = clause.time.anchor
        if isinstance(anchor, Event) and isinstance(anchor.actor, Ego):
            deed = anchor  # "when you turned left"
        else:
            named.append(anchor.actor if isinstance(anchor, Event) else anchor)
        time = Unsaid()
    moved = [sem for sem in (inner, *(c.sem for c in clause.complements)) if _changes_lane(sem)]
    named = [_lane_of(sem) for sem in moved] or named
    sides = [b for b, _ in clause.bearings if b in ("left", "right")]
    named += [Lane(cast(Any, side)) for side in sides]
    others = (t for t in named if isinstance(t, _OTHERS) and not isinstance(t, (Ego, Passenger)))
    thing: Thing | None = next(others, None)
    return Is("roomy", thing, event=deed, time=time, tense=cast(Any, clause.tense))


def _changes_lane(sem: object) -> TypeGuard[Event]:
    """Tell whether the room is wanted for a lane change of ours."""
    return isinstance(sem, Event) and sem.action in _CHANGES and isinstance(sem.actor, Ego)


def _lane_of(change: Event) -> Lane:
    """Give the lane that a lane change leads to: of no side, the one beside ours."""
    side = change.side if change.side in ("left", "right") else None
    return Lane(_CHANGES[change.action] or side or "other")


def _members(sem: Sem | None) -> tuple[Sem | None, ...]:
    return sem.members if isinstance(sem, Group) else (sem,)
