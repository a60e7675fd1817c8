"""The conduct of a drive: rules, comfort, distance to others, progress."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import msgspec
import numpy as np

from benchmarks.foreign import pdm
from benchmarks.foreign.rules import Rules
from sim.roads.network import Network
from sim.scene import Scene


class Conduct(msgspec.Struct, frozen=True):
    """The results of one drive in addition to `monitor.Drive`."""

    lights: int  # number of traffic lights passed
    reds: tuple[float, ...]  # [s] times of passing one on red
    crossings: int  # number driven over while somebody on foot was there
    violated: tuple[float, ...]  # [s] times when that was against the rule
    limits: tuple[float, ...]  # [s] times when violations of a speed limit began
    off_road: tuple[float, ...]  # [s] times when the ego left the road
    comfort: float  # share of the pieces of the ride within bounds
    time_to_collision: float  # share of the pieces of the ride within bounds
    travelled: tuple[float, ...]  # [m] at 10 Hz
    company: float  # average number of others in view


@dataclass
class Conducting:
    """An observer of a drive, scene by scene."""

    network: Network
    step: float  # [s] between scenes
    _rules: Rules = field(init=False)
    _scenes: list[Scene] = field(default_factory=list)
    _count: int = 0
    _travelled: list[float] = field(default_factory=list)
    _way: float = 0.0
    _last: Scene | None = None

    def __post_init__(self) -> None:
        self._rules = Rules(self.network)

    def see(self, scene: Scene) -> None:
        """Add one scene."""
        self._rules.see(scene)
        if self._last is not None:
            self._way += math.dist(self._last.ego.position, scene.ego.position)
        self._last = scene
        if self._count % max(1, round(pdm.SAMPLE / self.step)) == 0:
            self._scenes.append(scene)
            self._travelled.append(round(self._way, 2))
        self._count += 1

    def conduct(self) -> Conduct:
        """Return the results of the drive."""
        broken, egos = self._rules.broken(), [scene.ego for scene in self._scenes]
        company = sum(len(x.vehicles) + len(x.people) - 1 for x in self._scenes)
        return Conduct(
            broken.lights,
            broken.reds,
            broken.crossings,
            broken.violated,
            broken.limits,
            broken.off_road,
            pdm.comfortable(
                np.array([ego.speed for ego in egos]),
                np.array([ego.acceleration for ego in egos]),
                np.array([ego.heading for ego in egos]),
            ),
            pdm.in_time(self._scenes, self._off_lane()),
            tuple(self._travelled),
            round(company / max(len(self._scenes), 1), 1),
        )

    def _off_lane(self) -> Sequence[bool]:
        """Return for each scene whether the ego is in more than one lane or in a junction."""
        found = []
        for scene in self._scenes:
            places = self.network.locate(scene.ego.position, scene.ego.heading)
            lane = self.network.lanes[places[0].lane] if places else None
            aside = abs(places[0].lateral) + scene.ego.width / 2.0 if places else math.inf
            found.append(lane is None or lane.internal or aside > lane.width / 2.0)
        return found
