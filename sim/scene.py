"""What can be seen of the world at one instant, and what the car is told to do.

SI units; angles in radians anticlockwise from east; simulation time in seconds.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

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
    kind: str = "car"  # look: car, van, truck, bus, motorcycle, bicycle, tram, vehicle
    colour: str | None = None  # in words, None where it cannot be known
    signals: tuple[str, ...] = ()  # lights shown: left, right, brake


@dataclass(frozen=True, slots=True)
class PersonState:
    """One person outside of vehicles at one instant, in the map frame."""

    position: Point  # [m] foremost point
    heading: float  # [rad] anticlockwise from east, in (-pi, pi]
    speed: float  # [m/s] along heading, never negative
    length: float  # [m] from front to back
    width: float  # [m]
    kind: str = "pedestrian"  # what it looks like: pedestrian, wheelchair, scooter


class LightState(Enum):
    """What a traffic light shows to one link; the values are SUMO's letters."""

    RED = "r"
    RED_AMBER = "u"  # about to turn green
    AMBER = "y"  # about to turn red
    GREEN = "G"  # go: nobody has priority
    GREEN_YIELD = "g"  # go, but give way as the junction says
    STOP_FIRST = "s"  # go after a full stop, giving way: a turn on red
    FLASHING = "o"  # out of order: give way as the signs say
    OFF = "O"  # switched off: the signs give this link priority


@dataclass(frozen=True, slots=True)
class Signal:
    """One place in a traffic light: every link that has it is shown the same."""

    controller: str  # id of the traffic light in SUMO
    index: int  # in the controller's state


@dataclass(frozen=True, slots=True)
class Light:
    """What one signal in view shows."""

    signal: Signal
    state: LightState
    since: float  # [s] when it was first seen to be so without a break
    change_seen: bool  # whether it changed to this state then, or only came into view


@dataclass(frozen=True, slots=True)
class Unseen:
    """A stretch of a lane within reach of the eye that something tall stands before."""

    lane: str
    begin: float  # [m] along its centreline
    end: float  # [m]
    walled: bool = False  # a building hides its end, whatever vehicles stand there


@dataclass(frozen=True, slots=True)
class Scene:
    """Everything in view at one instant, the ego among it.

    Keys are names (0 is the ego), in increasing order; no vehicle and person share one.
    """

    time: float  # [s] simulation time
    vehicles: Mapping[int, VehicleState]
    lights: tuple[Light, ...] = ()  # in view, by controller and index
    people: Mapping[int, PersonState] = field(default_factory=dict)  # outside of vehicles
    unseen: tuple[Unseen, ...] = ()  # by lane, in the order of the network

    @property
    def ego(self) -> VehicleState:
        """The state of our own car."""
        return self.vehicles[EGO]

    def light(self, signal: Signal) -> Light | None:
        """Return what a signal shows; None where it is out of view."""
        return next((light for light in self.lights if light.signal == signal), None)


@dataclass(frozen=True, slots=True)
class Command:
    """The pose that the ego takes at the end of the coming simulation step."""

    position: Point  # [m] centre of the front bumper
    heading: float  # [rad]
    speed: float  # [m/s]
    edges: tuple[str, ...] = ()  # that it will drive along; () unknown
    lights: tuple[str, ...] | None = None  # to show, of left, right, brake; None leaves it to SUMO
