"""Goal recognition by inverse planning.

A goal is the more probable, the less the observed track costs in excess of the best way to it:
p(goal | track) ~ p(goal) exp(-beta (cost of the track and the best way on - cost of the best way
from its start)), as in IGP2 (Albrecht et al. 2021, Equations 6 and 7). Costs are seconds. A small
share of drivers is taken to drive for reasons that we do not see, whatever their goal.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from planner.actions import COMFORT, ActionPlan, Situation, Stop
from planner.astar import LANE_CHANGE_COST, SLOW, SOLUTIONS, Solution, ways
from planner.forward import DT, Motion, drive
from planner.goals import PLACES, Goal, goals_in_view, stopping_time
from planner.kernels.driving import ACCELERATION
from planner.obstacles import NOBODY, Obstacle, Traffic
from planner.rollout import Leg, Task
from planner.routes import onward
from planner.trace import Action, EgoGoal, Settings
from planner.tracks import Observed, aligned, coast, drive_on, links_of, sample_path
from planner.trajectory import Roads

NEGLIGIBLE = 0.01  # probability below which a goal or a way is dropped
UNEXPLAINED = 0.03  # share of drivers whose track says nothing of their goal
NO_WAY = 30.0  # [s] in excess for a goal to which no way is found any more
CLUTCH = 0.3  # [m] of sideways movement that is not taken for one


@dataclass(frozen=True, slots=True, eq=False)
class Trajectory:
    """One way in which a vehicle may go on, as an obstacle from now (step 0) on."""

    probability: float  # given the goal
    actions: tuple[Action, ...]
    motion: Obstacle


@dataclass(frozen=True, slots=True, eq=False)
class Belief:
    """One goal of one vehicle, and how likely it is."""

    goal: Goal
    likelihood: float
    probability: float
    trajectories: tuple[Trajectory, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _Way:
    """One way on from now."""

    cost: float  # [s]
    waiting: float  # [s] of it
    waits_now: bool
    actions: tuple[Action, ...]
    motion: Obstacle


@dataclass(frozen=True, slots=True, eq=False)
class _Coasting:
    """How one vehicle goes on if nothing changes, as others reckon with it."""

    elapsed: int  # steps of its track
    now: Obstacle  # from now on
    past: Obstacle  # from the first sample of its track on


def recognise(
    roads: Roads, tracks: Sequence[Observed], settings: Settings, time: float, ego: int
) -> dict[int, tuple[Belief, ...]]:
    """What every vehicle but the ego may be up to.

    Args:
        roads: the road network.
        tracks: all vehicles in view, the ego among them; each ends now.
        settings: view radius [m], horizon [s], rationality [1/s].
        time: [s] now.
        ego: name of the ego.
    """
    steps = round(settings.horizon / DT)
    coasting = {
        track.vehicle: _Coasting(
            track.elapsed,
            coast(roads, track, steps, past=False),
            coast(roads, track, steps, past=True),
        )
        for track in tracks
    }
    return {
        observed.vehicle: _beliefs(roads, observed, coasting, settings, time)
        for observed in tracks
        if observed.vehicle != ego
    }


def _beliefs(
    roads: Roads,
    observed: Observed,
    coasting: Mapping[int, _Coasting],
    settings: Settings,
    time: float,
) -> tuple[Belief, ...]:
    steps = round(settings.horizon / DT)
    others = [other for vehicle, other in coasting.items() if vehicle != observed.vehicle]
    starts = observed.situation(roads, -1, time)
    if not starts:
        return _unknown(roads, observed, steps)
    goals = goals_in_view(roads, starts, settings.view_radius)
    size = (observed.length, observed.width)
    nowhere = EgoGoal("", 0.0, None)
    frame = Task(roads, nowhere, size, time, steps, settings.view_radius, yielding=True)
    now = Traffic.of([other.now for other in others])
    onwards = [_ways_on(frame, starts, goal, observed, now) for goal in goals]
    likelihood = _likelihoods(frame, observed, goals, onwards, others, settings)
    weights = [goal.prior * like for goal, like in zip(goals, likelihood, strict=True)]
    if sum(weights) == 0.0:
        return _unknown(roads, observed, steps)
    weights = [w if w >= NEGLIGIBLE * sum(weights) else 0.0 for w in weights]
    return tuple(
        Belief(goal, like, weight / sum(weights), _trajectories(onward, settings))
        for goal, like, weight, onward in zip(goals, likelihood, weights, onwards, strict=True)
        if weight > 0.0
    )


def _unknown(roads: Roads, observed: Observed, steps: int) -> tuple[Belief, ...]:
    """A vehicle for which no goal makes sense: it is taken to go on as it does."""
    goal = Goal("continue", PLACES["continue"], None, 1.0)
    motion = coast(roads, observed, steps, past=False)
    return (Belief(goal, 1.0, 1.0, (Trajectory(1.0, ("continue",), motion),)),)


def _likelihoods(
    frame: Task,
    observed: Observed,
    goals: Sequence[Goal],
    onwards: Sequence[list[_Way]],
    others: Sequence[_Coasting],
    settings: Settings,
) -> list[float]:
    """How well each goal explains the track, relative to the one that does so best."""
    if not settings.recognition:
        return [1.0 if onward else 0.0 for onward in onwards]
    horizon = frame.horizon + observed.elapsed
    before = Traffic.of(
        [aligned(other.past, observed.elapsed - other.elapsed, horizon) for other in others]
    )
    excess = [
        _excess(frame, observed, goal, onward, before)
        for goal, onward in zip(goals, onwards, strict=True)
    ]
    best = min(excess)
    return [
        (1.0 - UNEXPLAINED) * math.exp(-settings.rationality * (e - best)) + UNEXPLAINED
        if onward
        else 0.0
        for e, onward in zip(excess, onwards, strict=True)
    ]


def _ways_on(
    frame: Task,
    starts: tuple[Situation, ...],
    goal: Goal,
    observed: Observed,
    others: Traffic,
) -> list[_Way]:
    if goal.target is None:
        return _stopping(frame, starts[0], observed, others)
    task = replace(frame, goal=goal.target)
    solutions = ways(task, starts, others, SOLUTIONS) or ways(task, starts, NOBODY, 1)
    return [
        _Way(
            solution.cost,
            len(solution.waits) * DT,
            0 in solution.waits,
            solution.actions,
            _motion(task, solution, observed, others),
        )
        for solution in solutions
    ]


def _motion(task: Task, solution: Solution, observed: Observed, others: Traffic) -> Obstacle:
    """A solution as an obstacle, driving on beyond its goal."""
    legs = solution.legs
    first = legs[-1].first + len(legs[-1].speed) - 1
    position, heading, speed, lanes = drive_on(
        task.roads, legs[-1].end, first, others, task.size, task.horizon
    )
    driven = [leg.position[1:] for leg in legs]
    return Obstacle(
        observed.vehicle,
        observed.length,
        observed.width,
        np.vstack((legs[0].position[:1], *driven, position)),
        np.concatenate((legs[0].heading[:1], *(leg.heading[1:] for leg in legs), heading)),
        np.concatenate((legs[0].speed[:1], *(leg.speed[1:] for leg in legs), speed)),
        links_of(task.roads, [lane for leg in legs for lane in leg.lanes] + list(lanes)),
    )


def _stopping(frame: Task, here: Situation, observed: Observed, others: Traffic) -> list[_Way]:
    """Braking to a standstill and staying there; nobody means to stay inside a junction."""
    row = onward(frame.roads, (here.location.lane,), here.location.offset + 100.0)
    path = frame.roads.path(row, here.position, here.heading, 12.0, 100.0)
    plan = ActionPlan("stop", path, (Stop(0.0),), path.length, math.inf, None)
    driven = drive(plan, Motion(0.0, here.speed, 0.0), 0, others, frame.size, frame.horizon)
    arcs, speed = driven.motion[:, 0], driven.motion[:, 1]
    if frame.roads.network.lanes[path.lane_at(float(arcs[-1]))[0]].internal:
        return []
    position, heading = sample_path(path, arcs, observed.length)
    rest = frame.horizon + 1 - len(arcs)
    motion = Obstacle(
        observed.vehicle,
        observed.length,
        observed.width,
        np.vstack((position, np.repeat(position[-1:], rest, axis=0))),
        np.concatenate((heading, np.repeat(heading[-1:], rest))),
        np.concatenate((speed, np.zeros(rest))),
        links_of(frame.roads, [lane for lane, start in path.lanes if start <= arcs[-1]]),
    )
    return [_Way(here.speed / COMFORT, 0.0, False, ("stop",), motion)]


def _excess(
    frame: Task,
    observed: Observed,
    goal: Goal,
    onwards: list[_Way],
    before: Traffic,
) -> float:
    """By how much [s] the track and the best way on cost more than the best way from its start.

    Waiting for others is never held against a goal: some take a gap that others let pass.
    """
    if not onwards:
        return NO_WAY
    if goal.target is None:
        return _stop_excess(frame, observed)
    start = frame.start - observed.elapsed * DT
    task = replace(frame, goal=goal.target, start=start, horizon=frame.horizon + observed.elapsed)
    then = observed.situation(frame.roads, 0, start)
    best = ways(task, then, before, 1) or ways(task, then, NOBODY, 1)
    if not best:
        return NO_WAY
    spent = observed.elapsed * DT + LANE_CHANGE_COST * _sideways(frame.roads, observed)
    if onwards[0].waits_now:
        spent -= _standing(observed)
    usual = best[0].cost - len(best[0].waits) * DT
    return max(spent + onwards[0].cost - onwards[0].waiting - usual, 0.0)


def _standing(observed: Observed) -> float:
    """For how long [s] the vehicle has been all but standing up to now."""
    driving = np.flatnonzero(observed.speed >= SLOW)
    return (observed.elapsed - int(driving[-1]) if len(driving) else observed.elapsed) * DT


def _stop_excess(frame: Task, observed: Observed) -> float:
    """The same for stopping where the vehicle would now come to rest."""
    moving = np.flatnonzero(observed.speed > 0.1)
    until = int(moving[-1]) if len(moving) else 0
    rest = float(observed.speed[-1])
    steps = np.hypot(*np.diff(observed.position, axis=0).T)
    distance = float(np.sum(steps)) + rest**2 / (2.0 * COMFORT)
    limit = max(frame.roads.fastest, float(np.max(observed.speed)))
    best = stopping_time(distance, float(observed.speed[0]), limit, ACCELERATION, COMFORT)
    return max(until * DT + rest / COMFORT - best, 0.0)


def _sideways(roads: Roads, observed: Observed) -> float:
    """By how many lane widths the vehicle moved sideways on its present edge."""
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


def _trajectories(onwards: list[_Way], settings: Settings) -> tuple[Trajectory, ...]:
    """The ways on with p(way | goal) by softmax over their costs."""
    best = onwards[0].cost
    weights = [math.exp(-settings.rationality * (way.cost - best)) for way in onwards]
    weights = [w if w >= NEGLIGIBLE * sum(weights) else 0.0 for w in weights]
    return tuple(
        Trajectory(weight / sum(weights), way.actions, way.motion)
        for way, weight in zip(onwards, weights, strict=True)
        if weight > 0.0
    )


def trajectories_to(
    frame: Task,
    starts: tuple[Situation, ...],
    goal: Goal,
    observed: Observed,
    others: Traffic,
    settings: Settings,
) -> tuple[Trajectory, ...]:
    """The ways on to a goal, however improbable it is; none where no way leads there."""
    onwards = _ways_on(frame, starts, goal, observed, others)
    return _trajectories(onwards, settings) if onwards else ()


def motion_along(frame: Task, legs: Sequence[Leg], observed: Observed, others: Traffic) -> Obstacle:
    """Legs driven one after the other from now, and the road followed from there."""
    return _motion(frame, Solution(0.0, tuple(legs)), observed, others)
