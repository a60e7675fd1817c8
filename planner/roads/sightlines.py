"""Lines of sight among vehicles."""

import math

from sim.scene import Point, VehicleState


def middle(state: VehicleState) -> Point:
    """Return the middle [m] of a vehicle."""
    x, y = state.position
    half = 0.5 * state.length
    return x - half * math.cos(state.heading), y - half * math.sin(state.heading)


def between(a: Point, b: Point, body: VehicleState) -> bool:
    """Check whether the line from a to b crosses a body: clipped to it in its own frame."""
    (x, y), cos, sin = middle(body), math.cos(body.heading), math.sin(body.heading)
    begin, end = 0.0, 1.0
    for along_x, along_y, size in ((cos, sin, body.length), (-sin, cos, body.width)):
        start = (a[0] - x) * along_x + (a[1] - y) * along_y
        move = (b[0] - a[0]) * along_x + (b[1] - a[1]) * along_y
        if abs(move) < 1e-9:
            if abs(start) > 0.5 * size:
                return False
            continue
        first, second = (-0.5 * size - start) / move, (0.5 * size - start) / move
        begin, end = max(begin, min(first, second)), min(end, max(first, second))
    return begin < end
