"""Straight roads drawn by hand, and vehicles observed on them: all can be worked out on paper.

The road of `avenue` leads east along y = 0, with a second lane at y = 3.5.
"""

import itertools
import math
from collections.abc import Sequence

import numpy as np

from planner.motion.forward import DT
from planner.motion.obstacles import Obstacle
from planner.motion.tracks import Observed
from planner.roads.trajectory import Roads
from sim.roads.network import Lane, Link
from sim.scene import Point
from tests.planner.nets import drawn, lane, link

LENGTH, WIDTH = 4.0, 2.0  # [m] of every vehicle here
SIZE = (LENGTH, WIDTH)


def avenue(length: float = 600.0, limit: float = 20.0) -> Roads:
    """A straight road with two lanes and nothing beyond."""
    lanes = [lane(f"road_{k}", [(0.0, 3.5 * k), (length, 3.5 * k)], limit) for k in range(2)]
    return drawn(lanes)


def crossing(*, yields: bool = True, limit: float = 20.0) -> Roads:
    """A road east that crosses a junction between x = 100 and 110, having to give way there."""
    lanes: list[Lane] = [
        lane("in_0", [(0.0, 0.0), (100.0, 0.0)], limit),
        lane(":J_0", [(100.0, 0.0), (105.0, 0.0)], limit, inside=True),
        lane(":J2_0", [(105.0, 0.0), (110.0, 0.0)], limit, inside=True),
        lane("out_0", [(110.0, 0.0), (400.0, 0.0)], limit),
    ]
    links: list[Link] = [
        link("in_0", "out_0", "straight", (":J_0", ":J2_0"), yields_to=(7,) if yields else ())
    ]
    return drawn(lanes, links)


def seen(
    points: Sequence[Point], speed: Sequence[float], heading: float = 0.0, vehicle: int = 1
) -> Observed:
    """A vehicle at points [m] with speeds [m/s], now last."""
    return Observed(
        vehicle, LENGTH, WIDTH, np.array(points), np.full(len(points), heading), np.array(speed)
    )


def eastward(x: float, speed: Sequence[float], y: float = 0.0, vehicle: int = 1) -> Observed:
    """A vehicle that has come to x [m] along y [m] with speeds [m/s], now last."""
    steps = [0.5 * (a + b) * DT for a, b in itertools.pairwise(speed)]
    back = [0.0, *itertools.accumulate(reversed(steps))][::-1]
    return seen([(x - far, y) for far in back], speed, vehicle=vehicle)


def standing(x: float, y: float = 0.0, vehicle: int = 2, steps: int = 400) -> Obstacle:
    """A vehicle that stands and goes on to."""
    return Obstacle(
        vehicle,
        LENGTH,
        WIDTH,
        np.tile((x, y), (steps, 1)),
        np.zeros(steps),
        np.zeros(steps),
        frozenset(),
    )


def turned(point: Point, angle: float) -> Point:
    """A point turned about the origin."""
    x, y = point
    cos, sin = math.cos(angle), math.sin(angle)
    return (x * cos - y * sin, x * sin + y * cos)


def corner(angle: float = 0.0, limit: float = 13.0) -> Roads:
    """A road east from which one goes straight on, or turns right in a bend of 8 m.

    The junction lies between x = 100 and 110; nobody has to give way.

    Args:
        angle: [rad] by which all is turned about the origin.
        limit: [m/s]
    """
    steps = [0.5 * math.pi * k / 8 for k in range(9)]
    bend = [(100.0 + 8.0 * math.sin(t), -8.0 + 8.0 * math.cos(t)) for t in steps]
    lines = {
        "in_0": [(0.0, 0.0), (100.0, 0.0)],
        ":J_0": [(100.0, 0.0), (110.0, 0.0)],
        "on_0": [(110.0, 0.0), (400.0, 0.0)],
        ":R_0": bend,
        "south_0": [(108.0, -8.0), (108.0, -300.0)],
    }
    lanes = [
        lane(name, [turned(p, angle) for p in line], limit, inside=name[0] == ":")
        for name, line in lines.items()
    ]
    links = [
        link("in_0", "south_0", "right", (":R_0",), index=0),
        link("in_0", "on_0", "straight", (":J_0",), index=1),
    ]
    return drawn(lanes, links)
