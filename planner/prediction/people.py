"""Goals of people on foot: crossing here, walking on, or staying.

As with vehicles, a goal is more probable the less the observed track costs in excess of the best
way to it (see `planner.prediction.likelihood`). Waiting at a red light, or for vehicles that do
not make way, does not make a goal less probable. A person who stands although nothing keeps them
from going probably intends to stay.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from planner.kernels.course import Bools
from planner.kernels.limits import GAP_HORIZON, OPEN
from planner.motion.forward import DT
from planner.motion.kerbs import (
    came_over,
    crossing_under,
    crossings_near,
    is_by,
    people_first,
    walks_back,
)
from planner.motion.obstacles import Motions, Obstacle
from planner.motion.surroundings import Surroundings
from planner.motion.tracks import Observed
from planner.motion.walking import (
    HALF_LANE,
    KERB,
    MEAN,
    WALKING,
    Route,
    across,
    direction_of,
    may_go,
    on_road,
    onward,
    paces,
    place_of,
    stand,
    walk,
)
from planner.prediction.beliefs import NEGLIGIBLE, Belief, Trajectory
from planner.prediction.goals import Goal
from planner.record.trace import ON_FOOT, EgoGoal, Settings
from planner.roads.trajectory import Array, Roads
from sim.roads.network import Crossing, angle_between, cumulative, project
from sim.scene import EGO, Signal, VehicleState

MOST = 8  # greatest number of people whose goals are recognised
BEHIND = 10.0  # [m] behind the ego; people farther behind do not matter to it
LOOK = 25  # samples of a track that are used, the latest ones
STAY = 0.1  # prior of staying; the other goals share the rest equally
UNEXPLAINED = 0.01  # share of people whose track says nothing about their goal
ROADSIDE = 50.0  # [m] from the ego within which people on a road count, wherever they go
TURNING = 0.5  # [s] of excess for heading at a right angle to the way to a goal
BEFORE_IT = 0.5  # [m] from the line of a crossing within which a person is in front of it
AT_KERB = 3.0  # [m] from a crossing within which somebody waits for it
FARTHER = 20.0  # [m] assumed distance of the goal of a person who walks on
COMING = 6.0  # [s] before a vehicle reaches a crossing, during which people wait for it
CREEPING = 1.0  # [m/s] up to which a vehicle counts as making way
ASLANT = math.pi / 4  # [rad] to the road; somebody who walks on it at a greater angle crosses it

PLACES = {
    "cross": "the other side of the road",
    "continue": "the way straight on",
    "stop": "where it stands",
}


@dataclass(frozen=True, slots=True)
class _Aim:
    """One goal of a person on foot, and the way there."""

    goal: Goal
    route: Route | None  # None: stays
    excess: float  # [s]


def concerned(
    roads: Roads, scene: Mapping[int, VehicleState], crossings: Sequence[Crossing], view: float
) -> list[int]:
    """Return the numbers of the people who may get in the ego's way, nearest first.

    Args:
        roads: the road network.
        scene: all road users, by number.
        crossings: those on the ego's way.
        view: [m] how far away people matter.
    """
    ego, found = scene[EGO], []
    cos, sin = math.cos(ego.heading), math.sin(ego.heading)
    for name, state in scene.items():
        if state.kind not in ON_FOOT:
            continue
        dx, dy = state.position[0] - ego.position[0], state.position[1] - ego.position[1]
        away = math.hypot(dx, dy)
        if away > view or dx * cos + dy * sin < -BEHIND:
            continue
        near = any(is_by(crossing, state.position) for crossing in crossings)
        if near or (away < ROADSIDE and on_road(roads.network, state.position)):
            found.append((away, name))
    return [name for _, name in sorted(found)[:MOST]]


def recognise_people(
    surroundings: Surroundings,
    people: Sequence[Observed],
    vehicles: Sequence[Observed],
    coasting: Sequence[Obstacle],
    settings: Settings,
) -> dict[int, tuple[Belief, ...]]:
    """Return the goals that people may have, with probabilities.

    Args:
        surroundings: the roads and lights.
        people: tracks of the people whose goals are recognised; they end now.
        vehicles: all in view, the ego included.
        coasting: the same vehicles, each going on as it does now.
        settings: rationality [1/s].
    """
    busy: dict[str, Bools] = {}
    found = {}
    for person in people:
        aims = _aims(surroundings, person, vehicles, settings)
        found[person.vehicle] = _beliefs(surroundings, person, aims, coasting, busy, settings)
    return found


def ways_of(
    surroundings: Surroundings,
    person: Observed,
    vehicles: Sequence[Observed],
    coasting: Sequence[Obstacle],
    settings: Settings,
) -> tuple[Belief, ...]:
    """Return every goal that a person may have, however improbable, each with probability 1."""
    aims = _aims(surroundings, person, vehicles, settings)
    busy: dict[str, Bools] = {}
    return tuple(
        Belief(aim.goal, 0.0, 1.0, _trajectories(surroundings, person, aim, coasting, busy))
        for aim in aims
    )


def _aims(
    surroundings: Surroundings, person: Observed, vehicles: Sequence[Observed], settings: Settings
) -> list[_Aim]:
    """Return the goals that a person may have, staying last."""
    network, here = surroundings.roads.network, place_of(person)
    on = crossing_under(surroundings.roads, here)
    routes: list[tuple[Crossing, Route]] = []
    if on is not None:
        routes = [(on, across(person, on, back=walks_back(person, on), on=True))]
    else:
        for crossing, back in crossings_near(surroundings.roads, here):
            if not came_over(person, crossing):
                routes.append((crossing, across(person, crossing, back=back, on=False)))
    waits = any(x.kerb is not None and x.kerb <= KERB for _, x in routes)
    reach = settings.horizon * MEAN
    ahead = None if on is not None else onward(network, person, reach, waits=waits)
    share = (1.0 - STAY) / (len(routes) + (ahead is not None))
    aims = []
    for crossing, route in routes:
        target = EgoGoal(crossing.id.rpartition("_")[0], 0.0, None)
        excess = 0.0 if on is not None else _crossing_excess(surroundings, person, route, vehicles)
        aims.append(_Aim(Goal("cross", PLACES["cross"], target, share), route, excess))
    if ahead is not None:
        kind = "cross" if _aslant(surroundings.roads, person) else "continue"
        goal = Goal(kind, PLACES[kind], None, share)  # type: ignore[arg-type]
        aims.append(_Aim(goal, ahead, _onward_excess(person)))
    return [*aims, _Aim(Goal("stop", PLACES["stop"], None, STAY), None, 0.0)]


def _beliefs(
    surroundings: Surroundings,
    person: Observed,
    aims: Sequence[_Aim],
    coasting: Sequence[Obstacle],
    busy: dict[str, Bools],
    settings: Settings,
) -> tuple[Belief, ...]:
    best = min(aim.excess for aim in aims)
    like = [
        (1.0 - UNEXPLAINED) * math.exp(-settings.rationality * (aim.excess - best)) + UNEXPLAINED
        if settings.recognition
        else 1.0
        for aim in aims
    ]
    weights = [aim.goal.prior * one for aim, one in zip(aims, like, strict=True)]
    weights = [w if w >= NEGLIGIBLE * sum(weights) else 0.0 for w in weights]
    return tuple(
        Belief(
            aim.goal,
            one,
            w / sum(weights),
            _trajectories(surroundings, person, aim, coasting, busy),
        )
        for aim, one, w in zip(aims, like, weights, strict=True)
        if w > 0.0
    )


def _trajectories(
    surroundings: Surroundings,
    person: Observed,
    aim: _Aim,
    coasting: Sequence[Obstacle],
    busy: dict[str, Bools],
) -> tuple[Trajectory, ...]:
    """Return the ways to a goal, one for each speed."""
    kind, route, steps = aim.goal.kind, aim.route, surroundings.steps + 1
    if route is None:
        return (Trajectory(1.0, (kind,), Motions(stand(person, steps))),)
    on_it, one = np.zeros(steps, np.bool_), route.crossing
    waits = one is not None and not people_first(surroundings.roads, one)
    if one is not None and waits:
        if one.id not in busy:
            busy[one.id] = _busy(one, coasting, steps)
        on_it = busy[one.id]

    def under(courses: tuple[int, ...], pace: float) -> Obstacle:
        lights = surroundings.lights(courses)
        free = may_go(route, pace, lights, on_it, steps, gaps=waits)
        return walk(person, route, pace, free)

    return tuple(
        Trajectory(share, (kind,), surroundings.motions(partial(under, pace=pace)))
        for pace, share in paces(person)
    )


def _crossing_excess(
    surroundings: Surroundings, person: Observed, route: Route, vehicles: Sequence[Observed]
) -> float:
    """Return the excess cost [s] of the track and the rest of the way to a crossing."""
    first = max(person.elapsed - LOOK, 0)
    speed, position = person.speed[first:], person.position[first:]
    pace = _pace(speed)
    start, kerb = (float(position[0, 0]), float(position[0, 1])), route.points[1]
    assert route.kerb is not None
    best, left = math.dist(start, kerb) / pace, route.kerb / pace
    spent = (len(speed) - 1) * DT
    if route.kerb <= AT_KERB and np.any(speed < WALKING) and route.crossing is not None:
        idle = (speed < WALKING)[1:]
        spent -= DT * int(
            np.sum(idle & _excused(surroundings, route.crossing, vehicles, len(idle)))
        )
    return max(spent + left - best, 0.0) + TURNING * (1.0 - math.cos(_turned(person, route)))


def _turned(person: Observed, route: Route) -> float:
    """Return the angle [rad] between a person's direction and the direction to cross."""
    here, entry, far = place_of(person), route.points[1], route.points[2]
    assert route.crossing is not None
    _, aside, _ = project((entry, far), here)
    target = far if abs(aside) < BEFORE_IT else entry
    wanted = math.atan2(target[1] - here[1], target[0] - here[0])
    return angle_between(direction_of(person), wanted)


