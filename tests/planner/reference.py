"""The kernels once more in plain Python and numpy: slow, readable, the measure of the fast ones.

See planner/kernels for the compiled ones, and test_kernels.py for the comparison.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from planner.kernels.along import LONG
from planner.kernels.collision import ALIKE, BERTH, SAFE_CUT_IN
from planner.kernels.corridor import APART, BENT, SHALLOW
from planner.kernels.limits import (
    ACCELERATION,
    ALIGNED,
    COMFORT,
    CUT_IN_MEMORY,
    EMERGENCY,
    FIRM,
    FOLLOWING,
    FORESIGHT,
    GAP_HORIZON,
    HINDERED,
    INTRUSION,
    JAM,
    JERK_DOWN,
    JERK_UP,
    MIN_GAP,
    REACTION,
    READY,
    RELAXATION,
    STANDING_TIME,
)
from planner.kernels.limits import BEFORE as SHORT_OF
from planner.kernels.projection import AFTER, BEFORE, FOREVER, SIDE_MARGIN
from planner.manoeuvres.plans import ActionPlan, GiveWay, KeepClear, LetCross
from planner.motion.forward import DT, Motion, advance
from planner.motion.obstacles import Obstacle
from planner.record.trace import HoldUp
from planner.roads.trajectory import Array, Path, relative


class Occupancy:
    """The stretch of one path that one obstacle occupies at each step."""

    def __init__(
        self, obstacle: Obstacle, low: Array, high: Array, along: Array, aligned: Array
    ) -> None:
        self.vehicle = obstacle.vehicle
        self._links = obstacle.links
        self._speed: list[float] = obstacle.speed.tolist()
        self._along: list[float] = along.tolist()
        self._aligned: list[float] = aligned.tolist()  # cosine of the angle to the path
        self._low: list[float] = low.tolist()  # NaN where the path is free of it
        self._high: list[float] = high.tolist()
        self._entered = _entry(low)
        wide_low, wide_high = _widen(low, high)
        self._wide_low: list[float] = wide_low.tolist()
        self._wide_high: list[float] = wide_high.tolist()
        there = np.flatnonzero(~np.isnan(wide_low))
        total = len(low)
        self.last = int(there[-1]) if len(there) else -1  # step at which it is on the path
        if self.last == total - 1:
            self.last = FOREVER
        self.top = float(np.nanmax(wide_high)) if len(there) else -np.inf  # [m] that it reaches

    def _at(self, step: int) -> int:
        return min(step, len(self._low) - 1)

    def gap(self, arc: float, step: int, length: float) -> float | None:
        """Distance [m] from a front at `arc` to the obstacle, if it is ahead on the path."""
        k = self._at(step)
        low, high = self._low[k], self._high[k]
        if low != low or 0.5 * (low + high) < arc - 0.5 * length:
            return None
        return low - arc

    def follows(self, centre: float, step: int) -> bool:
        """Whether it is on the path behind a vehicle whose centre is at an arc [m]."""
        k = self._at(step)
        return 0.5 * (self._low[k] + self._high[k]) < centre

    def speed(self, step: int) -> float:
        """Its speed [m/s]."""
        return self._speed[self._at(step)]

    def speed_along(self, step: int) -> float:
        """Its speed [m/s] along the path, never negative."""
        return max(self._along[self._at(step)], 0.0)

    def manner(self, step: int) -> HoldUp:
        """How it holds up who comes behind."""
        k = self._at(step)
        entered = self._entered[k]
        if entered > 0 and k - entered <= CUT_IN_MEMORY and self._speed[k] > 0.5:
            return "cut-in"
        return "blocked" if self._speed[k] <= 0.5 else "leader"

    def goes_first(self, links: frozenset[tuple[str, int]]) -> bool:
        """Whether it drives along one of the links."""
        return not self._links.isdisjoint(links)

    def leads(self, arc: float, step: int) -> bool:
        """Whether it drives along the path already, ahead of a front at an arc [m]."""
        k = self._at(step)
        return self._low[k] > arc and self._aligned[k] > ALIGNED

    def newcomer(self, step: int) -> tuple[float, float, float] | None:
        """Arcs [m] and speed [m/s] of one that moves in, had it come along the path."""
        last = len(self._low) - 1
        if not math.isnan(self._low[min(step, last)]):
            return None
        for k in range(min(step + 1, last), min(step + FORESIGHT, last) + 1):
            if not math.isnan(self._low[k]) and self._aligned[k] > ALIGNED:
                pace = max(self._along[k], 0.0)
                back = pace * (k - step) * DT
                return self._low[k] - back, self._high[k] - back, pace
        return None

    @property
    def total(self) -> int:
        """The number of steps that are known."""
        return len(self._low)

    def touches(self, low: float, high: float, step: int) -> bool:
        """Whether it takes a part of a stretch at a step."""
        return self._low[step] < high and self._high[step] > low

    def lowest(self, step: int) -> float:
        """The lowest arc [m] that it takes from a step on; infinite without any."""
        return min(
            (low for low in self._low[self._at(step) :] if not math.isnan(low)), default=math.inf
        )

    def between(self, begin: float, end: float, step: int) -> bool:
        """Whether it drives along the path, its rear between two arcs [m]."""
        k = self._at(step)
        return begin <= self._low[k] < end and self._aligned[k] > ALIGNED

    def meets(self, low: float, high: float, step: int) -> float | None:
        """Where [m] its own stretch begins, if within the safety time it shares one with ours."""
        k = self._at(step)
        begin = self._wide_low[k]
        return begin if begin < high and self._wide_high[k] > low else None


def occupancy(
    path: Path, obstacle: Obstacle, size: tuple[float, float], first: int, last: int
) -> Occupancy:
    """Project an obstacle onto a path.

    Args:
        path: the line that is driven.
        obstacle: the other vehicle.
        size: length and width [m] of the vehicle that drives along the path.
        first: step from which the occupancy is needed.
        last: step up to which it is needed.
    """
    total = len(obstacle.speed)
    low, high = np.full(total, np.nan), np.full(total, np.nan)
    along, aligned = np.zeros(total), np.zeros(total)
    start, stop = min(max(first - 1, 0), total - 1), min(last + AFTER, total)
    window = slice(start, stop)
    count = max(math.ceil(obstacle.length / LONG), 1)
    for k in range(count - 1, -1, -1):  # the foremost part last
        part = replace(
            obstacle, length=obstacle.length / count, position=_moved(obstacle, k, count)
        )
        part_low, part_high, cos = _part(path, part, size, window)
        low[window], high[window] = np.fmin(low[window], part_low), np.fmax(high[window], part_high)
        there = ~np.isnan(part_low)
        aligned[window] = np.where(there, cos, aligned[window])
    along = obstacle.speed * aligned
    return Occupancy(obstacle, low, high, along, aligned)


def _moved(obstacle: Obstacle, k: int, count: int) -> Array:
    """The front of a body's part number k of `count` [m] [T, 2]."""
    back = k * obstacle.length / count
    way = np.column_stack((np.cos(obstacle.heading), np.sin(obstacle.heading)))
    return obstacle.position - back * way


