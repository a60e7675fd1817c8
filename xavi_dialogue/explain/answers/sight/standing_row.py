"""Standing row: the vehicles that stand or creep one behind the other ahead of us."""

from typing import Final

from xavi_dialogue.domain.facts import Somebody
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.explain.answers.reference.asked import Asked

APART: Final = 15.0  # [m] maximum gap between two in a queue
SETTING_OFF: Final = 0.8  # [m/s] minimum speed of a head that has set off
SLOW: Final = 3.0  # [m/s] maximum speed of somebody in it


def head(asked: Asked, at: float) -> Vehicle | None:
    """Find the first of the queue ahead of us at a time [s]; None if nobody stands there."""
    row = standing_row(asked, at)
    return row[-1] if row else None


def standing_row(asked: Asked, at: float) -> list[Vehicle]:
    """List who stands or creeps ahead of us in a row at a time [s], the nearest first."""
    row: list[Vehicle] = []
    while (other := _next(asked, row[-1] if row else Ego(), at)) is not None:
        if other in row:
            break
        row.append(other)
    return row


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
