"""Reward: the components of a driven trajectory, and one number from these."""

import math

import numpy as np

from planner.record.trace import SAMPLE_PERIOD, Action, Component, Costs, Outcome, RewardTerm
from planner.roads.trajectory import Array

#: The cost of a drive, in seconds of travelling time: time counts as it is, each other component
#: with so many seconds per unit of its total over the drive (mean absolute value x time). Unlike
#: a mean, a total does not fall when a vehicle waits.
WEIGHTS: dict[Component, float] = {
    "time": 1.0,  # per s
    "jerk": 0.05,  # per m/s2
    "angular-acceleration": 4.0,  # per rad/s
    "curvature": 20.0,  # per s/m
}
#: The cost [s] of the other outcomes. After a termination the goal is still within reach, so
#: what was driven and the rest of the way count as well.
PENALTY: dict[Outcome, float] = {"collision": 200.0, "dead": 150.0, "termination": 10.0}
#: [s] Minimum cost of losing the way to the goal, on top of the whole way: being late is better.
LOST = 100.0


def components(
    time: float, speed: Array, acceleration: Array, curvature: Array
) -> dict[Component, float]:
    """Return the components of a trajectory.

    Args:
        time: [s] that it took.
        speed: [m/s] [N] at 5 Hz.
        acceleration: [m/s2] [N]
        curvature: [1/m] [N] of the path at the samples.

    Returns:
        The time [s], and the mean absolute jerk [m/s3], angular acceleration [rad/s2]
        and curvature [1/m] over the trajectory.
    """
    if len(speed) < 2:
        return {"time": time, "jerk": 0.0, "angular-acceleration": 0.0, "curvature": 0.0}
    turning = speed * curvature
    return {
        "time": time,
        "jerk": float(np.mean(np.abs(np.diff(acceleration)))) / SAMPLE_PERIOD,
        "angular-acceleration": float(np.mean(np.abs(np.diff(turning)))) / SAMPLE_PERIOD,
        "curvature": float(np.mean(np.abs(curvature))),
    }


def absent() -> dict[Component, float | None]:
    """Return the components of a rollout that did not reach the goal: none is present."""
    return {"time": None, "jerk": None, "angular-acceleration": None, "curvature": None}


#: The cost of an action by itself [s]: passengers wonder what a stop is for, and every lane change
#: is a risk.
EFFORT: dict[Action, float] = {"stop": 2.0, "change-left": 1.0, "change-right": 1.0}


#: The costs as every trace records them.
COSTS = Costs(WEIGHTS, PENALTY, EFFORT)


def terms(
    outcome: Outcome, parts: dict[Component, float], left: float, effort: float
) -> dict[RewardTerm, float]:
    """Return the cost of a rollout by term, in seconds of travelling time.

    Args:
        outcome: of the rollout.
        parts: the components of what was driven.
        left: [s] cost of the rest of the way if nobody is in the way; if the way to the goal is
            lost (dead), its cost at the start of the rollout.
        effort: [s] cost of its actions by themselves.

    Returns:
        The terms [s] that are not 0; the reward is minus their sum.
    """
    if outcome == "collision":
        return {"collision": PENALTY[outcome]}
    if outcome == "dead":
        whole = LOST + left if math.isfinite(left) else 0.0
        return {"dead": max(PENALTY[outcome], whole)}
    time = parts["time"]
    found: dict[RewardTerm, float] = {"time": WEIGHTS["time"] * time, "effort": effort}
    for name, value in parts.items():
        if name != "time":
            found[name] = WEIGHTS[name] * value * time
    if outcome == "termination":
        found |= {"late": PENALTY[outcome], "left": left}
    return {term: cost for term, cost in found.items() if cost != 0.0}


def reward(costs: dict[RewardTerm, float]) -> float:
    """Return the reward of a rollout, in (negative) seconds of travelling time, from its terms."""
    return -sum(costs.values())