def _part(
    path: Path, obstacle: Obstacle, size: tuple[float, float], window: slice
) -> tuple[Array, Array, Array]:
    """From where to where [m] a short body lies on a path, and the cosine of its angle to it."""
    x = obstacle.position[window, 0] - 0.5 * obstacle.length * np.cos(obstacle.heading[window])
    y = obstacle.position[window, 1] - 0.5 * obstacle.length * np.sin(obstacle.heading[window])
    low, high = np.full(len(x), np.nan), np.full(len(x), np.nan)
    # Nearest path point: |p - q|^2 without the term that does not depend on the point.
    squared = np.einsum("ij,ij->i", path.points, path.points)
    nearest = np.argmin(squared[None, :] - 2.0 * (np.column_stack((x, y)) @ path.points.T), axis=1)
    centre, aside = relative(path, nearest, x, y)
    turned = obstacle.heading[window] - path.heading[nearest]
    cos, sin = np.cos(turned), np.sin(turned)
    corridor = 0.5 * size[1] + SIDE_MARGIN
    half = 0.5 * (obstacle.length * np.abs(sin) + obstacle.width * np.abs(cos))
    beyond = (nearest == len(path.arc) - 1) & (centre > obstacle.length)
    into = half + corridor - np.abs(aside)
    on = [
        into[t] > 0.0
        and not beyond[t]
        and (into[t] >= SHALLOW or not _beside(path, obstacle, window.start + t, corridor))
        for t in range(len(x))
    ]
    inside = np.flatnonzero(on)
    if len(inside):
        ends = _extent(obstacle, aside[inside], cos[inside], sin[inside], corridor)
        arc = path.arc[nearest[inside]] + centre[inside]
        low[inside], high[inside] = arc + ends[0], arc + ends[1]
    return low, high, cos


