"""Paths along lanes: geometry that a vehicle can drive, with speed caps.

A path is sampled every metre. A vehicle that is not on the centreline (a lane change, or the
rest of one) is led onto it by a quintic blend, so heading and curvature stay continuous.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sim.network import Network, angle_between, cumulative
from sim.scene import Point

Array = NDArray[np.float64]

SPACING = 1.0  # [m] between path points
LATERAL_ACCELERATION = 2.5  # [m/s2] comfortable in bends
SMOOTHING = 2  # path points on each side over which curvature is averaged


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """A line to drive, from arc 0 on."""

    points: Array  # [m] [N, 2]
    arc: Array  # [m] [N] strictly increasing, from 0
    heading: Array  # [rad] [N] unwrapped
    curvature: Array  # [1/m] [N] positive to the left
    cap: Array  # [m/s] [N] speed limit, or the speed that the bend allows
    lanes: tuple[tuple[str, float], ...]  # (lane, arc at which it begins), in driving order

    @property
    def length(self) -> float:
        """Arc length [m]."""
        return float(self.arc[-1])

    def pose(self, arc: float, length: float = 0.0) -> tuple[Point, float]:
        """Position [m] and heading [rad] of a vehicle whose front is at `arc` [m].

        Args:
            arc: [m]
            length: [m] of the vehicle; without it, the heading is that in which its front moves.
        """
        x = float(np.interp(arc, self.arc, self.points[:, 0]))
        y = float(np.interp(arc, self.arc, self.points[:, 1]))
        heading = float(self.headings(np.array([arc]), length)[0])
        return (x, y), math.remainder(heading, 2.0 * math.pi)

    def headings(self, arcs: Array, length: float) -> Array:
        """Headings [rad] [N] of a vehicle of a length [m] with its front at arcs [m].

        Its rear follows its front: it points as the path does at its middle.
        """
        return np.interp(np.maximum(arcs - 0.5 * length, 0.0), self.arc, self.heading)

    def lane_at(self, arc: float) -> tuple[str, float]:
        """The lane at `arc` [m], and the arc [m] at which it begins."""
        found = self.lanes[0]
        for lane, start in self.lanes[1:]:
            if start > arc:
                break
            found = (lane, start)
        return found


class Roads:
    """A network with the sampled centrelines of the routes that planning uses, kept."""

    def __init__(self, network: Network) -> None:
        self.network = network
        self.fastest = max(lane.speed_limit for lane in network.lanes.values())  # [m/s]
        self._lines: dict[tuple[str, ...], Path] = {}

    def line(self, lanes: tuple[str, ...]) -> Path:
        """The centreline of a row of connected lanes, from the start of the first one."""
        found = self._lines.get(lanes)
        if found is None:
            found = self._lines[lanes] = _sample(self.network, lanes)
        return found

    def path(
        self, lanes: tuple[str, ...], position: Point, heading: float, blend: float, reach: float
    ) -> Path:
        """The path from a pose onto the centreline of connected lanes.

        Args:
            lanes: connected lanes; the pose lies beside the first of them, or on it.
            position: [m] of the front bumper.
            heading: [rad]
            blend: [m] length over which the lateral offset vanishes.
            reach: [m] largest length of the path; the lanes may end earlier.
        """
        line = self.line(lanes)
        offset, lateral, direction = _nearest(line, position)
        slope = math.tan(max(-0.6, min(0.6, angle_between(heading, direction))))
        first = int(np.searchsorted(line.arc, offset + 0.25 * SPACING))
        last = int(np.searchsorted(line.arc, offset + reach)) + 1
        arc = np.concatenate(([offset], line.arc[first:last]))
        if len(arc) < 3:
            arc = np.array([offset, offset + 0.5 * SPACING, offset + SPACING])
        reference = _interpolate(line, arc)
        if abs(lateral) < 0.02 and abs(slope) < 0.005:
            return _path(reference, arc - offset, line, offset)
        return _blended(line, reference, arc, offset, lateral, slope, blend)


def _blended(
    line: Path,
    reference: tuple[Array, Array, Array],
    arc: Array,
    offset: float,
    lateral: float,
    slope: float,
    blend: float,
) -> Path:
    """Shift a reference line by the quintic that leads `lateral` and `slope` to zero."""
    points, heading, cap = reference
    u = np.clip((arc - offset) / blend, 0.0, 1.0)
    aside = lateral * (1.0 - 10.0 * u**3 + 15.0 * u**4 - 6.0 * u**5)
    aside += slope * blend * (u - 6.0 * u**3 + 8.0 * u**4 - 3.0 * u**5)
    shifted = points + aside[:, None] * np.column_stack((-np.sin(heading), np.cos(heading)))
    steps = np.hypot(*np.diff(shifted, axis=0).T)
    length = np.concatenate(([0.0], np.cumsum(np.maximum(steps, 1e-6))))
    turned = np.unwrap(np.arctan2(np.gradient(shifted[:, 1]), np.gradient(shifted[:, 0])))
    return _path((shifted, turned, cap), length, line, offset, arc - offset)


def _path(
    shape: tuple[Array, Array, Array],
    arc: Array,
    line: Path,
    offset: float,
    along: Array | None = None,
) -> Path:
    """A path from its points, headings and caps; `along` maps onto the line's own arc."""
    points, heading, cap = shape
    curvature = _curvature(heading, arc)
    bend = np.sqrt(LATERAL_ACCELERATION / np.maximum(np.abs(curvature), 1e-4))
    own = arc if along is None else along
    starts = [(lane, float(np.interp(start - offset, own, arc))) for lane, start in line.lanes]
    first = max((k for k, (_, start) in enumerate(line.lanes) if start <= offset), default=0)
    lanes = ((starts[first][0], line.lanes[first][1] - offset), *starts[first + 1 :])
    return Path(points, arc, heading, curvature, np.minimum(cap, bend), lanes)


