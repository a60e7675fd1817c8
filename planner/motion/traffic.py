"""Other vehicles as moving obstacles, one by one and in tables."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from planner.kernels.course import Bools
from planner.kernels.projection import SIDE_MARGIN
from planner.kernels.reaction import Ints, react
from planner.kernels.stretches import Stretches, empty, roomier
from planner.roads.levels import NOBODY_ELSEWHERE, elsewhere
from planner.roads.trajectory import Array, Path
from planner.traffic_lights.signals import NO_LIGHTS, Lights


@dataclass(frozen=True, eq=False)
class Obstacle:
    """A vehicle whose motion is given, sampled in the common time base from step 0 on."""

    vehicle: int
    length: float  # [m]
    width: float  # [m]
    position: Array  # [m] [T, 2] front bumper; NaN where it is out of the network
    heading: Array  # [rad] [T]
    speed: Array  # [m/s] [T]
    links: frozenset[tuple[str, int]]  # (junction, link index) that it drives along
    berth: float = SIDE_MARGIN  # [m] kept free beside it
    on_foot: bool = False

    @cached_property
    def states(self) -> Array:
        """Its x, y [m], heading [rad] and speed [m/s] in one table [T, 4]."""
        found = np.empty((len(self.speed), 4))
        found[:, :2], found[:, 2], found[:, 3] = self.position, self.heading, self.speed
        return found

    def shifted(self, shift: int, steps: int) -> Array:
        """Return its states later by `shift` steps: absent before, and cut to 0 ... `steps`."""
        found = np.zeros((steps + 1, 4))
        found[:, :2] = np.nan
        source = self.states[max(-shift, 0) :][: steps + 1 - max(shift, 0)]
        found[max(shift, 0) : max(shift, 0) + len(source)] = source
        return found

    @property
    def rests(self) -> bool:
        """Whether it comes to rest in the end."""
        return float(self.speed[-1]) == 0.0 and math.isfinite(float(self.position[-1, 0]))


@dataclass(frozen=True, slots=True, eq=False)
class Motions:
    """The motion of one vehicle, which may depend on the courses of lights."""

    usual: Obstacle  # if they take their likeliest courses
    make: Callable[[tuple[int, ...]], Obstacle] | None = None  # by courses; None: always as usual

    def under(self, courses: tuple[int, ...]) -> Obstacle:
        """Return the motion if controllers take certain courses, computed when it is needed."""
        return self.usual if self.make is None else self.make(courses)


@dataclass(slots=True, eq=False)
class Met:
    """The stretches of one path that motions occupy, as far as these have been projected."""

    stretches: Stretches = field(default_factory=lambda: empty(0, 1))  # maybe with room for more
    count: int = 0  # of the rows in use
    rows: dict[object, int] = field(default_factory=dict)  # by tag; -1: never on the path

    def add(self, found: Stretches) -> None:
        """Add stretches; the room doubles where it does not suffice."""
        count = self.count + len(found.last)
        if self.count == 0:
            self.stretches, self.count = found, count
            return
        if count > len(self.stretches.last):
            self.stretches = roomier(self.stretches, self.count, 2 * count)
        for column, more in zip(self.stretches, found, strict=True):
            column[self.count : count] = more
        self.count = count


@dataclass(slots=True, eq=False)
class Pool:
    """Results kept of motions and paths, by the tag of each motion."""

    #: By path, width, first and last step, and steps in all.
    met: dict[tuple[Path, float, int, int, int], Met] = field(default_factory=dict)
    #: Whether a motion is above or below a path at each step [T]; by path, and steps in all.
    elsewhere: dict[tuple[Path, int], dict[object, Bools]] = field(default_factory=dict)
    #: Whether it goes first at a line with a light at each step [T]; by link, lights shown, and
    #: steps in all.
    firsts: dict[tuple[str, int, Lights, int], dict[object, Bools]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False)
class Traffic:
    """The motions of several vehicles, in one table for the kernels, and what lights show them."""

    vehicles: tuple[int, ...]  # [M]
    states: Array  # [M, T, 4] x, y [m], heading [rad], speed [m/s]
    sizes: Array  # [M, 2] length and width [m]
    links: tuple[frozenset[tuple[str, int]], ...]  # [M]
    noticed: Ints  # [M] steps for which they have seen the ego on their path
    braking: Bools  # [M] whether each has braked for the ego, or for one that did
    spaces: Array  # [M, 2] length and width [m] with what is kept free beside them
    on_foot: Bools  # [M]
    tags: tuple[object, ...]  # [M] the same where a motion is the same one, to the same step
    lights: Lights = field(default=NO_LIGHTS)
    pool: Pool = field(default_factory=Pool)

    @classmethod
    def of(
        cls,
        obstacles: Sequence[Obstacle],
        lights: Lights = NO_LIGHTS,
        pool: Pool | None = None,
    ) -> "Traffic":
        """Return the motions of obstacles; one that ends sooner than others keeps its last state.

        Args:
            obstacles: the others.
            lights: what they show.
            pool: shared with traffic in which some of the motions are the same.
        """
        total = max((len(obstacle.speed) for obstacle in obstacles), default=1)
        states = np.empty((len(obstacles), total, 4))
        for m, obstacle in enumerate(obstacles):
            count = len(obstacle.speed)
            states[m, :count] = obstacle.states
            if count < total:
                states[m, count:] = states[m, count - 1]
        return _in_table(obstacles, states, lights, Pool() if pool is None else pool)

    @classmethod
    def shifted(
        cls, obstacles: Sequence[tuple[Obstacle, int]], steps: int, lights: Lights
    ) -> "Traffic":
        """Return the motions of obstacles, each moved in time.

        Args:
            obstacles: the others, and by how many steps each is later.
            steps: the last step.
            lights: what they show.
        """
        states = np.empty((len(obstacles), steps + 1 if obstacles else 1, 4))
        for m, (obstacle, shift) in enumerate(obstacles):
            states[m] = obstacle.shifted(shift, steps)
        return _in_table([obstacle for obstacle, _ in obstacles], states, lights, Pool())

    def reacting(
        self, own: Array, size: tuple[float, float], first: int, path: Path | None = None
    ) -> "Traffic":
        """Return the motions with reactions to a vehicle; the same object if nobody reacts.

        Args:
            own: [S, 4] states of the vehicle at steps `first`, `first` + 1, ...
            size: length and width [m] of the vehicle.
            first: step of the first of them.
            path: the path that it drives along.
        """
        apart = NOBODY_ELSEWHERE if path is None else self.elsewhere(path)
        others = (self.states, self.sizes, self.noticed, self.braking)
        states, noticed, braking = react(own, size, first, *others, apart)
        if states is self.states and np.array_equal(noticed, self.noticed):
            return self
        tags = self.tags
        if states is not self.states:  # only vehicles that brake have a new motion
            late = zip(tags, braking.tolist(), strict=True)
            tags = tuple(object() if brakes else tag for tag, brakes in late)
        return replace(self, states=states, noticed=noticed, braking=braking, tags=tags)

    def elsewhere(self, path: Path) -> Bools:
        """Return which others are above or below a path [M, T]; [0, 0] if there is no bridge."""
        if not path.passings:
            return NOBODY_ELSEWHERE
        known = self.pool.elsewhere.setdefault((path, self.states.shape[1]), {})
        fresh = self.only([m for m, tag in enumerate(self.tags) if tag not in known])
        found = elsewhere(path.passings, fresh.states, fresh.sizes, fresh.on_foot)
        known.update(zip(fresh.tags, found, strict=True))
        rows = [known[tag] for tag in self.tags]
        return np.array(rows, np.bool_).reshape(self.states.shape[:2])

    def beside(self, path: Path) -> Array:
        """Return the states without those above or below a path, which are NaN."""
        there = self.elsewhere(path)
        return np.where(there[:, :, None], np.nan, self.states) if len(there) else self.states

    def since(self, step: int) -> "Traffic":
        """Return the same motions, with a later step as step 0."""
        states = np.ascontiguousarray(self.states[:, step:])
        tags = tuple((tag, step) for tag in self.tags)
        return replace(self, states=states, tags=tags, lights=self.lights.since(step))

    def only(self, which: Sequence[int]) -> "Traffic":
        """Return the traffic of some of the others, by their indices in increasing order."""
        if len(which) == len(self.vehicles):
            return self
        at = np.array(which, np.int64)
        return Traffic(
            tuple(self.vehicles[m] for m in which),
            self.states[at],
            self.sizes[at],
            tuple(self.links[m] for m in which),
            self.noticed[at],
            self.braking[at],
            self.spaces[at],
            self.on_foot[at],
            tuple(self.tags[m] for m in which),
            self.lights,
            self.pool,
        )


def _in_table(obstacles: Sequence[Obstacle], states: Array, lights: Lights, pool: Pool) -> Traffic:
    """Return the motions of obstacles, given their states [M, T, 4]."""
    sizes = [(o.length, o.width, o.width + 2.0 * (o.berth - SIDE_MARGIN)) for o in obstacles]
    table = np.array(sizes, np.float64).reshape(-1, 3)
    return Traffic(
        tuple(obstacle.vehicle for obstacle in obstacles),
        states,
        np.ascontiguousarray(table[:, :2]),
        tuple(obstacle.links for obstacle in obstacles),
        np.zeros(len(obstacles), np.int64),
        np.zeros(len(obstacles), np.bool_),
        np.ascontiguousarray(table[:, ::2]),
        np.array([o.on_foot for o in obstacles], np.bool_),
        tuple(obstacles),
        lights,
        pool,
    )


NOBODY = Traffic.of(())
