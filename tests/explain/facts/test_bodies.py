"""Distances of bodies, and the times until they touch, worked out by hand."""

import math

import pytest

from sim.scene import VehicleState
from xavi_dialogue.explain.facts.bodies import at_least, distance, time_to_touch


def car(
    x: float, y: float, heading: float = 0.0, speed: float = 0.0, length: float = 4.8
) -> VehicleState:
    """A car 1.8 m wide with the middle of its front at a place."""
    return VehicleState((x, y), heading, speed, 0.0, length, 1.8)


@pytest.mark.parametrize(
    ("other", "metres"),
    [
        (car(20.0, 0.0), 15.2),
        (car(20.0, 3.0), math.hypot(15.2, 1.2)),
        (car(0.5, 5.0), 3.2),
        (car(-7.8, 0.0), 3.0),
        (car(3.0, 0.0, math.pi / 2.0), 2.1),  # across our nose, its side 0.9 m from its middle
        (car(2.0, 0.0), 0.0),
    ],
)
def test_the_distance_of_bodies(other: VehicleState, metres: float) -> None:
    assert distance(car(0.0, 0.0), other) == pytest.approx(metres)
    assert distance(other, car(0.0, 0.0)) == pytest.approx(metres)


def test_a_corner_may_be_nearest_to_the_middle_of_a_side() -> None:
    """The long one lies along x; the other points at its side from above, turned by 45 degrees."""
    long, other = car(20.0, 0.0, 0.0, length=40.0), car(0.0, 4.0, -math.pi / 4.0)
    corner = 4.0 - 0.9 * math.sqrt(0.5)  # its right front one, lower than the middle of its front
    assert distance(long, other) == pytest.approx(corner - 0.9)
    assert distance(other, long) == pytest.approx(corner - 0.9)


def test_a_bound_of_the_distance() -> None:
    """From front to front, less what either body reaches at most."""
    near, far = car(0.0, 0.0), car(30.0, 40.0, length=9.0)
    assert at_least(near, far) == pytest.approx(50.0 - math.hypot(4.8, 1.8) - math.hypot(9.0, 1.8))


@pytest.mark.parametrize(
    ("one", "other", "seconds"),
    [
        (car(0.0, 0.0, 0.0, 10.0), car(24.75, 0.0), 2.0),  # 19.95 m to go
        (car(0.0, 0.0, 0.0, 10.0), car(24.85, 0.0), 2.1),
        (car(0.0, 0.0, 0.0, 10.0), car(34.7, 0.0, 0.0, 5.0), 6.0),  # 29.9 m at 5 m/s
        (car(0.0, 0.0, 0.0, 10.0), car(104.7, 0.0), 10.0),
        (car(0.0, 0.0, 0.0, 10.0), car(105.3, 0.0), None),
        (car(0.0, 0.0, 0.0, 10.0), car(300.0, 0.0), None),
        (car(0.0, 0.0, 0.0, 10.0), car(30.0, -30.0, math.pi / 2.0, 10.0), 3.0),  # noses at 29.1 m
        (car(0.0, 0.0, 0.0, 10.0), car(30.0, 30.0, math.pi / 2.0, 10.0), None),
        (car(0.0, 0.0, 0.0, 10.0), car(20.0, 0.0, 0.0, 10.0), None),
        (car(0.0, 0.0), car(2.0, 0.0), None),  # nobody moves
        (car(0.0, 0.0, math.pi, 10.0), car(-30.0, 0.0, math.pi, 4.0), 4.3),  # 25.2 m at 6 m/s
        (car(0.0, 0.0, math.pi / 2.0, 10.0), car(0.0, 30.0, math.pi / 2.0, 4.0), 4.3),
        (car(0.0, 0.0, math.pi / 4.0, 9.0), car(21.0, 21.0, math.pi / 4.0, 0.0), 2.8),  # 24.9 m
    ],
)
def test_the_time_until_bodies_touch(
    one: VehicleState, other: VehicleState, seconds: float | None
) -> None:
    found = time_to_touch(one, other)
    assert found == (None if seconds is None else pytest.approx(seconds))