def _beside(path: Path, obstacle: Obstacle, step: int, corridor: float) -> bool:
    """Whether a body is outside the corridor of a bent path, measured along its sides."""
    way = np.array([np.cos(obstacle.heading[step]), np.sin(obstacle.heading[step])])
    front = obstacle.position[step]
    k = _nearest(path, front - 0.5 * obstacle.length * way)
    ends = np.searchsorted(path.arc, path.arc[k] + obstacle.length * np.array([-1.0, 1.0]))
    turned = path.heading[np.minimum(ends, len(path.arc) - 1)] - path.heading[k]
    if np.abs(turned).max() < BENT:
        return False
    back = np.linspace(0.0, obstacle.length, math.ceil(obstacle.length / APART) + 1)
    for left in (-0.5, 0.5):
        side = front + left * obstacle.width * np.array([-way[1], way[0]])
        for place in side - back[:, None] * way:
            near = _nearest(path, place)
            if abs(relative(path, near, *place)[1]) < corridor:
                return False
    return True


def _nearest(path: Path, place: Array) -> int:
    return int(np.argmin(((path.points - place) ** 2).sum(axis=1)))


def _extent(
    obstacle: Obstacle, aside: Array, cos: Array, sin: Array, corridor: float
) -> tuple[Array, Array]:
    """From where to where [m] along the path, from its centre, a body lies in a corridor.

    Args:
        obstacle: the body.
        aside: [m] [N] of its centre to the left of the path.
        cos, sin: [N] of its heading against that of the path.
        corridor: [m] to either side of the path; every body reaches into it.
    """
    ahead = 0.5 * obstacle.length * np.array([1.0, 1.0, -1.0, -1.0])[:, None]
    left = 0.5 * obstacle.width * np.array([1.0, -1.0, -1.0, 1.0])[:, None]
    x, y = ahead * cos - left * sin, aside + ahead * sin + left * cos
    next_x, next_y = np.roll(x, -1, axis=0), np.roll(y, -1, axis=0)
    # Each edge of the body, cut off where it leaves the corridor.
    level = np.abs(next_y - y) < 1e-9
    slope = (next_x - x) / np.where(level, 1.0, next_y - y)
    begin = x + (np.clip(y, -corridor, corridor) - y) * slope
    end = next_x + (np.clip(next_y, -corridor, corridor) - next_y) * slope
    outside = (np.minimum(y, next_y) > corridor) | (np.maximum(y, next_y) < -corridor)
    low = np.where(outside, np.inf, np.minimum(begin, end)).min(axis=0)
    high = np.where(outside, -np.inf, np.maximum(begin, end)).max(axis=0)
    return low, high


def _entry(low: Array) -> list[int]:
    """For each step, the step at which the obstacle last came onto the path."""
    entered, result = 0, []
    for k, free in enumerate(np.isnan(low).tolist()):
        if free:
            entered = k + 1
        result.append(entered)
    return result


def _widen(low: Array, high: Array) -> tuple[Array, Array]:
    """The union of the occupied stretches within the safety time around each step."""
    wide_low, wide_high = low.copy(), high.copy()
    for shift in _shifts():
        wide_low = np.fmin(wide_low, _shifted(low, shift))
        wide_high = np.fmax(wide_high, _shifted(high, shift))
    return wide_low, wide_high


def _shifts() -> Iterable[int]:
    return (shift for shift in range(-BEFORE, AFTER + 1) if shift)


