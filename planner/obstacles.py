"""Other vehicles as moving obstacles, and the stretch of a path that each occupies in time."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from planner.trace import HoldUp
from planner.trajectory import Array, Path, relative

SIDE_MARGIN = 0.3  # [m] kept free beside the body
BEFORE, AFTER = 4, 5  # steps by which a gap must precede and outlast a vehicle with priority
FOREVER = 1 << 30  # a step that never comes
ALIGNED = 0.9  # cosine of the angle to the path from which a vehicle drives along it
CUT_IN_MEMORY = 15  # steps after entering the path during which a leader counts as cutting in


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
    x = obstacle.position[window, 0] - 0.5 * obstacle.length * np.cos(obstacle.heading[window])
    y = obstacle.position[window, 1] - 0.5 * obstacle.length * np.sin(obstacle.heading[window])
    # Nearest path point: |p - q|^2 without the term that does not depend on the point.
    squared = np.einsum("ij,ij->i", path.points, path.points)
    nearest = np.argmin(squared[None, :] - 2.0 * (np.column_stack((x, y)) @ path.points.T), axis=1)
    centre, aside = relative(path, nearest, x, y)
    turned = obstacle.heading[window] - path.heading[nearest]
    cos, sin = np.cos(turned), np.sin(turned)
    corridor = 0.5 * size[1] + SIDE_MARGIN
    half = 0.5 * (obstacle.length * np.abs(sin) + obstacle.width * np.abs(cos))
    beyond = (nearest == len(path.arc) - 1) & (centre > obstacle.length)
    inside = np.flatnonzero((np.abs(aside) < half + corridor) & ~beyond)
    if len(inside):
        ends = _extent(obstacle, aside[inside], cos[inside], sin[inside], corridor)
        arc = path.arc[nearest[inside]] + centre[inside]
        low[start + inside], high[start + inside] = arc + ends[0], arc + ends[1]
    along[window], aligned[window] = obstacle.speed[window] * cos, cos
    return Occupancy(obstacle, low, high, along, aligned)


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
