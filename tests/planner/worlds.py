"""Small worlds on the roads of s1 and s2, made by hand: no SUMO.

Places are given by lane and offset from its end, so that they hold wherever a junction lies.
"""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from planner.manoeuvres.actions import ActionPlan, Situation, expand
from planner.motion.forward import DT
from planner.motion.obstacles import Obstacle
from planner.motion.tracks import links_of
from planner.record.trace import Action, EgoGoal, Settings, Track
from planner.roads.routes import Refusal
from planner.roads.trajectory import Path, Roads
from planner.search.inputs import Frame, Moment, Root, root_at
from planner.search.mcts import Search
from sim.roads.netfile import read_network
from sim.roads.network import Direction, Link, Location, point_at
from sim.scene import EGO, VehicleState
from sim.setup.scenario import load

LENGTH, WIDTH = 4.8, 1.8  # [m] of every vehicle here
SIZE = (LENGTH, WIDTH)
VIEW = 100.0  # [m]
QUICK = Settings(rollouts=30, min_rollouts=4)

#: From which lane the ego of each scenario starts.
START = {"s1": "main_in_0", "s2": "south_in_0"}


@cache
def roads(name: str) -> Roads:
    """The roads of a scenario."""
    return Roads(read_network(load(name).network))


@cache
def goal(name: str) -> EgoGoal:
    """Where the ego of a scenario wants to go."""
    wanted = load(name).goal
    return EgoGoal(wanted.edge, wanted.position, wanted.lane)


def link(name: str, lane: str, direction: Direction) -> Link:
    """The link from a lane in a direction."""
    links = roads(name).network.links_from(lane)
    return next(link for link in links if link.direction == direction)


def row(name: str, lane: str, direction: Direction | None = None) -> tuple[str, ...]:
    """A lane alone, or with the way through the junction and the lane beyond."""
    if direction is None:
        return (lane,)
    way = link(name, lane, direction)
    return (lane, *way.via, way.to_lane)


def before_end(name: str, lane: str, distance: float) -> float:
    """The offset [m] on a lane at a distance [m] before its end."""
    return roads(name).network.lanes[lane].length - distance


@dataclass(frozen=True)
class Seen:
    """A vehicle as it is now, and how it came here."""

    state: VehicleState
    track: Track


def changing(name: str, lane: str, onto: str, at: float, length: float = 25.0) -> Path:
    """The line of a lane change that begins at an offset [m] on a lane."""
    here = situation(name, lane, at)
    lanes = (onto, *row(name, onto, "straight")[1:])
    return roads(name).path(lanes, here.position, here.heading, length, 200.0)


def driven(line: Path, until: float, speeds: Sequence[float], time: float = 0.0) -> Seen:
    """A vehicle that drove along a line at the given speeds [m/s] at 5 Hz.

    Args:
        line: a path, or the centreline of connected lanes.
        until: [m] arc at which it is now.
        speeds: of all samples, now last.
        time: [s] now.
    """
    steps = [0.5 * (a + b) * DT for a, b in itertools.pairwise(speeds)]
    arcs = until - np.concatenate((np.cumsum(steps[::-1])[::-1], [0.0]))
    poses = [line.pose(float(arc)) for arc in arcs]
    track = Track(
        round(time - DT * (len(speeds) - 1), 3),
        tuple((round(x, 2), round(y, 2)) for (x, y), _ in poses),
        tuple(round(heading, 4) for _, heading in poses),
        tuple(speeds),
    )
    state = VehicleState(track.position[-1], track.heading[-1], speeds[-1], 0.0, LENGTH, WIDTH)
    return Seen(state, track)


def still(name: str, lanes: tuple[str, ...], at: float, speed: float = 8.0) -> Seen:
    """A vehicle that comes into view now."""
    return driven(roads(name).line(lanes), at, (speed,))


def frame(name: str, settings: Settings = QUICK, seed: int = 0) -> Frame:
    """What the decisions of a ride have in common."""
    return Frame(roads(name), goal(name), settings, seed, "car")


def moment(name: str, seen: Mapping[int, Seen], time: float = 0.0, number: int = 0) -> Moment:
    """A decision to take; 0 is the ego."""
    here = root_at(roads(name), seen[EGO].state, time)
    assert here is not None
    scene = {vehicle: one.state for vehicle, one in seen.items()}
    history = {vehicle: one.track for vehicle, one in seen.items()}
    return Moment(number, time, scene, history, Root(here))


def situation(
    name: str, lane: str, offset: float, speed: float = 8.0, acceleration: float = 0.0
) -> Situation:
    """On the centreline of a lane at an offset [m]."""
    position, heading = point_at(roads(name).network.lanes[lane].centreline, offset)
    return Situation(0.0, position, heading, speed, acceleration, Location(lane, offset, 0.0))


def plan_of(name: str, here: Situation, action: Action, *, aim: bool = False) -> ActionPlan:
    """The plan for an action that applies; with `aim`, towards the scenario's goal."""
    plan = expand(roads(name), here, action, goal(name) if aim else None, VIEW)
    assert not isinstance(plan, Refusal), plan.reason
    return plan


def obstacle(
    name: str, lanes: tuple[str, ...], arcs: Sequence[float], vehicle: int = 1
) -> Obstacle:
    """A vehicle whose front is at the given arcs [m] along lanes, step by step."""
    line: Path = roads(name).line(lanes)
    poses = [line.pose(arc) for arc in arcs]
    return Obstacle(
        vehicle,
        LENGTH,
        WIDTH,
        np.array([position for position, _ in poses]),
        np.array([heading for _, heading in poses]),
        np.gradient(np.array(arcs)) / DT if len(arcs) > 1 else np.zeros(1),
        links_of(roads(name), lanes),
    )


def run(search: Search) -> None:
    """Run all rollouts of a search, in one tree."""
    search.grow(search.settings.rollouts)
    search.conclude()