def _shifted(values: Array, shift: int) -> Array:
    """values[k + shift], NaN beyond either end."""
    result = np.full(len(values), np.nan)
    if shift > 0:
        result[:-shift] = values[shift:]
    else:
        result[-shift:] = values[:shift]
    return result


@dataclass(frozen=True, slots=True)
class Hindrance:
    """What kept the vehicle below its free speed in one step."""

    step: int  # of DT, in the common time base
    vehicle: int
    how: HoldUp
    speed: float  # [m/s] of the hindering vehicle


@dataclass(frozen=True, slots=True, eq=False)
class Drive:
    """What came of driving an action plan."""

    first: int  # step of the first sample
    motions: tuple[Motion, ...]  # [N >= 1] at steps first, first + 1, ...
    finished: bool  # the action's end was reached (else the horizon came first)
    goal_time: float | None  # [s] since the time base, where the goal was passed
    hindrances: tuple[Hindrance, ...]


class Lane:
    """A path prepared for driving: the speed from which every bend ahead can be braked for."""

    def __init__(self, path: Path) -> None:
        caps = path.cap.tolist()
        arcs = path.arc.tolist()
        for k in range(len(caps) - 2, -1, -1):
            reachable = math.sqrt(caps[k + 1] ** 2 + 2.0 * COMFORT * (arcs[k + 1] - arcs[k]))
            caps[k] = min(caps[k], reachable)
        even = np.arange(0.0, arcs[-1] + 1.0)
        self.speeds: list[float] = np.interp(even, arcs, caps).tolist()

    def speed(self, arc: float) -> float:
        """The highest speed [m/s] at an arc [m]."""
        k = int(arc)
        return self.speeds[k] if k < len(self.speeds) else self.speeds[-1]


def drive(
    plan: ActionPlan,
    start: Motion,
    first: int,
    obstacles: Sequence[Obstacle],
    size: tuple[float, float],
    horizon: int,
) -> Drive:
    """Drive an action plan until it ends.

    Args:
        plan: what to drive; its path is the vehicle's own.
        start: where on the path the vehicle is, and how fast.
        first: step at which it is there.
        obstacles: the other vehicles, in the common time base.
        size: length and width [m] of the vehicle.
        horizon: the last step.
    """
    lane = Lane(plan.path)
    everybody = tuple(
        occupancy(plan.path, obstacle, size, first, horizon + GAP_HORIZON) for obstacle in obstacles
    )
    crossing = tuple(o for o in everybody if not o.follows(start.arc - size[0] / 2.0, first))
    others = crossing
    motion, motions, hindrances = start, [start], []
    standing, goal_time, finished = 0, None, False
    for step in range(first, horizon):
        others = tuple(o for o in others if not o.follows(motion.arc - size[0] / 2.0, step))
        acceleration, hindrance = accelerate(
            plan, lane, motion, step, others, everybody, size[0], crossing=crossing
        )
        if hindrance is not None:
            hindrances.append(hindrance)
        before, motion = motion, advance(motion, acceleration, DT)
        motions.append(motion)
        if plan.goal is not None and motion.arc >= plan.goal:
            share = (plan.goal - before.arc) / max(motion.arc - before.arc, 1e-9)
            goal_time, finished = (step + min(max(share, 0.0), 1.0)) * DT, True
            break
        standing = standing + 1 if motion.speed < 0.1 else 0
        if standing * DT >= STANDING_TIME if plan.stops else motion.arc >= plan.end:
            finished = True
            break
    return Drive(first, tuple(motions), finished, goal_time, tuple(hindrances))


