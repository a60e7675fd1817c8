"""Rollouts: the ego takes macro actions in turn while the others follow sampled trajectories."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from planner.actions import ActionPlan, Situation
from planner.collision import first_overlap
from planner.forward import DT, Drive, Hindrance, Motion, drive
from planner.obstacles import Obstacle
from planner.reward import absent, components
from planner.trace import Action, Component, EgoGoal, HeldUp, HoldUp, Outcome
from planner.trajectory import Array, Roads
from sim.network import Location

SAFE_CUT_IN = 1.5  # [s] to collision with a follower, below which a lane change hits it
GRACE = 3  # steps by which two stretches of one hold-up may lie apart


@dataclass(frozen=True, slots=True)
class Task:
    """What the rollouts of one decision have in common."""

    roads: Roads
    goal: EgoGoal
    size: tuple[float, float]  # [m] length and width of the ego
    start: float  # [s] simulation time of step 0
    horizon: int  # last step
    view: float  # [m]
    yielding: bool = False  # whether those behind brake for a vehicle that moves in before them


@dataclass(frozen=True, slots=True, eq=False)
class Leg:
    """One macro action within a rollout."""

    action: Action
    first: int  # step at which it began
    lanes: tuple[str, ...]  # driven, in order
    position: Array  # [m] [N, 2] at steps first, first + 1, ...
    heading: Array  # [rad] [N]
    speed: Array  # [m/s] [N]
    acceleration: Array  # [m/s2] [N]
    curvature: Array  # [1/m] [N]
    outcome: Outcome | None  # None: the rollout goes on from `end`
    goal_time: float | None  # [s] since step 0
    collided_with: int | None
    hindrances: tuple[Hindrance, ...]
    end: Situation


def take(
    task: Task, plan: ActionPlan, motion: Motion, first: int, obstacles: Sequence[Obstacle]
) -> Leg:
    """Drive one macro action, from its beginning or from where it is under way.

    Args:
        task: the decision's frame.
        plan: the action.
        motion: where on its path the ego is.
        first: the step at which it is there.
        obstacles: the others' sampled motions.
    """
    driven = drive(plan, motion, first, obstacles, task.size, task.horizon)
    return _leg(task, plan, driven, obstacles)


def _leg(task: Task, plan: ActionPlan, driven: Drive, obstacles: Sequence[Obstacle]) -> Leg:
    arcs = np.array([motion.arc for motion in driven.motions])
    path = plan.path
    position = np.column_stack(
        (np.interp(arcs, path.arc, path.points[:, 0]), np.interp(arcs, path.arc, path.points[:, 1]))
    )
    heading = path.headings(arcs, task.size[0])
    hit = _collision(task, plan, driven, position, heading, obstacles)
    count = len(arcs) if hit is None else hit[0] + 1
    last = driven.motions[count - 1]
    end = _situation(task, plan, last, driven.first + count - 1)
    if hit is not None:
        outcome: Outcome | None = "collision"
    elif driven.goal_time is not None:
        outcome = "done"
    elif not driven.finished:
        outcome = "termination"
    else:
        outcome = None if _reachable(task, end.location) else "dead"
    return Leg(
        plan.action,
        driven.first,
        tuple(lane for lane, start in path.lanes if start <= last.arc),
        position[:count],
        heading[:count],
        np.array([motion.speed for motion in driven.motions[:count]]),
        np.array([motion.acceleration for motion in driven.motions[:count]]),
        np.interp(arcs[:count], path.arc, path.curvature),
        outcome,
        driven.goal_time if outcome == "done" else None,
        hit[1] if hit is not None else None,
        tuple(h for h in driven.hindrances if h.step < driven.first + count),
        end,
    )


def _collision(
    task: Task,
    plan: ActionPlan,
    driven: Drive,
    position: Array,
    heading: Array,
    obstacles: Sequence[Obstacle],
) -> tuple[int, int] | None:
    """The first collision: (sample, vehicle). Followers that would have braked do not count."""
    hits = []
    for other in obstacles:
        stop = min(driven.first + len(position), len(other.speed))
        count = stop - driven.first
        window = slice(driven.first, stop)
        where, turned = other.position[window], other.heading[window]
        size = (other.length, other.width)
        sample = first_overlap(position[:count], heading[:count], task.size, where, turned, size)
        careless = plan.changes_lane and not task.yielding
        if sample is None and careless:
            sample = _cut_off(task, driven, position, heading, other)
        elif sample is not None and not careless:
            sample = _unless_behind(sample, position, heading, where)
        if sample is not None:
            hits.append((sample, other.vehicle))
    return min(hits, default=None)


def _unless_behind(sample: int, position: Array, heading: Array, other: Array) -> int | None:
    """The sample of an overlap, unless the other ran into us from behind."""
    offset = other[sample] - position[sample]
    ahead = offset[0] * math.cos(heading[sample]) + offset[1] * math.sin(heading[sample])
    return None if ahead < -1.0 else sample


def _cut_off(
    task: Task, driven: Drive, position: Array, heading: Array, other: Obstacle
) -> int | None:
    """The last sample of a lane change that ends right before a faster follower."""
    step = driven.first + len(position) - 1
    if step >= len(other.speed):
        return None
    offset = other.position[step] - position[-1]
    cos, sin = math.cos(heading[-1]), math.sin(heading[-1])
    gap = -(offset[0] * cos + offset[1] * sin) - task.size[0]
    aside = abs(offset[1] * cos - offset[0] * sin)
    closing = float(other.speed[step]) - driven.motions[-1].speed
    if aside < 1.5 and gap > -task.size[0] and gap < closing * SAFE_CUT_IN:
        return len(position) - 1
    return None


def _situation(task: Task, plan: ActionPlan, motion: Motion, step: int) -> Situation:
    position, heading = plan.path.pose(motion.arc)
    lane, begin = plan.path.lane_at(motion.arc)
    location = Location(lane, motion.arc - begin, 0.0)
    time = task.start + step * DT
    return Situation(time, position, heading, motion.speed, motion.acceleration, location)


def _reachable(task: Task, here: Location) -> bool:
    """Whether the goal can still be reached along the road network."""
    network = task.roads.network
    lane = network.lanes[here.lane]
    link = network.link_via(here.lane)
    edge = lane.edge if link is None else network.lanes[link.to_lane].edge
    if edge == task.goal.edge:
        return link is not None or here.offset <= task.goal.position
    return edge in network.distance_to(task.goal.edge)


def summarise(legs: Sequence[Leg], outcome: Outcome) -> dict[Component, float | None]:
    """The reward components of a rollout."""
    if outcome != "done" or legs[-1].goal_time is None:
        return absent()
    return components(
        legs[-1].goal_time,
        np.concatenate([leg.speed for leg in legs]),
        np.concatenate([leg.acceleration for leg in legs]),
        np.concatenate([leg.curvature for leg in legs]),
    )


def held_up(legs: Sequence[Leg], start: float) -> tuple[HeldUp, ...]:
    """Join the hindered steps of a rollout into stretches, by vehicle.

    A leader that brakes while it is in the way is recorded as leader even where it cut in
    before: what costs time then is its braking.
    """
    stretches: dict[int, list[list[Hindrance]]] = {}
    for leg in legs:
        for step in leg.hindrances:
            runs = stretches.setdefault(step.vehicle, [])
            kind = step.how == "right-of-way"
            if (
                runs
                and step.step - runs[-1][-1].step <= GRACE
                and kind == (runs[-1][-1].how == "right-of-way")
            ):
                runs[-1].append(step)
            else:
                runs.append([step])
    found = [_stretch(run, start) for runs in stretches.values() for run in runs]
    return tuple(sorted(found, key=lambda stretch: (stretch.since, stretch.vehicle)))


def _stretch(run: list[Hindrance], start: float) -> HeldUp:
    speeds = [step.speed for step in run]
    how: HoldUp = run[0].how
    if how == "cut-in" and speeds[0] - min(speeds) > 2.0:
        how = "leader"
    return HeldUp(
        vehicle=run[0].vehicle,
        since=round(start + run[0].step * DT, 2),
        until=round(start + (run[-1].step + 1) * DT, 2),
        how=how,
        speed_from=round(speeds[0], 2),
        speed_to=round(min(speeds), 2),
    )
