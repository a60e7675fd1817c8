"""Roads that pass above or below a path: vehicles on them are not in its way.

Where roads cross at one level, a map has a junction. Lanes that cross and that no junction joins
are on different levels, as they are to SUMO; maps need not tell heights, and those that do often
have them from the ground below a bridge.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from planner.kernels.bridges import Sides, mark_along, sides_of
from sim.roads.lines import ON_LANE, crossings
from sim.roads.network import Lane, Link, Network, angle_between
from sim.scene import Point

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]

BODY = 25.0  # [m] maximum length of a body
WIDE = 5.0  # [m] of the road that is crossed, to each side of its lane
NEAR = 30.0  # [m] from a junction within which lanes that it joins may just overlap
SAME = 8.0  # [m] from a crossing within which other lanes may be taken for the one that crosses
END = 0.5  # [m] from the end of a lane within which another one just touches it
NOBODY_ELSEWHERE: Bools = np.zeros((0, 0), np.bool_)
FOOT, CAR = "pedestrian", "passenger"


@dataclass(frozen=True, slots=True, eq=False)
class Passing:
    """A lane that passes above or below another one."""

    edge: str
    on_foot: bool  # whether it is for people on foot, and not for cars
    place: Point  # [m] where they cross
    reach: float  # [m] around it within which a body may be above or below the other lane
    line: Sides  # its middle there, and on from there
    before: float  # [m] along the line up to where a front is not there yet
    after: float  # [m] along the line from where a body is out of the way, without its length
    turn: float  # [rad] from its heading up to which one drives along it


def elsewhere(
    passings: Sequence[Passing], states: Array, sizes: Array, on_foot: Bools | None = None
) -> Bools:
    """Return which others are above or below a path, and not on it [M, T].

    Args:
        passings: the lanes that cross the path.
        states: [M, T, 4] x, y [m], heading [rad], speed [m/s] of the others.
        sizes: [M, 2] length and width [m].
        on_foot: [M] whether each is on foot.
    """
    found: Bools = np.zeros(states.shape[:2], np.bool_)
    walks = np.zeros(len(states), np.bool_) if on_foot is None else on_foot
    for one in passings:
        which = np.flatnonzero(walks == one.on_foot)
        if len(which):
            lane = (one.line, one.place, one.reach, one.before, one.after)
            # People walk both ways.
            mark_along(found, states, sizes, which, *lane, ON_LANE, one.turn, one.on_foot)
    return found


def load_kernels() -> None:
    """Load what is compiled for `elsewhere`, which only networks with bridges call."""
    line = sides_of(np.array(((0.0, 0.0), (1.0, 0.0))))
    one = Passing("", False, (0.0, 0.0), 1.0, line, 0.0, 1.0, 1.0)
    elsewhere((one,), np.zeros((1, 1, 4)), np.ones((1, 3)))


class Levels:
    """The lanes of a network that pass above or below others."""

    def __init__(self, network: Network) -> None:
        self._network = network
        self._found: dict[str, tuple[Passing, ...]] = {}

    def prepare(self) -> None:
        """Compute in advance what every search needs."""
        _ = (self._boxes, self._from, self._beside)

    def across(self, lanes: Iterable[str]) -> tuple[Passing, ...]:
        """Return the lanes that pass above or below some that are driven along in a row.

        Where they come round onto the road that crosses them, that one is left out.
        """
        row = tuple(lanes)
        before = [link.from_lane for link in self._network.links_to(row[0])]
        found = [one for name in (*before, *row) for one in self._across(name)]
        if not found:
            return ()
        own = {self._network.lanes[name].edge for name in row}
        return tuple(one for one in found if one.edge not in own)

    def cross(self, one: str, other: str) -> bool:
        """Check whether two lanes pass above or below one another."""
        edge = self._network.lanes[other].edge
        return any(passing.edge == edge for passing in self._across(one))

    def _across(self, name: str) -> tuple[Passing, ...]:
        found = self._found.get(name)
        if found is None:
            found = self._found[name] = tuple(self._search(self._network.lanes[name]))
        return found

    @cached_property
    def _lanes(self) -> tuple[Lane, ...]:
        return (*self._network.lanes.values(), *self._network.other_lanes.values())

    @cached_property
    def _boxes(self) -> Array:
        """The least and the greatest x and y [m] of every lane [4, L]."""
        rows = []
        for lane in self._lanes:
            xs, ys = zip(*lane.centreline, strict=True)
            rows.append((min(xs), min(ys), max(xs), max(ys)))
        return np.array(rows, np.float64).T

    @cached_property
    def _links(self) -> tuple[Link, ...]:
        return (*self._network.links, *self._network.other_links)

    @cached_property
    def _from(self) -> dict[str, tuple[Link, ...]]:
        found: dict[str, tuple[Link, ...]] = {}
        for link in self._links:
            for name in (link.from_lane, *link.via):
                found[name] = (*found.get(name, ()), link)
        return found

    @cached_property
    def _by_name(self) -> dict[str, Lane]:
        return {lane.id: lane for lane in self._lanes}

    @cached_property
    def _junctions(self) -> dict[str, set[str]]:
        """The junctions that each edge begins or ends at, or is inside of."""
        found: dict[str, set[str]] = {}
        for link in self._links:
            for name in (link.from_lane, *link.via, link.to_lane):
                found.setdefault(self._by_name[name].edge, set()).add(link.junction)
        return found

    @cached_property
    def _beside(self) -> dict[str, set[str]]:
        """The junctions that short edges lead to from each junction."""
        found: dict[str, set[str]] = {}
        for lane in self._lanes:
            if not lane.internal and lane.length < NEAR:
                ends = self._junctions.get(lane.edge, set())
                for end in ends:
                    found.setdefault(end, set()).update(ends)
        return found

    def _joined(self, one: Lane, other: Lane) -> bool:
        """Check whether both are at one junction, or at two close by."""
        ends = self._junctions.get(one.edge, set())
        near = ends.union(*(self._beside.get(end, set()) for end in ends))
        return not near.isdisjoint(self._junctions.get(other.edge, set()))

    def _around(self, x: tuple[float, float], y: tuple[float, float]) -> list[Lane]:
        """Return the lanes of which something may lie within a box [m]."""
        low_x, low_y, high_x, high_y = self._boxes
        met = (low_x <= x[1]) & (high_x >= x[0]) & (low_y <= y[1]) & (high_y >= y[0])
        return [self._lanes[k] for k in np.flatnonzero(met).tolist()]

    def _search(self, own: Lane) -> Iterator[Passing]:
        """Yield the lanes that pass above or below one."""
        xs, ys = zip(*own.centreline, strict=True)
        for other in self._around((min(xs), max(xs)), (min(ys), max(ys))):
            joined = self._joined(own, other)
            unknown = other.internal and other.edge not in self._junctions
            if other.edge == own.edge or unknown or (joined and (own.internal or other.internal)):
                continue
            for place, at, theirs, heading, turn in crossings(own.centreline, other.centreline):
                ends = (at, own.length - at, theirs, other.length - theirs)
                beside = min(ends) < (NEAR if joined else END)
                if not beside and not self._mistaken(own, other, place, heading):
                    yield from self._passings(other, place, theirs, turn)

    def _mistaken(self, own: Lane, other: Lane, place: Point, heading: float) -> bool:
        """Check whether a vehicle on our level may be mistaken for one on the lane that crosses."""
        x, y = place
        for lane in self._around((x - SAME, x + SAME), (y - SAME, y + SAME)):
            if lane.edge in (own.edge, other.edge) or not self._joined(own, lane):
                continue
            for a, b in pairwise(lane.centreline):
                turned = angle_between(math.atan2(b[1] - a[1], b[0] - a[0]), heading)
                if _distance(a, b, place) <= SAME and abs(turned) <= math.pi / 4:
                    return True
        return False

    def _passings(self, lane: Lane, place: Point, at: float, turn: float) -> Iterator[Passing]:
        """Yield a lane that crosses, with each way on from it."""
        wide = WIDE / math.sin(turn)
        on_foot = FOOT in lane.permits and CAR not in lane.permits
        for line in self._onward(lane, at + wide + BODY - lane.length):
            first, rest = line[0], line[1:]
            points = [first, *(b for a, b in pairwise(line) if math.dist(a, b) > 1e-3)]
            if at < wide:  # a vehicle from before the lane comes straight
                (ax, ay), (bx, by) = first, next(p for p in rest if math.dist(p, first) > 1e-3)
                long = math.dist((ax, ay), (bx, by))
                points[0] = (ax - (bx - ax) * wide / long, ay - (by - ay) * wide / long)
            begin = at + (wide if at < wide else 0.0)
            reach = wide + BODY + ON_LANE
            half = 0.5 * min(turn, math.pi - turn)
            row = sides_of(np.array(points, np.float64))
            yield Passing(lane.edge, on_foot, place, reach, row, begin - wide, begin + wide, half)

    def _onward(self, lane: Lane, left: float) -> Iterator[tuple[Point, ...]]:
        """Yield the centreline of a lane and on for some way [m], by every link from its end."""
        links = self._from.get(lane.id, ())
        if left <= 0.0 or not links or lane.internal:
            yield lane.centreline
            return
        for link in links:
            beyond = [self._by_name[name].centreline for name in (*link.via, link.to_lane)]
            yield (*lane.centreline, *(point for line in beyond for point in line))


def _distance(a: Point, b: Point, place: Point) -> float:
    """Return the distance [m] of a place from a stretch of road."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    long = dx * dx + dy * dy
    share = ((place[0] - a[0]) * dx + (place[1] - a[1]) * dy) / long if long > 0.0 else 0.0
    share = max(0.0, min(1.0, share))
    return math.hypot(place[0] - a[0] - share * dx, place[1] - a[1] - share * dy)