def accelerate(
    plan: ActionPlan,
    lane: Lane,
    motion: Motion,
    step: int,
    others: Sequence[Occupancy],
    everybody: Sequence[Occupancy],
    length: float,
    dt: float = DT,
    crossing: Sequence[Occupancy] | None = None,
) -> tuple[float, Hindrance | None]:
    """What to do in the coming step, and who is in the way.

    Args:
        plan: what is being driven.
        lane: its path, prepared.
        motion: where on the path the vehicle is.
        step: now, in the common time base.
        others: the vehicles to keep behind of.
        length: [m] of the vehicle.
        dt: [s] length of the coming step.
        crossing: motions to give way to, where they are not those of `others`.

    Returns:
        Acceleration [m/s2], and the hindrance where there is one.
    """
    first = others if crossing is None else crossing
    free = _free_speed(plan, lane, motion, step, first)
    found = _behind(others, motion, step, length, Wish(free, plan.halting or FOLLOWING, None))
    if plan.stops:
        free = 0.0
        found = Wish(0.0, EMERGENCY if found.hardest == EMERGENCY else plan.halting, None)
    found = _behind_newcomers(everybody, motion, step, length, found)
    found = _out_of_junctions(plan, others, motion, step, length, found)
    found = _at_lines(plan, lane, first, motion, step, length, found)
    acceleration = _towards(motion.speed, motion.acceleration, found.speed, found.hardest, dt)
    if found.hindrance is None or found.speed > free - HINDERED:
        return acceleration, None
    other, how = found.hindrance
    return acceleration, Hindrance(step, other.vehicle, how, other.speed(step))


class Wish(NamedTuple):
    """The speed that is wanted so far, and who is the reason."""

    speed: float  # [m/s]
    hardest: float  # [m/s2] braking that is allowed for it
    hindrance: tuple[Occupancy, str] | None

    def lowered(self, speed: float, other: Occupancy, how: str) -> "Wish":
        """The same for a lower speed, of which another vehicle is the reason."""
        return Wish(speed, self.hardest, (other, how)) if speed < self.speed else self


def _free_speed(
    plan: ActionPlan, lane: Lane, motion: Motion, step: int, first: Sequence[Occupancy]
) -> float:
    """The speed with nobody in the way: slower where somebody stands who goes first."""
    free = lane.speed(motion.arc + motion.speed * RELAXATION)
    for line in plan.give_ways:
        gap = line.stop - motion.arc
        stand = (other.speed(step) < JAM for other in first if other.goes_first(line.yields_to))
        if gap > 0.0 and any(stand):
            free = min(free, math.sqrt(READY**2 + 2.0 * COMFORT * gap))
    return free


def _behind(
    others: Sequence[Occupancy], motion: Motion, step: int, length: float, found: Wish
) -> Wish:
    """Keep behind those ahead on the path."""
    for other in others:
        gap = other.gap(motion.arc, step, length)
        if gap is None:
            continue
        pace = other.speed_along(step)
        beside = gap <= 0.0 and pace < JAM
        speed = safe_speed(gap - MIN_GAP, 0.0 if beside else pace, FOLLOWING)
        if speed < found.speed:
            late = gap < MIN_GAP or speed < motion.speed - 3.0
            hardest = EMERGENCY if late else FOLLOWING
            found = Wish(speed, hardest, (other, other.manner(step)))
    return found


def _behind_newcomers(
    everybody: Sequence[Occupancy], motion: Motion, step: int, length: float, found: Wish
) -> Wish:
    """Keep behind those who are about to come onto the path ahead."""
    for other in everybody:
        newcomer = other.newcomer(step)
        if newcomer is not None:
            low, high, pace = newcomer
            speed = safe_speed(low - motion.arc - MIN_GAP, pace, FOLLOWING)
            if 0.5 * (low + high) > motion.arc - 0.5 * length:
                found = found.lowered(speed, other, "cut-in")
    return found


def _stopping(motion: Motion) -> float:
    """The distance [m] in which a comfortable stop is still to be planned."""
    return motion.speed**2 / (2.0 * COMFORT) + motion.speed * REACTION + 3.0


def _out_of_junctions(
    plan: ActionPlan,
    others: Sequence[Occupancy],
    motion: Motion,
    step: int,
    length: float,
    found: Wish,
) -> Wish:
    """Stay out of junctions beyond which there is no room."""
    for room in plan.keep_clears:
        gap = room.stop - motion.arc
        jam = _jam(others, step, room, length)
        if 0.0 <= gap <= _stopping(motion) and jam is not None:
            found = found.lowered(safe_speed(gap, 0.0, COMFORT), jam, "blocked")
    return found


