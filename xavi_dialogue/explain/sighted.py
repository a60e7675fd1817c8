"""Sighted: what another vehicle was seen to do at the time that a question is about."""

from planner.trace import PlanTrace
from xavi_dialogue.explain.explanation import Activity, Evidence, Explanation
from xavi_dialogue.explain.motion import Sighting
from xavi_dialogue.explain.query import QueryAction
from xavi_dialogue.explain.ride import Ride, decline
from xavi_dialogue.explain.when import Focus, pick

GAP = 1.0  # [s] after which a vehicle that was not seen again was out of view
SPEEDS: tuple[QueryAction, ...] = ("slow-down", "speed-up", "stop")  # told by the speed itself


def sighted(ride: Ride, focus: Focus, vehicle: int, trace: PlanTrace) -> Explanation:
    """What a vehicle was seen to do in a part of the ride.

    Raises:
        Unanswered: it was not seen then.
    """
    motion = ride.motion(vehicle)
    then = motion.until(focus.moment)
    if not then.time or focus.moment - then.time[-1] > GAP:
        raise decline("outside-record", vehicle=vehicle, time=focus.moment)
    seen = [s for s in motion.sightings() if focus.meets(*s.span)]
    if focus.instant:
        seen = [s for s in seen if s.action not in SPEEDS and s.start <= focus.moment <= s.end]
    activity = Activity(
        vehicle, tuple(s.action for s in seen[-2:]), None, then.speed[-1], then.trend
    )
    return Explanation(
        factual=(),
        counterfactual=(),
        outcome=None,
        effects=(),
        causes=(),
        evidence=Evidence("tree", 0, 0, (trace.trace_id,)),
        activity=activity,
        sim_time=trace.sim_time,
        moment=focus.moment if focus.instant or not seen else seen[-1].start,
        instant=focus.instant,
    )


def last_time(ride: Ride, vehicle: int, action: QueryAction) -> Sighting | None:
    """The last time that a vehicle did something; at the time asked about, if any."""
    return pick(ride.past, ride.motion(vehicle).times(action), lambda s: s.span)
