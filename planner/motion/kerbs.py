"""Places of people on foot beside crossings and on them."""

import math
from collections.abc import Iterator

import numpy as np

from planner.kernels.course import Ints
from planner.motion.tracks import Observed
from planner.motion.walking import KERB, direction_of, place_of
from planner.roads.trajectory import Array, Roads
from sim.roads.network import Crossing, angle_between, cumulative, project
from sim.scene import Point

REACH = 12.0  # [m] from a crossing within which people may be about to use it
LATELY = 25  # samples within which a person counts as having just crossed
LONGEST = 20.0  # [m] maximum length of half a crossing
ASIDE = 0.5  # [m] beside a crossing within which a person counts as on it


def crossings_near(roads: Roads, here: Point) -> Iterator[tuple[Crossing, bool]]:
    """Yield the crossings that begin near a place, and whether their lines end there."""
    for k in _around(roads, here, REACH).tolist():
        crossing = roads.network.crossings[k // 2]
        near, far = crossing.line[0], crossing.line[-1]
        if (math.dist(here, far) < math.dist(here, near)) == bool(k % 2):
            yield crossing, bool(k % 2)


def crossing_under(roads: Roads, here: Point) -> Crossing | None:
    """Return the crossing that a person is on, beyond its kerb."""
    for k in _around(roads, here, LONGEST).tolist():
        crossing: Crossing = roads.network.crossings[k // 2]
        offset, aside, _ = project(crossing.line, here)
        inside = KERB < offset < cumulative(crossing.line)[-1] - KERB
        if inside and abs(aside) <= 0.5 * crossing.width + ASIDE:
            return crossing
    return None


def on_crossing(roads: Roads, here: Point) -> bool:
    """Check whether a place is on a crossing, beyond its kerb."""
    return crossing_under(roads, here) is not None


def is_by(crossing: Crossing, here: Point) -> bool:
    """Check whether a place is near an end of a crossing, or on it."""
    start, end = crossing.line[0], crossing.line[-1]
    if min(math.dist(here, start), math.dist(here, end)) <= REACH:
        return True
    offset, aside, _ = project(crossing.line, here)
    inside = 0.0 <= offset <= cumulative(crossing.line)[-1]
    return inside and abs(aside) <= 0.5 * crossing.width + ASIDE


def people_first(roads: Roads, crossing: Crossing) -> bool:
    """Check whether people on a crossing have priority over vehicles."""
    links = roads.network.junction_links(crossing.junction).values()
    over = [link for link in links if crossing.index in link.other_foes]
    return bool(over) and all(crossing.index in link.other_yields_to for link in over)


def walks_back(person: Observed, crossing: Crossing) -> bool:
    """Check whether a person on a crossing walks against the direction of its line."""
    _, _, heading = project(crossing.line, place_of(person))
    return math.cos(angle_between(direction_of(person), heading)) < 0.0


def came_over(person: Observed, crossing: Crossing) -> bool:
    """Check whether a person has just walked over a crossing."""
    length = cumulative(crossing.line)[-1]
    for x, y in person.position[max(person.elapsed - LATELY, 0) :: 5].tolist():
        offset, aside, _ = project(crossing.line, (x, y))
        if 1.0 < offset < length - 1.0 and abs(aside) < 0.5 * crossing.width:
            return True
    return False


def _around(roads: Roads, here: Point, reach: float) -> Ints:
    """Return which ends of crossings are within reach [m] of a place, as indices into `_ends`."""
    ends = _ends(roads)
    found: Ints = np.flatnonzero(np.hypot(ends[:, 0] - here[0], ends[:, 1] - here[1]) <= reach)
    return found


def _ends(roads: Roads) -> Array:
    """Return the places where crossings begin and end [m] [2 C, 2]."""
    if roads.kerbs is None:
        ends = [point for x in roads.network.crossings for point in (x.line[0], x.line[-1])]
        roads.kerbs = np.array(ends, np.float64).reshape(-1, 2)
    return roads.kerbs
