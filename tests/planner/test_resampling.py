"""A line sampled anew is what numpy makes of it, to the last bit."""

import math

import numpy as np
import pytest

from planner.kernels.along import within
from planner.kernels.resampling import nearest, resampled


@pytest.mark.parametrize("seed", range(40))
def test_resampling_interpolates_as_numpy_does(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count = int(rng.integers(3, 200))
    arc = np.concatenate(([0.0], np.cumsum(rng.uniform(0.5, 1.2, count - 1))))
    points, heading = rng.normal(0.0, 100.0, (count, 2)), rng.normal(size=count)
    curvature, cap = rng.normal(size=count), rng.uniform(5.0, 30.0, count)
    at = np.concatenate((arc[1:], np.arange(0.3, arc[-1] + 9.0, 0.7)))
    at.sort()
    end = float(heading[-1])
    direction = (math.cos(end), math.sin(end))
    found = resampled(at, arc, (points, heading, curvature), cap, direction)
    beyond = np.maximum(at - arc[-1], 0.0)
    x = np.interp(at, arc, points[:, 0]) + beyond * direction[0]
    y = np.interp(at, arc, points[:, 1]) + beyond * direction[1]
    index = np.minimum(np.searchsorted(arc, at + 1e-9), count - 1)
    bends = np.where(beyond > 0.0, 0.0, np.interp(at, arc, curvature))
    wanted = (np.column_stack((x, y)), np.interp(at, arc, heading), bends, cap[index])
    for ours, theirs in zip(found, wanted, strict=True):
        assert ours.tobytes() == theirs.tobytes()


def test_nearest_looks_at_the_first_points_alone() -> None:
    points = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])
    assert nearest(points, 4, 2.9, 1.0) == 3
    assert nearest(points, 2, 2.9, 1.0) == 1
    assert nearest(points, 4, 0.5, 0.0) == 0


def test_a_stretch_is_within_what_it_leads_aside() -> None:
    arc = np.arange(4.0)
    heading = np.array([0.0, 0.5, 0.5, 0.0])
    total = np.array([0.0, 0.25, 0.75, 1.0])  # [m] aside, for small angles
    low, high = np.array([0, 0]), np.array([3, 2])
    assert within(total, heading, arc, low, high, 0.8).tolist() == [False, True]
    assert within(total, heading, arc, low, high, 1.0).tolist() == [True, True]
