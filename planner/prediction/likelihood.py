"""The likelihood of inverse planning: how well a goal explains the track of a vehicle.

A goal is the more probable, the less the observed track costs in excess of the best way to it:
p(goal | track) ~ p(goal) exp(-beta (cost of the track and the best way on - cost of the best way
from its start)), as in IGP2 (Albrecht et al. 2021, Equations 6 and 7). Costs are seconds. The
tracks of a small share of drivers are assumed to be independent of their goals.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from planner.kernels.limits import ACCELERATION
from planner.manoeuvres.actions import COMFORT
from planner.motion.forward import DT
from planner.motion.obstacles import NOBODY, Traffic
from planner.motion.tracks import Observed
from planner.prediction.astar import LANE_CHANGE_COST, SLOW, ways
from planner.prediction.goals import Goal, stopping_time
from planner.record.trace import EgoGoal, Settings
from planner.roads.trajectory import Roads
from planner.rollouts.rollout import Task

UNEXPLAINED = 0.03  # share of drivers whose track says nothing of their goal
NO_WAY = 30.0  # [s] excess cost for a goal to which no way is found
CLUTCH = 0.3  # [m] sideways movement up to this much is ignored
PAUSE = 3  # minimum number of slow steps for a vehicle to count as waiting


def likelihoods(
    frame: Task,
    observed: Observed,
    goals: Sequence[Goal],
    left: Sequence[float | None],
    before: Traffic,
    settings: Settings,
) -> list[float]:
    """Return how well each goal explains the track, relative to the one that explains it best.

    Args:
        frame: the planning from now on; its goal does not matter.
        observed: the track.
        goals: to compare.
        left: [s] cost of the best way on to each goal, without waiting; None without a way.
        before: the others, from the first sample of the track on.
        settings: rationality [1/s].
    """
    moved = _sideways(frame.roads, observed)
    excess = [
        _excess(frame, observed, goal, driving, before, moved)
        for goal, driving in zip(goals, left, strict=True)
    ]
    best = min(excess)
    return [
        (1.0 - UNEXPLAINED) * math.exp(-settings.rationality * (e - best)) + UNEXPLAINED
        if driving is not None
        else 0.0
        for e, driving in zip(excess, left, strict=True)
    ]


def _excess(
    frame: Task,
    observed: Observed,
    goal: Goal,
    left: float | None,
    before: Traffic,
    moved: float,
) -> float:
    """Return the excess cost [s] of the track and the best way on over the best way from its start.

    Waiting for others does not count: some drivers take gaps that others let pass.
    """
    if left is None:
        return NO_WAY
    if goal.target is None:
        return _stop_excess(frame, observed)
    start = frame.start - observed.elapsed * DT
    task = replace(frame, goal=goal.target, start=start, horizon=frame.horizon + observed.elapsed)
    then = observed.situation(frame.roads, 0, start)
    best = ways(task, then, before, 1) or ways(task, then, NOBODY, 1)
    if not best:
        return NO_WAY
    spent = observed.elapsed * DT + LANE_CHANGE_COST * moved
    spent -= _waited(frame, observed, goal.target, before)
    return max(spent + left - (best[0].cost - len(best[0].waits) * DT), 0.0)


def _waited(frame: Task, observed: Observed, target: EgoGoal, before: Traffic) -> float:
    """Return how long [s] up to now the vehicle has stood because others were in its way."""
    driving = np.flatnonzero(observed.speed >= SLOW)
    since = int(driving[-1]) + 1 if len(driving) else 0
    stood = observed.elapsed - since
    if stood < PAUSE:
        return 0.0
    start = frame.start - stood * DT
    task = replace(frame, goal=target, start=start, horizon=frame.horizon + stood)
    then = observed.situation(frame.roads, since, start)
    best = ways(task, then, before.since(since), 1)
    waited = sum(step < stood for step in best[0].waits) if best else 0
    return waited * DT


def _stop_excess(frame: Task, observed: Observed) -> float:
    """Return the excess cost [s] for stopping where the vehicle would now come to rest."""
    moving = np.flatnonzero(observed.speed > 0.1)
    until = int(moving[-1]) if len(moving) else 0
    rest = float(observed.speed[-1])
    steps = np.hypot(*np.diff(observed.position, axis=0).T)
    distance = float(np.sum(steps)) + rest**2 / (2.0 * COMFORT)
    limit = max(frame.roads.fastest, float(np.max(observed.speed)))
    best = stopping_time(distance, float(observed.speed[0]), limit, ACCELERATION, COMFORT)
    return max(until * DT + rest / COMFORT - best, 0.0)


def _sideways(roads: Roads, observed: Observed) -> float:
    """Return by how many lane widths the vehicle moved sideways on its present edge."""
    edge, last, moved = None, 0.0, 0.0
    for sample in range(0, len(observed.speed), 2):
        position = (float(observed.position[sample, 0]), float(observed.position[sample, 1]))
        found = roads.network.locate(position, float(observed.heading[sample]))
        lane = roads.network.lanes[found[0].lane] if found else None
        if lane is None or lane.internal:
            continue
        across = lane.index * lane.width + found[0].lateral
        if lane.edge != edge:
            edge, last, moved = lane.edge, across, 0.0
        elif abs(across - last) > CLUTCH:
            moved += abs(across - last) / lane.width
            last = across
    return moved
