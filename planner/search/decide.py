"""One decision: recognition of the others' goals, the search, and the record as a PlanTrace."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeAlias

import numpy as np

from planner.hidden_areas.caution import cautious
from planner.manoeuvres.actions import Situation
from planner.manoeuvres.footways import crossings_along
from planner.motion.forward import DT
from planner.motion.tracks import Observed, indicating, lanes_at
from planner.prediction.people import concerned
from planner.prediction.recognise import Belief, Trajectory, recognise
from planner.prediction.relevance import relevant
from planner.record.fitting import fitted
from planner.record.hidden_record import Phantom
from planner.record.light_record import LightPrediction
from planner.record.trace import (
    ON_FOOT,
    SCHEMA,
    Component,
    EgoGoal,
    GoalPrediction,
    PlanTrace,
    RewardTerm,
    Rollout,
    Settings,
    TimedAction,
    Track,
    TrajectoryPrediction,
    VehiclePrediction,
)
from planner.roads.trajectory import Array, Roads
from planner.rollouts.reward import COSTS
from planner.rollouts.rollout import Task
from planner.rollouts.waypoints import way, waypoint
from planner.search.mcts import Root, Search
from planner.search.road_facts import road_facts
from planner.search.simulated import Simulated
from planner.traffic_lights.signals import Outlook
from sim.roads.network import Crossing
from sim.scene import EGO, Point, VehicleState

Line: TypeAlias = tuple[tuple[Point, ...], tuple[float, ...]]  # places [m], speeds [m/s]

CROWD = 16  # maximum number of vehicles whose goals are recognised
DIGITS: dict[Component, int] = {
    "time": 2,
    "jerk": 4,
    "angular-acceleration": 5,
    "curvature": 6,
}


@dataclass(frozen=True, slots=True)
class Frame:
    """The inputs that stay the same from decision to decision."""

    roads: Roads
    goal: EgoGoal
    settings: Settings
    seed: int
    vehicle: str  # the car's id on the bus


@dataclass(frozen=True, slots=True)
class Moment:
    """The inputs that are new in every decision."""

    number: int
    time: float  # [s]
    scene: Mapping[int, VehicleState]
    history: Mapping[int, Track]
    root: Root
    unseen: Mapping[int, float] = field(default_factory=dict)  # [s] when last seen
    unpaced: frozenset[int] = frozenset()  # whose speed a removed vehicle limited
    lights: tuple[LightPrediction, ...] = ()
    phantoms: tuple[Phantom, ...] = ()

    @property
    def outlook(self) -> Outlook:
        """The courses that the lights may take."""
        return Outlook(self.time, self.lights)


@dataclass(frozen=True, slots=True, eq=False)
class Decision:
    """A decision: its record, and the beliefs, which the driver needs besides."""

    trace: PlanTrace
    beliefs: Mapping[int, Sequence[Belief]]


def decide(frame: Frame, moment: Moment) -> Decision:
    """Decide what to do next."""
    beliefs = predict(frame, moment)
    search = prepare(frame, moment, beliefs)
    search.run()
    return Decision(record(frame, moment, beliefs, search), beliefs)


def predict(frame: Frame, moment: Moment) -> dict[int, tuple[Belief, ...]]:
    """Recognise the goals of vehicles that may meet the ego, and of people who may get in its way.

    In a crowd, this covers only the nearest CROWD of these vehicles. Others that are near the ego
    count only as obstacles to them.
    """
    ego, view = moment.scene[EGO], frame.settings.view_radius
    nearest = sorted(
        (vehicle for vehicle, state in moment.scene.items() if state.kind not in ON_FOOT),
        key=lambda vehicle: math.dist(moment.scene[vehicle].position, ego.position),
    )
    people = concerned(frame.roads, moment.scene, _crossings_ahead(frame, moment), view)
    others = {vehicle: moment.scene[vehicle] for vehicle in nearest if vehicle != EGO}
    here = moment.root.here.location
    may_meet = relevant(frame.roads, others, here, frame.goal, frame.settings)
    planned = [vehicle for vehicle in nearest if vehicle in may_meet][:CROWD]
    tracks = [
        replace(
            observed(vehicle, moment.history[vehicle], moment.scene[vehicle]),
            paced=vehicle not in moment.unpaced,
        )
        for vehicle in sorted({*nearest[: 1 + CROWD], *planned, *people})
    ]
    apart = frozenset(others).difference(planned)
    found = lanes_at(frame.roads, ego.position, ego.heading)  # as recorded
    bound = waypoint(frame.roads, found[0], frame.goal) if found else None
    time, outlook = moment.time, moment.outlook
    return recognise(frame.roads, tracks, frame.settings, time, EGO, outlook, apart, bound)


def _crossings_ahead(frame: Frame, moment: Moment) -> tuple[Crossing, ...]:
    """Return the crossings for people on foot that lie on the ego's way."""
    here, under_way = moment.root.here.location.lane, moment.root.under_way
    lanes: tuple[str, ...] = (here,)
    if under_way is not None:
        plan, _ = under_way
        row = [lane for lane, start in plan.path.lanes if start <= plan.end]
        lanes = tuple(row[row.index(here) :]) if here in row else lanes
    edges = way(frame.roads, lanes, frame.goal)
    return crossings_along(frame.roads, here, edges, frame.settings.view_radius)


def prepare(
    frame: Frame, moment: Moment, beliefs: Mapping[int, Sequence[Belief]], salt: str = ""
) -> Search:
    """Return a search that has not been run yet; another `salt` gives it other random draws."""
    ego = moment.scene[EGO]
    task = Task(
        frame.roads,
        waypoint(frame.roads, moment.root.here.location, frame.goal),
        (ego.length, ego.width),
        moment.time,
        round(frame.settings.horizon / DT),
        frame.settings.view_radius,
        reacting=frame.settings.reacting is True,
        slow=cautious(moment.phantoms),
    )
    seed = f"{frame.seed}/{moment.number}{salt}"
    outlook, phantoms = moment.outlook, moment.phantoms
    return Search(task, moment.root, beliefs, frame.settings, seed, outlook, phantoms)


def observed(vehicle: int, track: Track, state: VehicleState) -> Observed:
    """Return a recorded track, ready for recognition."""
    return Observed(
        vehicle,
        state.length,
        state.width,
        np.array(track.position),
        np.array(track.heading),
        np.array(track.speed),
        indicating(state),
        kind=state.kind,
    )


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


def root_at(roads: Roads, ego: VehicleState, time: float) -> Situation | None:
    """Return the situation of the ego, from its state alone; None off the road."""
    found = lanes_at(roads, ego.position, ego.heading)
    if not found:
        return None
    return Situation(time, ego.position, ego.heading, ego.speed, ego.acceleration, found[0])
