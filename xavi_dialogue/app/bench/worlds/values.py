"""What a world is made of: roads, vehicles, and which of these matters to the ego."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

Kind: TypeAlias = Literal["leader", "leader-2", "cross", "merge", "oncoming", "occluder"]
Shape: TypeAlias = Literal["car", "van", "truck", "bus", "motorcycle"]

KINDS: tuple[Kind, ...] = ("leader", "leader-2", "cross", "merge", "oncoming", "occluder")


@dataclass(frozen=True, slots=True)
class Node:
    """A junction, or the end of a road."""

    id: str
    x: float  # [m]
    y: float  # [m]
    end: bool  # of a road


@dataclass(frozen=True, slots=True)
class Edge:
    """One direction of a road."""

    id: str
    start: str  # node
    end: str
    lanes: int
    speed: float  # [m/s] limit
    priority: int
    length: float  # [m] between the nodes


@dataclass(frozen=True, slots=True)
class Roads:
    """A network as it is drawn; edges by id."""

    nodes: tuple[Node, ...]
    edges: dict[str, Edge]


@dataclass(frozen=True, slots=True)
class Halt:
    """Where and how long a vehicle stands."""

    edge: str
    lane: int
    position: float  # [m] along the edge
    duration: float  # [s]
    beside: bool  # parked beside the lane, and not on it


@dataclass(frozen=True, slots=True)
class Vehicle:
    """One vehicle: how it looks, where it starts, what it does."""

    role: str  # in the story, in a word
    shape: Shape
    route: tuple[str, ...]  # edges
    lane: int
    position: float  # [m] front bumper along the first edge
    speed: float  # [m/s] at the start
    top: float | None = None  # [m/s] it never drives faster; None: as fast as allowed
    halt: Halt | None = None
    manners: tuple[tuple[str, str], ...] = ()  # attributes of SUMO's driver


@dataclass(frozen=True, slots=True)
class Sketch:
    """A story before anybody else is added."""

    roads: Roads
    ego: Vehicle
    planted: Vehicle
    occluder: Vehicle | None = None


@dataclass(frozen=True, slots=True)
class World:
    """A story with everybody in it."""

    kind: Kind
    seed: int
    roads: Roads
    ego: Vehicle
    others: dict[int, Vehicle]  # by name
    planted: int
    occluder: int | None
