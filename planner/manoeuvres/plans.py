"""Manoeuvres, and the plan of a macro action that is made of them."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from planner.record.trace import Action
from planner.roads.trajectory import Array, Path
from sim.roads.network import Crossing, Direction, Link, Location
from sim.scene import Point, Signal


@dataclass(frozen=True, slots=True)
class LaneFollow:
    """Drive along the lane."""

    start: float  # [m] arc
    end: float  # [m] arc


@dataclass(frozen=True, slots=True)
class LaneChange:
    """Move over to the neighbouring lane."""

    start: float  # [m] arc
    end: float  # [m] arc
    side: Direction


@dataclass(frozen=True, slots=True)
class Foe:
    """A link whose way crosses another one at a junction with lights."""

    key: tuple[str, int]  # (junction, link index)
    first: bool  # whether it goes first where both may go
    signal: Signal | None
    line: tuple[float, float, float, float]  # x, y [m] beyond which it cannot wait; cosine, sine


@dataclass(frozen=True, slots=True)
class GiveWay:
    """Wait at a line until those who go first on the link's foes leave a gap."""

    stop: float  # [m] arc of the waiting line, for the front bumper; negative once passed
    clear: float  # [m] arc at which the junction is left
    link: Link
    yields_to: frozenset[tuple[str, int]]  # (junction, link index) of those who go first
    foes: tuple[Foe, ...] = ()  # where a light controls the link


@dataclass(frozen=True, slots=True)
class LetCross:
    """Wait before a crossing until the people who come over it leave a gap."""

    stop: float  # [m] arc at which to wait, for the front bumper; negative once passed
    clear: float  # [m] arc at which the crossing is left
    yields_to: frozenset[tuple[str, int]]  # (junction, index) of the crossing
    crossing: Crossing | None  # None: people who walk on the road elsewhere
    first: bool  # whether people have priority there

    @property
    def foes(self) -> tuple[Foe, ...]:
        """None: how people wait at lights is part of their motion."""
        return ()


@dataclass(frozen=True, slots=True)
class ObeyLight:
    """Stop at a light unless it shows green."""

    stop: float  # [m] arc at which to stop, for the front bumper; negative once passed
    signal: Signal


@dataclass(frozen=True, slots=True)
class KeepClear:
    """Wait before a junction that others cross until there is room beyond it."""

    stop: float  # [m] arc at which to wait, for the front bumper
    out: float  # [m] arc at which the junction is left


@dataclass(frozen=True, slots=True)
class Turn:
    """Cross a junction along a link."""

    start: float  # [m] arc
    end: float  # [m] arc
    direction: Direction


@dataclass(frozen=True, slots=True)
class Stop:
    """Brake to a standstill and stand for STANDING_TIME."""

    start: float  # [m] arc
    braking: float  # [m/s2]


Manoeuvre = LaneFollow | LaneChange | KeepClear | GiveWay | LetCross | ObeyLight | Turn | Stop


@dataclass(frozen=True, slots=True)
class Situation:
    """The place and motion of a vehicle when it chooses an action."""

    time: float  # [s]
    position: Point  # [m]
    heading: float  # [rad]
    speed: float  # [m/s]
    acceleration: float  # [m/s2]
    location: Location


@dataclass(frozen=True, eq=False)
class ActionPlan:
    """One macro action, ready to be driven. What is asked of it again and again is kept."""

    action: Action
    path: Path
    manoeuvres: tuple[Manoeuvre, ...]
    end: float  # [m] arc at which the action is over
    commit: float  # [m] arc from which it can no longer be taken back
    goal: float | None  # [m] arc at which the goal is reached, if this action reaches it

    @cached_property
    def give_ways(self) -> tuple[GiveWay, ...]:
        """The lines at which this action may have to wait."""
        return tuple(m for m in self.manoeuvres if isinstance(m, GiveWay))

    @cached_property
    def crossings(self) -> tuple[LetCross, ...]:
        """The crossings for people that this action comes to."""
        return tuple(m for m in self.manoeuvres if isinstance(m, LetCross))

    @cached_property
    def lines(self) -> tuple[GiveWay | LetCross, ...]:
        """Where this action may have to wait for others who go first."""
        return (*self.give_ways, *self.crossings)

    @cached_property
    def obey_lights(self) -> tuple[ObeyLight, ...]:
        """The lights that this action comes to."""
        return tuple(m for m in self.manoeuvres if isinstance(m, ObeyLight))

    @cached_property
    def keep_clears(self) -> tuple[KeepClear, ...]:
        """The junctions that this action must not block."""
        return tuple(m for m in self.manoeuvres if isinstance(m, KeepClear))

    @property
    def stops(self) -> bool:
        """Whether the action ends at a standstill."""
        return self.action == "stop"

    @cached_property
    def met(self) -> frozenset[tuple[str, int]]:
        """The links, as (junction, index), of all that matter at `lines`, wherever they are."""
        foes = (foe.key for line in self.lines for foe in line.foes)
        return frozenset().union(foes, *(line.yields_to for line in self.lines))

    @cached_property
    def line_arcs(self) -> Array:
        """The arcs [m] of `lines`, where each is left, and whether it is a line to give way at."""
        rows = [(line.stop, line.clear, isinstance(line, GiveWay)) for line in self.lines]
        return np.array(rows, np.float64).reshape(-1, 3)

    @cached_property
    def room_arcs(self) -> Array:
        """The arcs [m] of `keep_clears`, and where each junction is left."""
        rows = [(room.stop, room.out) for room in self.keep_clears]
        return np.array(rows, np.float64).reshape(-1, 2)

    @cached_property
    def light_arcs(self) -> Array:
        """The arcs [m] of `obey_lights`."""
        return np.array([light.stop for light in self.obey_lights], np.float64)

    @cached_property
    def signals(self) -> tuple[Signal, ...]:
        """What the lights are that this action comes to."""
        return tuple(light.signal for light in self.obey_lights)

    @cached_property
    def halting(self) -> float:
        """The braking [m/s2] with which it comes to a standstill; 0 unless it stops."""
        return max((m.braking for m in self.manoeuvres if isinstance(m, Stop)), default=0.0)

    @cached_property
    def changes_lane(self) -> bool:
        """Whether the action moves to another lane of the same edge."""
        return any(isinstance(m, LaneChange) for m in self.manoeuvres)
