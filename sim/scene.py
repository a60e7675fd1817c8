"""What can be seen of the world at one instant, and what the car is told to do.

SI units; angles in radians anticlockwise from east; simulation time in seconds.
"""

from collections.abc import Mapping
from dataclasses import dataclass

Point = tuple[float, float]  # [m] (x east, y north)

EGO = 0  # the name of our own car, always


@dataclass(frozen=True, slots=True)
class VehicleState:
    """One vehicle at one instant, in the map frame."""

    position: Point  # [m] centre of the front bumper
    heading: float  # [rad] anticlockwise from east, in (-pi, pi]
    speed: float  # [m/s] along heading, never negative
    acceleration: float  # [m/s2] along heading
    length: float  # [m] from front to rear bumper
    width: float  # [m]
    kind: str = "car"  # what it looks like: car, truck, bus, motorcycle, bicycle
    colour: str | None = None  # in words, None where it cannot be told
    signals: tuple[str, ...] = ()  # lights shown: left, right, brake


@dataclass(frozen=True, slots=True)
class Scene:
    """Every vehicle in view at one instant, the ego among them.

    Keys are the vehicles' names (0 is the ego), in increasing order.
    """

    time: float  # [s] simulation time
    vehicles: Mapping[int, VehicleState]

    @property
    def ego(self) -> VehicleState:
        """The state of our own car."""
        return self.vehicles[EGO]


@dataclass(frozen=True, slots=True)
class Command:
    """The pose that the ego takes at the end of the coming simulation step."""

    position: Point  # [m] centre of the front bumper
    heading: float  # [rad]
    speed: float  # [m/s]
    edges: tuple[str, ...] = ()  # that it will drive along; () unknown
    lights: tuple[str, ...] | None = None  # to show, of left, right, brake; None leaves it to SUMO
