"""Observation of one drive, scene by scene: collisions, hard brakes, arrival."""

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

import msgspec

from benchmarks.drive.fault import KEPT, caused_by_ego, provoked_by_ego
from sim.boxes import Box, overlap
from sim.roads.bridges import apart
from sim.roads.network import Network
from sim.scene import EGO, Scene
from sim.setup.goal import Goal

HARD_BRAKE = -4.0  # [m/s2]
EPSILON = 1e-6  # [s]

Ended: TypeAlias = Literal["arrived", "collided", "left", "duration"]  # left: without arriving


class Hit(msgspec.Struct, frozen=True):
    """A collision of the ego."""

    vehicle: int  # name of the vehicle or person
    time: float  # [s]
    caused: bool  # whether by the ego; see `fault`


class Drive(msgspec.Struct, frozen=True):
    """The results of one drive."""

    ended: Ended
    time: float  # [s] when it ended
    hits: tuple[Hit, ...]
    hard_brakes: int  # times that the ego began to brake harder than 4 m/s2
    provoked: int  # times that it made another vehicle do so

    @property
    def caused(self) -> bool:
        """Whether the ego caused a collision."""
        return any(hit.caused for hit in self.hits)


@dataclass
class Observer:
    """An observer of a drive, scene by scene."""

    network: Network
    goal: Goal
    hits: list[Hit] = field(default_factory=list)
    hard_brakes: int = 0
    provoked: int = 0
    arrived: bool = False
    _recent: deque[Scene] = field(default_factory=deque)
    _braking: frozenset[int] = frozenset()

    def see(self, scene: Scene) -> None:
        """Add one scene."""
        braking = frozenset(
            name for name, one in scene.vehicles.items() if one.acceleration < HARD_BRAKE
        )
        for name in sorted(braking - self._braking):
            if name == EGO:
                self.hard_brakes += 1
            else:
                self.provoked += provoked_by_ego(scene, name)
        self._braking = braking
        self.hits.extend(self._touched(scene))
        self.arrived = self.arrived or reached(self.network, self.goal, scene)
        self._recent.append(scene)
        while self._recent[0].time < scene.time - KEPT - EPSILON:
            self._recent.popleft()

    def drive(self, ended: Ended) -> Drive:
        """Return the results of the drive, which ends with the latest scene."""
        time = self._recent[-1].time
        return Drive(ended, time, tuple(self.hits), self.hard_brakes, self.provoked)

    def _touched(self, scene: Scene) -> Iterator[Hit]:
        everybody: dict[int, Box] = {**scene.vehicles, **scene.people}
        for name, other in everybody.items():
            if name == EGO or not overlap(scene.ego, other):
                continue
            if not apart(self.network, scene.ego, other):
                caused = caused_by_ego(self._recent, scene, name, self.network)
                yield Hit(name, round(scene.time, 3), caused)


def reached(network: Network, goal: Goal, scene: Scene) -> bool:
    """Check whether the ego is at its goal: on its edge, at or beyond its position."""
    places = network.locate(scene.ego.position, scene.ego.heading)
    if not places:
        return False
    lane = network.lanes[places[0].lane]
    right = goal.lane is None or lane.index == goal.lane
    return lane.edge == goal.edge and right and places[0].offset >= goal.position - 1e-3
