"""A* over macro actions: the best ways of a vehicle to a goal among the others."""

import heapq
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from planner.manoeuvres.actions import ActionPlan, Situation, expand
from planner.motion.forward import DT, Motion
from planner.motion.obstacles import Traffic
from planner.record.trace import ACTIONS, Action
from planner.roads.routes import Refusal
from planner.rollouts.rollout import Leg, Task, take
from planner.rollouts.waypoints import time_left
from sim.roads.network import Location

LANE_CHANGE_COST = 3.0  # [s] cost of a change by one lane
DEPTH = 3  # maximum number of macro actions in a row
GRIP = 12.0  # [m/s2] lateral acceleration; more than tyres allow, since paths are rough
SOLUTIONS = 2
SLOW = 2.0  # [m/s] below which a vehicle waits rather than drives
SLACK = 8.0  # [s] maximum cost of a further solution beyond that of the best
SPARE = 0.5  # [s] allowance for errors of lower bounds


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
        """The steps in which others, or lights, make it stand or drive slower than SLOW."""
        return tuple(
            step
            for leg in self.legs
            for step in np.union1d(leg.hindrances.step, leg.stops.step).tolist()
            if leg.speed[step - leg.first] < SLOW
        )


@dataclass(frozen=True, slots=True, eq=False)
class _Reached:
    """A node of the search: the legs driven so far, and the situation at their end."""

    cost: float  # [s] of time and lane changes so far
    here: Situation
    legs: tuple[Leg, ...]

    @property
    def there(self) -> bool:
        """Whether the goal is reached."""
        return bool(self.legs) and self.legs[-1].outcome == "done"


@dataclass(frozen=True, slots=True, eq=False)
class _Ahead:
    """An action that may be taken at a node; it is driven when no other node is more promising.

    Actions that do not lead to the goal are mostly ruled out before they are driven.
    """

    node: _Reached
    plan: ActionPlan
    changes: float  # [s] cost of all lane changes so far, its own included


def ways(
    task: Task,
    starts: Sequence[Situation],
    traffic: Traffic,
    wanted: int,
    grip: float = GRIP,
) -> list[Solution]:
    """Return the cheapest ways to the task's goal, best first.

    Args:
        task: frame and goal; its size is that of the vehicle.
        starts: situations that it may be in, one for each lane that fits.
        traffic: the others' motions.
        wanted: how many ways to look for.
        grip: [m/s2] maximum lateral acceleration.
    """
    frontier: list[tuple[float, int, _Reached | _Ahead]] = []
    count = 0
    for here in starts:
        heapq.heappush(frontier, (_remaining(task, here), count, _Reached(0.0, here, ())))
        count += 1
    found: list[Solution] = []
    while frontier and len(found) < wanted:
        estimate, order, node = heapq.heappop(frontier)
        if found and estimate > found[0].cost + SLACK:
            break
        if isinstance(node, _Ahead):
            reached = _driven(task, node, traffic, grip)
            if reached is not None:
                ahead = 0.0 if reached.there else _remaining(task, reached.here)
                heapq.heappush(frontier, (reached.cost + ahead, order, reached))
        elif node.there:
            found.append(Solution(node.cost, node.legs))
        else:
            for child in _expand(task, starts, node):
                count += 1
                heapq.heappush(frontier, (_least(task, child), count, child))
    return found


def held(
    task: Task, starts: Sequence[Situation], actions: Sequence[Action], traffic: Traffic
) -> tuple[Leg, ...]:
    """Return the actions driven in turn, as far as others allow; () if the first one is impossible.

    Args:
        task: frame; its size is that of the vehicle.
        starts: situations that it may be in; the first from which the first action works counts.
        actions: its macro actions.
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


def _expand(task: Task, starts: Sequence[Situation], node: _Reached) -> list[_Ahead]:
    """Return the actions that may be taken at a node."""
    legs = node.legs
    if len(legs) >= DEPTH:
        return []
    driven = [leg.action for leg in legs]
    moved = {"change-left", "change-right"}.intersection(driven)
    children = []
    for action in ACTIONS:
        if action == "stop" or (moved and action.startswith("change") and action not in moved):
            continue
        plan = expand(task.roads, node.here, action, task.goal, task.view)
        if not isinstance(plan, Refusal):
            changes = sum(_lanes_moved(x, starts, k) for k, x in enumerate((*driven, action)))
            children.append(_Ahead(node, plan, LANE_CHANGE_COST * changes))
    return children


def _driven(task: Task, ahead: _Ahead, traffic: Traffic, grip: float) -> _Reached | None:
    """Return the node that an action leads to; None if the action fails."""
    here, legs = ahead.node.here, ahead.node.legs
    first = legs[-1].first + len(legs[-1].speed) - 1 if legs else 0
    leg = take(task, ahead.plan, Motion(0.0, here.speed, here.acceleration), first, traffic)
    if leg.outcome not in (None, "done") or not _drivable(leg, grip):
        return None
    time = leg.goal_time if leg.goal_time is not None else leg.end.time - task.start
    return _Reached(time + ahead.changes, leg.end, (*legs, leg))


def _least(task: Task, ahead: _Ahead) -> float:
    """Return a lower bound of the cost [s] of ways to the goal that continue with an action.

    The vehicle is never faster than now or than its path allows, whichever is more. It completes
    the action within one step after the end of the plan.
    """
    plan, here = ahead.plan, ahead.node.here
    fastest = max(here.speed, float(np.max(plan.path.cap)))
    so_far = here.time - task.start + plan.end / fastest + ahead.changes
    if plan.goal is not None:
        return so_far - SPARE
    ends = (plan.end, plan.end + fastest * DT)
    left = min(time_left(task.roads, _at(plan, arc), task.goal) for arc in ends)
    return so_far + left - DT - SPARE


def _at(plan: ActionPlan, arc: float) -> Location:
    lane, begin = plan.path.lane_at(arc)
    return Location(lane, arc - begin, 0.0)


def _drivable(leg: Leg, grip: float) -> bool:
    """Check whether the lateral acceleration stays below `grip` [m/s2] everywhere."""
    return bool(np.max(leg.speed**2 * np.abs(leg.curvature)) < grip)


def _lanes_moved(action: Action, starts: Sequence[Situation], index: int) -> float:
    """Return by how many lane widths an action moves sideways, the first one from its offset."""
    moved = 1.0 if action in ("change-left", "change-right") else 0.0
    if index > 0:
        return moved
    aside = starts[0].location.lateral / 3.5
    side = 1.0 if action == "change-left" else -1.0
    return abs(moved * side - aside)


def _remaining(task: Task, here: Situation) -> float:
    return time_left(task.roads, here.location, task.goal)