def _at_lines(
    plan: ActionPlan,
    lane: Lane,
    first: Sequence[Occupancy],
    motion: Motion,
    step: int,
    length: float,
    found: Wish,
) -> Wish:
    """Wait at lines for those who go first."""
    for line in plan.lines:
        gap = line.stop - motion.arc
        if gap > _stopping(motion) or motion.arc >= line.clear:
            continue
        blocker = _blocker(lane, motion, step, line, first, length)
        speed = safe_speed(gap, 0.0, COMFORT)
        if blocker is not None and speed < found.speed:
            at_line = motion.speed**2 < 2.0 * FIRM * gap
            room = gap if at_line else blocker.lowest(step) - SHORT_OF - motion.arc
            hardest, needed = found.hardest, at_line or _hits(lane, motion, step, blocker, length)
            if needed and 0.0 < 2.0 * FOLLOWING * room < motion.speed**2:
                hardest = min(motion.speed**2 / (2.0 * room), EMERGENCY)
            found = Wish(speed, hardest, (blocker, "right-of-way"))
    return found


def _hits(lane: Lane, motion: Motion, step: int, other: Occupancy, length: float) -> bool:
    """Whether driving on freely ends in a collision with somebody on the path."""
    arc, speed, acceleration = motion.arc, motion.speed, motion.acceleration
    for ahead in range(step + 1, min(step + GAP_HORIZON, other.total)):
        wanted = lane.speed(arc + speed * RELAXATION)
        acceleration = _towards(speed, acceleration, wanted, FOLLOWING, DT)
        before, speed = speed, max(speed + acceleration * DT, 0.0)
        arc += 0.5 * (before + speed) * DT
        if other.touches(arc - length, arc, ahead):
            return True
    return False


def _jam(
    others: Sequence[Occupancy], step: int, room: KeepClear, length: float
) -> Occupancy | None:
    """Who takes the room beyond a junction, at a crawl."""
    until = room.out + length + MIN_GAP
    ahead = [other for other in others if other.between(room.stop, until, step)]
    nearest = min(ahead, key=lambda other: other.gap(room.stop, step, length) or 0.0, default=None)
    return nearest if nearest is not None and nearest.speed(step) < JAM else None


def _towards(speed: float, acceleration: float, wanted: float, hardest: float, dt: float) -> float:
    """The acceleration [m/s2] that leads to a wanted speed [m/s], within all limits."""
    wished = min(max((wanted - speed) / RELAXATION, -hardest), ACCELERATION)
    if wished < acceleration:
        return max(wished, acceleration - JERK_DOWN * dt)
    return min(wished, max(acceleration + JERK_UP * dt, min(0.0, acceleration + JERK_DOWN * dt)))


def safe_speed(gap: float, leader: float, braking: float) -> float:
    """Krauss' safe speed [m/s] at a gap [m] behind a leader of a speed [m/s]."""
    reach = braking * REACTION
    return max(0.0, -reach + math.sqrt(reach**2 + leader**2 + 2.0 * braking * max(gap, 0.0)))


def _blocker(
    lane: Lane,
    motion: Motion,
    step: int,
    line: GiveWay | LetCross,
    others: Sequence[Occupancy],
    length: float,
) -> Occupancy | None:
    """Who must be waited for: going on freely would get in the way of its right to go first.

    Beyond the line, that is asked only of those before whom one can still stop.
    """
    late: list[Occupancy] = []
    first = [
        other
        for other in others
        if other.goes_first(line.yields_to)
        and other.last >= step
        and not other.leads(motion.arc, step)
    ]
    if not first:
        return None
    arc, speed, acceleration = motion.arc, motion.speed, motion.acceleration
    passed = max(other.top for other in first) + length + 1.0
    last = max(other.last for other in first)
    for ahead in range(step + 1, min(step + GAP_HORIZON, last + 1)):
        wanted = lane.speed(arc + speed * RELAXATION)
        acceleration = _towards(speed, acceleration, wanted, FOLLOWING, DT)
        before, speed = speed, max(speed + acceleration * DT, 0.0)
        arc += 0.5 * (before + speed) * DT
        if arc > passed:
            return None
        for other in [one for one in first if one not in late]:
            begin = other.meets(arc - length - 1.0, arc + 1.0, ahead)
            if begin is not None:
                stopping = motion.speed**2 / (2.0 * FOLLOWING)
                if not (motion.arc > line.stop and begin - motion.arc < stopping - INTRUSION):
                    return other
                late.append(other)
    return None