def _sample(network: Network, lanes: tuple[str, ...]) -> Path:
    """Join and resample the centrelines of connected lanes."""
    points: list[Point] = []
    starts: list[tuple[str, float]] = []
    caps: list[tuple[float, float]] = []
    total = 0.0
    for lane_id in lanes:
        lane = network.lanes[lane_id]
        starts.append((lane_id, total))
        caps.append((total, lane.speed_limit))
        total += cumulative(lane.centreline)[-1]
        points.extend(p for p in lane.centreline if not points or math.dist(p, points[-1]) > 1e-3)
    raw = np.array(points)
    at = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(raw, axis=0).T))))
    arc = np.linspace(0.0, at[-1], max(3, math.ceil(at[-1] / SPACING) + 1))
    even = np.column_stack((np.interp(arc, at, raw[:, 0]), np.interp(arc, at, raw[:, 1])))
    heading = np.unwrap(np.arctan2(np.gradient(even[:, 1]), np.gradient(even[:, 0])))
    cap = np.array([limit for _, limit in caps])
    index = np.searchsorted(np.array([start for start, _ in caps]), arc + 1e-9, side="right") - 1
    return Path(even, arc, heading, _curvature(heading, arc), cap[index], tuple(starts))


def _curvature(heading: Array, arc: Array) -> Array:
    """Change of heading per metre, averaged over a few points: lanes are polygons."""
    n = len(arc)
    low = np.maximum(np.arange(n) - SMOOTHING, 0)
    high = np.minimum(np.arange(n) + SMOOTHING, n - 1)
    result: Array = (heading[high] - heading[low]) / np.maximum(arc[high] - arc[low], 1e-6)
    return result


def _interpolate(line: Path, arc: Array) -> tuple[Array, Array, Array]:
    """Points, headings and caps of a line at arcs; straight on beyond its end."""
    beyond = np.maximum(arc - line.length, 0.0)
    end = line.heading[-1]
    x = np.interp(arc, line.arc, line.points[:, 0]) + beyond * math.cos(end)
    y = np.interp(arc, line.arc, line.points[:, 1]) + beyond * math.sin(end)
    index = np.minimum(np.searchsorted(line.arc, arc + 1e-9), len(line.arc) - 1)
    return np.column_stack((x, y)), np.interp(arc, line.arc, line.heading), line.cap[index]


def _nearest(line: Path, position: Point) -> tuple[float, float, float]:
    """Arc [m], distance to the left [m] and heading [rad] of the nearest place on a line."""
    offsets = line.points - np.array(position)
    k = int(np.argmin(np.einsum("ij,ij->i", offsets, offsets)))
    along, aside = relative(line, k, np.array([position[0]]), np.array([position[1]]))
    arc = float(line.arc[k] + along[0])
    return max(arc, 0.0), float(aside[0]), float(line.heading[k])


def relative(line: Path, k: Any, x: Array, y: Array) -> tuple[Array, Array]:
    """Coordinates [m] of points (x, y) along and to the left of the path point(s) `k`."""
    dx, dy = x - line.points[k, 0], y - line.points[k, 1]
    cos, sin = np.cos(line.heading[k]), np.sin(line.heading[k])
    return dx * cos + dy * sin, dy * cos - dx * sin
