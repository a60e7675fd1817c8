"""Lanes that go on to the side of where they came."""

import numpy as np
import pytest

from planner.roads.shifts import ROOM, shifted


def jog(aside: float, over: float = 8.0, turn: float = 0.0) -> np.ndarray:
    """A line along x whose lane goes on `aside` [m] to the left, and then turns [rad]."""
    x = np.arange(0.0, 121.0)
    y = aside * np.clip((x - 56.0) / over, 0.0, 1.0) + np.maximum(x - 56.0 - over, 0.0) * turn
    return np.column_stack((x, y))


JOINT = np.array([56.0, 64.0])  # where the lane within the junction begins, and that beyond it


def curvature(points: np.ndarray) -> float:
    """The largest change of heading per metre."""
    steps = np.diff(points, axis=0)
    heading = np.arctan2(steps[:, 1], steps[:, 0])
    return float(np.max(np.abs(np.diff(heading)) / np.hypot(*steps[1:].T)))


@pytest.mark.parametrize("aside", [1.5, 2.3, 3.2, -2.3])
def test_a_jog_is_driven_gently_within_the_lane(aside: float) -> None:
    points = jog(aside)
    led = shifted(points, JOINT)
    assert np.max(np.abs(led[:, 1] - points[:, 1])) <= ROOM + 1e-9
    assert curvature(led) < 0.25 * curvature(points)
    assert led[:20] == pytest.approx(points[:20])
    assert led[-20:] == pytest.approx(points[-20:])


def test_the_way_over_is_as_long_as_the_lane_leaves_room_for() -> None:
    # A quintic over L leads 3.2 m aside with at most 5.77 * 3.2 / L^2 of curvature; where it is
    # 0.7 m off, 4 m before the middle, it has done 22 % of the way: L = 25 m.
    assert curvature(shifted(jog(3.2), JOINT)) == pytest.approx(5.77 * 3.2 / 25.0**2, rel=0.25)


@pytest.mark.parametrize(("aside", "over"), [(2.3, 4.0), (2.6, 5.0), (3.2, 6.0)])
def test_a_short_jog_is_led_over_as_gently_as_the_lane_allows(aside: float, over: float) -> None:
    points = jog(aside, over)
    led = shifted(points, np.array([56.0, 56.0 + over]))
    assert np.max(np.abs(led[:, 1] - points[:, 1])) <= ROOM + 1e-9
    assert curvature(led) < 0.2 * curvature(points)


@pytest.mark.parametrize(
    "points",
    [
        jog(0.0),
        jog(1.0),  # so little that it is driven as it is drawn
        jog(5.0),  # no lane's width any more
        jog(2.3, turn=0.2),  # the road turns
        jog(2.3)[50:60],  # too short to tell
        np.column_stack((50.0 * np.sin(np.arange(60) / 50), 50.0 * np.cos(np.arange(60) / 50))),
    ],
)
def test_what_is_no_jog_stays_as_it_is(points: np.ndarray) -> None:
    assert shifted(points, JOINT) is points


def test_a_chicane_within_a_lane_is_the_shape_of_the_road() -> None:
    points = jog(2.3)
    assert shifted(points, np.array([0.0, 20.0])) is points
