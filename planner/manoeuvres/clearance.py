"""Clearance: vehicles that stand beside the path, so near that the ego would touch them.

Car-following stays behind vehicles on the path. But the body of a turning vehicle covers more than
its path: one that waits inside a junction may stand clear of the line of the front, and not of the
body.
"""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from planner.record.trace import ON_FOOT
from planner.roads.levels import elsewhere
from planner.roads.trajectory import Path
from sim.boxes import overlap
from sim.scene import VehicleState

SPACING = 0.5  # [m] at which places along the path are tried
MARGIN = 0.1  # [m] kept free at each side


def first_touch(
    path: Path, arc: float, reach: float, ego: VehicleState, standing: Mapping[int, VehicleState]
) -> tuple[float, int] | None:
    """Return the arc [m] up to which the way is free, and the vehicle there; None if all is free.

    Vehicles that the ego touches already cannot be avoided, and are left out.

    Args:
        path: the path driven.
        arc: [m] of the front.
        reach: [m] distance ahead that is examined.
        ego: the vehicle; its size counts.
        standing: the others that do not move, by number.
    """
    body = replace(ego, width=ego.width + 2.0 * MARGIN)
    near = {
        name: other
        for name, other in standing.items()
        if math.dist(other.position, ego.position) <= reach + ego.length + other.length
        and not overlap(_at(path, arc, body), other)
        and not _on_another_level(path, other)
    }
    last = min(arc + reach, path.length)
    for k in range(1, math.ceil(max(last - arc, 0.0) / SPACING) + 1 if near else 0):
        there = _at(path, min(arc + k * SPACING, last), body)
        for name, other in near.items():
            if overlap(there, other):
                return arc + (k - 1) * SPACING, name
    return None


def _on_another_level(path: Path, other: VehicleState) -> bool:
    """Check whether a vehicle stands above or below a path."""
    if not path.passings:
        return False
    state = np.array([[(*other.position, other.heading, other.speed)]])
    size, walks = np.array([(other.length, other.width)]), np.array([other.kind in ON_FOOT])
    return bool(elsewhere(path.passings, state, size, walks)[0, 0])


def _at(path: Path, arc: float, body: VehicleState) -> VehicleState:
    position, heading = path.pose(arc, body.length)
    return replace(body, position=position, heading=heading)
