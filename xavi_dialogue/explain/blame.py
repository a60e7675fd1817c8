"""Blame: a vehicle that a question takes for the cause, though it has no influence."""

from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.holdups import hold_ups
from xavi_dialogue.causal.influence import influence
from xavi_dialogue.causal.model import Intervention
from xavi_dialogue.explain.causes import LONGER
from xavi_dialogue.explain.query import Query
from xavi_dialogue.explain.ride import Ride, decline
from xavi_dialogue.explain.vehicles import check_known, number_of

#: `Query.event` of questions about what a vehicle had to do with it. Those are declined where the
#: answer is nothing; whether it was because of a vehicle is answered with no.
INFLUENCE = "influence"


def blamed(query: Query) -> int | None:
    """The vehicle that a question takes for the cause, where it is another's."""
    number = number_of(query.hypothesised_cause or "")
    return None if number == EGO else number


def decision_at(ride: Ride, time: float | None) -> PlanTrace:
    """The last decision of the ride up to a time [s].

    Raises:
        Unanswered: there is none.
    """
    found = ride.at(ride.now if time is None else time)
    return ride.latest if found is None else found


def check_influence(ride: Ride, vehicle: int, trace: PlanTrace) -> None:
    """Decline where the record of a decision shows no influence of a vehicle on it.

    That is where the mutual information of its behaviour and the choice among all first actions
    does not exceed what chance produces; and where under none of them, those apart that leave the
    way to the goal, it is collided with or expected to hold the ego up; and the ego did not give
    way to it since.

    Facts: `bits` [bit] where there was a choice, and `null` [bit] its 95 % point by chance, which
    is left out where there is nothing to compare with it; `seen` is False where the decision
    did not reckon with the vehicle at all.

    Raises:
        Unanswered: there is no influence; or the vehicle is unknown.
    """
    check_known(ride, vehicle)
    model = ride.model(trace)
    if vehicle not in model.vehicles:
        raise decline("no-influence", vehicle=vehicle, seen=False, time=trace.sim_time)
    options = [i for a in model.options() if (i := model.intervene((a,))) is not None]
    waited = any(e.vehicle == vehicle for e in ride.events if e.sim_time >= trace.sim_time)
    if waited or any(_concerns(option, vehicle) for option in options):
        return
    measured = next((found for found in influence(model) if found.vehicle == vehicle), None)
    if measured is not None and measured.significant:
        return
    bits, null = (measured.bits, measured.null) if measured is not None else (None, None)
    time = trace.sim_time
    raise decline("no-influence", vehicle=vehicle, bits=bits, null=null, seen=True, time=time)


def _concerns(option: Intervention, vehicle: int) -> bool:
    """Whether a vehicle is in the way under an option that leads to the goal."""
    if option.likeliest == "dead":
        return False
    held = hold_ups(option).get(vehicle)
    delays = held is not None and held.expected >= LONGER
    return delays or vehicle in option.collisions()
