"""Goal recognition by inverse planning: goals of other road users, with probabilities.

For every goal in view, the best ways there are planned. `planner.prediction.likelihood` computes
how well a goal explains the track.
"""

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

import numpy as np

from planner.manoeuvres.actions import COMFORT, Situation
from planner.motion.forward import DT
from planner.motion.obstacles import NOBODY, Motions, Obstacle, Traffic
from planner.motion.surroundings import Others, Surroundings
from planner.motion.tracks import Observed, berth_of, coast, drive_on, links_of, queued
from planner.prediction.astar import GRIP, SOLUTIONS, Solution, held, ways
from planner.prediction.beliefs import NEGLIGIBLE, Belief, Trajectory, likeliest
from planner.prediction.goals import PLACES, Goal, goals_in_view
from planner.prediction.indication import indicated
from planner.prediction.likelihood import likelihoods
from planner.prediction.people import past_of, recognise_people
from planner.prediction.relevance import gives_way
from planner.prediction.stopping import stopping
from planner.record.trace import ON_FOOT, Action, EgoGoal, Settings
from planner.roads.trajectory import Roads
from planner.rollouts.rollout import Leg, Task, held_by_lights, held_up
from planner.traffic_lights.signals import DARK, Outlook

__all__ = ["Belief", "Trajectory", "motion_along", "recognise", "trajectories_to"]


@dataclass(frozen=True, eq=False)
class _Way:
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


@dataclass(frozen=True, slots=True, eq=False)
class _Coasting:
    """The motion of one road user that others expect."""

    elapsed: int  # steps of its track
    now: Motions  # from now on
    past: Obstacle  # from the first sample of its track on


def recognise(
    roads: Roads,
    tracks: Sequence[Observed],
    settings: Settings,
    time: float,
    ego: int,
    outlook: Outlook = DARK,
    apart: Collection[int] = (),
    bound: EgoGoal | None = None,
) -> dict[int, tuple[Belief, ...]]:
    """Return the beliefs about all road users except for the ego.

    Each expects the others to coast. A vehicle that stands, or will be held at a light, would then
    stand forever, so the others expect its likeliest motion: a queue dissolves from its head.
    Vehicles that have to give way to the ego expect it to drive to the place that it is bound for.

    Args:
        roads: the road network.
        tracks: vehicles in view, the ego included, and people on foot; each ends now.
        settings: view radius [m], horizon [s], rationality [1/s].
        time: [s] now.
        ego: number of the ego.
        outlook: the lights.
        apart: vehicles without beliefs: they count only as obstacles to others.
        bound: the place that the ego is bound for; None if it is not known, and the ego coasts.
    """
    steps = round(settings.horizon / DT)
    surroundings = Surroundings(roads, outlook, steps)
    usual = surroundings.lights(outlook.usual)
    people = [track for track in tracks if track.kind in ON_FOOT]
    vehicles = [track for track in tracks if track.kind not in ON_FOOT]
    coasting = {
        track.vehicle: _Coasting(
            track.elapsed,
            surroundings.on(track.kind).coast(track),
            coast(surroundings.on(track.kind).roads, track, steps, past=True, lights=usual),
        )
        for track in vehicles
    }
    found: dict[int, tuple[Belief, ...]] = {}
    if people:
        going_on = [mine.now.usual for mine in coasting.values()]
        found = recognise_people(surroundings, people, vehicles, going_on, settings)
    for walker in people:
        now = likeliest(found[walker.vehicle])
        coasting[walker.vehicle] = _Coasting(walker.elapsed, now, past_of(walker, now.usual))
    held = {one for one, mine in coasting.items() if outlook.known and mine.now.usual.rests}
    us: tuple[_Coasting, _Coasting] | None = None  # the ego as it coasts, and as it would drive
    for observed in queued(vehicles, held, None if bound is None else ego):
        one, own = observed.vehicle, surroundings.on(observed.kind)
        waits = observed.standing or one in held
        if one == ego and bound is not None:
            driving = _bound_for(own, observed, coasting, settings, time, bound)
            us = None if driving is None else (coasting[ego], driving)
        elif one != ego and one not in apart:
            found[one] = _beliefs(own, observed, coasting, settings, time, us)
            if waits:
                coasting[one] = replace(coasting[one], now=likeliest(found[one]))
    return {track.vehicle: found[track.vehicle] for track in tracks if track.vehicle in found}


def _frame(surroundings: Surroundings, observed: Observed, settings: Settings, time: float) -> Task:
    """Return the task of planning for a vehicle from now on, without a goal."""
    size, nowhere = (observed.length, observed.width), EgoGoal("", 0.0, None)
    steps, view, pace = surroundings.steps, settings.view_radius, observed.pace
    return Task(surroundings.roads, nowhere, size, time, steps, view, yielding=True, pace=pace)


def _bound_for(
    surroundings: Surroundings,
    observed: Observed,
    coasting: Mapping[int, _Coasting],
    settings: Settings,
    time: float,
    bound: EgoGoal,
) -> _Coasting | None:
    """Return the likeliest motion of a vehicle to the place that it is bound for."""
    others = [other.now for vehicle, other in coasting.items() if vehicle != observed.vehicle]
    starts = observed.situation(surroundings.roads, -1, time)
    goal, frame = Goal("continue", "", bound, 1.0), _frame(surroundings, observed, settings, time)
    found = _ways_on(frame, starts, goal, observed, Others(surroundings, tuple(others)))
    return replace(coasting[observed.vehicle], now=found[0].motions) if found else None


