"""Values along a path: its curvature, the highest speeds, and the states of a vehicle on it."""

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

LONG = 7.0  # [m] a longer body does not lie along the path's direction at its middle in a bend

_jit = njit(cache=True, error_model="numpy")


@_jit
def braking_caps(cap: Floats, arc: Floats, braking: float) -> Floats:
    """Return the highest speed [m/s] at every metre that allows braking for all caps ahead.

    Args:
        cap, arc: [N] highest speed [m/s] and arc [m] of each point of the path.
        braking: [m/s2] deceleration.
    """
    caps = cap.copy()
    for k in range(len(caps) - 2, -1, -1):
        reachable = math.sqrt(caps[k + 1] ** 2 + 2.0 * braking * (arc[k + 1] - arc[k]))
        caps[k] = min(caps[k], reachable)
    return np.interp(np.arange(0.0, arc[-1] + 1.0), arc, caps)


@_jit
def place(
    points: Floats, arc: Floats, heading: Floats, curvature: Floats, motion: Floats, length: float
) -> tuple[Floats, Floats]:
    """Return the states of a vehicle at given places on a path.

    Args:
        points, arc, heading, curvature: of the path.
        motion: [S, 3] arc [m], speed [m/s] and acceleration.
        length: [m] of the vehicle; its rear follows its front.

    Returns:
        States [S, 4], and the curvature [1/m] [S] at the front.
    """
    arcs = motion[:, 0]
    states = np.empty((len(motion), 4))
    states[:, 0] = np.interp(arcs, arc, points[:, 0])
    states[:, 1] = np.interp(arcs, arc, points[:, 1])
    if length <= LONG:
        states[:, 2] = np.interp(np.maximum(arcs - 0.5 * length, 0.0), arc, heading)
    else:
        states[:, 2] = chords(points, arc, heading, arcs, length)
    states[:, 3] = motion[:, 1]
    return states, np.interp(arcs, arc, curvature)


@_jit
def chords(points: Floats, arc: Floats, heading: Floats, arcs: Floats, length: float) -> Floats:
    """Return the headings [rad] [S] of a body whose front and rear are both on a path.

    Before its first point, the path leads straight on.

    Args:
        points, arc, heading: of the path.
        arcs: [m] [S] of the front.
        length: [m] of the body.
    """
    found = np.interp(np.maximum(arcs - 0.5 * length, 0.0), arc, heading)
    x, y = np.interp(arcs, arc, points[:, 0]), np.interp(arcs, arc, points[:, 1])
    rear = arcs - length
    rear_x, rear_y = np.interp(rear, arc, points[:, 0]), np.interp(rear, arc, points[:, 1])
    cos, sin = math.cos(heading[0]), math.sin(heading[0])
    for k in range(len(arcs)):
        before = min(rear[k], 0.0)
        dx, dy = x[k] - rear_x[k] - before * cos, y[k] - rear_y[k] - before * sin
        turned = math.atan2(dy, dx) - found[k]
        found[k] += math.atan2(math.sin(turned), math.cos(turned))
    return found


@_jit
def averaged(
    heading: Floats, arc: Floats, windows: Ints, cut: float, swerve: float, jog: float, alike: float
) -> Floats:
    """Return the curvature [1/m] [N] of a line, averaged over windows: see `curvature_of`.

    Args:
        heading, arc: [N] [rad], [m].
        windows: points on each side to average over, the narrowest first.
        cut: [m] maximum distance of a wider curve from the line.
        swerve: curvature of a swerve, times length^2 / way aside.
        jog, alike: [m] to the side, and [rad] turned, up to which it is a swerve.
    """
    count, spacing = len(arc), arc[-1] / (len(arc) - 1)
    total, so_far = np.zeros(count), 0.0  # integral of the heading along the line
    for k in range(1, count):
        so_far += 0.5 * (heading[k] + heading[k - 1])
        total[k] = so_far * spacing
    found = np.empty(count)
    for k in range(count):
        wide = True
        for i in range(len(windows)):
            low, high = max(k - windows[i], 0), min(k + windows[i], count - 1)
            width, turn = max(arc[high] - arc[low], 1e-6), heading[high] - heading[low]
            bulge = total[high] - total[low] - 0.5 * (heading[high] + heading[low]) * width
            wide &= i == 0 or abs(turn) * width / 8.0 + 0.5 * abs(bulge) <= cut
            if i == 0 or (wide and abs(turn / width) < abs(found[k])):
                found[k] = turn / width
            gently = abs(turn) / width + swerve * abs(bulge) / width**2
            swerves = abs(turn) <= alike and gently < abs(found[k])
            if swerves and _within(total, heading, arc, low, high, jog):
                found[k] = math.copysign(gently, found[k])
    return found


@_jit
def _within(total: Floats, heading: Floats, arc: Floats, low: int, high: int, most: float) -> bool:
    """Check whether a stretch of a line deviates at most `most` [m] from a straight one.

    Args:
        total: [N] integral of the heading along the line.
        heading, arc: [N] [rad], [m].
        low, high: first and last index of the stretch.
        most: [m] from the straight line in the direction in which the stretch begins.
    """
    for k in range(low, high + 1):
        if not abs(total[k] - total[low] - heading[low] * (arc[k] - arc[low])) <= most:
            return False
    return True
