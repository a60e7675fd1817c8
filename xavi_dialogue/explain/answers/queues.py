"""Queues: who stands at the head of the queue that we stand in."""

from typing import Final

from msgspec.structs import replace

from xavi_dialogue.domain.answers import Answer, Identified
from xavi_dialogue.domain.facts import Episode, Somebody
from xavi_dialogue.domain.meaning import Which
from xavi_dialogue.domain.terms import (
    Between,
    Ego,
    Event,
    Feature,
    Happens,
    Proposition,
    Related,
    Vehicle,
    Wanted,
)
from xavi_dialogue.explain.answers.propositions.identify import identified, which
from xavi_dialogue.explain.answers.reference.asked import Asked

APART: Final = 15.0  # [m] maximum gap between two in a queue
SLOW: Final = 3.0  # [m/s] maximum speed of somebody in it
SETTING_OFF: Final = 0.8  # [m/s] minimum speed of a head that has set off


def who(question: Which, asked: Asked) -> Answer:
    """Return for whom something holds; for the head of a queue, who stands there.

    Raises:
        Unanswered: it presupposes something that did not happen.
    """
    first = head(asked, asked.moment) if is_head(question.such) else None
    if first is not None:
        return identified(asked, first, asked.moment)
    found = which(question, asked)
    match question.such:
        case Happens(Event(time=Between(begin, end))) if isinstance(found, Identified):
            return _at(found, begin, end)
    return found


def _at(found: Identified, begin: float, end: float) -> Identified:
    """Keep the one who did something at just that time: "which of them crossed last?"."""
    deeds = [f for f in found.facts if isinstance(f, Episode) and isinstance(f.actor, Vehicle)]
    exact = [e for e in deeds if (e.begin, e.end) == (begin, end)]
    if len(exact) != 1 or len(deeds) < 2:
        return found
    looks = tuple(x for x in found.looks if Vehicle(x.vehicle) == exact[0].actor)
    return replace(found, looks=looks, facts=(exact[0],))


def is_head(such: Proposition | None) -> bool:
    """Check whether the question is who is at the front of a queue."""
    match such:
        case Related(relation="on" | "ahead-of" | "near", thing=Wanted(), to=Feature("queue")):
            return True
    return False


def head(asked: Asked, at: float) -> Vehicle | None:
    """Find the first of the queue ahead of us at a time [s]; None if nobody stands there."""
    row: list[Vehicle] = []
    while (other := _next(asked, row[-1] if row else Ego(), at)) is not None:
        if other in row:
            break
        row.append(other)
    return row[-1] if row else None


def _next(asked: Asked, one: Somebody, at: float) -> Vehicle | None:
    """Find who stands next and close ahead of somebody."""
    world = asked.world
    near: list[tuple[float, int]] = []
    for v in world.in_view(at):
        other = Vehicle(v)
        look = world.look(v, at)
        if other == one or look is None or look.oncoming or look.speed > SLOW:
            continue
        gap = world.measure("distance", one, at, other).value
        if gap is not None and gap <= APART and world.relation("ahead-of", other, one, at):
            near.append((gap, v))
    return Vehicle(min(near)[1]) if near else None
