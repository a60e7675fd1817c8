"""Walking: whether we have to let somebody on foot go first, by what they do or are about to do."""

from collections.abc import Collection
from typing import Final

from planner.record.trace import ON_FOOT
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.explain.answers.expectations.precedence import red_ahead
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.occasions import overlaps
from xavi_dialogue.explain.facts.episodes.waiting import let_first, top_holders
from xavi_dialogue.explain.history.restraints import held_by

LIKELY: Final = 0.5  # minimum probability, or share of the rollouts


def walks_first(asked: Asked, vehicle: int | None, about: Window, waited: Episode | None) -> bool:
    """Check whether we must let somebody on foot go first, as planned or done."""
    if vehicle is None:
        return False
    look, trace = asked.world.look(vehicle, about.end), asked.world.states.trace(about.end)
    if look is None or look.kind not in ON_FOOT or trace is None:
        return False
    crossing = asked.world.episodes(actor=Vehicle(vehicle), actions=("cross",), object=Ego())
    first = waited is not None or any(overlaps(asked, e, about) for e in crossing)
    first = first or bool(held_by(asked.ride, vehicle, about.begin, about.end))
    return first or (vehicle, "right-of-way") in top_holders(asked.world.states, trace, EGO)


def about_to_cross(asked: Asked, vehicle: int | None) -> bool:
    """Check whether we are likely to let somebody on foot go first, by the present decision.

    At a red light, it is the light that holds us.
    """
    trace = asked.world.states.trace(asked.now)
    if trace is None or red_ahead(trace.road) or vehicle is None:
        return False
    held = bool(held_by(asked.ride, vehicle, asked.now, asked.now))
    return in_view(asked, vehicle, ON_FOOT) and (held or let_first(trace, vehicle) >= LIKELY)


def in_view(asked: Asked, vehicle: int, kinds: Collection[str]) -> bool:
    """Check whether a road user is in view now and of one of some kinds."""
    look = asked.world.look(vehicle, asked.now)
    return look is not None and look.in_view and look.kind in kinds
