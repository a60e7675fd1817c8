"""Other vehicles as moving obstacles, and the stretches of a path that they occupy in time."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from planner.kernels.course import Bools
from planner.kernels.driving import ALIGNED, OPEN, RIGHT_OF_WAY, SHUT
from planner.kernels.projection import SIDE_MARGIN, Stretches, project, project_some, select
from planner.kernels.reaction import Ints, react
from planner.manoeuvres.plans import Foe, GiveWay, LetCross
from planner.record.trace import HoldUp
from planner.roads.levels import NOBODY_ELSEWHERE, elsewhere
from planner.roads.trajectory import Array, Path
from planner.traffic_lights.signals import NO_LIGHTS, Lights
from sim.scene import Signal

#: How a vehicle is held up, by the kernel's index.
HOW: tuple[HoldUp, ...] = ("leader", "right-of-way", "cut-in", "blocked", "cut-in")


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

    @property
    def rests(self) -> bool:
        """Whether it comes to rest in the end."""
        return float(self.speed[-1]) == 0.0 and math.isfinite(float(self.position[-1, 0]))


@dataclass(frozen=True, slots=True, eq=False)
class Motions:
    """How one vehicle moves, which may depend on how lights go on."""

    usual: Obstacle  # where they take their likeliest courses
    make: Callable[[tuple[int, ...]], Obstacle] | None = None  # by courses; None: always as usual

    def under(self, courses: tuple[int, ...]) -> Obstacle:
        """Return the motion where controllers take certain courses, made when it is needed."""
        return self.usual if self.make is None else self.make(courses)


@dataclass(slots=True, eq=False)
class Met:
    """The stretches of one path that motions occupy, as far as these have been projected."""

    stretches: Stretches | None = None
    rows: dict[object, int] = field(default_factory=dict)  # by tag; -1 where it is never on it


@dataclass(slots=True, eq=False)
class Pool:
    """Results kept of motions and paths, by the tag of each motion."""

    #: By path, width, first and last step, and steps in all.
    met: dict[tuple[Path, float, int, int, int], Met] = field(default_factory=dict)
    #: Who is above or below a path at each step [T]; by path, and steps in all.
    elsewhere: dict[tuple[Path, int], dict[object, Bools]] = field(default_factory=dict)
    #: Who goes first at a line with a light at each step [T]; by its link, what lights show, and
    #: steps in all.
    firsts: dict[tuple[str, int, Lights, int], dict[object, Bools]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False)
class Traffic:
    """The motions of several vehicles, in one table for the kernels, and what lights show them."""

    vehicles: tuple[int, ...]  # [M]
    states: Array  # [M, T, 4] x, y [m], heading [rad], speed [m/s]
    sizes: Array  # [M, 2] length and width [m]
    links: tuple[frozenset[tuple[str, int]], ...]  # [M]
    noticed: Ints  # [M] steps for which the ego has been on their path, as `reacting` counts
    braking: Bools  # [M] who has braked for the ego, or for one that did
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
        """Return the motions of obstacles; one that ends sooner than others stays as it is then.

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
        """Return the motions of obstacles, each later by so many steps: absent before, then cut.

        Args:
            obstacles: the others, and by how many steps each is moved.
            steps: the last step.
            lights: what they show.
        """
        total = steps + 1 if obstacles else 1
        states = np.zeros((len(obstacles), total, 4))
        states[:, :, :2] = np.nan
        for m, (obstacle, shift) in enumerate(obstacles):
            source = obstacle.states[max(-shift, 0) :][: total - max(shift, 0)]
            states[m, max(shift, 0) : max(shift, 0) + len(source)] = source
        return _in_table([obstacle for obstacle, _ in obstacles], states, lights, Pool())

    def reacting(
        self, own: Array, size: tuple[float, float], first: int, path: Path | None = None
    ) -> "Traffic":
        """The motions where the others react to a vehicle; the same object where nobody does.

        Args:
            own: [S, 4] states of the vehicle at steps `first`, `first` + 1, ...
            size: length and width [m] of the vehicle.
            first: step of the first of them.
            path: that it drives along.
        """
        apart = NOBODY_ELSEWHERE if path is None else self.elsewhere(path)
        others = (self.states, self.sizes, self.noticed, self.braking)
        states, noticed, braking = react(own, size, first, *others, apart)
        if states is self.states and np.array_equal(noticed, self.noticed):
            return self
        tags = self.tags
        if states is not self.states:  # only who brakes moves otherwise than before
            late = zip(tags, braking.tolist(), strict=True)
            tags = tuple(object() if brakes else tag for tag, brakes in late)
        return replace(self, states=states, noticed=noticed, braking=braking, tags=tags)

    def elsewhere(self, path: Path) -> Bools:
        """Who is above or below a path, and not on it [M, T]; [0, 0] where there is no bridge."""
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
        """Some of the others, by their indices in increasing order."""
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


