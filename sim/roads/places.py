"""Look-up of the lanes on which a pose may lie."""

import math
from collections.abc import Mapping
from itertools import pairwise

from sim.roads.lanes import Lane, Location
from sim.roads.lines import angle_between, cumulative, project
from sim.scene import Point

CELL = 20.0  # [m] side of a cell
MARGIN = 10.0  # [m] around a centreline; cells that reach into it list the lane
SLACK = 0.01  # [m] greatest error in distances
END = 0.5  # [m] beyond the ends of a lane that still count as on it


class Places:
    """Lanes by the cells of a grid that are near their centrelines."""

    def __init__(self, lanes: Mapping[str, Lane]) -> None:
        """Enter lanes in the grid."""
        self._lanes = {lane.id: (lane, _box(lane)) for lane in lanes.values()}
        cells: dict[tuple[int, int], dict[str, None]] = {}
        for lane in lanes.values():
            for (ax, ay), (bx, by) in pairwise(lane.centreline):
                steps = max(1, math.ceil(math.hypot(bx - ax, by - ay) / 5.0))
                for k in range(steps + 1):
                    x, y = ax + (bx - ax) * k / steps, ay + (by - ay) * k / steps
                    for dx in (-MARGIN, MARGIN):
                        for dy in (-MARGIN, MARGIN):
                            cell = (int((x + dx) // CELL), int((y + dy) // CELL))
                            cells.setdefault(cell, {})[lane.id] = None
        self._cells = {cell: tuple(found) for cell, found in cells.items()}

    def find(
        self, position: Point, heading: float, reach: float, turn: float
    ) -> tuple[Location, ...]:
        """Return the lanes on which a pose may lie, nearest centreline first.

        Args:
            position: [m]
            heading: [rad]
            reach: [m] largest distance from the centreline.
            turn: [rad] largest difference of heading.
        """
        found = []
        x, y = position
        for lane_id in self._cells.get((int(x // CELL), int(y // CELL)), ()):
            lane, (low_x, low_y, high_x, high_y) = self._lanes[lane_id]
            if x < low_x - reach or x > high_x + reach or y < low_y - reach or y > high_y + reach:
                continue
            offset, lateral, direction = project(lane.centreline, position)
            inside = -END <= offset <= lane.length + END
            if inside and abs(lateral) <= reach and abs(angle_between(heading, direction)) <= turn:
                clamped = min(max(offset, 0.0), lane.length)
                found.append(Location(lane_id, clamped, lateral))
        found.sort(key=lambda location: (round(abs(location.lateral), 3), location.lane))
        return tuple(found)


def _box(lane: Lane) -> tuple[float, float, float, float]:
    """Return least x and y, greatest x and y [m] of the places that project onto a lane."""
    beyond = max(lane.length - cumulative(lane.centreline)[-1], 0.0) + END + SLACK
    xs, ys = zip(*lane.centreline, strict=True)
    return min(xs) - beyond, min(ys) - beyond, max(xs) + beyond, max(ys) + beyond
