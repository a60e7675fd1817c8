"""Polylines: places on them, their lengths and headings."""

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import pairwise

from sim.scene import Point

ON_LANE = 2.0  # [m] from the middle of a lane up to which a vehicle is on it
STEEP = math.radians(15.0)  # least angle at which roads cross


def project(line: tuple[Point, ...], position: Point) -> tuple[float, float, float]:
    """Nearest place on a polyline.

    Returns:
        Offset along the line [m], distance to its left [m], heading of the line there [rad].
        The offset is negative or beyond the length where the end segments' extensions are
        nearest.
    """
    best = (math.inf, 0.0, 0.0, 0.0)
    travelled = 0.0
    last = len(line) - 2
    for k in range(last + 1):
        (ax, ay), (bx, by) = line[k], line[k + 1]
        dx, dy = bx - ax, by - ay
        length = math.hypot(dx, dy)
        if length == 0.0:
            continue
        along = ((position[0] - ax) * dx + (position[1] - ay) * dy) / length
        low = -math.inf if k == 0 else 0.0
        high = math.inf if k == last else length
        clamped = min(max(along, low), high)
        px, py = ax + dx * clamped / length, ay + dy * clamped / length
        distance = math.hypot(position[0] - px, position[1] - py)
        if distance < best[0]:
            side = dx * (position[1] - ay) - dy * (position[0] - ax)
            lateral = math.copysign(distance, side)
            best = (distance, travelled + clamped, lateral, math.atan2(dy, dx))
        travelled += length
    return best[1], best[2], best[3]


def angle_between(a: float, b: float) -> float:
    """Return the angle [rad] from b to a, in (-pi, pi]."""
    difference = math.fmod(a - b, 2.0 * math.pi)
    if difference > math.pi:
        difference -= 2.0 * math.pi
    elif difference <= -math.pi:
        difference += 2.0 * math.pi
    return difference


def cumulative(line: tuple[Point, ...]) -> list[float]:
    """Arc length [m] at each point of a polyline, from 0."""
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
    """Yield where two lines cross steeply between their ends.

    Roads that cross so without a junction are on different levels: a bridge and a road below.

    Yields:
        The place [m], how far [m] it is along each, the heading [rad] of the other one there, and
        the angle [rad] between them.
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
