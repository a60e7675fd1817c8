"""Rollouts: the ego takes macro actions in turn while the others follow sampled trajectories.

They react to the ego if the task says so: see `planner.kernels.reaction`. A collision that then
remains is one at the other's side, or one that it could not have avoided by braking firmly
(`FIRM`) along its path, once it had seen the ego there for its reaction time. As in traffic law,
an ego that is hit from behind without having changed lanes has not collided. Who crosses its way
is not behind it: the rear of a long vehicle may still hit it once the front has passed.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from planner.hidden_areas.caution import Careful, careful_steps, caution
from planner.kernels.along import place
from planner.kernels.collision import first_hit
from planner.kernels.limits import FIRM, RIGHT_OF_WAY
from planner.manoeuvres.actions import ActionPlan, Situation
from planner.motion.forward import DT, Drive, Hindrances, Motion, Stops, drive, lane_of
from planner.motion.obstacles import HOW, Traffic
from planner.record.light_record import HeldByLight
from planner.record.trace import Action, Component, EgoGoal, HeldUp, HoldUp, Outcome
from planner.roads.trajectory import Array, Path, Roads
from planner.rollouts.reward import components
from sim.roads.network import Location
from sim.scene import Signal

STILL = 0.1  # [m/s] speed below which a vehicle counts as standing
GRACE = 3  # maximum difference of steps within one stretch of a hold-up


@dataclass(frozen=True, slots=True)
class Task:
    """The inputs that the rollouts of one decision have in common."""

    roads: Roads
    goal: EgoGoal
    size: tuple[float, float]  # [m] length and width of the ego
    start: float  # [s] simulation time of step 0
    horizon: int  # last step
    view: float  # [m] how far ahead junctions are seen
    yielding: bool = False  # whether those behind brake for a vehicle that moves in front of them
    pace: float = math.inf  # [m/s] maximum speed at which it wants to drive
    reacting: bool = False  # whether the others brake for the ego
    #: links to approach slowly, and how far [m] behind their lines to be slow: see
    #: planner.hidden_areas.caution
    slow: Mapping[tuple[str, int], float] = field(default_factory=dict)


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
    hindrances: Hindrances
    stops: Stops
    end: Situation
    ahead: tuple[tuple[str, float], ...]  # lanes yet to be driven, and how much [m] of each
    traffic: Traffic  # the others, as they have reacted and go on
    careful: Careful  # where hidden parts of the road made it slower


def take(task: Task, plan: ActionPlan, motion: Motion, first: int, traffic: Traffic) -> Leg:
    """Drive one macro action, from its beginning or from where it is under way.

    Args:
        task: what the rollouts of the decision have in common.
        plan: the action.
        motion: where on its path the ego is.
        first: the step at which it is there.
        traffic: the others' sampled motions.
    """
    driven = _drive(task, plan, motion, first, traffic)
    states, curvature = _placed(task, plan, driven)
    if task.reacting:
        reacted = traffic.reacting(states, task.size, first, plan.path)
        if reacted.states is not traffic.states and _matters(plan, states, first, reacted):
            driven = _drive(task, plan, motion, first, reacted)
            states, curvature = _placed(task, plan, driven)
            reacted = traffic.reacting(states, task.size, first, plan.path)
        traffic = reacted
    return _leg(task, plan, driven, traffic, states, curvature)


def _matters(plan: ActionPlan, states: Array, first: int, traffic: Traffic) -> bool:
    """Check whether the others' reactions may matter to the ego that drives along states [S, 4].

    On a plan without lines or areas to keep clear, they do not if all that brake stay behind it.
    """
    if plan.lines or plan.keep_clears:
        return True
    theirs = traffic.states[traffic.braking, first : first + len(states)]
    own = states[: theirs.shape[1]]
    cos, sin = np.cos(own[:, 2]), np.sin(own[:, 2])
    ahead = (theirs[:, :, 0] - own[:, 0]) * cos + (theirs[:, :, 1] - own[:, 1]) * sin
    return bool(np.any(ahead > 0.0))


def _drive(task: Task, plan: ActionPlan, motion: Motion, first: int, traffic: Traffic) -> Drive:
    pace: float | Array = task.pace
    if task.slow and plan.give_ways:
        pace = np.minimum(pace, caution(plan, task.slow, len(lane_of(plan.path).caps)))
    return drive(plan, motion, first, traffic, task.size, task.horizon, pace)


def _placed(task: Task, plan: ActionPlan, driven: Drive) -> tuple[Array, Array]:
    """Return the states [S, 4] of a drive, and the curvature [1/m] [S] at the front."""
    path, length = plan.path, float(task.size[0])
    return place(path.points, path.arc, path.heading, path.curvature, driven.motion, length)


def _leg(
    task: Task, plan: ActionPlan, driven: Drive, traffic: Traffic, states: Array, curvature: Array
) -> Leg:
    """Return a drive as a leg, with its outcome."""
    careless = plan.changes_lane and not task.yielding
    braking = FIRM if task.reacting else 0.0
    hit, who = first_hit(
        states, task.size, driven.first, *_real(traffic, plan.path), careless, braking
    )
    count = len(states) if who < 0 else hit + 1
    arc, speed, acceleration = driven.motion[count - 1].tolist()
    last = Motion(arc, speed, acceleration)
    end = _situation(task, plan, last, driven.first + count - 1)
    if who >= 0:
        outcome: Outcome | None = "collision"
    elif driven.goal_time is not None:
        outcome = "done"
    elif not _reachable(task, end.location):
        outcome = "dead"
    elif driven.finished:
        outcome = None
    else:
        outcome = "termination" if _leads_on(task, plan) else "dead"
    return Leg(
        plan.action,
        driven.first,
        tuple(lane for lane, start in plan.path.lanes if start <= arc),
        states[:count, :2],
        states[:count, 2],
        states[:count, 3],
        driven.motion[:count, 2],
        curvature[:count],
        outcome,
        driven.goal_time if outcome == "done" else None,
        traffic.vehicles[who] if who >= 0 else None,
        driven.hindrances.before(driven.first + count),
        driven.stops.before(driven.first + count),
        end,
        _ahead(plan, arc) if outcome == "termination" else (),
        traffic,
        careful_steps(plan, task.slow, driven, count) if task.slow else (),
    )


def _real(traffic: Traffic, path: Path) -> tuple[Array, Array]:
    """Return the motions and sizes of all but phantoms: these would brake, and never collide."""
    states = traffic.beside(path)
    if min(traffic.vehicles, default=0) >= 0:
        return states, traffic.sizes
    there = np.array(traffic.vehicles) >= 0  # phantoms come last
    return states[there], traffic.sizes[there]


def _leads_on(task: Task, plan: ActionPlan) -> bool:
    """Check whether the goal can still be reached after an action that is under way."""
    if plan.stops or plan.goal is not None:
        return True
    lane, begin = plan.path.lane_at(plan.end)
    return _reachable(task, Location(lane, plan.end - begin, 0.0))


def _ahead(plan: ActionPlan, arc: float) -> tuple[tuple[str, float], ...]:
    """Return the lanes from an arc [m] to the end of a plan, and how much [m] of each that is.

    There are none if the plan reaches the goal or stops.
    """
    if plan.stops or plan.goal is not None:
        return ()
    lanes = plan.path.lanes
    bounds = [*(start for _, start in lanes[1:]), math.inf]
    parts = [
        (lane, min(bound, plan.end) - max(start, arc))
        for (lane, start), bound in zip(lanes, bounds, strict=True)
    ]
    return tuple((lane, length) for lane, length in parts if length > 0.0)


def _situation(task: Task, plan: ActionPlan, motion: Motion, step: int) -> Situation:
    position, heading = plan.path.pose(motion.arc)
    lane, begin = plan.path.lane_at(motion.arc)
    location = Location(lane, motion.arc - begin, 0.0)
    time = task.start + step * DT
    return Situation(time, position, heading, motion.speed, motion.acceleration, location)


def _reachable(task: Task, here: Location) -> bool:
    """Check whether the goal can still be reached along the road network."""
    network = task.roads.network
    lane = network.lanes[here.lane]
    link = network.link_via(here.lane)
    edge = lane.edge if link is None else network.lanes[link.to_lane].edge
    if edge == task.goal.edge:
        return link is not None or here.offset <= task.goal.position
    return edge in network.distance_to(task.goal.edge)


def summarise(task: Task, legs: Sequence[Leg]) -> dict[Component, float]:
    """Return the reward components of what was driven, to the goal or the end of the rollout."""
    if not legs:
        return components(0.0, np.empty(0), np.empty(0), np.empty(0))
    passed = legs[-1].goal_time
    return components(
        legs[-1].end.time - task.start if passed is None else passed,
        np.concatenate([leg.speed for leg in legs]),
        np.concatenate([leg.acceleration for leg in legs]),
        np.concatenate([_driven_curvature(leg) for leg in legs]),
    )


def _driven_curvature(leg: Leg) -> Array:
    """Return the curvature [1/m] [N] of a leg; 0 while it waits at a light, as it does not turn."""
    waits = leg.stops.step - leg.first
    waits = waits[leg.speed[waits] < STILL]
    if len(waits) == 0:
        return leg.curvature
    curvature = leg.curvature.copy()
    curvature[waits] = 0.0
    return curvature


def held_up(legs: Sequence[Leg], start: float) -> tuple[HeldUp, ...]:
    """Join the hindered steps of a rollout into stretches, by vehicle.

    A vehicle that cut in is recorded as a leader if it then brakes while it is in the way: what
    costs time then is its braking.
    """
    return tuple(stretch for stretch in hindered(legs, start) if stretch.vehicle >= 0)


def hindered(legs: Sequence[Leg], start: float) -> tuple[HeldUp, ...]:
    """Join the hindered steps into stretches, phantoms (with negative numbers) included."""
    known = [leg.hindrances for leg in legs]
    step = np.concatenate([h.step for h in known]) if known else np.empty(0, np.int64)
    if len(step) == 0:
        return ()
    vehicle = np.concatenate([h.vehicle for h in known])
    order = np.argsort(vehicle, kind="stable")
    step, vehicle = step[order], vehicle[order]
    how = np.concatenate([h.how for h in known])[order]
    speed = np.concatenate([h.speed for h in known])[order]
    other = np.diff(vehicle) != 0
    other |= np.diff(step) > GRACE
    other |= np.diff(how == RIGHT_OF_WAY)
    begin = np.concatenate(([0], np.flatnonzero(other) + 1))
    end = np.concatenate((begin[1:], [len(step)])) - 1
    columns = (vehicle[begin], step[begin], step[end], how[begin], speed[begin])
    lowest = np.minimum.reduceat(speed, begin)
    rows = zip(*(column.tolist() for column in (*columns, lowest)), strict=True)
    found = [_stretch(start, *row) for row in rows]
    return tuple(sorted(found, key=lambda stretch: (stretch.since, stretch.vehicle)))


def _stretch(
    start: float, vehicle: int, first: int, last: int, code: int, speed: float, lowest: float
) -> HeldUp:
    """Return a stretch of steps `first` to `last` in which a vehicle held the ego up."""
    how: HoldUp = HOW[code]
    if how == "cut-in" and speed - lowest > 2.0:
        how = "leader"
    return HeldUp(
        vehicle=vehicle,
        since=round(start + first * DT, 2),
        until=round(start + (last + 1) * DT, 2),
        how=how,
        speed_from=round(speed, 2),
        speed_to=round(lowest, 2),
    )


def held_by_lights(legs: Sequence[Leg], start: float) -> tuple[HeldByLight, ...]:
    """Join the steps in which lights held the ego up into stretches, in order."""
    runs: list[tuple[Signal, int, int]] = []
    for leg in legs:
        for step, which in zip(leg.stops.step.tolist(), leg.stops.which.tolist(), strict=True):
            signal = leg.stops.signals[which]
            if runs and runs[-1][0] == signal and step - runs[-1][2] <= GRACE:
                runs[-1] = (signal, runs[-1][1], step)
            else:
                runs.append((signal, step, step))
    return tuple(
        HeldByLight(
            signal.controller,
            signal.index,
            round(start + first * DT, 2),
            round(start + (last + 1) * DT, 2),
        )
        for signal, first, last in runs
    )
