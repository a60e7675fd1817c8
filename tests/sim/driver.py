"""A plain driver for the ego: keeps its lane, keeps a distance, never changes lanes."""

import math

from sim.roads.network import Network, angle_between, point_at, project
from sim.scene import EGO, Command, Point, Scene, VehicleState


class LaneFollower:
    """Follows one line, speeding up to a limit and braking behind whoever is on the line."""

    def __init__(
        self,
        line: tuple[Point, ...],
        step: float,
        limit: float = 13.89,
        acceleration: float = 2.0,
        braking: float = 3.0,
    ) -> None:
        self.line, self.step, self.limit = line, step, limit
        self.acceleration, self.braking = acceleration, braking
        self.offset: float | None = None

    def command(self, scene: Scene) -> Command:
        """The pose at the end of the coming step."""
        ego = scene.ego
        if self.offset is None:
            self.offset = project(self.line, ego.position)[0]
        speed = min(ego.speed + self.acceleration * self.step, self.limit)
        speed = max(0.0, min(speed, self._safe_speed(scene)))
        self.offset += speed * self.step
        position, heading = point_at(self.line, self.offset)
        return Command(position, heading, speed)

    def _safe_speed(self, scene: Scene) -> float:
        """The speed from which the ego can stop behind a leader who brakes (Krauss 1998)."""
        limits = [math.inf]
        for name, other in scene.vehicles.items():
            if name != EGO and self._on_line(other):
                gap = project(self.line, other.position)[0] - other.length - self.offset - 2.0
                if gap > -other.length:
                    limits.append(self._behind(max(gap, 0.0), other.speed))
        return min(limits)

    def _behind(self, gap: float, leader: float) -> float:
        reaction = self.braking * 1.0
        return -reaction + math.sqrt(reaction**2 + leader**2 + 2.0 * self.braking * gap)

    def _on_line(self, other: VehicleState) -> bool:
        _, lateral, heading = project(self.line, other.position)
        return abs(lateral) < 1.8 and abs(angle_between(other.heading, heading)) < 1.0


def lane_line(network: Network, *lanes: str) -> tuple[Point, ...]:
    """The centreline through several lanes in a row."""
    points: list[Point] = []
    for lane in lanes:
        points += [p for p in network.lanes[lane].centreline if not points or p != points[-1]]
    return tuple(points)
