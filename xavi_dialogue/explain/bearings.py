"""Where the other vehicles are, seen from our car."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal, TypeAlias

from sim.network import angle_between
from sim.scene import EGO, VehicleState

Place: TypeAlias = Literal[
    "ahead",
    "behind",
    "ahead-left",
    "ahead-right",
    "beside-left",
    "beside-right",
    "behind-left",
    "behind-right",
    "oncoming",
    "passed",
    "crossing-left",
    "crossing-right",
]
Vehicles: TypeAlias = Mapping[int, VehicleState]

SAME_LANE = 2.0  # [m] sideways distance of centres below which a vehicle is on our line
SAME_WAY = math.radians(50.0)  # headings that differ by less go our way
OPPOSITE = math.radians(130.0)  # and by more come towards us, until they have passed


@dataclass(frozen=True, slots=True)
class Bearing:
    """The centre of another vehicle in our car's frame."""

    ahead: float  # [m] negative: behind
    left: float  # [m] negative: to the right
    turn: float  # [rad] its heading relative to ours, in (-pi, pi]
    clear: float  # [m] half the lengths of both: nearer than this they are side by side

    @property
    def distance(self) -> float:
        """Between the centres [m]."""
        return math.hypot(self.ahead, self.left)


def bearing(ego: VehicleState, other: VehicleState) -> Bearing:
    """Where `other` is, seen from `ego`."""
    (ex, ey), (ox, oy) = _centre(ego), _centre(other)
    cos, sin = math.cos(ego.heading), math.sin(ego.heading)
    dx, dy = ox - ex, oy - ey
    return Bearing(
        ahead=dx * cos + dy * sin,
        left=dy * cos - dx * sin,
        turn=angle_between(other.heading, ego.heading),
        clear=(ego.length + other.length) / 2.0,
    )


def place(seen: Bearing) -> Place:
    """The bearing as one of a few places that have words."""
    if abs(seen.turn) >= OPPOSITE:
        return "oncoming" if seen.ahead > 0.0 else "passed"
    if abs(seen.turn) > SAME_WAY:
        return "crossing-left" if seen.left > 0.0 else "crossing-right"
    if abs(seen.left) <= SAME_LANE:
        return "ahead" if seen.ahead > 0.0 else "behind"
    if abs(seen.ahead) <= seen.clear:
        return "beside-left" if seen.left > 0.0 else "beside-right"
    if seen.ahead > 0.0:
        return "ahead-left" if seen.left > 0.0 else "ahead-right"
    return "behind-left" if seen.left > 0.0 else "behind-right"


def nearest_first(vehicles: Vehicles) -> tuple[tuple[int, Bearing], ...]:
    """The other vehicles and where they are; of two at one distance the lower name first."""
    ego = vehicles[EGO]
    seen = [(name, bearing(ego, state)) for name, state in vehicles.items() if name != EGO]
    return tuple(sorted(seen, key=lambda one: (round(one[1].distance, 3), one[0])))


def nearest_at(vehicles: Vehicles, places: Iterable[Place]) -> tuple[int, ...]:
    """The nearest vehicle at any of the places, or none."""
    wanted = frozenset(places)
    found = (name for name, seen in nearest_first(vehicles) if place(seen) in wanted)
    return tuple(found)[:1]


def _centre(state: VehicleState) -> tuple[float, float]:
    (x, y), half = state.position, state.length / 2.0
    return x - half * math.cos(state.heading), y - half * math.sin(state.heading)
