"""Distances between vehicles as oriented boxes, and times until they touch."""

import math
from dataclasses import replace

from sim.boxes import corners, overlap
from sim.scene import Point, VehicleState

HORIZON = 10.0  # [s] up to which a collision course is followed
STEP = 0.1  # [s]


def distance(a: VehicleState, b: VehicleState) -> float:
    """Return the distance [m] between two bodies; 0 if they overlap."""
    if overlap(a, b):
        return 0.0
    one, other = corners(a), corners(b)
    return min(
        min(_to_edge(p, other[k - 1], other[k]) for p in one for k in range(4)),
        min(_to_edge(p, one[k - 1], one[k]) for p in other for k in range(4)),
    )


def at_least(a: VehicleState, b: VehicleState) -> float:
    """Return a lower bound [m] of the distance between two bodies, which is quick to compute."""
    reach = math.hypot(a.length, a.width) + math.hypot(b.length, b.width)
    return math.dist(a.position, b.position) - reach


def time_to_touch(a: VehicleState, b: VehicleState) -> float | None:
    """Return the time [s] until two bodies touch if both go straight on; None if they do not."""
    relative = math.hypot(
        a.speed * math.cos(a.heading) - b.speed * math.cos(b.heading),
        a.speed * math.sin(a.heading) - b.speed * math.sin(b.heading),
    )
    if relative < 1e-3 or at_least(a, b) > relative * HORIZON:
        return None
    for k in range(round(HORIZON / STEP) + 1):
        if overlap(_moved(a, k * STEP), _moved(b, k * STEP)):
            return k * STEP
    return None


def _moved(state: VehicleState, time: float) -> VehicleState:
    x, y = state.position
    way = state.speed * time
    there = (x + way * math.cos(state.heading), y + way * math.sin(state.heading))
    return replace(state, position=there)


def _to_edge(point: Point, a: Point, b: Point) -> float:
    dx, dy = b[0] - a[0], b[1] - a[1]
    length = dx * dx + dy * dy
    along = ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / length if length > 0.0 else 0.0
    share = min(max(along, 0.0), 1.0)
    return math.hypot(point[0] - a[0] - share * dx, point[1] - a[1] - share * dy)
