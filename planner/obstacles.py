"""Other vehicles as moving obstacles, and the stretches of a path that they occupy in time."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from planner.kernels.driving import Bools
from planner.kernels.projection import Stretches, project
from planner.kernels.reaction import Ints, react
from planner.trace import HoldUp
from planner.trajectory import Array, Path

#: How a vehicle is held up, by the kernel's index.
HOW: tuple[HoldUp, ...] = ("leader", "right-of-way", "cut-in", "blocked", "cut-in")


@dataclass(frozen=True, slots=True, eq=False)
class Obstacle:
    """A vehicle whose motion is given, sampled in the common time base from step 0 on."""

    vehicle: int
    length: float  # [m]
    width: float  # [m]
    position: Array  # [m] [T, 2] front bumper; NaN where it is out of the network
    heading: Array  # [rad] [T]
    speed: Array  # [m/s] [T]
    links: frozenset[tuple[str, int]]  # (junction, link index) that it drives along


@dataclass(frozen=True, slots=True, eq=False)
class Traffic:
    """The motions of several vehicles, in one table for the kernels."""

    vehicles: tuple[int, ...]  # [M]
    states: Array  # [M, T, 4] x, y [m], heading [rad], speed [m/s]
    sizes: Array  # [M, 2] length and width [m]
    links: tuple[frozenset[tuple[str, int]], ...]  # [M]
    noticed: Ints  # [M] steps for which the ego has been on their path, as `reacting` counts
    braking: Bools  # [M] who has braked for the ego, or for one that did

    @classmethod
    def of(cls, obstacles: Sequence[Obstacle]) -> "Traffic":
        """The motions of obstacles; one that ends sooner than others stays as it is then."""
        total = max((len(obstacle.speed) for obstacle in obstacles), default=1)
        states = np.empty((len(obstacles), total, 4))
        for m, obstacle in enumerate(obstacles):
            count = len(obstacle.speed)
            states[m, :count, :2] = obstacle.position
            states[m, :count, 2], states[m, :count, 3] = obstacle.heading, obstacle.speed
            states[m, count:] = states[m, count - 1]
        return cls(
            tuple(obstacle.vehicle for obstacle in obstacles),
            states,
            np.array([(o.length, o.width) for o in obstacles]).reshape(-1, 2),
            tuple(obstacle.links for obstacle in obstacles),
            np.zeros(len(obstacles), np.int64),
            np.zeros(len(obstacles), np.bool_),
        )

    def reacting(self, own: Array, size: tuple[float, float], first: int) -> "Traffic":
        """The motions where the others react to a vehicle; the same object where nobody does.

        Args:
            own: [S, 4] states of the vehicle at steps `first`, `first` + 1, ...
            size: length and width [m] of the vehicle.
            first: step of the first of them.
        """
        states, noticed, braking = react(
            own, size, first, self.states, self.sizes, self.noticed, self.braking
        )
        if states is self.states and np.array_equal(noticed, self.noticed):
            return self
        return replace(self, states=states, noticed=noticed, braking=braking)

    def since(self, step: int) -> "Traffic":
        """The same motions, with a later step as step 0."""
        return replace(self, states=np.ascontiguousarray(self.states[:, step:]))


NOBODY = Traffic.of(())


@dataclass(frozen=True, slots=True, eq=False)
class Occupancy:
    """The stretches of one path that traffic occupies at each step."""

    traffic: Traffic
    stretches: Stretches

    def behind(self, centre: float) -> Bools:
        """Who is on the path behind a centre at an arc [m], at step 0 [M]."""
        found: Bools = 0.5 * (self.stretches.low[:, 0] + self.stretches.high[:, 0]) < centre
        return found

    def firsts(self, lines: Iterable[frozenset[tuple[str, int]]]) -> Bools:
        """Who drives along one of the links of each line [L, M]."""
        found = [[not own.isdisjoint(line) for own in self.traffic.links] for line in lines]
        return np.array(found, dtype=np.bool_).reshape(len(found), len(self.traffic.links))


def occupancy(path: Path, traffic: Traffic, width: float, first: int, last: int) -> Occupancy:
    """Project traffic onto a path.

    Args:
        path: the line that is driven.
        traffic: the other vehicles.
        width: [m] of the vehicle that drives along the path.
        first: step from which the occupancy is needed.
        last: step up to which it is needed.
    """
    stretches = project(
        path.points, path.arc, path.heading, traffic.states, traffic.sizes, width, first, last
    )
    return Occupancy(traffic, stretches)