@dataclass(frozen=True, slots=True, eq=False)
class Occupancy:
    """The stretches of one path that traffic occupies at each step."""

    traffic: Traffic
    stretches: Stretches

    def behind(self, front: float, length: float) -> Bools:
        """Return whom driving on does not come to, at step 0 [M].

        These are vehicles behind the middle of the own body, and people behind its front.

        Args:
            front: [m] arc of the own front.
            length: [m] of the own body.
        """
        low, high = self.stretches.low[:, 0], self.stretches.high[:, 0]
        found: Bools = 0.5 * (low + high) < front - 0.5 * length
        found |= self.traffic.on_foot & (high < front)
        return found

    def manner(self, who: Ints, step: Ints, how: Ints) -> Ints:
        """How vehicles hold up, as indices into HOW: people who walk across have right of way.

        Args:
            who, step, how: [H] index of the one, when, and how it would be of a vehicle.
        """
        if not np.any(self.traffic.on_foot):
            return how
        t = np.minimum(step, self.stretches.cosine.shape[1] - 1)
        crosses = self.traffic.on_foot[who] & (self.stretches.cosine[who, t] < ALIGNED)
        found: Ints = np.where(crosses, RIGHT_OF_WAY, how)
        return found

    def firsts(self, lines: Sequence[GiveWay | LetCross]) -> Bools:
        """Return who goes first at each line [L, M, T], at each step where there are lights."""
        links = self.traffic.links
        found = [[not own.isdisjoint(line.yields_to) for own in links] for line in lines]
        always = np.array(found, dtype=np.bool_).reshape(len(found), len(links), 1)
        if not any(line.foes for line in lines):
            return always
        steps = self.traffic.states.shape[1]
        changing = np.repeat(always, steps, axis=2)
        for k, line in enumerate(lines):
            if isinstance(line, GiveWay) and line.foes:
                changing[k] = _by_light(self.traffic, line, steps)
        return changing


def occupancy(path: Path, traffic: Traffic, width: float, first: int, last: int) -> Occupancy:
    """Project traffic onto a path.

    Args:
        path: the line that is driven.
        traffic: the other vehicles.
        width: [m] of the vehicle that drives along the path.
        first: step from which the occupancy is needed.
        last: step up to which it is needed.
    """
    return Occupancy(traffic, _projected(path, traffic, width, first, last))


def _projected(path: Path, traffic: Traffic, width: float, first: int, last: int) -> Stretches:
    """Return where traffic is on a path; see `occupancy`."""
    line, states = (path.points, path.arc, path.heading), traffic.beside(path)
    return project(*line, states, traffic.spaces, width, first, last)


def meeting(
    path: Path,
    lines: Sequence[GiveWay | LetCross],
    traffic: Traffic,
    width: float,
    first: int,
    last: int,
) -> Occupancy:
    """Project onto a path what comes onto it; what has been projected before is looked up.

    Args:
        path: the line that is driven.
        lines: on it; who goes first at one of them counts, wherever it is.
        traffic: the other vehicles.
        width: [m] of the vehicle that drives along the path.
        first, last: steps from which, and up to which, the occupancy is needed.
    """
    if not traffic.vehicles:
        return occupancy(path, traffic, width, first, last)
    key = (path, width, first, last, traffic.states.shape[1])
    met = traffic.pool.met.get(key)
    if met is None:
        met = traffic.pool.met[key] = Met()
    fresh = [m for m, tag in enumerate(traffic.tags) if tag not in met.rows]
    if fresh or met.stretches is None:
        _add(met, path, traffic, fresh, width, first, last)
    assert met.stretches is not None
    rows = [met.rows[tag] for tag in traffic.tags]
    there = [m for m, row in enumerate(rows) if row >= 0]
    if lines:
        firsts: set[tuple[str, int]] = set()
        for line in lines:
            firsts.update(line.yields_to, (foe.key for foe in line.foes))
        links = enumerate(traffic.links)
        there = [m for m, own in links if rows[m] >= 0 or not firsts.isdisjoint(own)]
    some, chosen = traffic.only(there), [rows[m] for m in there]
    if chosen == list(range(len(met.stretches.last))):
        return Occupancy(some, met.stretches)
    return Occupancy(some, select(met.stretches, np.array(chosen, np.int64), some.states))