def _beliefs(
    surroundings: Surroundings,
    observed: Observed,
    coasting: Mapping[int, _Coasting],
    settings: Settings,
    time: float,
    us: tuple[_Coasting, _Coasting] | None,
) -> tuple[Belief, ...]:
    roads = surroundings.roads
    others = [other for vehicle, other in coasting.items() if vehicle != observed.vehicle]
    starts = observed.situation(roads, -1, time)
    if not starts:
        return _unknown(surroundings, observed)
    goals = goals_in_view(roads, starts, settings.view_radius)
    frame = _frame(surroundings, observed, settings, time)
    now = Others(surroundings, tuple(other.now for other in others))
    onwards = _ways_to(frame, starts, goals, observed, now)
    if us is not None:
        links = us[0].now.usual.links | us[1].now.usual.links
        reckoned = [us[1].now if other is us[0] else other.now for other in others]
        with_us = Others(surroundings, tuple(reckoned), now.pool)
        onwards = [
            _ways_on(frame, starts, goal, observed, with_us) or ways
            if ways and gives_way(roads.network, ways[0].motions.usual.links, links)
            else ways
            for goal, ways in zip(goals, onwards, strict=True)
        ]
    left = [ways[0].cost - ways[0].waiting if ways else None for ways in onwards]
    likelihood = (
        likelihoods(frame, observed, goals, left, _before(surroundings, observed, others), settings)
        if settings.recognition
        else [0.0 if driving is None else 1.0 for driving in left]
    )
    shown = [1.0] * len(goals)
    if settings.recognition:
        shown = indicated(roads, observed, starts[0], goals, settings.view_radius)
        likelihood = [like * share for like, share in zip(likelihood, shown, strict=True)]
    weights = [goal.prior * like for goal, like in zip(goals, likelihood, strict=True)]
    if sum(weights) == 0.0:
        return _unknown(surroundings, observed)
    weights = [w if w >= NEGLIGIBLE * sum(weights) else 0.0 for w in weights]
    return tuple(
        Belief(goal, like, weight / sum(weights), _trajectories(onward, settings, time), share)
        for goal, like, weight, onward, share in zip(
            goals, likelihood, weights, onwards, shown, strict=True
        )
        if weight > 0.0
    )


def _before(surroundings: Surroundings, observed: Observed, others: Sequence[_Coasting]) -> Traffic:
    """Return the motions of the others from the first sample of a track on."""
    return Traffic.shifted(
        [(other.past, observed.elapsed - other.elapsed) for other in others],
        surroundings.steps + observed.elapsed,
        surroundings.lights_before(observed.elapsed),
    )


def _unknown(surroundings: Surroundings, observed: Observed) -> tuple[Belief, ...]:
    """Return the belief about a vehicle for which no goal is possible: it coasts."""
    goal = Goal("continue", PLACES["continue"], None, 1.0)
    return (
        Belief(goal, 1.0, 1.0, (Trajectory(1.0, ("continue",), surroundings.coast(observed)),)),
    )


def _ways_to(
    frame: Task,
    starts: tuple[Situation, ...],
    goals: Sequence[Goal],
    observed: Observed,
    others: Others,
) -> list[list[_Way]]:
    """Return the ways on to each goal.

    If only stopping is possible within GRIP, the bends of the map are too sharp, and GRIP is
    ignored.
    """
    found = [_ways_on(frame, starts, goal, observed, others) for goal in goals]
    if any(ways for goal, ways in zip(goals, found, strict=True) if goal.target is not None):
        return found
    return [_ways_on(frame, starts, goal, observed, others, math.inf) for goal in goals]


def _ways_on(
    frame: Task,
    starts: tuple[Situation, ...],
    goal: Goal,
    observed: Observed,
    others: Others,
    grip: float = GRIP,
) -> list[_Way]:
    if goal.target is None:
        motion = stopping(frame, starts[0], observed, others.usual)
        cost = starts[0].speed / COMFORT
        return [] if motion is None else [_Way(cost, 0.0, ("stop",), (), lambda: Motions(motion))]
    task = replace(frame, goal=goal.target)
    solutions = ways(task, starts, others.usual, SOLUTIONS, grip)
    if not solutions:
        return _held_up(task, starts, observed, others, grip)
    return [
        _Way(
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
) -> list[_Way]:
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
        found.append(_Way(free.cost, 0.0, free.actions, far.legs, drive_on))
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


def _trajectories(onwards: list[_Way], settings: Settings, time: float) -> tuple[Trajectory, ...]:
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
    onwards = _ways_on(frame, starts, goal, observed, others)
    return _trajectories(onwards, settings, frame.start) if onwards else ()


def motion_along(frame: Task, legs: Sequence[Leg], observed: Observed, others: Traffic) -> Obstacle:
    """Return the motion along legs from now, and along the road from their end."""
    return _motion(frame, Solution(0.0, tuple(legs)), observed, others)
