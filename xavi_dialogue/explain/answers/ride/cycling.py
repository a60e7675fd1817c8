"""Cycling: whether we have to let a bicycle beside us go straight on, as we turn across its way."""

from typing import Final

from xavi_dialogue.domain.facts import Look
from xavi_dialogue.explain.answers.expectations.precedence import red_ahead
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.ride.walking import LIKELY, about_to_cross, in_view
from xavi_dialogue.explain.facts.episodes.waiting import let_first
from xavi_dialogue.explain.history.restraints import held_by
from xavi_dialogue.explain.history.ride import prediction

BICYCLES: Final = frozenset(("bicycle",))
ASIDE: Final = 1.0  # [m] minimum sideways distance of a bicycle beside us
BESIDE: Final = 4.0  # [m] the maximum
BEHIND: Final = 15.0  # [m] how far back it may be
COMING: Final = 30.0  # [m] maximum distance of the junction at which we turn


def rides_first(asked: Asked, vehicle: int | None, about: Window) -> bool:
    """Check whether we had to let a bicycle go first in a stretch of the ride, as we drove."""
    look = None if vehicle is None else asked.world.look(vehicle, about.end)
    if vehicle is None or look is None or look.kind not in BICYCLES:
        return False
    return bool(held_by(asked.ride, vehicle, about.begin, about.end))


def likely_let(asked: Asked, vehicle: int | None) -> bool:
    """Check whether we are likely to let somebody on foot, or on a bicycle, go first now."""
    return about_to_cross(asked, vehicle) or about_to_ride(asked, vehicle)


def about_to_ride(asked: Asked, vehicle: int | None) -> bool:
    """Check whether we are likely to let a bicycle go first, by the present decision.

    While a red light holds us, rollouts do not tell that: who goes straight on beside us does.
    """
    trace = asked.world.states.trace(asked.now)
    if trace is None or vehicle is None or not in_view(asked, vehicle, BICYCLES):
        return False
    if let_first(trace, vehicle) >= LIKELY:
        return True
    known, look = prediction(trace, vehicle), asked.world.look(vehicle, asked.now)
    straight = sum(g.probability for g in known.goals if g.kind == "exit-straight") if known else 0
    return straight >= LIKELY and look is not None and _beside(asked, look)


def _beside(asked: Asked, look: Look) -> bool:
    """Check whether somebody is or comes beside us, at a red light where we turn right."""
    step, road = asked.world.junction(asked.now), asked.world.road(asked.now)
    if step is None or road is None or not red_ahead(road):
        return False
    turns = step.turn == "exit-right" and step.kind == "junction" and step.distance <= COMING
    beside = -BESIDE < look.left < -ASIDE and not look.oncoming
    return turns and beside and -BEHIND < look.ahead < step.distance + ASIDE