def _add(
    met: Met,
    path: Path,
    traffic: Traffic,
    fresh: Sequence[int],
    width: float,
    first: int,
    last: int,
) -> None:
    """Project motions, by their indices, that have not been projected onto a path yet."""
    line, which = (path.points, path.arc, path.heading), np.array(fresh, np.int64)
    if path.passings:
        traffic, which = traffic.only(fresh), np.arange(len(fresh))
    states, spaces = traffic.beside(path), traffic.spaces
    rows, found = project_some(*line, states, spaces, width, first, last, which)
    known = 0 if met.stretches is None else len(met.stretches.last)
    for m, row in zip(which.tolist(), rows.tolist(), strict=True):
        met.rows[traffic.tags[m]] = known + row if row >= 0 else -1
    if met.stretches is None:
        met.stretches = found
    elif len(found.last):
        met.stretches = Stretches(*map(np.concatenate, zip(met.stretches, found, strict=True)))


def _by_light(traffic: Traffic, line: GiveWay, steps: int) -> Bools:
    """Return who goes first at a line with a light [M, T], which may show others red.

    Who is inside the junction is let out, whatever the light; of the others, those go first for
    whom the junction's rules say so while their light lets them in, and ours does not let us first.
    """
    key = (line.link.junction, line.link.index, traffic.lights, steps)
    known = traffic.pool.firsts.setdefault(key, {})
    yields: Bools | None = None
    for m, (tag, links) in enumerate(zip(traffic.tags, traffic.links, strict=True)):
        if tag not in known:
            yields = _not_first(traffic, line, steps) if yields is None else yields
            known[tag] = _first_by_light(traffic, line, links, traffic.states[m], yields)
    rows = [known[tag] for tag in traffic.tags]
    return np.array(rows, np.bool_).reshape(len(rows), steps)


def _not_first(traffic: Traffic, line: GiveWay, steps: int) -> Bools:
    """At which steps [T] our own light does not let us first at a line."""
    ours = line.link.control
    if not isinstance(ours, Signal):
        return np.ones(steps, np.bool_)
    found: Bools = traffic.lights.shows(ours, steps)[:steps] >= OPEN
    return found


def _first_by_light(
    traffic: Traffic,
    line: GiveWay,
    links: frozenset[tuple[str, int]],
    states: Array,
    yields: Bools,
) -> Bools:
    """Return when one of the others goes first at a line with a light [T]."""
    first: Bools = np.zeros(len(states), np.bool_)
    for foe in line.foes:
        if foe.key in links:
            inside = _beyond(states, foe)
            first |= inside
            if foe.first:
                first |= yields & ~inside & ~_held(traffic, foe, inside, len(states))
    return first


def _beyond(states: Array, foe: Foe) -> Bools:
    """At which steps [T] of its motion [T, 4] who drives along a link is beyond its line."""
    x, y, cos, sin = foe.line
    found: Bools = (states[:, 0] - x) * cos + (states[:, 1] - y) * sin > 0.0
    return found


def _held(traffic: Traffic, foe: Foe, inside: Bools, steps: int) -> Bools:
    """At which steps [T] a light holds who comes along a link; not one who passes it anyway."""
    if foe.signal is None:
        return np.zeros(steps, np.bool_)
    shows = traffic.lights.shows(foe.signal, steps)[:steps]
    entry = int(np.argmax(inside)) if np.any(inside) else steps - 1
    if shows[entry] == SHUT and np.any(inside):
        return np.zeros(steps, np.bool_)
    held: Bools = shows >= SHUT
    return held
