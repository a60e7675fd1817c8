"""Who does otherwise than was foreseen."""

import numpy as np
import pytest

from planner.driving.monitoring import STRAY, SURPRISE, as_foreseen
from planner.motion.obstacles import Obstacle
from sim.scene import PersonState, VehicleState


def motion(x: list[float], speed: float) -> Obstacle:
    """A motion along x at a speed."""
    count = len(x)
    places = np.column_stack((np.array(x), np.zeros(count)))
    return Obstacle(1, 0.3, 0.5, places, np.zeros(count), np.full(count, speed), frozenset())


def walker(x: float, y: float = 0.0, speed: float = 1.3) -> PersonState:
    """Somebody who walks at a place."""
    return PersonState((x, y), 0.0, speed, 0.3, 0.5)


@pytest.mark.parametrize(
    ("state", "foreseen"),
    [
        (walker(1.3), True),
        (walker(0.0, speed=0.0), True),  # who has stopped is not far from where he was expected
        (walker(1.3, STRAY - 0.1), True),
        (walker(1.3, STRAY + 0.1), False),  # across a corner in no time, as SUMO has people walk
        (walker(-1.0), False),
    ],
)
def test_somebody_on_foot_is_about_where_it_was_foreseen(
    state: PersonState, foreseen: bool
) -> None:
    assert as_foreseen(state, motion([0.0, 1.3, 2.6], 1.3), 1) == foreseen


def test_who_has_left_the_network_in_a_motion_is_not_foreseen_to_be_here() -> None:
    assert not as_foreseen(walker(2.6), motion([0.0, 1.3, float("nan")], 1.3), 2)


def test_a_motion_that_ends_stays_as_it_is_then() -> None:
    assert as_foreseen(walker(2.6), motion([0.0, 1.3, 2.6], 1.3), 9)


def test_a_vehicle_drives_about_as_fast_as_was_foreseen() -> None:
    for off, foreseen in ((SURPRISE - 0.1, True), (SURPRISE + 0.1, False)):
        state = VehicleState((50.0, 0.0), 0.0, 10.0 + off, 0.0, 4.5, 1.8)
        assert as_foreseen(state, motion([0.0, 2.0], 10.0), 1) == foreseen
