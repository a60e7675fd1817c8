"""The parts of the roads that the ego cannot see."""

import numpy as np

from sim.perception.buildings import NO_WALLS, Walls
from sim.roads.network import Network, point_at
from sim.scene import Point, Unseen

SPACING = 5.0  # [m] between the points that are tested
ON_FOOT = frozenset({"pedestrian"})


class Blind:
    """The lanes for vehicles as rows of points that are tested for being out of sight."""

    def __init__(self, network: Network) -> None:
        """Put points along all lanes except those for people on foot only."""
        every = (*network.lanes.values(), *network.other_lanes.values())
        points: list[Point] = []
        owners: list[int] = []
        offsets: list[float] = []
        self._lanes = [lane for lane in every if lane.permits - ON_FOOT and lane.length > 0.0]
        for number, lane in enumerate(self._lanes):
            count = max(1, round(lane.length / SPACING))
            for k in range(count):
                offsets.append(lane.length * (k + 0.5) / count)
                points.append(point_at(lane.centreline, offsets[-1])[0])
                owners.append(number)
        self._points = np.array(points).reshape(-1, 2)
        self._owners = np.array(owners, dtype=np.int64)
        self._offsets = np.array(offsets)

    def stretches(
        self, eye: Point, radius: float, walls: Walls, buildings: Walls = NO_WALLS
    ) -> tuple[Unseen, ...]:
        """Return the stretches of lanes within a radius [m] of the eye that are behind walls.

        Args:
            eye: [m] the place from which the ego looks.
            radius: [m] how far the ego sees.
            walls: the sides of buildings and tall vehicles.
            buildings: the sides of buildings alone.
        """
        if not len(walls.starts):
            return ()
        dx, dy = (self._points - eye).T
        near = np.flatnonzero(dx * dx + dy * dy <= radius * radius)
        hidden = near[walls.hide(eye, self._points[near])]
        breaks = np.flatnonzero((np.diff(hidden) > 1) | (np.diff(self._owners[hidden]) != 0)) + 1
        runs = [run for run in np.split(hidden, breaks) if len(run)]
        walled = buildings.hide(eye, self._points[[int(run[-1]) for run in runs]])
        return tuple(self._stretch(run, bool(x)) for run, x in zip(runs, walled, strict=True))

    def _stretch(
        self, places: "np.ndarray[tuple[int], np.dtype[np.int64]]", walled: bool
    ) -> Unseen:
        """Return a stretch that reaches half a spacing beyond its first and last point."""
        lane = self._lanes[int(self._owners[places[0]])]
        half = lane.length / max(1, round(lane.length / SPACING)) / 2.0
        begin, end = self._offsets[places[0]] - half, self._offsets[places[-1]] + half
        return Unseen(lane.id, round(float(begin), 2), round(float(end), 2), walled)