def first_overlap(
    position: Array,
    heading: Array,
    size: tuple[float, float],
    other_position: Array,
    other_heading: Array,
    other_size: tuple[float, float],
) -> int | None:
    """Index of the first sample in which two boxes overlap, or None.

    Args:
        position, other_position: [m] [T, 2] centres of the front bumpers.
        heading, other_heading: [rad] [T]
        size, other_size: length and width [m].
    """
    ax, ay = np.cos(heading), np.sin(heading)
    bx, by = np.cos(other_heading), np.sin(other_heading)
    dx = (other_position[:, 0] - 0.5 * other_size[0] * bx) - (position[:, 0] - 0.5 * size[0] * ax)
    dy = (other_position[:, 1] - 0.5 * other_size[0] * by) - (position[:, 1] - 0.5 * size[0] * ay)
    cos, sin = np.abs(ax * bx + ay * by), np.abs(ax * by - ay * bx)
    length, width = 0.5 * size[0], 0.5 * size[1]
    other_length, other_width = 0.5 * other_size[0], 0.5 * other_size[1]
    overlaps = (
        (np.abs(dx * ax + dy * ay) < length + other_length * cos + other_width * sin)
        & (np.abs(dy * ax - dx * ay) < width + other_length * sin + other_width * cos)
        & (np.abs(dx * bx + dy * by) < other_length + length * cos + width * sin)
        & (np.abs(dy * bx - dx * by) < other_width + length * sin + width * cos)
    )
    hits = np.flatnonzero(overlaps)
    return int(hits[0]) if len(hits) else None


def first_hit(
    own: Array,
    size: tuple[float, float],
    first: int,
    obstacles: Sequence[Obstacle],
    careless: bool,
) -> tuple[int, int]:
    """The first collision: sample and index of the obstacle, or (-1, -1)."""
    hits = []
    for m, other in enumerate(obstacles):
        stop = min(first + len(own), len(other.speed))
        count = stop - first
        where, turned = other.position[first:stop], other.heading[first:stop]
        theirs = (other.length, other.width)
        body = (own[:count, :2], own[:count, 2], size)
        if careless:
            ahead = np.column_stack((np.cos(own[:count, 2]), np.sin(own[:count, 2])))
            longer = (size[0] + 2.0 * BERTH, size[1])
            free = (own[:count, :2] + BERTH * ahead, own[:count, 2], longer)
            if first_overlap(*free, where, turned, theirs) != 0:
                body = free
        sample = first_overlap(*body, where, turned, theirs)
        if sample is None and careless:
            sample = _cut_off(own, size[0], first, other)
        elif sample is not None and not careless:
            behind = _ahead(own[sample], where[sample]) < -1.0
            if behind and math.cos(turned[sample] - own[sample, 2]) > ALIKE:
                sample = None
        if sample is not None:
            hits.append((sample, m))
    return min(hits, default=(-1, -1))


def _ahead(own: Array, other: Array) -> float:
    """How far [m] another front is ahead of ours."""
    x, y = other[0] - own[0], other[1] - own[1]
    return float(x * math.cos(own[2]) + y * math.sin(own[2]))


def _cut_off(own: Array, length: float, first: int, other: Obstacle) -> int | None:
    """The last sample of a lane change that ends right before a faster follower."""
    step = first + len(own) - 1
    if step >= len(other.speed):
        return None
    x, y = other.position[step] - own[-1, :2]
    gap = -_ahead(own[-1], other.position[step]) - length
    aside = abs(y * math.cos(own[-1, 2]) - x * math.sin(own[-1, 2]))
    closing = float(other.speed[step]) - own[-1, 3]
    if aside < 1.5 and gap > -length and gap < closing * SAFE_CUT_IN:
        return len(own) - 1
    return None
