"""Profile: the speed of the ego by place, under a plan.

Two plans are compared place by place, not moment by moment. A plan that comes to a bend sooner also
slows down for it sooner, and loses nothing by that.
"""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from planner.record.trace import SAMPLE_PERIOD, PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.model import Intervention
from xavi_dialogue.explain.causes.vehicles.course import lines
from xavi_dialogue.explain.history.ride import Ride

Array = NDArray[np.float64]

REACH, GRID = 80.0, 2.0  # [m] length of road that counts, and the step between its places
PLACES = np.arange(GRID, REACH + GRID / 2.0, GRID)
SHOWN = 2.5  # [s] after a decision from which the speed that followed is known


def speeds(trace: PlanTrace, plan: Intervention) -> Array | None:
    """Return the expected speed [m/s] at each place of the road ahead; None: not recorded.

    Beyond the end of a rollout, its last speed counts.

    Returns:
        Speeds [REACH / GRID].
    """
    known = lines(trace)
    total, mass = np.zeros(len(PLACES)), 0.0
    for result, weight in zip(plan.results, plan.weights, strict=True):
        line = known.get(result.rollout.index)
        if line is None or weight <= 0.0:
            continue
        gone, speed = _gone(line.speed, [SAMPLE_PERIOD] * (len(line.speed) - 1))
        total += weight * np.interp(PLACES, gone, speed)
        mass += weight
    return total / mass if mass > 0.0 else None


def driven(ride: Ride, trace: PlanTrace) -> Array | None:
    """Return how fast [m/s] the ego has driven at each place since a decision.

    Returns:
        Speeds [REACH / GRID], NaN at places that it has not come to; None if that is too soon to
        know.
    """
    if ride.now - trace.sim_time < SHOWN:
        return None
    motion = ride.motion(EGO)
    inside = motion.within(trace.sim_time, ride.now)
    speeds_then = [motion.speed[k] for k in inside]
    times = [motion.time[k] for k in inside]
    if len(times) < 2:
        return None
    gone, speed = _gone(speeds_then, np.diff(times).tolist())
    found: Array = np.interp(PLACES, gone, speed, right=math.nan)
    return None if bool(np.all(np.isnan(found))) else found


def _gone(speed: Sequence[float], periods: Sequence[float]) -> tuple[Array, Array]:
    """Return distances [m] and speeds [m/s] from samples of speed and the times [s] between."""
    values = np.asarray(speed, dtype=np.float64)
    steps = 0.5 * (values[1:] + values[:-1]) * np.asarray(periods, dtype=np.float64)
    return np.concatenate(([0.0], np.cumsum(steps))), values
