"""Scenes, which hold what the ego can see at one instant, and commands to the ego.

SI units; angles in radians anticlockwise from east; simulation time in seconds.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import Annotated

from msgspec import Meta

Point = tuple[float, float]  # [m] (x east, y north)

# What is read from files and messages is refused beyond these bounds.
Coordinate = Annotated[float, Meta(ge=-1e8, le=1e8)]  # [m] no map projection exceeds it
Speed = Annotated[float, Meta(ge=-1e3, le=1e3)]  # [m/s]
Size = Annotated[float, Meta(ge=0.0, le=1e3)]  # [m] of a road user

EGO = 0  # the name of our own car, always


@dataclass(frozen=True, slots=True)
class VehicleState:
    """One vehicle at one instant, in the map frame."""

    position: tuple[Coordinate, Coordinate]  # [m] centre of the front bumper
    heading: float  # [rad] anticlockwise from east, in (-pi, pi]
    speed: Speed  # [m/s] along heading, never negative
    acceleration: float  # [m/s2] along heading
    length: Size  # [m] from front to rear bumper
    width: Size  # [m]
    kind: str = "car"  # by its look: car, van, truck, bus, motorcycle, bicycle, tram, vehicle
    colour: str | None = None  # a word; None if unknown
    signals: tuple[str, ...] = ()  # lights shown: left, right, brake


@dataclass(frozen=True, slots=True)
class PersonState:
    """One person outside of vehicles at one instant, in the map frame."""

    position: tuple[Coordinate, Coordinate]  # [m] foremost point
    heading: float  # [rad] anticlockwise from east, in (-pi, pi]
    speed: Speed  # [m/s] along heading, never negative
    length: Size  # [m] from front to back
    width: Size  # [m]
    kind: str = "pedestrian"  # by its look: pedestrian, wheelchair, scooter


class LightState(Enum):
    """The state that a traffic light shows to one link; the values are SUMO's letters."""

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
    """One position in the state of a traffic light; its links all see the same state."""

    controller: str  # id of the traffic light in SUMO
    index: int  # in the controller's state


@dataclass(frozen=True, slots=True)
class Light:
    """The state of one signal in view."""

    signal: Signal
    state: LightState
    since: float  # [s] start of the time for which it has been seen in this state
    change_seen: bool  # True: seen to change to this state then; False: only came into view


@dataclass(frozen=True, slots=True)
class Unseen:
    """A stretch of a lane within the view radius that something tall hides from the ego."""

    lane: str
    begin: float  # [m] along its centreline
    end: float  # [m]
    walled: bool = False  # a building hides its far end, no matter which vehicles are around


@dataclass(frozen=True, slots=True)
class Scene:
    """Everything in view at one instant, including the ego.

    Keys are names (0 is the ego), in increasing order; no vehicle and person share one.
    """

    time: float  # [s] simulation time
    vehicles: Mapping[int, VehicleState]  # by number
    lights: tuple[Light, ...] = ()  # in view, by controller and index
    people: Mapping[int, PersonState] = field(default_factory=dict)  # outside of vehicles
    unseen: tuple[Unseen, ...] = ()  # by lane, in the order of the network

    @property
    def ego(self) -> VehicleState:
        """The state of our own car."""
        return self.vehicles[EGO]

    def light(self, signal: Signal) -> Light | None:
        """Return what a signal shows; None if it is out of view."""
        return next((light for light in self.lights if light.signal == signal), None)


@dataclass(frozen=True, slots=True)
class Command:
    """The pose that the ego takes at the end of the coming simulation step."""

    position: Point  # [m] centre of the front bumper
    heading: float  # [rad]
    speed: float  # [m/s]
    edges: tuple[str, ...] = ()  # that it will drive along; () if unknown
    lights: tuple[str, ...] | None = None  # to show: left, right, brake; None leaves it to SUMO
