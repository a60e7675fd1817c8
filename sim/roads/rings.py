"""Roundabouts of networks whose files do not name them, such as converted maps.

A ring is a cycle of one-way edges that turns in one sense, once around, and is about as long as
wide. Every road that joins it gives way to it.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from sim.roads.network import Lane, Link, angle_between
from sim.scene import Point

LONGEST = 400.0  # [m] greatest circumference
LEAST_ROUND = 0.6  # least 4 pi area / circumference^2: 1 for a circle, 0.79 for a square
TURN_BACK = math.radians(45.0)  # greatest total turn against the ring's own sense
FULL_TURN = math.radians(20.0)  # greatest deviation of the total turn from a full one


def find_rings(lanes: Mapping[str, Lane], links: Sequence[Link]) -> tuple[frozenset[str], ...]:
    """Return the rings of a network, in the order of its links.

    Args:
        lanes: by id.
        links: with their right of way.

    Returns:
        The edges of each ring.
    """
    search = _Search(lanes, links)
    found: dict[frozenset[str], None] = {}
    for edge in search.out:
        for side in (1.0, -1.0):
            cycle = search.cycle(edge, side)
            if cycle and search.is_ring(cycle, side):
                found.setdefault(frozenset(lanes[link.from_lane].edge for link in cycle))
    return tuple(found)


class _Search:
    """A search for cycles of edges, which always turns to the same side."""

    def __init__(self, lanes: Mapping[str, Lane], links: Sequence[Link]) -> None:
        self.lanes, self.links = lanes, links
        self.out: dict[str, dict[str, Link]] = {}  # by edge, then by the edge that follows
        self.begins: dict[str, str] = {}  # the junction where an edge begins
        self.ends: dict[str, str] = {}  # the junction where an edge ends
        for link in links:
            start, end = lanes[link.from_lane].edge, lanes[link.to_lane].edge
            self.ends[start] = self.begins[end] = link.junction
            if link.direction != "turnaround":
                self.out.setdefault(start, {}).setdefault(end, link)

    def cycle(self, edge: str, side: float) -> list[Link]:
        """Return the links back to an edge, turning to one side (1 left, -1 right); [] if none."""
        path: list[Link] = []
        here, length, seen = edge, 0.0, {edge}
        while ways := self.out.get(here):
            link = max(ways.values(), key=lambda way: side * self._turn(way))
            path.append(link)
            length += self.lanes[link.from_lane].length
            here = self.lanes[link.to_lane].edge
            if here == edge:
                return path
            if here in seen or length > LONGEST:
                break
            seen.add(here)
        return []

    def is_ring(self, cycle: list[Link], side: float) -> bool:
        """Check whether a cycle is a roundabout, and not some other loop."""
        edges = {self.lanes[link.from_lane].edge for link in cycle}
        line = self._outline(cycle)
        turns = [side * turn for turn in _turns(line)]
        round_once = abs(sum(turns) - 2.0 * math.pi) <= FULL_TURN
        steady = -sum(turn for turn in turns if turn < 0.0) <= TURN_BACK
        around = sum(math.dist(a, b) for a, b in pairwise(line))
        compact = around <= LONGEST and 4.0 * math.pi * _area(line) >= LEAST_ROUND * around**2
        return round_once and steady and compact and self._one_way(edges) and self._first(edges)

    def _turn(self, link: Link) -> float:
        """Return how far [rad] the road turns left from a link's lane to the lane after it."""
        start, end = self.lanes[link.from_lane].centreline, self.lanes[link.to_lane].centreline
        return angle_between(_heading(end[0], end[1]), _heading(start[-2], start[-1]))

    def _outline(self, cycle: list[Link]) -> list[Point]:
        """Return the closed line [m] through the lanes of a cycle."""
        points: list[Point] = []
        for link in cycle:
            for lane in (link.from_lane, *link.via):
                points += self.lanes[lane].centreline
        points.append(points[0])
        return [p for k, p in enumerate(points) if k == 0 or math.dist(p, points[k - 1]) > 0.05]

    def _one_way(self, edges: set[str]) -> bool:
        """Check whether no edge outside leads back along one of these."""
        ways = {(self.ends.get(edge), self.begins.get(edge)) for edge in edges}
        others = self.begins.keys() & self.ends.keys() - edges
        return not any((self.begins[edge], self.ends[edge]) in ways for edge in others)

    def _first(self, edges: set[str]) -> bool:
        """Check whether roads join these edges and give way to them wherever the ways meet."""
        met = [(entry, along) for entry, along in self._entries(edges) if along]
        return bool(met) and all(along <= set(entry.yields_to) for entry, along in met)

    def _entries(self, edges: set[str]) -> Iterator[tuple[Link, set[int]]]:
        """Yield the links that join these edges, each with the ring's own links that it meets."""
        along = {
            (link.junction, link.index)
            for link in self.links
            if self.lanes[link.from_lane].edge in edges and self.lanes[link.to_lane].edge in edges
        }
        for link in self.links:
            start, end = self.lanes[link.from_lane].edge, self.lanes[link.to_lane].edge
            if end in edges and start not in edges:
                yield link, {foe for foe in link.foes if (link.junction, foe) in along}


def _heading(a: Point, b: Point) -> float:
    return math.atan2(b[1] - a[1], b[0] - a[0])


def _turns(line: list[Point]) -> list[float]:
    """Return the turn to the left [rad] at each point of a closed line."""
    headings = [_heading(a, b) for a, b in pairwise(line)]
    return [angle_between(b, a) for a, b in pairwise([*headings, headings[0]])]


def _area(line: list[Point]) -> float:
    """Return the area [m2] within a closed line (shoelace formula)."""
    return abs(sum(ax * by - bx * ay for (ax, ay), (bx, by) in pairwise(line))) / 2.0
