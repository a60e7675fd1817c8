"""Motions of people on foot: over crossings, along the road, and when they set out.

Walking speeds are those of Weidmann (1993, Transporttechnik der Fussgaenger, ETH Zurich): 1.34 m/s
with a standard deviation of 0.26.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from planner.kernels.course import Bools
from planner.kernels.elementary import arctan2
from planner.kernels.limits import OPEN
from planner.motion.obstacles import Obstacle
from planner.motion.tracks import Observed
from planner.roads.trajectory import Array
from planner.traffic_lights.signals import STEP, Lights
from sim.roads.network import Crossing, Network, cumulative, point_at, project
from sim.scene import Point, Signal

MEAN, DEVIATION = 1.34, 0.26  # [m/s]
#: Three speeds that represent all, in standard deviations from the mean, with probabilities.
SPREAD = ((-1.04, 0.3), (0.0, 0.4), (1.04, 0.3))
WALKING = 0.3  # [m/s] minimum speed of a person who counts as walking
BESIDE = 0.3  # [m] minimum distance of people on a crossing from its edge
AWAY = 2.0  # [m] distance beyond a crossing at which a person is out of the way
SAFE = 1.5  # [s] spare time of a gap beyond what crossing takes
LEAVES = 0.5  # [m] between the places ahead at which to look for a road
SEEN = 15.0  # [m] how far ahead to look for it
HALF_LANE = 1.6  # [m]
KERB = 0.2  # [m] to either side of the beginning of a crossing within which somebody waits there


@dataclass(frozen=True, slots=True, eq=False)
class Route:
    """The way of a person on foot, from the present place on."""

    points: tuple[Point, ...]  # [m]
    kerb: float | None  # [m] arc where the person may have to wait; None if it is behind them
    crossing: Crossing | None  # that it leads over

    @property
    def links(self) -> frozenset[tuple[str, int]]:
        """The crossing, as (junction, index), at which others give way to the person."""
        one = self.crossing
        return frozenset() if one is None else frozenset(((one.junction, one.index),))


def across(person: Observed, crossing: Crossing, *, back: bool, on: bool) -> Route:
    """Return the route over a crossing.

    Args:
        person: who walks.
        crossing: to walk over.
        back: whether against the direction of its line.
        on: whether the person is on it already.
    """
    line = tuple(reversed(crossing.line)) if back else crossing.line
    here = place_of(person)
    _, aside, _ = project(line, here)
    most = max(0.5 * crossing.width - BESIDE, 0.0)
    aside = min(max(aside, -most), most)
    ends = [_beside(line, end, aside) for end in (0.0, cumulative(line)[-1])]
    (x, y), heading = ends[1], point_at(line, cumulative(line)[-1])[1]
    far = (x + AWAY * math.cos(heading), y + AWAY * math.sin(heading))
    if on:
        return Route((here, ends[1], far), None, crossing)
    return Route((here, ends[0], ends[1], far), math.dist(here, ends[0]), crossing)


def onward(network: Network, person: Observed, reach: float, *, waits: bool = False) -> Route:
    """Return the route straight on; it ends before a road for cars unless the person is on one.

    A person who waits at a kerb may stand right where the road begins, and is not on it.
    """
    (x, y), heading = place_of(person), direction_of(person)
    cos, sin = math.cos(heading), math.sin(heading)
    free, half = reach, HALF_LANE - (KERB if waits else 0.0)
    if not on_road(network, (x, y), half):
        steps = np.arange(0.0, min(reach, SEEN), LEAVES).tolist()
        places = ((a, a + LEAVES) for a in steps)
        ahead = (a for a, b in places if on_road(network, (x + b * cos, y + b * sin), half))
        free = next(ahead, reach)
    return Route(((x, y), (x + free * cos, y + free * sin)), None, None)


def on_road(network: Network, position: Point, half: float = HALF_LANE) -> bool:
    """Check whether a place is within `half` [m] of the middle of a lane for cars."""
    return bool(network.locate(position, 0.0, half, math.pi))


def place_of(person: Observed) -> Point:
    """Return the place of a person [m]."""
    return float(person.position[-1, 0]), float(person.position[-1, 1])


def direction_of(person: Observed) -> float:
    """Return the heading [rad] of a person."""
    return float(person.heading[-1])


def paces(person: Observed) -> tuple[tuple[float, float], ...]:
    """Return possible walking speeds [m/s] with probabilities; the observed one of a walker."""
    walked = person.speed[person.speed >= WALKING]
    if float(person.speed[-1]) >= WALKING:
        return ((float(np.mean(walked)), 1.0),)
    return tuple((MEAN + k * DEVIATION, share) for k, share in SPREAD)


def may_go(
    route: Route, pace: float, lights: Lights, busy: Bools, steps: int, *, gaps: bool
) -> Bools:
    """Return at which steps a person would set out over a crossing [steps].

    Args:
        route: the way over it.
        pace: [m/s]
        lights: from now on.
        busy: [steps] when vehicles are on it.
        steps: how many.
        gaps: whether the person has no priority, and so waits for a gap.
    """
    one = route.crossing
    free: Bools = np.ones(steps, np.bool_)
    if one is None:
        return free
    if isinstance(one.control, Signal):
        free &= lights.shows(one.control, steps)[:steps] <= OPEN
    elif gaps:
        needed = math.ceil((cumulative(one.line)[-1] / pace + SAFE) / STEP)
        total = np.concatenate(([0], np.cumsum(busy[:steps])))
        last = np.minimum(np.arange(steps) + needed, steps)
        free &= total[last] == total[:steps]
    return free


def walk(person: Observed, route: Route, pace: float, free: Bools) -> Obstacle:
    """Return the motion of a person who walks along a route, and is gone at its end.

    Args:
        person: who walks.
        route: from now on.
        pace: [m/s]
        free: [T] whether the person would set out from the kerb at each step.
    """
    steps = np.arange(len(free), dtype=np.float64)
    arcs: Array = pace * STEP * steps
    at_kerb = 0 if route.kerb is None else math.ceil(route.kerb / (pace * STEP))
    if route.kerb is not None and not bool(np.all(free[at_kerb:])):
        open_ = np.flatnonzero(free[at_kerb:])
        go = at_kerb + int(open_[0]) if len(open_) else len(free)
        arcs = np.minimum(arcs, route.kerb) + pace * STEP * np.maximum(steps - go, 0.0)
    return _along(person, route, arcs)


def stand(person: Observed, steps: int) -> Obstacle:
    """Return the motion of a person who stays at the same place."""
    return Obstacle(
        person.vehicle,
        person.length,
        person.width,
        np.repeat(person.position[-1:], steps, axis=0),
        np.full(steps, direction_of(person)),
        np.zeros(steps),
        frozenset(),
        on_foot=True,
    )


def straight(person: Observed, steps: int) -> Obstacle:
    """Return the motion of a person who goes straight on, wherever that leads."""
    pace, heading = float(person.speed[-1]), direction_of(person)
    arcs = pace * STEP * np.arange(steps, dtype=np.float64)
    ahead = np.array([math.cos(heading), math.sin(heading)])
    return Obstacle(
        person.vehicle,
        person.length,
        person.width,
        person.position[-1] + arcs[:, None] * ahead,
        np.full(steps, heading),
        np.full(steps, pace),
        frozenset(),
        on_foot=True,
    )


def _along(person: Observed, route: Route, arcs: Array) -> Obstacle:
    """Return the motion of a person at given arcs [m] [T] of a route; NaN beyond its end."""
    points = np.array(route.points)
    sides = np.diff(points, axis=0)
    lengths = np.hypot(sides[:, 0], sides[:, 1])
    at = np.concatenate(([0.0], np.cumsum(lengths)))
    leg = np.clip(np.searchsorted(at, arcs, side="right") - 1, 0, len(lengths) - 1)
    share = (arcs - at[leg]) / np.maximum(lengths[leg], 1e-6)
    position = points[leg] + share[:, None] * sides[leg]
    position[arcs > at[-1]] = np.nan
    heading = arctan2(sides[leg, 1], sides[leg, 0])
    speed = np.gradient(arcs) / STEP if len(arcs) > 1 else np.zeros(len(arcs))
    heading = np.where(lengths[leg] < 1e-3, direction_of(person), heading)
    return Obstacle(
        person.vehicle,
        person.length,
        person.width,
        position,
        heading,
        speed,
        route.links,
        on_foot=True,
    )


def _beside(line: Sequence[Point], arc: float, aside: float) -> Point:
    """Return the place at an arc [m] of a line, `aside` [m] to its left."""
    (x, y), heading = point_at(tuple(line), arc)
    return x - aside * math.sin(heading), y + aside * math.cos(heading)
