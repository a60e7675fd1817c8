"""What the ego can see: tall vehicles hide what is wholly behind them."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from sim.boxes import corners
from sim.scene import Point, VehicleState

TALL = 2.0  # [m] least height of a vehicle that hides others: the ego sees over cars


@dataclass(frozen=True, slots=True)
class Body:
    """A vehicle with its height."""

    state: VehicleState
    height: float  # [m]


def hidden(ego: VehicleState, target: Body, others: Iterable[Body]) -> bool:
    """Whether a vehicle cannot be seen from the middle of the ego's roof.

    It cannot where its middle and its four corners are all behind tall vehicles, none of which
    is lower than itself.

    Args:
        ego: whose view it is.
        target: the vehicle to be seen.
        others: those that may stand between; the target may be among them.
    """
    walls = [
        body.state
        for body in others
        if body.height >= max(TALL, target.height) and body.state is not target.state
    ]
    eye = _middle(ego)
    return all(_blocked(eye, point, walls) for point in _outline(target.state))


def crosses(a: Point, b: Point, box: VehicleState) -> bool:
    """Whether the straight line from a to b passes through a vehicle; touching is not passing.

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


def _blocked(eye: Point, point: Point, walls: Sequence[VehicleState]) -> bool:
    return any(crosses(eye, point, wall) for wall in walls)


def _outline(state: VehicleState) -> tuple[Point, ...]:
    return (_middle(state), *corners(state))


def _middle(state: VehicleState) -> Point:
    x, y = state.position
    back = state.length / 2.0
    return x - back * math.cos(state.heading), y - back * math.sin(state.heading)
