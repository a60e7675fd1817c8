"""The road network as a lane graph with geometry and right of way: pure queries.

Coordinates are those of the SUMO net: metres, x east, y north; headings in radians
anticlockwise from east. `sim.netfile` reads a network from a SUMO net file.
"""

import math
from bisect import bisect_right
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Literal, TypeAlias

from sim.scene import Point, Signal

Direction = Literal["left", "straight", "right", "turnaround"]


@dataclass(frozen=True, slots=True)
class Unsignalled:
    """No traffic light controls the link."""


Control: TypeAlias = Signal | Unsignalled
UNSIGNALLED = Unsignalled()


@dataclass(frozen=True, slots=True)
class Lane:
    """One lane: of an edge, or inside a junction (`internal`)."""

    id: str
    edge: str
    index: int  # 0 is the rightmost lane of its edge
    width: float  # [m]
    speed_limit: float  # [m/s]
    centreline: tuple[Point, ...]  # [m] [N >= 2] in driving direction
    internal: bool
    length: float  # [m] along the centreline


@dataclass(frozen=True, slots=True)
class Link:
    """A way through a junction, from one lane to another."""

    junction: str
    index: int  # of this link in the junction's right-of-way matrix
    from_lane: str
    to_lane: str
    via: tuple[str, ...]  # internal lanes in driving order; () where the lanes touch
    direction: Direction
    yields_to: tuple[int, ...]  # links of the same junction that go first
    foes: tuple[int, ...]  # links of the same junction whose paths cross or merge
    waits_inside: bool  # may enter and wait at the end of via[0] for oncoming traffic
    control: Control = UNSIGNALLED


@dataclass(frozen=True, slots=True)
class Location:
    """A place on a lane."""

    lane: str
    offset: float  # [m] along the lane's centreline
    lateral: float  # [m] to the left of the centreline


