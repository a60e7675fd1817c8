"""Synthetic decisions: traces of any size, for timing their explanation."""

import itertools
import random

from planner.record.trace import (
    SCHEMA,
    Action,
    Component,
    EgoGoal,
    GoalPrediction,
    HeldUp,
    PlannedAction,
    PlanTrace,
    Rollout,
    Sample,
    Settings,
    TimedAction,
    TrajectoryPrediction,
    VehiclePrediction,
)
from sim.scene import EGO, VehicleState

ACTIONS: tuple[Action, ...] = ("continue", "change-left", "stop")
FACT: Action = "change-left"
FOIL: Action = "continue"
GOALS: tuple[Action, ...] = ("exit-right", "continue")
STANDING = VehicleState((0.0, 0.0), 0.0, 0.0, 0.0, 4.5, 1.8)
WAYS = 2  # trajectories of a goal
EVERY_SO_OFTEN = 9  # one of this many rollouts collides

Choices = tuple[tuple[int, int], ...]  # goal and trajectory of every vehicle, in order
Plan = tuple[Action, ...]


def made_up(vehicles: int, depth: int, rollouts: int, seed: int = 0) -> PlanTrace:
    """Return a decision with given numbers of others, actions in a row, and random rollouts."""
    rng = random.Random(f"{vehicles}/{depth}/{rollouts}/{seed}")
    seen = _predictions(vehicles, rng)
    options = [(g, t) for g in range(len(GOALS)) for t in range(WAYS)]
    weights = [
        [goal.probability * way.probability for goal in one.goals for way in goal.trajectories]
        for one in seen
    ]
    rows = []
    for k in range(rollouts):
        first = ACTIONS[k % len(ACTIONS)]  # the later ones go on as they began
        later = first if rng.random() < 0.7 else rng.choice(ACTIONS)
        drawn = tuple(rng.choices(options, weight)[0] for weight in weights)
        rows.append(((first, *(later,) * (depth - 1)), drawn))
    return _trace(seen, rows, seed)


def complete(vehicles: int, depth: int, seed: int = 0) -> PlanTrace:
    """Return a decision in which every plan was tried with every sample, once."""
    rng = random.Random(f"{vehicles}/{depth}/{seed}")
    options = [(g, t) for g in range(len(GOALS)) for t in range(WAYS)]
    samples = list(itertools.product(options, repeat=vehicles))
    plans = itertools.product(ACTIONS, repeat=depth)
    rows = [(plan, sample) for plan in plans for sample in samples]
    return _trace(_predictions(vehicles, rng), rows, seed)


def _predictions(vehicles: int, rng: random.Random) -> tuple[VehiclePrediction, ...]:
    return tuple(_prediction(vehicle, rng) for vehicle in range(1, vehicles + 1))


def _prediction(vehicle: int, rng: random.Random) -> VehiclePrediction:
    chance = round(rng.uniform(0.1, 0.9), 3)
    goals = []
    for kind, probability in zip(GOALS, (chance, 1.0 - chance), strict=True):
        share = round(rng.uniform(0.2, 0.8), 3)
        ways = tuple(TrajectoryPrediction(p, (kind,), (), ()) for p in (share, 1.0 - share))
        goals.append(GoalPrediction(kind, kind, kind, 0.5, 1.0, probability, ways))
    return VehiclePrediction(vehicle, tuple(goals))


def _trace(
    seen: tuple[VehiclePrediction, ...], rows: list[tuple[Plan, Choices]], seed: int
) -> PlanTrace:
    return PlanTrace(
        schema=SCHEMA,
        vehicle="car",
        sim_time=0.0,
        decision=0,
        seed=seed,
        settings=Settings(),
        network="0",
        goal=EgoGoal("out", 80.0, None),
        under_way=None,
        history={},
        scene=dict.fromkeys((EGO, *(one.vehicle for one in seen)), STANDING),
        predictions=seen,
        rollouts=tuple(_rollout(k, plan, drawn) for k, (plan, drawn) in enumerate(rows)),
        not_applicable=(),
        plan=(PlannedAction(FACT, -12.0, len(rows)),),
    )


def _rollout(index: int, plan: Plan, drawn: Choices) -> Rollout:
    """Return the rollout of a plan with a sample: odd vehicles slow those that stay behind."""
    slow = [k + 1 for k, (goal, _) in enumerate(drawn) if goal == 0 and k % 2 == 0]
    behind = FOIL in plan
    dice = random.Random(f"{plan}/{drawn}")
    collides = behind and dice.randrange(EVERY_SO_OFTEN) == 0
    time = 12.0 + (3.0 * len(slow) if behind else 0.0) + sum(way for _, way in drawn) / 10.0
    values: dict[Component, float | None] = {
        "time": time,
        "jerk": dice.uniform(0.3, 0.9),
        "angular-acceleration": dice.uniform(0.0, 0.1),
        "curvature": dice.uniform(0.0, 0.01),
    }
    held = tuple(HeldUp(v, 1.0, 4.0, "leader", 10.0, 5.0) for v in slow) if behind else ()
    return Rollout(
        index=index,
        forced=False,
        samples=tuple(Sample(k + 1, goal, way) for k, (goal, way) in enumerate(drawn)),
        actions=tuple(TimedAction(action, 2.0 * d) for d, action in enumerate(plan)),
        path=None,
        speed=None,
        same_as=None,
        outcome="collision" if collides else "done",
        components=dict.fromkeys(values) if collides else values,
        reward=-200.0 if collides else -time,
        collided_with=1 if collides else None,
        held_up=held,
    )
