"""The stretches of a path that others occupy over time, and which of them go first."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from planner.kernels.course import Bools
from planner.kernels.limits import ALIGNED, OPEN, RIGHT_OF_WAY, SHUT
from planner.kernels.projection import project
from planner.kernels.reaction import Ints
from planner.kernels.stretches import Stretches, first_of, select
from planner.manoeuvres.plans import Foe, GiveWay, LetCross
from planner.motion.traffic import NOBODY, Met, Motions, Obstacle, Pool, Traffic
from planner.record.trace import HoldUp
from planner.roads.trajectory import Array, Path
from sim.scene import Signal

__all__ = [
    "HOW",
    "NOBODY",
    "Motions",
    "Obstacle",
    "Occupancy",
    "Pool",
    "Traffic",
    "meeting",
    "occupancy",
]

#: The ways in which a vehicle is held up, by the kernel's index.
HOW: tuple[HoldUp, ...] = ("leader", "right-of-way", "cut-in", "blocked", "cut-in")


@dataclass(frozen=True, slots=True, eq=False)
class Occupancy:
    """The stretches of one path that traffic occupies at each step."""

    traffic: Traffic
    which: Ints  # [M] indices of those in the traffic that count
    stretches: Stretches

    def vehicle(self, who: int) -> int:
        """Return the name of one of those that count."""
        return self.traffic.vehicles[int(self.which[who])]

    def behind(self, front: float, length: float) -> Bools:
        """Return which others the vehicle cannot run into by driving on, at step 0 [M].

        These are vehicles behind the middle of its own body, and people behind its front.

        Args:
            front: [m] arc of the vehicle's front.
            length: [m] length of the vehicle.
        """
        low, high = self.stretches.low[:, 0], self.stretches.high[:, 0]
        found: Bools = 0.5 * (low + high) < front - 0.5 * length
        found |= self.traffic.on_foot[self.which] & (high < front)
        return found

    def manner(self, who: Ints, step: Ints, how: Ints) -> Ints:
        """Return the kinds of hold-ups, as indices into HOW; people who cross have right of way.

        Args:
            who, step, how: [H] the other's index, the step, and the kind if it is a vehicle.
        """
        if not np.any(self.traffic.on_foot):
            return how
        t = np.minimum(step, self.stretches.cosine.shape[1] - 1)
        crosses = self.traffic.on_foot[self.which[who]] & (self.stretches.cosine[who, t] < ALIGNED)
        found: Ints = np.where(crosses, RIGHT_OF_WAY, how)
        return found

    def firsts(self, lines: Sequence[GiveWay | LetCross]) -> Bools:
        """Return which others go first at each line [L, M, T], at each step if there are lights."""
        links = [self.traffic.links[m] for m in self.which.tolist()]
        found = [[not own.isdisjoint(line.yields_to) for own in links] for line in lines]
        always = np.array(found, dtype=np.bool_).reshape(len(found), len(links), 1)
        if not any(line.foes for line in lines):
            return always
        steps = self.traffic.states.shape[1]
        changing = np.repeat(always, steps, axis=2)
        for k, line in enumerate(lines):
            if isinstance(line, GiveWay) and line.foes:
                changing[k] = _by_light(self.traffic, self.which, line, steps)
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
    every = np.arange(len(traffic.vehicles))
    rows, found = _projected(path, traffic, width, first, last, every)
    return Occupancy(traffic, every, select(found, rows, traffic.states, every))


def _projected(
    path: Path, traffic: Traffic, width: float, first: int, last: int, which: Ints
) -> tuple[Ints, Stretches]:
    """Project some motions, by their indices, onto a path; see `occupancy` and the kernel."""
    line, states = (path.points, path.arc, path.heading), traffic.beside(path)
    return project(*line, states, traffic.spaces, width, first, last, which)


def meeting(
    path: Path,
    met_at_lines: frozenset[tuple[str, int]],
    traffic: Traffic,
    width: float,
    first: int,
    last: int,
) -> Occupancy:
    """Project the motions that come onto a path; earlier projections are looked up.

    Args:
        path: the line that is driven.
        met_at_lines: links, as (junction, index); vehicles that use one of them always count.
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
    if fresh:
        _add(met, path, traffic, fresh, width, first, last)
    rows = [met.rows[tag] for tag in traffic.tags]
    there = [m for m, row in enumerate(rows) if row >= 0]
    if met_at_lines:
        links = enumerate(traffic.links)
        there = [m for m, own in links if rows[m] >= 0 or not met_at_lines.isdisjoint(own)]
    which, chosen = np.array(there, np.int64), [rows[m] for m in there]
    if chosen == list(range(met.count)):
        return Occupancy(traffic, which, first_of(met.stretches, met.count))
    found = select(met.stretches, np.array(chosen, np.int64), traffic.states, which)
    return Occupancy(traffic, which, found)


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
    which = np.array(fresh, np.int64)
    if path.passings:
        traffic, which = traffic.only(fresh), np.arange(len(fresh))
    rows, found = _projected(path, traffic, width, first, last, which)
    for m, row in zip(which.tolist(), rows.tolist(), strict=True):
        met.rows[traffic.tags[m]] = met.count + row if row >= 0 else -1
    met.add(found)


def _by_light(traffic: Traffic, which: Ints, line: GiveWay, steps: int) -> Bools:
    """Return which others go first at a line with a light [M, T], which may show them red.

    Vehicles inside the junction may leave it, whatever the light. Others go first if the junction's
    rules say so, their light lets them in, and our own light does not let us go first.
    """
    key = (line.link.junction, line.link.index, traffic.lights, steps)
    known = traffic.pool.firsts.setdefault(key, {})
    yields: Bools | None = None
    rows = []
    for m in which.tolist():
        tag = traffic.tags[m]
        if tag not in known:
            yields = _not_first(traffic, line, steps) if yields is None else yields
            known[tag] = _first_by_light(traffic, line, traffic.links[m], traffic.states[m], yields)
        rows.append(known[tag])
    return np.array(rows, np.bool_).reshape(len(rows), steps)


def _not_first(traffic: Traffic, line: GiveWay, steps: int) -> Bools:
    """Return the steps [T] at which our own light does not let us go first at a line."""
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
    """Return the steps at which another vehicle goes first at a line with a light [T]."""
    first: Bools = np.zeros(len(states), np.bool_)
    for foe in line.foes:
        if foe.key in links:
            inside = _beyond(states, foe)
            first |= inside
            if foe.first:
                first |= yields & ~inside & ~_held(traffic, foe, inside, len(states))
    return first


def _beyond(states: Array, foe: Foe) -> Bools:
    """Return the steps [T] of a motion [T, 4] along a link at which it is beyond the line."""
    x, y, cos, sin = foe.line
    found: Bools = (states[:, 0] - x) * cos + (states[:, 1] - y) * sin > 0.0
    return found


def _held(traffic: Traffic, foe: Foe, inside: Bools, steps: int) -> Bools:
    """Return the steps [T] at which a light holds a vehicle; none if it passes the light anyway."""
    if foe.signal is None:
        return np.zeros(steps, np.bool_)
    shows = traffic.lights.shows(foe.signal, steps)[:steps]
    entry = int(np.argmax(inside)) if np.any(inside) else steps - 1
    if shows[entry] == SHUT and np.any(inside):
        return np.zeros(steps, np.bool_)
    held: Bools = shows >= SHUT
    return held
