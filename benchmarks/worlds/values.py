"""The parts of a world: roads, vehicles, and the vehicles that matter to the ego."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

Kind: TypeAlias = Literal[
    "one", "both", "either", "pre-empted", "distractor", "none", "interactive"
]
Family: TypeAlias = Literal["straight", "bent"]  # of roads
Shape: TypeAlias = Literal["car", "van", "truck", "bus", "motorcycle"]

KINDS: tuple[Kind, ...] = (
    "one",
    "both",
    "either",
    "pre-empted",
    "distractor",
    "none",
    "interactive",
)


@dataclass(frozen=True, slots=True)
class Node:
    """A junction, or the end of a road."""

    id: str
    x: float  # [m]
    y: float  # [m]
    end: bool  # whether it is the end of a road


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
    shape: tuple[tuple[float, float], ...] = ()  # [m] points of its line, if it is not straight


@dataclass(frozen=True, slots=True)
class Roads:
    """A network, with its edges by id."""

    nodes: tuple[Node, ...]
    edges: dict[str, Edge]


@dataclass(frozen=True, slots=True)
class Halt:
    """The place and duration of a vehicle's halt."""

    edge: str
    lane: int
    position: float  # [m] along the edge
    duration: float  # [s]
    beside: bool  # whether it is parked beside the lane, not on it


@dataclass(frozen=True, slots=True)
class Vehicle:
    """One vehicle, with its look, start, route and behaviour."""

    role: str  # in the story, in a word
    shape: Shape
    route: tuple[str, ...]  # edges
    lane: int
    position: float  # [m] front bumper along the first edge
    speed: float  # [m/s] at the start
    top: float | None = None  # [m/s] top speed; None: as fast as allowed
    halt: Halt | None = None
    manners: tuple[tuple[str, str], ...] = ()  # attributes of SUMO's driver


@dataclass(frozen=True, slots=True)
class Sketch:
    """A story without bystanders."""

    roads: Roads
    ego: Vehicle
    planted: tuple[Vehicle, ...]  # vehicles on which the ego's action depends
    idle: tuple[Vehicle, ...] = ()  # vehicles in its way or hiding others, which do not matter

    @property
    def cast(self) -> tuple[Vehicle, ...]:
        """All vehicles in the story, except for the ego."""
        return self.planted + self.idle


@dataclass(frozen=True, slots=True)
class World:
    """A story with its bystanders."""

    kind: Kind
    seed: int
    roads: Roads
    ego: Vehicle
    others: dict[int, Vehicle]  # by name
    planted: tuple[int, ...]
    idle: tuple[int, ...]
