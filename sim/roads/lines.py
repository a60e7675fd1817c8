"""Polylines: places on them, their lengths and headings."""

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

from sim.scene import Point

ON_LANE = 2.0  # [m] greatest distance from the middle of a lane for a vehicle to be on it
CLEARLY = 1.0 + 1e-9  # factor on a squared distance that exceeds rounding errors
STEEP = math.radians(15.0)  # least angle between lines that cross


class Segment(NamedTuple):
    """One straight part of a polyline."""

    start: Point  # [m]
    side: Point  # [m] vector from its start to its end
    length: float  # [m]
    low: float  # [m] along it where it begins to count; the first segment extends backwards
    high: float  # [m] along it where it ceases to count; the last segment extends forwards
    before: float  # [m] length of the line before it
    heading: float  # [rad]


@lru_cache(maxsize=4096)
def segments(line: tuple[Point, ...]) -> tuple[Segment, ...]:
    """Return the segments of a polyline whose length is not zero."""
    found = []
    travelled = 0.0
    last = len(line) - 2
    for k in range(last + 1):
        (ax, ay), (bx, by) = line[k], line[k + 1]
        dx, dy = bx - ax, by - ay
        length = math.hypot(dx, dy)
        if length == 0.0:
            continue
        low = -math.inf if k == 0 else 0.0
        high = math.inf if k == last else length
        found.append(Segment((ax, ay), (dx, dy), length, low, high, travelled, math.atan2(dy, dx)))
        travelled += length
    return tuple(found)


def project(line: tuple[Point, ...], position: Point) -> tuple[float, float, float]:
    """Find the nearest place on a polyline.

    Returns:
        Offset along the line [m], distance to its left [m], heading of the line there [rad].
        The offset is negative or greater than the length if the extension of an end segment is
        nearest.
    """
    nearest, found, at, limit = math.inf, None, 0.0, math.inf
    x, y = position
    for part in segments(line):
        (ax, ay), (dx, dy), length, low, high, _, _ = part
        along = ((x - ax) * dx + (y - ay) * dy) / length
        if along < low:
            along = low
        if along > high:
            along = high
        off_x, off_y = x - (ax + dx * along / length), y - (ay + dy * along / length)
        if off_x * off_x + off_y * off_y > limit:  # clearly farther: spares the exact distance
            continue
        distance = math.hypot(off_x, off_y)
        if distance < nearest:
            nearest, found, at = distance, part, along
            limit = distance * distance * CLEARLY
    if found is None:
        return 0.0, 0.0, 0.0
    (ax, ay), (dx, dy) = found.start, found.side
    side = dx * (y - ay) - dy * (x - ax)
    return found.before + at, math.copysign(nearest, side), found.heading


def angle_between(a: float, b: float) -> float:
    """Return the angle [rad] from b to a, in (-pi, pi]."""
    difference = math.fmod(a - b, 2.0 * math.pi)
    if difference > math.pi:
        difference -= 2.0 * math.pi
    elif difference <= -math.pi:
        difference += 2.0 * math.pi
    return difference


def cumulative(line: tuple[Point, ...]) -> list[float]:
    """Return the arc length [m] at each point of a polyline, from 0."""
    total = [0.0]
    for (ax, ay), (bx, by) in pairwise(line):
        total.append(total[-1] + math.hypot(bx - ax, by - ay))
    return total


def point_at(line: tuple[Point, ...], offset: float) -> tuple[Point, float]:
    """Return the point [m] and heading [rad] at an offset [m] along a polyline (clamped to it)."""
    arc = cumulative(line)
    k = min(max(bisect_right(arc, offset) - 1, 0), len(line) - 2)
    (ax, ay), (bx, by) = line[k], line[k + 1]
    span = arc[k + 1] - arc[k]
    share = min(max((offset - arc[k]) / span, 0.0), 1.0) if span > 0.0 else 0.0
    return (ax + (bx - ax) * share, ay + (by - ay) * share), math.atan2(by - ay, bx - ax)


def crossings(
    own: Sequence[Point], other: Sequence[Point]
) -> Iterator[tuple[Point, float, float, float, float]]:
    """Yield the places where two lines cross at a steep angle.

    Roads that cross in this way without a junction are on different levels: a bridge and a road
    below.

    Yields:
        The place [m], its offsets [m] along the own and the other line, the heading [rad] of the
        other line there, and the angle [rad] between the two.
    """
    at = 0.0
    for a, b in pairwise(own):
        theirs, long = 0.0, math.dist(a, b)
        for c, d in pairwise(other):
            far = math.dist(c, d)
            dx, dy, ex, ey = b[0] - a[0], b[1] - a[1], d[0] - c[0], d[1] - c[1]
            sine = dx * ey - dy * ex
            if abs(sine) > math.sin(STEEP) * long * far > 0.0:
                s = ((c[0] - a[0]) * ey - (c[1] - a[1]) * ex) / sine
                t = ((c[0] - a[0]) * dy - (c[1] - a[1]) * dx) / sine
                if 0.0 < s <= 1.0 and 0.0 < t <= 1.0:
                    turn = math.acos(max(-1.0, min(1.0, (dx * ex + dy * ey) / (long * far))))
                    place = (a[0] + s * dx, a[1] + s * dy)
                    yield place, at + s * long, theirs + t * far, math.atan2(ey, ex), turn
            theirs += far
        at += long
