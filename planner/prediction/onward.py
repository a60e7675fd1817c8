"""The ways of a vehicle on to its goals, among the others, and its motion along each."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from planner.manoeuvres.actions import COMFORT, Situation
from planner.motion.forward import DT
from planner.motion.obstacles import NOBODY, Motions, Obstacle, Traffic
from planner.motion.surroundings import Others
from planner.motion.tracks import Observed, berth_of, drive_on, links_of
from planner.prediction.astar import GRIP, SOLUTIONS, Solution, held, ways
from planner.prediction.beliefs import NEGLIGIBLE, Trajectory
from planner.prediction.goals import Goal
from planner.prediction.stopping import stopping
from planner.record.trace import Action, Settings
from planner.rollouts.rollout import Leg, Task, held_by_lights, held_up


@dataclass(frozen=True, eq=False)
class Way:
    """One way on from now; its motion beyond the goal is computed when it is needed."""

    cost: float  # [s]
    waiting: float  # [s] part of the cost: waiting for others and at lights
    actions: tuple[Action, ...]
    legs: tuple[Leg, ...]
    drive_on: Callable[[], Motions]

    @cached_property
    def motions(self) -> Motions:
        """Return the motions that others expect."""
        return self.drive_on()


def ways_to(
    frame: Task,
    starts: tuple[Situation, ...],
    goals: Sequence[Goal],
    observed: Observed,
    others: Others,
) -> list[list[Way]]:
    """Return the ways on to each goal, as `ways_on` does.

    If only stopping is possible within GRIP, the bends of the map are too sharp, and GRIP is
    ignored.
    """
    found = [ways_on(frame, starts, goal, observed, others) for goal in goals]
    if any(ways for goal, ways in zip(goals, found, strict=True) if goal.target is not None):
        return found
    return [ways_on(frame, starts, goal, observed, others, math.inf) for goal in goals]


def ways_on(
    frame: Task,
    starts: tuple[Situation, ...],
    goal: Goal,
    observed: Observed,
    others: Others,
    grip: float = GRIP,
) -> list[Way]:
    """Return the best ways on to a goal, the best first; [] if there is none.

    Args:
        frame: the planning from now on; its goal does not matter.
        starts: situations that the vehicle may be in.
        goal: where it goes.
        observed: its track.
        others: the others' motions, and the lights.
        grip: [m/s2] maximum lateral acceleration.
    """
    if goal.target is None:
        motion = stopping(frame, starts[0], observed, others.usual)
        cost = starts[0].speed / COMFORT
        return [] if motion is None else [Way(cost, 0.0, ("stop",), (), lambda: Motions(motion))]
    task = replace(frame, goal=goal.target)
    solutions = ways(task, starts, others.usual, SOLUTIONS, grip)
    if not solutions:
        return _held_up(task, starts, observed, others, grip)
    return [
        Way(
            solution.cost,
            len(solution.waits) * DT,
            solution.actions,
            solution.legs,
            partial(_motions, task, starts, solution, observed, others),
        )
        for solution in solutions
    ]


def _held_up(
    task: Task, starts: tuple[Situation, ...], observed: Observed, others: Others, grip: float
) -> list[Way]:
    """Return the best way to a goal that others or lights block, as far as they allow.

    Who stands, and cannot even move out without a collision, is expected to wait.
    """
    found = []
    for free in ways(task, starts, NOBODY, 1, grip):
        legs = held(task, starts, free.actions, others.usual)
        waits = None
        if observed.standing and not legs:
            waits = stopping(task, starts[0], observed, others.usual)
        far = Solution(free.cost, legs or free.legs)
        go = partial(_motions, task, starts, far, observed, others)
        drive_on = go if waits is None else partial(Motions, waits)
        found.append(Way(free.cost, 0.0, free.actions, far.legs, drive_on))
    return found


def _motions(
    task: Task,
    starts: tuple[Situation, ...],
    solution: Solution,
    observed: Observed,
    others: Others,
) -> Motions:
    """Return the motions of a solution under all courses of the lights."""

    def under(courses: tuple[int, ...]) -> Obstacle:
        traffic = others.under(courses)
        if courses == others.surroundings.outlook.usual:
            return _motion(task, solution, observed, traffic)
        legs = held(task, starts, solution.actions, traffic) or solution.legs
        return _motion(task, Solution(solution.cost, legs), observed, traffic)

    return others.surroundings.motions(under)


def _motion(task: Task, solution: Solution, observed: Observed, others: Traffic) -> Obstacle:
    """Return the motion of a solution, which goes on beyond its goal."""
    legs = solution.legs
    first = legs[-1].first + len(legs[-1].speed) - 1
    position, heading, speed, lanes = drive_on(
        task.roads, legs[-1].end, first, others, task.size, task.horizon, task.pace
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
        berth_of(task.roads, observed),
    )


def trajectories(onwards: list[Way], settings: Settings, time: float) -> tuple[Trajectory, ...]:
    """Return the ways on with p(way | goal) by softmax over their costs."""
    best = onwards[0].cost
    weights = [math.exp(-settings.rationality * (way.cost - best)) for way in onwards]
    weights = [w if w >= NEGLIGIBLE * sum(weights) else 0.0 for w in weights]
    return tuple(
        Trajectory(
            weight / sum(weights),
            way.actions,
            way.motions,
            held_up(way.legs, time),
            held_by_lights(way.legs, time),
        )
        for way, weight in zip(onwards, weights, strict=True)
        if weight > 0.0
    )


def trajectories_to(
    frame: Task,
    starts: tuple[Situation, ...],
    goal: Goal,
    observed: Observed,
    others: Others,
    settings: Settings,
) -> tuple[Trajectory, ...]:
    """Return the ways on to a goal, however improbable it is; () if no way leads there."""
    onwards = ways_on(frame, starts, goal, observed, others)
    return trajectories(onwards, settings, frame.start) if onwards else ()


def motion_along(frame: Task, legs: Sequence[Leg], observed: Observed, others: Traffic) -> Obstacle:
    """Return the motion along legs from now, and along the road from their end."""
    return _motion(frame, Solution(0.0, tuple(legs)), observed, others)
