"""Taken: which of the roads that others were expected to take they were seen on."""

import math

from planner.record.trace import PlanTrace
from xavi_dialogue.domain.facts import Belief, Expectation
from xavi_dialogue.domain.terms import Vehicle
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.answers.reference.moments import SHORT


def last_turn(asked: Asked, vehicle: int, before: float) -> float:
    """Return when [s] a vehicle was last through a junction before a time [s].

    What was expected until then was of that junction.
    """
    ways: tuple[ActionName, ...] = ("exit-left", "exit-right", "exit-straight")
    found = asked.world.episodes(actor=Vehicle(vehicle), actions=ways, end=before)
    over = [e.end for e in found if e.end is not None and e.end < before - SHORT]
    return max(over, default=-math.inf)


def took(asked: Asked, belief: Belief, expected: Expectation) -> bool:
    """Check whether a vehicle was seen on the road that it was expected to take.

    Then the belief was right, even if the bend of that road looks like another turn.
    """
    return on_road(asked, belief, expected) is not None


def on_road(asked: Asked, belief: Belief, expected: Expectation) -> float | None:
    """Return when [s] a vehicle was first seen on a road on which it was not at a belief."""
    if expected.place is None:
        return None
    times = [
        trace.sim_time
        for trace in asked.ride.traces
        if trace.sim_time >= belief.time and _is_on(trace, belief.vehicle, expected.place)
    ]
    return times[0] if times and times[0] > belief.time else None


def _is_on(trace: PlanTrace, vehicle: int, edge: str) -> bool:
    place = None if trace.road is None else trace.road.places.get(vehicle)
    return place is not None and place.edge == edge and not place.in_junction
