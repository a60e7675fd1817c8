"""Values along a path: the highest speed at each place, and the states of a vehicle on it."""

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

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
        length: [m] of the vehicle; it points as the path does at its middle, because its
            rear follows its front.

    Returns:
        States [S, 4], and the curvature [1/m] [S] at the front.
    """
    arcs = motion[:, 0]
    states = np.empty((len(motion), 4))
    states[:, 0] = np.interp(arcs, arc, points[:, 0])
    states[:, 1] = np.interp(arcs, arc, points[:, 1])
    states[:, 2] = np.interp(np.maximum(arcs - 0.5 * length, 0.0), arc, heading)
    states[:, 3] = motion[:, 1]
    return states, np.interp(arcs, arc, curvature)


@_jit
def within(
    total: Floats, heading: Floats, arc: Floats, low: Ints, high: Ints, most: float
) -> Bools:
    """Check for each stretch of a line whether it deviates at most `most` [m] to the side.

    Args:
        total: [N] integral of the heading along the line.
        heading, arc: [N] [rad], [m].
        low, high: [K] first and last index of each stretch.
        most: [m] from the straight line in the direction in which the stretch begins.
    """
    found = np.ones(len(low), np.bool_)
    for i in range(len(low)):
        a = low[i]
        for k in range(a, high[i] + 1):
            if not abs(total[k] - total[a] - heading[a] * (arc[k] - arc[a])) <= most:
                found[i] = False
                break
    return found
