"""Passed: whether somebody whom the ego had to let go first is no longer in its way."""

import math

from sim.scene import EGO
from xavi_dialogue.explain.facts.states import States, states_of
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.explain.history.thresholds import SAME_LANE

AWAY = 0.2  # [m/s] minimum speed sideways, away from our lane


def has_passed(ride: Ride, vehicle: int | None, time: float) -> bool:
    """Check whether a road user is behind us at a time [s], out of sight, or beyond our lane.

    Who is beside our lane has passed it only if he moves away from it.
    """
    if vehicle is None:
        return False
    states = states_of(ride)
    seen = states.offset(EGO, vehicle, time)
    if seen is None:
        return states.seen(vehicle).motion.index(time) is not None
    if seen.ahead + seen.clear < 0.0:
        return True
    state = states.state(vehicle, time)
    if state is None or abs(seen.left) <= SAME_LANE + _reach(states, vehicle, seen.turn):
        return False
    return math.copysign(1.0, seen.left) * state.speed * math.sin(seen.turn) > AWAY


def _reach(states: States, vehicle: int, turn: float) -> float:
    """Return how far [m] a road user reaches sideways from its centre."""
    shape = states.shape(vehicle)
    return 0.0 if shape is None else abs(math.sin(turn)) * shape.length / 2.0
