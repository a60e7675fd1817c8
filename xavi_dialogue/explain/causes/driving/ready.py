"""Ready: what the ego slowed down for although it then did not happen.

The ego was ready to let somebody go first who might have come, or to stay behind somebody who would
be in the way of what it put off. Or it was about to change lanes, or had decided to turn.
"""

from collections.abc import Collection
from itertools import pairwise

from planner.record.trace import ON_FOOT, PlanTrace
from xavi_dialogue.causal.holdups import VehicleHoldUp, hold_ups
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.explain.causes.driving.yielding import leads
from xavi_dialogue.explain.causes.plans.contrast import factual
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES
from xavi_dialogue.explain.causes.vehicles.involved import LIKELY
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.ride import Ride, Unanswered, chose, planned

AHEAD = 1.0  # [s] before an episode in which it may have been decided
TURNS = frozenset(("exit-left", "exit-right"))
SOON = 2.5  # [s] after an episode in which a change of lanes belongs to it
LEAST = 0.05  # share of the rollouts of a plan in which somebody must have held it up ...
MIGHT = 0.2  # ... if it is on foot, and may not want to cross


def ready_for(
    ride: Ride, world: World, deed: Episode, cleared: Collection[int]
) -> MotionCause | None:
    """Find who might have come first, or been in our way, in the decisions of an episode.

    It is who holds up the plan, or what a stop puts off, longest in the mean. Vehicles that make
    no difference (`cleared`) are left out.
    """
    end = ride.now if deed.end is None else deed.end
    found: dict[MotionCause, float] = {}
    for trace in ride.traces:
        if not deed.begin - AHEAD <= trace.sim_time <= end or trace.road is None:
            continue
        first = {fact.vehicle for fact in trace.road.priority if fact.who == "vehicle"}
        held = [held for held in _held(ride, trace, deed, end) if held.vehicle not in cleared]
        for one in held:
            ahead = one.share >= LIKELY and leads(world, one.vehicle, deed.begin)
            cause = None
            if one.vehicle in first and one.share >= LEAST:
                cause = MotionCause("give-way-line", one.vehicle)
            elif ahead and chose(trace, "stop"):
                cause = MotionCause("leader", one.vehicle)
            elif _on_foot(trace, one.vehicle) and one.share >= MIGHT and one.began <= end:
                cause = MotionCause("may-go-first", one.vehicle)
            if cause is not None:
                found[cause] = max(found.get(cause, 0.0), one.expected)
    return max(found, key=lambda cause: found[cause], default=None)


def _on_foot(trace: PlanTrace, name: int) -> bool:
    """Check whether a road user is on foot, and so in none of the rules of right of way."""
    return name in trace.scene and trace.scene[name].kind in ON_FOOT


def _held(ride: Ride, trace: PlanTrace, deed: Episode, end: float) -> list[VehicleHoldUp]:
    """Return who holds up a plan during an episode, or, at any time, what a stop puts off."""
    model = ride.model(trace)
    try:
        found = [*hold_ups(factual(model, trace), (deed.begin - AHEAD, end)).values()]
    except Unanswered:
        found = []
    after = model.intervene(planned(trace)[1:2]) if chose(trace, "stop") else None
    return found if after is None else [*found, *hold_ups(after).values()]


def next_move(ride: Ride, trace: PlanTrace, deed: Episode) -> MotionCause | None:
    """Find the lane change that comes second in a plan, if it began soon after, or still may."""
    end = ride.now if deed.end is None else deed.end
    moves = [action for action in planned(trace)[1:2] if action in CHANGES]
    begun = [d.action for d in ride.begun if deed.begin <= d.started <= end + SOON]
    put_off = ride.latest is not trace and end + SOON < ride.now
    if not moves or (put_off and moves[0] not in begun):
        return None
    return MotionCause("next-move", actions=(moves[0],))


def given_up(ride: Ride, deed: Episode) -> MotionCause | None:
    """Find a turn that was decided during an episode, and that the next decision gave up again."""
    end = ride.now if deed.end is None else deed.end
    for one, after in pairwise(ride.traces):
        if not deed.begin - AHEAD <= one.sim_time <= end or after.under_way is not None:
            continue
        was, then = planned(one)[:1], planned(after)[:1]
        driven = any(
            d.action in was and d.started <= one.sim_time <= (d.ended or ride.now) and d.carried_out
            for d in ride.begun
        )
        if was != then and set(was) & TURNS and not driven:
            return MotionCause("given-up", actions=was)
    return None
