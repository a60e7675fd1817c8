"""A* over macro actions: how a vehicle would best reach a goal among the others."""

import heapq
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from planner.actions import Situation, expand
from planner.forward import Motion
from planner.obstacles import Traffic
from planner.rollout import Leg, Task, take
from planner.routes import Refusal
from planner.trace import ACTIONS, Action
from planner.waypoints import time_left

LANE_CHANGE_COST = 3.0  # [s] that changing by one lane is worth
DEPTH = 3  # macro actions in a row
GRIP = 12.0  # [m/s2] of lateral acceleration; well beyond that of tyres, for paths are rough
SOLUTIONS = 2
SLOW = 2.0  # [m/s] below which a vehicle waits rather than drives
SLACK = 8.0  # [s] by which a further solution may cost more than the best


@dataclass(frozen=True, slots=True, eq=False)
class Solution:
    """One way to the goal."""

    cost: float  # [s] of time and lane changes, from the start
    legs: tuple[Leg, ...]

    @property
    def actions(self) -> tuple[Action, ...]:
        """The macro actions, in order."""
        return tuple(leg.action for leg in self.legs)

    @property
    def waits(self) -> tuple[int, ...]:
        """The steps in which others, or lights, keep it all but standing."""
        return tuple(
            step
            for leg in self.legs
            for step in np.union1d(leg.hindrances.step, leg.stops.step).tolist()
            if leg.speed[step - leg.first] < SLOW
        )


def ways(
    task: Task,
    starts: Sequence[Situation],
    traffic: Traffic,
    wanted: int,
    grip: float = GRIP,
) -> list[Solution]:
    """The cheapest ways to the task's goal, best first.

    Args:
        task: frame and goal; its size is that of the vehicle.
        starts: where it may be, one for each lane that fits.
        traffic: the others' motions.
        wanted: how many ways to look for.
        grip: [m/s2] of lateral acceleration that no way may exceed.
    """
    frontier: list[tuple[float, int, float, Situation, tuple[Leg, ...]]] = []
    count = 0
    for here in starts:
        heapq.heappush(frontier, (_remaining(task, here), count, 0.0, here, ()))
        count += 1
    found: list[Solution] = []
    while frontier and len(found) < wanted:
        estimate, _, cost, here, legs = heapq.heappop(frontier)
        if found and estimate > found[0].cost + SLACK:
            break
        if legs and legs[-1].outcome == "done":
            found.append(Solution(cost, legs))
            continue
        for leg in _expand(task, here, legs, traffic, grip):
            changes = sum(_lanes_moved(step, starts, k) for k, step in enumerate((*legs, leg)))
            time = leg.goal_time if leg.goal_time is not None else leg.end.time - task.start
            so_far = time + LANE_CHANGE_COST * changes
            ahead = 0.0 if leg.outcome == "done" else _remaining(task, leg.end)
            count += 1
            heapq.heappush(frontier, (so_far + ahead, count, so_far, leg.end, (*legs, leg)))
    return found


def held(
    task: Task, starts: Sequence[Situation], actions: Sequence[Action], traffic: Traffic
) -> tuple[Leg, ...]:
    """The actions in turn, as far as others let it drive; () where the first one cannot be done.

    Args:
        task: frame; its size is that of the vehicle.
        starts: where it may be; the first from which the actions apply counts.
        actions: what it does.
        traffic: the others' motions.
    """
    for start in starts:
        legs: list[Leg] = []
        here, first = start, 0
        for action in actions:
            plan = expand(task.roads, here, action, task.goal, task.view)
            if isinstance(plan, Refusal):
                break
            leg = take(task, plan, Motion(0.0, here.speed, here.acceleration), first, traffic)
            if leg.outcome == "collision":
                break
            legs.append(leg)
            here, first = leg.end, leg.first + len(leg.speed) - 1
            if leg.outcome is not None:
                break
        if legs:
            return tuple(legs)
    return ()


def _expand(
    task: Task, here: Situation, legs: tuple[Leg, ...], traffic: Traffic, grip: float
) -> list[Leg]:
    if len(legs) >= DEPTH:
        return []
    first = legs[-1].first + len(legs[-1].speed) - 1 if legs else 0
    moved = {leg.action for leg in legs} & {"change-left", "change-right"}
    children = []
    for action in ACTIONS:
        if action == "stop" or (moved and action.startswith("change") and action not in moved):
            continue
        plan = expand(task.roads, here, action, task.goal, task.view)
        if isinstance(plan, Refusal):
            continue
        leg = take(task, plan, Motion(0.0, here.speed, here.acceleration), first, traffic)
        if leg.outcome in (None, "done") and _drivable(leg, grip):
            children.append(leg)
    return children


def _drivable(leg: Leg, grip: float) -> bool:
    """Whether no bend is taken faster than any car could."""
    return bool(np.max(leg.speed**2 * np.abs(leg.curvature)) < grip)


def _lanes_moved(leg: Leg, starts: Sequence[Situation], index: int) -> float:
    """By how many lane widths a leg moves sideways; the first one starts from where it is."""
    moved = 1.0 if leg.action in ("change-left", "change-right") else 0.0
    if index > 0:
        return moved
    aside = starts[0].location.lateral / 3.5
    side = 1.0 if leg.action == "change-left" else -1.0
    return abs(moved * side - aside)


def _remaining(task: Task, here: Situation) -> float:
    return time_left(task.roads, here.location, task.goal)
