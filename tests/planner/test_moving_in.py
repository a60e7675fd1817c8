"""Who changes lanes before another, and how much room that leaves."""

import numpy as np
import pytest

from planner.kernels.collision import moved_in
from planner.kernels.reaction import FIRM

DT, LENGTH, WIDTH = 0.2, 4.5, 3.2  # [s], [m] of a car, [m] of a lane


def states(front: float, speed: float, aside: list[float], heading: float = 0.0) -> np.ndarray:
    """A vehicle along x [S, 4], so far to the side at each step."""
    steps = np.arange(len(aside))
    return np.column_stack(
        (
            front + speed * DT * steps,
            aside,
            np.full(len(aside), heading),
            np.full(len(aside), speed),
        )
    )


CHANGE = [0.0, 0.4, 1.0, 1.6, 2.2, 2.8, 3.2]  # [m]: within 1.5 m of the next lane from step 4 on
BESIDE = [WIDTH] * 7


@pytest.mark.parametrize(
    ("gap", "speed", "other", "cut_off"),
    [
        (17.9, 20.0, 20.0, True),  # 20 m/s for 0.9 s are 18 m
        (18.1, 20.0, 20.0, False),
        (2.0, 2.0, 2.0, False),  # 1.8 m in a queue
        (26.0, 20.0, 22.0, True),  # and (22^2 - 20^2) / (2 * 4.4) = 9.5 m, which makes 29.3
        (30.0, 20.0, 22.0, False),
        (9.0, 22.0, 20.0, False),  # 18 - 9.5 = 8.5 m for who falls back
    ],
)
def test_a_follower_is_left_its_safe_distance(
    gap: float, speed: float, other: float, cut_off: bool
) -> None:
    own = states(100.0, speed, CHANGE)
    at_entry = own[4, 0] - LENGTH - gap  # where the follower is once both are in one lane
    behind = states(at_entry - other * DT * 4, other, BESIDE)
    found = moved_in(own, LENGTH, 0, behind[None], FIRM)
    assert found == ((4, 0) if cut_off else (-1, -1))


def test_who_comes_behind_in_the_own_lane_or_against_it_is_not_cut_off() -> None:
    own = states(100.0, 20.0, CHANGE)
    follower = states(94.0, 20.0, [0.0] * 7)
    oncoming = states(94.0, 20.0, BESIDE, heading=np.pi)
    assert moved_in(own, LENGTH, 0, np.stack((follower, oncoming)), FIRM) == (-1, -1)


def test_who_is_ahead_in_the_other_lane_is_not_cut_off() -> None:
    own, leader = states(100.0, 20.0, CHANGE), states(112.0, 20.0, BESIDE)
    assert moved_in(own, LENGTH, 0, leader[None], FIRM) == (-1, -1)
