"""Walking: whether we have to let somebody on foot go first."""

from planner.record.trace import ON_FOOT
from sim.scene import EGO
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import Window
from xavi_dialogue.explain.answers.reference.occasions import overlaps
from xavi_dialogue.explain.facts.episodes.waiting import top_holders
from xavi_dialogue.explain.history.restraints import held_by


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
