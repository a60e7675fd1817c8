"""Approaching: how close a vehicle will come, by our plan and by what is expected of it."""

import math
from collections.abc import Sequence
from dataclasses import replace

from planner.record.trace import SAMPLE_PERIOD, PlanTrace, TrajectoryPrediction
from sim.scene import EGO, Point, VehicleState
from xavi_dialogue.domain.answers import Closeness
from xavi_dialogue.domain.facts import Measure
from xavi_dialogue.domain.terms import Ego, Vehicle
from xavi_dialogue.explain.answers.expectations.foreseen import collision_chance
from xavi_dialogue.explain.answers.reference.asked import Asked
from xavi_dialogue.explain.causes.vehicles.course import lines
from xavi_dialogue.explain.facts.bodies import at_least, distance
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.ride import planned, prediction

STRIDE = 0.3  # [m] minimum distance of two places that give a heading


def foreseen_closeness(asked: Asked, vehicle: int) -> Closeness | None:
    """Return how close a vehicle comes if all goes as planned and expected; None: not known."""
    trace = asked.ride.at(asked.now, vehicle)
    here, there = (asked.world.states.state(one, asked.now) for one in (EGO, vehicle))
    if trace is None or here is None or there is None:
        return None
    course = _course(trace, vehicle)
    found = None if course is None else _closest(trace, (here, there), *course, asked.now)
    if found is None:
        return None
    apart, time = found
    closest = Measure("distance", Ego(), time, value=apart, to=Vehicle(vehicle), extreme="lowest")
    risk = collision_chance(asked, asked.now, vehicle)
    return Closeness(vehicle, closest, None, risk, "close", asked.now, past=False, foreseen=True)


def _course(trace: PlanTrace, vehicle: int) -> tuple[Motion, TrajectoryPrediction] | None:
    """Return our line in a rollout of the plan, and the vehicle's way in it, the likeliest one."""
    known, ours = prediction(trace, vehicle), lines(trace)
    plan = planned(trace)[:1]
    found: list[tuple[float, int, int, TrajectoryPrediction]] = []
    for rollout in trace.rollouts:
        begun = tuple(a.action for a in rollout.actions[:1]) == plan
        drawn = next((s for s in rollout.samples if s.vehicle == vehicle), None)
        if known is None or drawn is None or not begun or rollout.index not in ours:
            continue
        goal = known.goals[drawn.goal]
        way = goal.trajectories[drawn.trajectory]
        if len(way.path) > 1:
            share = goal.probability * way.probability
            found.append((share, len(ours[rollout.index].position), -rollout.index, way))
    if not found:
        return None
    _, _, index, way = max(found, key=lambda one: one[:3])
    return ours[-index], way


def _closest(
    trace: PlanTrace,
    now: tuple[VehicleState, VehicleState],
    ours: Motion,
    way: TrajectoryPrediction,
    begin: float,
) -> tuple[float, float] | None:
    """Return the smallest distance [m] of both bodies from a time [s] on, and when [s] that is."""
    best: tuple[float, float] | None = None
    for k in range(min(len(ours.position), len(way.path))):
        time = trace.sim_time + k * SAMPLE_PERIOD
        if time < begin:
            continue
        one, other = _at(now[0], ours.position, k), _at(now[1], way.path, k)
        if best is not None and at_least(one, other) >= best[0]:
            continue
        apart = distance(one, other)
        if best is None or apart < best[0]:
            best = (apart, time)
    return best


def _at(state: VehicleState, path: Sequence[Point], k: int) -> VehicleState:
    """Return the state of a vehicle at a sample of its course, heading along it."""
    x, y = path[k]
    before = (p for p in reversed(path[:k]) if math.dist(p, path[k]) >= STRIDE)
    last = next(before, None)
    heading = state.heading if last is None else math.atan2(y - last[1], x - last[0])
    return replace(state, position=(x, y), heading=heading)
