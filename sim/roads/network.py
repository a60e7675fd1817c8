"""The road network: a lane graph with geometry and right of way, for queries only.

Coordinates are those of the SUMO net: metres, x east, y north; headings in radians
anticlockwise from east. `sim.roads.netfile` reads a network from a SUMO net file.

`lanes` and `links` are those that cars may use, such as the ego. Those for others only (buses,
trams, bicycles, pedestrians) are in `other_lanes` and `other_links`.
"""

import heapq
import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from sim.roads.lanes import (
    UNSIGNALLED,
    Control,
    Crossing,
    Direction,
    Lane,
    Link,
    Location,
    Unsignalled,
)
from sim.roads.lines import angle_between, cumulative, point_at, project
from sim.roads.places import Places
from sim.scene import Point, Signal

__all__ = [
    "UNSIGNALLED",
    "Control",
    "Crossing",
    "Direction",
    "Lane",
    "Link",
    "Location",
    "Network",
    "Unsignalled",
    "angle_between",
    "cumulative",
    "point_at",
    "project",
]


@dataclass(frozen=True)
class Network:
    """A road network; all look-ups are by id."""

    lanes: Mapping[str, Lane]  # in file order
    links: tuple[Link, ...]  # in file order
    hash: str  # of the network, independent of comments in its file
    roundabouts: tuple[frozenset[str], ...] = ()  # the edges of each ring
    equal: frozenset[str] = frozenset()  # junctions where traffic from the right goes first
    rail_crossings: frozenset[str] = frozenset()  # junctions where roads cross rails
    other_lanes: Mapping[str, Lane] = field(default_factory=dict)  # that cars may not use
    other_links: tuple[Link, ...] = ()  # that cars may not use
    crossings: tuple[Crossing, ...] = ()

    def roundabout(self, edge: str) -> frozenset[str] | None:
        """Return the ring that an edge is part of."""
        return next((ring for ring in self.roundabouts if edge in ring), None)

    def signalled(self, signal: Signal) -> tuple[Link, ...]:
        """Return the links that a signal controls."""
        return self._signalled.get(signal, ())

    def links_from(self, lane: str) -> tuple[Link, ...]:
        """Return the links that begin at the end of a lane; none for an internal lane."""
        return self._links_from.get(lane, ())

    def links_to(self, lane: str) -> tuple[Link, ...]:
        """Return the links that end at the beginning of a lane; none for an internal lane."""
        return self._links_to.get(lane, ())

    def link_via(self, lane: str) -> Link | None:
        """Return the link that an internal lane belongs to."""
        return self._link_via.get(lane)

    def junction_links(self, junction: str) -> Mapping[int, Link]:
        """Return the links of a junction by their index."""
        return self._junction_links[junction]

    def junction_others(self, junction: str) -> Mapping[int, Link | Crossing]:
        """Return the crossings and the links for others only of a junction, by their index."""
        return self._junction_others.get(junction, {})

    def crossings_on(self, link: Link) -> tuple[Crossing, ...]:
        """Return the crossings that a link leads over."""
        beside = self.junction_others(link.junction)
        met = (beside.get(index) for index in link.other_foes)
        return tuple(way for way in met if isinstance(way, Crossing))

    def edge_lanes(self, edge: str) -> tuple[Lane, ...]:
        """Return the lanes of an edge from right to left.

        Raises:
            KeyError: there is no such edge.
        """
        return self._edge_lanes[edge]

    def left_of(self, lane: str) -> Lane | None:
        """Return the neighbouring lane on the left in the same direction."""
        return self._neighbour(lane, 1)

    def right_of(self, lane: str) -> Lane | None:
        """Return the neighbouring lane on the right in the same direction."""
        return self._neighbour(lane, -1)

    def distance_to(self, edge: str) -> Mapping[str, float]:
        """Return the driving distance [m] from the end of each edge to the start of `edge`.

        Edges from which `edge` cannot be reached are absent; `edge` itself has distance 0.
        Lane changes cost no distance.
        """
        found = self._distances.get(edge)
        if found is None:
            found = self._distances[edge] = self._search_back(edge)
        return found

    def locate(
        self, position: Point, heading: float, reach: float = 2.5, turn: float = math.pi / 4
    ) -> tuple[Location, ...]:
        """Return the lanes on which a pose may lie, nearest centreline first.

        Args:
            position: [m]
            heading: [rad]
            reach: [m] largest distance from the centreline.
            turn: [rad] largest difference of heading.
        """
        return self._places.find(position, heading, reach, turn)

    def locate_aside(
        self, position: Point, heading: float, reach: float = 2.5, turn: float = math.pi / 4
    ) -> tuple[Location, ...]:
        """Do the same as `locate` for the lanes that cars may not use."""
        return self._other_places.find(position, heading, reach, turn)

    @cached_property
    def _links_from(self) -> dict[str, tuple[Link, ...]]:
        result: dict[str, tuple[Link, ...]] = {}
        for link in self.links:
            result[link.from_lane] = (*result.get(link.from_lane, ()), link)
        return result

    @cached_property
    def _links_to(self) -> dict[str, tuple[Link, ...]]:
        result: dict[str, tuple[Link, ...]] = {}
        for link in self.links:
            result[link.to_lane] = (*result.get(link.to_lane, ()), link)
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
    def _junction_others(self) -> dict[str, dict[int, Link | Crossing]]:
        result: dict[str, dict[int, Link | Crossing]] = {}
        for link in self.other_links:
            result.setdefault(link.junction, {})[link.index] = link
        for crossing in self.crossings:
            result.setdefault(crossing.junction, {})[crossing.index] = crossing
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
    def _places(self) -> Places:
        return Places(self.lanes)

    @cached_property
    def _other_places(self) -> Places:
        return Places(self.other_lanes)

    def _neighbour(self, lane: str, step: int) -> Lane | None:
        here = self.lanes[lane]
        if here.internal:
            return None
        # Lanes that cars may not use leave gaps in the numbers.
        lanes = self._edge_lanes[here.edge]
        return next((other for other in lanes if other.index == here.index + step), None)

    def _search_back(self, edge: str) -> dict[str, float]:
        """Search for distances [m] against the driving direction (Dijkstra's algorithm)."""
        distance: dict[str, float] = {}
        frontier = [(0.0, edge)]
        while frontier:
            far, here = heapq.heappop(frontier)
            if here in distance:
                continue
            distance[here] = far
            base = far + (0.0 if here == edge else self._edge_lanes[here][0].length)
            for start, across in self._before.get(here, {}).items():
                if start not in distance:
                    heapq.heappush(frontier, (base + across, start))
        return distance

    @cached_property
    def _before(self) -> dict[str, dict[str, float]]:
        """The edges from which each edge is entered, with the least length [m] in between."""
        before: dict[str, dict[str, float]] = {}
        for link in self.links:
            start, end = self.lanes[link.from_lane].edge, self.lanes[link.to_lane].edge
            across = sum(self.lanes[lane].length for lane in link.via)
            known = before.setdefault(end, {}).get(start, math.inf)
            before[end][start] = min(known, across)
        return before
