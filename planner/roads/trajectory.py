"""Paths along lanes: geometry that a vehicle can drive, with speed caps.

A path is sampled every metre. A vehicle that is not on the centreline (a lane change, or the
rest of one) is led onto it by a quintic blend, so heading and curvature stay continuous.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planner.kernels.along import LONG, chords
from planner.kernels.elementary import arctan2, power
from planner.kernels.resampling import nearest, resampled
from planner.roads.levels import Levels, Passing
from planner.roads.shifts import shifted
from planner.roads.smoothing import curvature_of, smoothed
from sim.roads.network import Network, angle_between
from sim.scene import Point

Array = NDArray[np.float64]

SPACING = 1.0  # [m] between path points
LATERAL_ACCELERATION = 3.5  # [m/s2] in bends, as people drive in town
DETAIL = 0.4  # [m] below which the steps of a polygon are noise
TIGHTEST = 0.3  # [1/m] of curvature, from which on a line is made wider
ROUNDS = 20  # maximum number of rounds of widening
HAIRPIN = (5, 2.2)  # path points on each side, and [rad] turned there: no corner to be widened
OVERSHOOT = 6.0  # [m] beyond its lane at which a vehicle may be found
STEEPEST = 0.6  # [rad] of heading against a lane with which a blend onto it begins
KEPT = 1024  # maximum number of cached paths, and of plans along them


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """A line to drive, from arc 0 on."""

    points: Array  # [m] [N, 2]
    arc: Array  # [m] [N] strictly increasing, from 0
    heading: Array  # [rad] [N] unwrapped
    curvature: Array  # [1/m] [N] positive to the left
    cap: Array  # [m/s] [N] speed limit, or the speed that the bend allows
    lanes: tuple[tuple[str, float], ...]  # (lane, arc at which it begins), in driving order
    passings: tuple[Passing, ...] = ()  # the lanes above and below it

    @property
    def length(self) -> float:
        """Arc length [m]."""
        return float(self.arc[-1])

    def pose(self, arc: float, length: float = 0.0) -> tuple[Point, float]:
        """Return position [m] and heading [rad] of a vehicle whose front is at `arc` [m].

        Args:
            arc: [m]
            length: [m] of the vehicle; without it, the heading is that in which its front moves.
        """
        x = float(np.interp(arc, self.arc, self.points[:, 0]))
        y = float(np.interp(arc, self.arc, self.points[:, 1]))
        heading = float(self.headings(np.array([arc]), length)[0])
        return (x, y), math.remainder(heading, 2.0 * math.pi)

    def headings(self, arcs: Array, length: float) -> Array:
        """Return headings [rad] [N] of a vehicle of a length [m] with its front at arcs [m].

        Its rear follows its front: it points as the path does at its middle, and a long one from
        where its rear is on the path to its front.
        """
        if length > LONG:
            return chords(self.points, self.arc, self.heading, arcs, length)
        return np.interp(np.maximum(arcs - 0.5 * length, 0.0), self.arc, self.heading)

    def lane_at(self, arc: float) -> tuple[str, float]:
        """Return the lane at `arc` [m], and the arc [m] at which it begins."""
        found = self.lanes[0]
        for lane, start in self.lanes[1:]:
            if start > arc:
                break
            found = (lane, start)
        return found


class Roads:
    """A network with a cache of the sampled centrelines of the routes that planning uses."""

    def __init__(self, network: Network) -> None:
        self.network = network
        self.fastest = max(lane.speed_limit for lane in network.lanes.values())  # [m/s]
        self.ends: dict[str, Any] = {}  # by lane, kept by planner.roads.routes
        self.foes: dict[tuple[str, int], Any] = {}  # by link, kept by planner.manoeuvres.layout
        self.classes: dict[str, Roads] = {}  # by kind of vehicle, kept by planner.roads.classes
        self.footways: dict[
            tuple[str, int], Any
        ] = {}  # by link, kept by planner.manoeuvres.footways
        self.kerbs: Array | None = None  # kept by planner.motion.kerbs
        self.meetings: dict[
            tuple[str, int, int], float
        ] = {}  # kept by planner.hidden_areas.phantoms
        self.tolls: dict[str, Any] = {}  # kept by planner.rollouts.waypoints
        self.costs: dict[str, dict[str, float]] = {}  # kept by planner.rollouts.waypoints
        self.before: dict[str, dict[str, float]] | None = None  # kept by planner.rollouts.waypoints
        self.sides: dict[frozenset[str], Any] = {}  # by ring, kept by planner.roads.roundabouts
        self.located: dict[tuple[Point, float], Any] = {}  # by pose, kept by planner.motion.tracks
        self.plans: dict[Any, Any] = {}  # by situation, kept by planner.manoeuvres.actions
        self.levels = Levels(network)
        self._lines: dict[tuple[str, ...], Path] = {}
        self._paths: dict[Any, Path] = {}

    def line(self, lanes: tuple[str, ...]) -> Path:
        """Return the centreline of a row of connected lanes, from the start of the first one."""
        found = self._lines.get(lanes)
        if found is None:
            found = self._lines[lanes] = _sample(self.network, lanes)
        return found

    def path(
        self,
        lanes: tuple[str, ...],
        position: Point,
        heading: float,
        blend: float,
        reach: float,
        least: float = 0.0,
    ) -> Path:
        """Return the path from a pose onto the centreline of connected lanes.

        Args:
            lanes: connected lanes; the pose lies beside the first of them, or on it.
            position: [m] of the front bumper.
            heading: [rad]
            blend: [m] length over which the lateral offset vanishes.
            reach: [m] largest length of the path; the lanes may end earlier.
            least: [m] shortest length; where the lanes end earlier, it leads straight on.
        """
        key = (lanes, position, heading, blend, reach, least)
        found = self._paths.get(key)
        if found is None:
            if len(self._paths) >= KEPT:
                self._paths.clear()
            found, passings = self._path(*key), self.levels.across(lanes)
            found = replace(found, passings=passings) if passings else found
            self._paths[key] = found
        return found

    def _path(
        self,
        lanes: tuple[str, ...],
        position: Point,
        heading: float,
        blend: float,
        reach: float,
        least: float,
    ) -> Path:
        line = self.line(lanes)
        offset, lateral, direction = _nearest(line, position)
        turned = angle_between(heading, direction)
        slope = math.tan(max(-STEEPEST, min(STEEPEST, turned)))
        first = int(np.searchsorted(line.arc, offset + 0.25 * SPACING))
        last = int(np.searchsorted(line.arc, offset + reach)) + 1
        along = np.concatenate(([0.0], line.arc[first:last] - offset))
        if len(along) < 3 or along[-1] < least:
            along = np.concatenate((along, np.arange(along[-1] + SPACING, least, SPACING)))
            while len(along) < 3:
                along = np.append(along, along[-1] + SPACING)
        if abs(lateral) < 0.02 and abs(slope) < 0.005:
            return _straightly(line, along, offset)
        return _blended(line, along, offset, lateral, slope, blend)


def _straightly(line: Path, along: Array, offset: float) -> Path:
    """Return the part of a line from `offset` [m] on, at distances `along` [m] from there."""
    points, heading, curvature, cap = _interpolate(line, along + offset)
    return _path(points, along, heading, curvature, cap, _lanes(line, offset, along, along))


def _blended(
    line: Path, along: Array, offset: float, lateral: float, slope: float, blend: float
) -> Path:
    """Return the same, shifted by the quintic that leads `lateral` [m] and `slope` to zero."""
    points, heading, bend, cap = _interpolate(line, along + offset)
    over = int(np.searchsorted(along, blend))  # points before the path is on the line
    u, ahead, bent = along[:over] / blend, heading[:over], bend[:over]
    aside = lateral * (1.0 - u**3 * (10.0 - 15.0 * u + 6.0 * u**2))
    aside += slope * blend * (u - u**3 * (6.0 - 8.0 * u + 3.0 * u**2))
    rise = -30.0 * lateral / blend * (u * (1.0 - u)) ** 2
    rise += slope * (1.0 - u**2 * (18.0 - 32.0 * u + 15.0 * u**2))
    turning = -60.0 * lateral / blend**2 * u * (1.0 - u) * (1.0 - 2.0 * u)
    turning += slope / blend * u * (-36.0 + 96.0 * u - 60.0 * u**2)
    stretch = np.maximum(1.0 - aside * bent, 0.2)  # of the shifted line against the line
    points[:over, 0] -= aside * np.sin(ahead)
    points[:over, 1] += aside * np.cos(ahead)
    heading[:over] += arctan2(rise, stretch)
    bend[:over] = bent / stretch + turning / power(stretch**2 + rise**2, 1.5)
    x, y = points[:, 0], points[:, 1]
    steps = np.maximum(np.hypot(x[1:] - x[:-1], y[1:] - y[:-1]), 1e-3)
    arc = np.concatenate(([0.0], np.cumsum(steps)))
    return _path(points, arc, heading, bend, cap, _lanes(line, offset, along, arc))


def _path(
    points: Array,
    arc: Array,
    heading: Array,
    curvature: Array,
    cap: Array,
    lanes: tuple[tuple[str, float], ...],
) -> Path:
    bend = np.sqrt(LATERAL_ACCELERATION / np.maximum(np.abs(curvature), 1e-4))
    return Path(points, arc, heading, curvature, np.minimum(cap, bend), lanes)


def _lanes(line: Path, offset: float, along: Array, arc: Array) -> tuple[tuple[str, float], ...]:
    """Return the lanes from `offset` [m] on; `along` is mapped onto `arc`."""
    first = max((k for k, (_, start) in enumerate(line.lanes) if start <= offset), default=0)
    name, start = line.lanes[first]
    rest = line.lanes[first + 1 :]
    begins = np.interp([start - offset for _, start in rest], along, arc)
    return (
        (name, start - offset),
        *((lane, float(begin)) for (lane, _), begin in zip(rest, begins, strict=True)),
    )


def _sample(network: Network, lanes: tuple[str, ...]) -> Path:
    """Join and resample the centrelines of connected lanes."""
    points: list[Point] = []
    starts: list[float] = []
    caps: list[float] = []
    total = 0.0  # up to the last point
    for name in lanes:
        lane = network.lanes[name]
        gap = math.dist(points[-1], lane.centreline[0]) if points else 0.0
        starts.append(total + gap)
        caps.append(lane.speed_limit)
        last = len(lane.centreline) - 1
        for k, point in enumerate(lane.centreline):
            step = math.dist(point, points[-1]) if points else math.inf
            if step > DETAIL or (k == last and step > 1e-3):
                total += step if points else 0.0
                points.append(point)
    if len(points) < 2:
        points.append((points[0][0] + 1e-3, points[0][1]))
    raw, index = smoothed(np.array(points))
    at, along = _along(raw), _along(raw[index])
    arc = np.linspace(0.0, at[-1], max(3, math.ceil(at[-1] / SPACING) + 1))
    even = np.column_stack((np.interp(arc, at, raw[:, 0]), np.interp(arc, at, raw[:, 1])))
    arc, even, begins = _rounded(arc, even, np.interp(starts, along, at[index]))
    heading = np.unwrap(arctan2(np.gradient(even[:, 1]), np.gradient(even[:, 0])))
    cap = np.array(caps)[np.searchsorted(begins, arc + 1e-9, side="right") - 1]
    row = tuple(zip(lanes, begins.tolist(), strict=True))
    return Path(even, arc, heading, curvature_of(heading, arc), cap, row)


def _along(points: Array) -> Array:
    """Return how far [m] [N] points are along a line."""
    return np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))


def _rounded(arc: Array, points: Array, starts: Array) -> tuple[Array, Array, Array]:
    """Smooth jogs of a line, and widen corners that are tighter than a car can turn.

    Args:
        arc, points: of a line with even spacing.
        starts: [m] arcs of places on it.

    Returns:
        Arc, points and starts of the line that can be driven; unchanged if it needs no change.
    """
    bent = shifted(points, starts[1:] / max(arc[1], 1e-9))
    loose: NDArray[np.bool_] | None = None
    for _ in range(ROUNDS):
        steps = np.diff(bent, axis=0)
        heading = np.unwrap(arctan2(steps[:, 1], steps[:, 0]))
        sharp = np.abs(np.diff(heading)) > TIGHTEST * np.hypot(*steps[1:].T)
        if not np.any(sharp):
            break
        loose = ~_hairpins(points) if loose is None else loose
        moved = (np.convolve(sharp, np.ones(5), "same")[: len(sharp)] > 0.0) & loose
        if not np.any(moved):
            break
        halfway = 0.5 * bent[1:-1] + 0.25 * (bent[:-2] + bent[2:])
        bent = bent.copy()
        bent[1:-1][moved] = halfway[moved]
    if bent is points:
        return arc, points, starts
    at = _along(bent)
    even = np.linspace(0.0, at[-1], len(arc))
    line = np.column_stack((np.interp(even, at, bent[:, 0]), np.interp(even, at, bent[:, 1])))
    return even, line, np.interp(starts, arc, at)


def _hairpins(points: Array) -> NDArray[np.bool_]:
    """Return whether a line turns back at each of its inner points [N - 2]."""
    steps = np.diff(points, axis=0)
    heading = np.unwrap(arctan2(steps[:, 1], steps[:, 0]))
    inner = np.arange(len(points) - 2)
    low, high = np.maximum(inner - HAIRPIN[0], 0), inner + 1 + HAIRPIN[0]
    turned = heading[np.minimum(high, len(heading) - 1)] - heading[low]
    result: NDArray[np.bool_] = np.abs(turned) > HAIRPIN[1]
    return result


def _interpolate(line: Path, arc: Array) -> tuple[Array, Array, Array, Array]:
    """Return points, headings, curvatures and caps at arcs; straight on beyond the line's end."""
    end = float(line.heading[-1])
    direction = (math.cos(end), math.sin(end))
    columns = (line.points, line.heading, line.curvature)
    return resampled(arc, line.arc, columns, line.cap, direction)


def _nearest(line: Path, position: Point) -> tuple[float, float, float]:
    """Return arc [m], distance to the left [m] and heading [rad] of the nearest place on a line.

    Only the line's first lane is searched: the line may pass the same place again later.
    """
    first = line.lanes[1][1] if len(line.lanes) > 1 else line.length
    count = int(np.searchsorted(line.arc, first + OVERSHOOT)) + 1
    k = nearest(line.points, count, float(position[0]), float(position[1]))
    along, aside = relative(line, k, np.array([position[0]]), np.array([position[1]]))
    arc = float(line.arc[k] + along[0])
    return max(arc, 0.0), float(aside[0]), float(line.heading[k])


def relative(line: Path, k: Any, x: Array, y: Array) -> tuple[Array, Array]:
    """Return coordinates [m] of points (x, y) along and to the left of the path point(s) `k`."""
    dx, dy = x - line.points[k, 0], y - line.points[k, 1]
    cos, sin = np.cos(line.heading[k]), np.sin(line.heading[k])
    return dx * cos + dy * sin, dy * cos - dx * sin
