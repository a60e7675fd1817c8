"""The record of a decision as a PlanTrace."""

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np

from planner.motion.forward import DT
from planner.prediction.recognise import Belief, Trajectory
from planner.record.fitting import fitted
from planner.record.trace import (
    SCHEMA,
    Component,
    GoalPrediction,
    PlanTrace,
    RewardTerm,
    Rollout,
    TimedAction,
    TrajectoryPrediction,
    VehiclePrediction,
)
from planner.roads.trajectory import Array
from planner.rollouts.reward import COSTS
from planner.search.inputs import Frame, Moment
from planner.search.mcts import Search
from planner.search.road_facts import road_facts
from planner.search.simulated import Simulated
from sim.scene import Point

Line: TypeAlias = tuple[tuple[Point, ...], tuple[float, ...]]  # places [m], speeds [m/s]

DIGITS: dict[Component, int] = {
    "time": 2,
    "jerk": 4,
    "angular-acceleration": 5,
    "curvature": 6,
}


def record(
    frame: Frame, moment: Moment, beliefs: Mapping[int, Sequence[Belief]], search: Search
) -> PlanTrace:
    """Return the trace of a decision."""
    under_way, plan = moment.root.under_way, search.plan()
    view = frame.settings.view_radius
    trace = PlanTrace(
        schema=SCHEMA,
        vehicle=frame.vehicle,
        sim_time=moment.time,
        decision=moment.number,
        seed=frame.seed,
        settings=frame.settings,
        network=frame.roads.network.hash,
        goal=frame.goal,
        under_way=None if under_way is None else TimedAction(under_way[0].action, moment.time),
        history=dict(sorted(moment.history.items())),
        scene=dict(sorted(moment.scene.items())),
        predictions=tuple(
            VehiclePrediction(vehicle, tuple(_goal(belief) for belief in known))
            for vehicle, known in beliefs.items()
        ),
        rollouts=rollouts(search.rollouts, moment.time),
        not_applicable=search.not_applicable(),
        plan=plan,
        unseen=dict(sorted(moment.unseen.items())),
        waypoint=None if search.task.goal == frame.goal else search.task.goal,
        road=road_facts(
            frame.roads, moment.scene, moment.root, plan, frame.goal, view, moment.lights
        ),
        costs=COSTS,
        lights=moment.lights,
        phantoms=moment.phantoms,
        driving=moment.root.driving,
    )
    return fitted(trace)


def rollouts(simulated: Sequence[Simulated], start: float, offset: int = 0) -> tuple[Rollout, ...]:
    """Return the records of rollouts, numbered from `offset`, each path and speed recorded once."""
    seen: dict[Line, int] = {}
    lines: dict[tuple[int, ...], Line] = {}  # by legs, which many rollouts share
    parts: dict[int, dict[Component, float | None]] = {}  # by identity, as they are shared
    costs: dict[int, dict[RewardTerm, float]] = {}
    found = []
    for index, one in enumerate(simulated, offset):
        legs = tuple(map(id, one.legs))
        line = lines.get(legs)
        if line is None:
            line = lines[legs] = _line(one)
        if id(one.terms) not in costs:
            costs[id(one.terms)] = {term: round(cost, 4) for term, cost in one.terms.items()}
        if id(one.components) not in parts:
            parts[id(one.components)] = {
                name: None if value is None else round(value, DIGITS[name])
                for name, value in one.components.items()
            }
        first = seen.setdefault(line, index)
        new = first == index
        found.append(
            Rollout(
                index=index,
                forced=one.forced,
                samples=one.samples,
                actions=tuple(
                    TimedAction(leg.action, round(start + leg.first * DT, 2)) for leg in one.legs
                ),
                path=line[0] if new else None,
                speed=line[1] if new else None,
                same_as=None if new else first,
                outcome=one.outcome,
                components=parts[id(one.components)],
                reward=one.reward,
                collided_with=one.legs[-1].collided_with if one.legs else None,
                held_up=one.held_up,
                terms=costs[id(one.terms)],
                weight=None if one.weight is None else round(one.weight, 6),
                braking=one.braking,
                lights=one.lights,
                held_by_lights=one.held_by_lights,
                phantoms=one.phantoms,
                held_by_hidden=one.held_by_hidden,
            )
        )
    return tuple(found)


def _line(one: Simulated) -> Line:
    if not one.legs:
        return (), ()
    position = np.vstack((one.legs[0].position[:1], *(leg.position[1:] for leg in one.legs)))
    speed = np.concatenate((one.legs[0].speed[:1], *(leg.speed[1:] for leg in one.legs)))
    return points(position), numbers(speed)


def points(position: Array) -> tuple[Point, ...]:
    """Return positions [m] [N, 2] as the trace records them, to the decimetre."""
    x, y = np.round(position, 1).T.tolist()
    return tuple(zip(x, y, strict=True))


def numbers(values: Array) -> tuple[float, ...]:
    """Return speeds [m/s] [N] as the trace records them."""
    return tuple(np.round(values, 1).tolist())


def _goal(belief: Belief) -> GoalPrediction:
    target = belief.goal.target
    return GoalPrediction(
        kind=belief.goal.kind,
        place=belief.goal.place,
        edge=None if target is None else target.edge,
        prior=round(belief.goal.prior, 6),
        likelihood=round(belief.likelihood, 6),
        probability=round(belief.probability, 6),
        trajectories=tuple(_trajectory(way) for way in belief.trajectories),
        indicators=round(belief.indicators, 4),
    )


def _trajectory(way: Trajectory) -> TrajectoryPrediction:
    there = ~np.isnan(way.motion.position[:, 0])
    return TrajectoryPrediction(
        probability=round(way.probability, 6),
        actions=way.actions,
        path=points(way.motion.position[there]),
        speed=numbers(way.motion.speed[there]),
        held_up=way.held_up,
        held_by_lights=way.held_by_lights,
    )
