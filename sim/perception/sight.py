"""Visibility for the ego: tall vehicles and buildings hide what is wholly behind them."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Generic, TypeAlias, TypeVar

from sim.boxes import Box, corners
from sim.perception.buildings import NO_WALLS, Walls
from sim.scene import PersonState, Point, VehicleState

TALL = 2.0  # [m] least height of a vehicle that hides others: the ego sees over cars


State = TypeVar("State", VehicleState, PersonState)
Anybody: TypeAlias = "Body[VehicleState] | Body[PersonState]"


@dataclass(frozen=True, slots=True)
class Body(Generic[State]):
    """A vehicle or person with its height."""

    state: State
    height: float  # [m]


def hidden(
    ego: VehicleState, target: Anybody, others: Iterable[Anybody], buildings: Walls = NO_WALLS
) -> bool:
    """Check whether a vehicle or person cannot be seen from the middle of the ego's roof.

    It is hidden if its middle and each of its four corners are behind a building, or behind a
    tall vehicle that is not lower than itself.

    Args:
        ego: the vehicle that looks.
        target: the vehicle or person to see.
        others: those that may stand between; the target may be among them.
        buildings: the walls that may stand between.
    """
    walls = [
        body.state
        for body in others
        if body.height >= max(TALL, target.height) and body.state is not target.state
    ]
    eye = eye_of(ego)
    return all(
        _blocked(eye, point, walls) or buildings.between(eye, point)
        for point in _outline(target.state)
    )


def crosses(a: Point, b: Point, box: Box) -> bool:
    """Check whether the straight line from a to b passes through a box; touching is not passing.

    The line is clipped by the two pairs of parallel sides (Liang and Barsky, 1984).
    """
    ahead = (math.cos(box.heading), math.sin(box.heading))
    enters, leaves = 0.0, 1.0
    for axis, low, high in (
        (ahead, -box.length, 0.0),
        ((-ahead[1], ahead[0]), -box.width / 2.0, box.width / 2.0),
    ):
        start = (a[0] - box.position[0]) * axis[0] + (a[1] - box.position[1]) * axis[1]
        step = (b[0] - a[0]) * axis[0] + (b[1] - a[1]) * axis[1]
        if abs(step) < 1e-12:
            if not low < start < high:
                return False
            continue
        near, far = sorted(((low - start) / step, (high - start) / step))
        enters, leaves = max(enters, near), min(leaves, far)
    return leaves - enters > 1e-9


def eye_of(ego: VehicleState) -> Point:
    """Return the place [m] from which the ego looks: the middle of its roof."""
    return _middle(ego)


def _blocked(eye: Point, point: Point, walls: Sequence[Box]) -> bool:
    return any(crosses(eye, point, wall) for wall in walls)


def _outline(state: Box) -> tuple[Point, ...]:
    return (_middle(state), *corners(state))


def _middle(state: Box) -> Point:
    x, y = state.position
    back = state.length / 2.0
    return x - back * math.cos(state.heading), y - back * math.sin(state.heading)