def _onward_excess(person: Observed) -> float:
    """Return the excess cost [s] of the track over going straight on in its first direction."""
    first = max(person.elapsed - LOOK, 0)
    position, speed = person.position[first:], person.speed[first:]
    pace, start = _pace(speed), position[0]
    moved = np.hypot(*(position - start).T)
    away = np.flatnonzero(moved > 1.0)
    ahead = np.array([math.cos(direction_of(person)), math.sin(direction_of(person))])
    if len(away):
        ahead = (position[away[0]] - start) / moved[away[0]]
    target = start + (FARTHER + moved[-1]) * ahead
    left = float(np.hypot(*(target - position[-1]))) / pace
    return max((len(speed) - 1) * DT + left - (FARTHER + float(moved[-1])) / pace, 0.0)


def _pace(speed: Array) -> float:
    walked = speed[speed >= WALKING]
    return float(np.mean(walked)) if len(walked) else MEAN


def _excused(
    surroundings: Surroundings, crossing: Crossing, vehicles: Sequence[Observed], samples: int
) -> Bools:
    """Return in which of the last samples a person had to wait at a crossing [samples]."""
    if isinstance(crossing.control, Signal):
        before = surroundings.outlook.before(samples, surroundings.steps + GAP_HORIZON)
        held: Bools = before.shows(crossing.control, samples)[:samples] > OPEN
        return held
    middle = np.mean(np.array(crossing.line), axis=0)
    reach = 0.5 * cumulative(crossing.line)[-1]
    coming: Bools = np.zeros(samples, np.bool_)
    for other in vehicles:
        n = min(samples, len(other.speed))
        offset = middle - other.position[-n:]
        cos, sin = np.cos(other.heading[-n:]), np.sin(other.heading[-n:])
        speed = other.speed[-n:]
        along = offset[:, 0] * cos + offset[:, 1] * sin
        aside = np.abs(offset[:, 1] * cos - offset[:, 0] * sin)
        near = (along > -other.length) & (along < COMING * speed + reach) & (aside < reach + 2.0)
        coming[samples - n :] |= near & (speed > CREEPING)
    return coming


