"""The parts of a road network: lanes, links through junctions, crossings, places."""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from sim.scene import Point, Signal

Direction = Literal["left", "straight", "right", "turnaround"]


@dataclass(frozen=True, slots=True)
class Unsignalled:
    """The absence of a traffic light that controls a link."""


Control: TypeAlias = Signal | Unsignalled
UNSIGNALLED = Unsignalled()


@dataclass(frozen=True, slots=True)
class Lane:
    """One lane: of an edge, or inside a junction (`internal`)."""

    id: str
    edge: str
    index: int  # 0 is the rightmost lane of its edge
    width: float  # [m]
    speed_limit: float  # [m/s]
    centreline: tuple[Point, ...]  # [m] [N >= 2] in driving direction
    internal: bool
    length: float  # [m] along the centreline
    stated_length: float  # [m] by the file; offsets of departures and stops refer to it
    permits: frozenset[str]  # classes of vehicles that may use it, in SUMO's words
    limits: tuple[tuple[str, float], ...] = ()  # [m/s] by class, if not the speed limit of cars

    def offset(self, stated: float) -> float:
        """Return the offset [m] along the centreline for an offset [m] by the stated length."""
        return stated * self.length / self.stated_length

    def limit_for(self, kind: str) -> float:
        """Return the speed limit [m/s] of a class of vehicles."""
        return dict(self.limits).get(kind, self.speed_limit)


@dataclass(frozen=True, slots=True)
class Link:
    """A way through a junction, from one lane to another."""

    junction: str
    index: int  # of this link in the junction's right-of-way matrix
    from_lane: str
    to_lane: str
    via: tuple[str, ...]  # internal lanes in driving order; () if the lanes touch
    direction: Direction
    yields_to: tuple[int, ...]  # links for cars of the same junction that go first
    foes: tuple[int, ...]  # links for cars of the same junction whose paths cross or merge
    waits_inside: bool  # may enter and wait at the end of via[0] for oncoming traffic
    control: Control = UNSIGNALLED
    other_yields_to: tuple[int, ...] = ()  # other links and crossings there that go first
    other_foes: tuple[int, ...] = ()  # other links and crossings there that it crosses or joins


@dataclass(frozen=True, slots=True)
class Crossing:
    """A place where people on foot cross a road."""

    id: str  # of its lane
    junction: str
    index: int  # in the junction's right-of-way matrix
    line: tuple[Point, ...]  # [m] [N >= 2] its middle, from kerb to kerb
    width: float  # [m]
    edges: tuple[str, ...]  # that it crosses
    control: Control


@dataclass(frozen=True, slots=True)
class Location:
    """A place on a lane."""

    lane: str
    offset: float  # [m] along the lane's centreline
    lateral: float  # [m] to the left of the centreline