@dataclass(frozen=True)
class Network:
    """A road network; all look-ups are by id."""

    lanes: Mapping[str, Lane]  # in file order
    links: tuple[Link, ...]  # in file order
    hash: str  # of the network, independent of comments in its file
    roundabouts: tuple[frozenset[str], ...] = ()  # the edges of each ring
    equal: frozenset[str] = frozenset()  # junctions where who comes from the right goes first
    rail_crossings: frozenset[str] = frozenset()  # junctions where roads cross rails

    def roundabout(self, edge: str) -> frozenset[str] | None:
        """The ring that an edge is part of."""
        return next((ring for ring in self.roundabouts if edge in ring), None)

    def signalled(self, signal: Signal) -> tuple[Link, ...]:
        """The links that a signal controls."""
        return self._signalled.get(signal, ())

    def links_from(self, lane: str) -> tuple[Link, ...]:
        """The links that begin at the end of a lane (not of an internal one)."""
        return self._links_from.get(lane, ())

    def link_via(self, lane: str) -> Link | None:
        """The link that an internal lane belongs to."""
        return self._link_via.get(lane)

    def junction_links(self, junction: str) -> Mapping[int, Link]:
        """The links of a junction by their index."""
        return self._junction_links[junction]

    def edge_lanes(self, edge: str) -> tuple[Lane, ...]:
        """The lanes of an edge from right to left.

        Raises:
            KeyError: there is no such edge.
        """
        return self._edge_lanes[edge]

    def left_of(self, lane: str) -> Lane | None:
        """The neighbouring lane on the left in the same direction."""
        return self._neighbour(lane, 1)

    def right_of(self, lane: str) -> Lane | None:
        """The neighbouring lane on the right in the same direction."""
        return self._neighbour(lane, -1)

    def distance_to(self, edge: str) -> Mapping[str, float]:
        """Driving distance [m] from the end of each edge to the start of `edge`.

        Edges from which `edge` cannot be reached are absent; `edge` itself has distance 0.
        Lane changes are free.
        """
        found = self._distances.get(edge)
        if found is None:
            found = self._distances[edge] = self._search_back(edge)
        return found

    def locate(
        self, position: Point, heading: float, reach: float = 2.5, turn: float = math.pi / 4
    ) -> tuple[Location, ...]:
        """The lanes on which a pose may lie, nearest centreline first.

        Args:
            position: [m]
            heading: [rad]
            reach: [m] largest distance from the centreline.
            turn: [rad] largest difference of heading.
        """
        found = []
        for lane_id in self._near(position):
            lane = self.lanes[lane_id]
            offset, lateral, direction = project(lane.centreline, position)
            inside = -0.5 <= offset <= lane.length + 0.5
            if inside and abs(lateral) <= reach and abs(angle_between(heading, direction)) <= turn:
                clamped = min(max(offset, 0.0), lane.length)
                found.append(Location(lane_id, clamped, lateral))
        found.sort(key=lambda location: (round(abs(location.lateral), 3), location.lane))
        return tuple(found)

    @cached_property
    def _links_from(self) -> dict[str, tuple[Link, ...]]:
        result: dict[str, tuple[Link, ...]] = {}
        for link in self.links:
            result[link.from_lane] = (*result.get(link.from_lane, ()), link)
        return result

    @cached_property
    def _signalled(self) -> dict[Signal, tuple[Link, ...]]:
        result: dict[Signal, tuple[Link, ...]] = {}
        for link in self.links:
            if isinstance(link.control, Signal):
                result[link.control] = (*result.get(link.control, ()), link)
        return result

    @cached_property
    def _link_via(self) -> dict[str, Link]:
        return {lane: link for link in self.links for lane in link.via}

    @cached_property
    def _junction_links(self) -> dict[str, dict[int, Link]]:
        result: dict[str, dict[int, Link]] = {}
        for link in self.links:
            result.setdefault(link.junction, {})[link.index] = link
        return result

    @cached_property
    def _edge_lanes(self) -> dict[str, tuple[Lane, ...]]:
        result: dict[str, list[Lane]] = {}
        for lane in self.lanes.values():
            if not lane.internal:
                result.setdefault(lane.edge, []).append(lane)
        for lanes in result.values():
            lanes.sort(key=lambda lane: lane.index)
        return {edge: tuple(lanes) for edge, lanes in result.items()}

    @cached_property
    def _distances(self) -> dict[str, dict[str, float]]:
        return {}

    @cached_property
    def _grid(self) -> dict[tuple[int, int], tuple[str, ...]]:
        """Lanes by the 20 m cells that their centrelines pass within 10 m of."""
        cells: dict[tuple[int, int], dict[str, None]] = {}
        for lane in self.lanes.values():
            for (ax, ay), (bx, by) in pairwise(lane.centreline):
                steps = max(1, math.ceil(math.hypot(bx - ax, by - ay) / 5.0))
                for k in range(steps + 1):
                    x, y = ax + (bx - ax) * k / steps, ay + (by - ay) * k / steps
                    for dx in (-10.0, 10.0):
                        for dy in (-10.0, 10.0):
                            cell = (int((x + dx) // 20.0), int((y + dy) // 20.0))
                            cells.setdefault(cell, {})[lane.id] = None
        return {cell: tuple(lanes) for cell, lanes in cells.items()}

    def _near(self, position: Point) -> tuple[str, ...]:
        return self._grid.get((int(position[0] // 20.0), int(position[1] // 20.0)), ())

    def _neighbour(self, lane: str, step: int) -> Lane | None:
        here = self.lanes[lane]
        if here.internal:
            return None
        # Lanes that cars may not use leave gaps in the numbers.
        lanes = self._edge_lanes[here.edge]
        return next((other for other in lanes if other.index == here.index + step), None)

    def _search_back(self, edge: str) -> dict[str, float]:
        """Dijkstra against the driving direction over edges."""
        before: dict[str, dict[str, float]] = {}
        for link in self.links:
            start, end = self.lanes[link.from_lane].edge, self.lanes[link.to_lane].edge
            across = sum(self.lanes[lane].length for lane in link.via)
            known = before.setdefault(end, {}).get(start, math.inf)
            before[end][start] = min(known, across)
        distance: dict[str, float] = {}
        frontier = {edge: 0.0}
        while frontier:
            here = min(frontier, key=lambda name: (frontier[name], name))
            distance[here] = frontier.pop(here)
            base = distance[here] + (0.0 if here == edge else self._edge_lanes[here][0].length)
            for start, across in before.get(here, {}).items():
                if start not in distance:
                    frontier[start] = min(frontier.get(start, math.inf), base + across)
        return distance


def project(line: tuple[Point, ...], position: Point) -> tuple[float, float, float]:
    """Nearest place on a polyline.

    Returns:
        Offset along the line [m], distance to its left [m], heading of the line there [rad].
        The offset is negative or beyond the length where the end segments' extensions are
        nearest.
    """
    best = (math.inf, 0.0, 0.0, 0.0)
    travelled = 0.0
    last = len(line) - 2
    for k in range(last + 1):
        (ax, ay), (bx, by) = line[k], line[k + 1]
        dx, dy = bx - ax, by - ay
        length = math.hypot(dx, dy)
        if length == 0.0:
            continue
        along = ((position[0] - ax) * dx + (position[1] - ay) * dy) / length
        low = -math.inf if k == 0 else 0.0
        high = math.inf if k == last else length
        clamped = min(max(along, low), high)
        px, py = ax + dx * clamped / length, ay + dy * clamped / length
        distance = math.hypot(position[0] - px, position[1] - py)
        if distance < best[0]:
            side = dx * (position[1] - ay) - dy * (position[0] - ax)
            lateral = math.copysign(distance, side)
            best = (distance, travelled + clamped, lateral, math.atan2(dy, dx))
        travelled += length
    return best[1], best[2], best[3]


def angle_between(a: float, b: float) -> float:
    """The angle [rad] from b to a, in (-pi, pi]."""
    difference = math.fmod(a - b, 2.0 * math.pi)
    if difference > math.pi:
        difference -= 2.0 * math.pi
    elif difference <= -math.pi:
        difference += 2.0 * math.pi
    return difference


def cumulative(line: tuple[Point, ...]) -> list[float]:
    """Arc length [m] at each point of a polyline, from 0."""
    total = [0.0]
    for (ax, ay), (bx, by) in pairwise(line):
        total.append(total[-1] + math.hypot(bx - ax, by - ay))
    return total


def point_at(line: tuple[Point, ...], offset: float) -> tuple[Point, float]:
    """The point [m] and heading [rad] at an offset [m] along a polyline (clamped to it)."""
    arc = cumulative(line)
    k = min(max(bisect_right(arc, offset) - 1, 0), len(line) - 2)
    (ax, ay), (bx, by) = line[k], line[k + 1]
    span = arc[k + 1] - arc[k]
    share = min(max((offset - arc[k]) / span, 0.0), 1.0) if span > 0.0 else 0.0
    return (ax + (bx - ax) * share, ay + (by - ay) * share), math.atan2(by - ay, bx - ax)