def _busy(crossing: Crossing, coasting: Sequence[Obstacle], steps: int) -> Bools:
    """Return at which steps vehicles that go on as they do now are on a crossing [steps]."""
    start, end = np.array(crossing.line[0]), np.array(crossing.line[-1])
    length = float(np.hypot(*(end - start)))
    cos, sin = (end - start) / max(length, 1e-6)
    found: Bools = np.zeros(steps, np.bool_)
    for other in coasting:
        n = min(steps, len(other.speed))
        back = 0.5 * other.length
        x = other.position[:n, 0] - back * np.cos(other.heading[:n]) - start[0]
        y = other.position[:n, 1] - back * np.sin(other.heading[:n]) - start[1]
        along, aside = x * cos + y * sin, np.abs(y * cos - x * sin)
        found[:n] |= (along > 0.0) & (along < length) & (aside < back + 0.5 * crossing.width)
    return found


def _aslant(roads: Roads, person: Observed) -> bool:
    """Check whether a person on a road walks across it rather than along it."""
    found = roads.network.locate(place_of(person), 0.0, HALF_LANE, math.pi)
    if not found or person.speed[-1] < WALKING:
        return False
    _, _, along = project(roads.network.lanes[found[0].lane].centreline, place_of(person))
    return abs(math.sin(angle_between(direction_of(person), along))) > math.sin(ASLANT)


def past_of(person: Observed, motion: Obstacle) -> Obstacle:
    """Return a person's whole track, followed by a motion."""
    return replace(
        motion,
        position=np.vstack((person.position[:-1], motion.position)),
        heading=np.concatenate((person.heading[:-1], motion.heading)),
        speed=np.concatenate((person.speed[:-1], motion.speed)),
    )
