"""Buildings that hide what is behind them: outlines, taken as higher than all road users."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.boxes import Box, corners
from sim.scene import Point, VehicleState

KIND = "building"  # prefix of the types of their polygons in SUMO's imports of OpenStreetMap
OPEN = ("building.roof", "building.carport", "building.bridge")  # a car drives and sees below them
Rows = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Walls:
    """The walls around the ego."""

    starts: Rows  # [m] [N, 2]
    ends: Rows  # [m] [N, 2]

    def between(self, a: Point, b: Point) -> bool:
        """Check whether the straight line from a to b passes through a wall.

        Two segments cross if the ends of each lie on different sides of the other (de Berg et
        al., "Computational Geometry", 2008, section 2.1); touching is not crossing.
        """
        if not len(self.starts):
            return False
        ax, ay = a
        way = np.array([b[0] - ax, b[1] - ay])
        one = _side(way, self.starts - (ax, ay))
        other = _side(way, self.ends - (ax, ay))
        walls = self.ends - self.starts
        before = _side(walls, np.array(a) - self.starts)
        after = _side(walls, np.array(b) - self.starts)
        return bool(np.any((one * other < 0.0) & (before * after < 0.0)))

    def hide(self, eye: Point, points: Rows) -> NDArray[np.bool_]:
        """Return which of many points [m] [M, 2] are behind a wall, as `between` says."""
        if not len(self.starts) or not len(points):
            return np.zeros(len(points), dtype=bool)
        starts, ends, ways = self.starts - eye, self.ends - eye, points - eye
        walls = ends - starts
        one, other = ways @ _turned(starts).T, ways @ _turned(ends).T  # [M, N]: sides of the way
        before = _side(walls, -starts)  # [N] side of the wall on which the eye is
        after = before - ways @ _turned(walls).T  # [M, N] side of it on which the point is
        crossed: NDArray[np.bool_] = (one * other < 0.0) & (before * after < 0.0)
        hidden: NDArray[np.bool_] = np.logical_or.reduce(crossed, axis=1)
        return hidden

    def beside(self, boxes: Iterable[Box]) -> "Walls":
        """Return these walls together with the sides of boxes."""
        starts, ends = [self.starts], [self.ends]
        for box in boxes:
            around = np.array(corners(box))
            starts.append(around)
            ends.append(np.roll(around, -1, axis=0))
        return Walls(np.concatenate(starts), np.concatenate(ends))


NO_WALLS = Walls(np.empty((0, 2)), np.empty((0, 2)))


class Buildings:
    """The buildings of a world."""

    def __init__(self, polygons: Iterable[tuple[str, tuple[Point, ...]]]) -> None:
        """Keep the polygons that hide something.

        Args:
            polygons: the type and outline [m] of each.
        """
        starts: list[Point] = []
        ends: list[Point] = []
        owners: list[int] = []
        for number, (kind, outline) in enumerate(polygons):
            if kind.startswith(KIND) and not kind.startswith(OPEN) and len(outline) > 2:
                starts += outline
                ends += (*outline[1:], outline[0])
                owners += [number] * len(outline)
        self._starts = np.array(starts).reshape(-1, 2)
        self._ends = np.array(ends).reshape(-1, 2)
        self._owners = np.array(owners, dtype=np.int64)

    def around(self, ego: VehicleState, radius: float) -> Walls:
        """Return the walls that may be partly within a radius [m] of the ego.

        A building that contains the ego hides nothing: the road leads through it.
        """
        if not len(self._starts):
            return NO_WALLS
        low = np.minimum(self._starts, self._ends) - radius
        high = np.maximum(self._starts, self._ends) + radius
        near = np.all((low <= ego.position) & (high >= ego.position), axis=1)
        near &= ~np.isin(self._owners, self._around(ego.position))
        return Walls(self._starts[near], self._ends[near])

    def _around(self, point: Point) -> NDArray[np.int64]:
        """Return the buildings that contain a point: a ray crosses an odd number of their walls."""
        x, y = point
        (ax, ay), (bx, by) = self._starts.T, self._ends.T
        level = (ay > y) != (by > y)
        ahead = np.zeros(len(ax), dtype=bool)
        ahead[level] = (bx - ax)[level] * ((y - ay) / (by - ay + ~level))[level] + ax[level] > x
        crossed = np.bincount(self._owners[ahead])
        found: NDArray[np.int64] = np.flatnonzero(crossed % 2)
        return found


def _turned(ways: Rows) -> Rows:
    """Return vectors turned so that a scalar product with them is a cross product."""
    return np.stack([ways[:, 1], -ways[:, 0]], axis=1)


def _side(way: Rows, points: Rows) -> Rows:
    """Return the side of a way on which points lie: positive on its left (cross product)."""
    side: Rows = way[..., 0] * points[..., 1] - way[..., 1] * points[..., 0]
    return side
