"""Ready: what the ego slowed down for though it did not come to it.

It was ready to let somebody go first who might have come; or it had decided to turn.
"""

from collections.abc import Collection
from itertools import pairwise

from xavi_dialogue.causal.holdups import hold_ups
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.explain.causes.contrast import factual
from xavi_dialogue.explain.history.ride import Ride, Unanswered, planned

AHEAD = 1.0  # [s] before an episode, in which the decision for it may lie
TURNS = frozenset(("exit-left", "exit-right"))
LEAST = 0.05  # share of the rollouts of a plan in which somebody must have held it up


def ready_for(ride: Ride, deed: Episode, cleared: Collection[int]) -> MotionCause | None:
    """Find who had right of way and might have come first, in the decisions of an episode.

    Who holds the plan up longest in the mean; vehicles that make no difference are left out.
    """
    end = ride.now if deed.end is None else deed.end
    found: dict[int, float] = {}
    for trace in ride.traces:
        if not deed.begin - AHEAD <= trace.sim_time <= end or trace.road is None:
            continue
        first = {fact.vehicle for fact in trace.road.priority if fact.who == "vehicle"}
        try:
            held = hold_ups(factual(ride.model(trace), trace), (deed.begin - AHEAD, end))
        except Unanswered:
            continue
        for vehicle, one in held.items():
            if vehicle in first and vehicle not in cleared and one.share >= LEAST:
                found[vehicle] = max(found.get(vehicle, 0.0), one.expected)
    longest = max(found, key=lambda v: found[v], default=None)
    return None if longest is None else MotionCause("give-way-line", longest)


def given_up(ride: Ride, deed: Episode) -> MotionCause | None:
    """Find a turn that was decided during an episode, and that the next decision gave up again."""
    end = ride.now if deed.end is None else deed.end
    for one, after in pairwise(ride.traces):
        if not deed.begin - AHEAD <= one.sim_time <= end or after.under_way is not None:
            continue
        was, then = planned(one)[:1], planned(after)[:1]
        if was != then and set(was) & TURNS:
            return MotionCause("given-up", actions=was)
    return None
