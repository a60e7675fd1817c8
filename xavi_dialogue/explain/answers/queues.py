"""Queues: who stands at the head of the queue that we stand in."""

from typing import Final

from xavi_dialogue.domain.answers import Answer
from xavi_dialogue.domain.facts import Somebody
from xavi_dialogue.domain.meaning import Which
from xavi_dialogue.domain.terms import Ego, Feature, Proposition, Related, Vehicle, Wanted
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
    return which(question, asked) if first is None else identified(asked, first, asked.moment)


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
