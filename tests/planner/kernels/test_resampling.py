"""A line sampled anew is what numpy makes of it, to the last bit."""

import math

import numpy as np
import pytest

from planner.kernels.resampling import nearest, resampled
from planner.roads.smoothing import ALIKE, CUT, JOG, SWERVE, WINDOWS, curvature_of


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


@pytest.mark.parametrize("seed", range(20))
def test_curvature_is_averaged_as_numpy_does(seed: int) -> None:
    rng = np.random.default_rng(seed)
    arc = np.arange(float(rng.integers(3, 250)))
    bends = np.where(rng.random(len(arc)) < 0.1, rng.normal(0.0, 0.12, len(arc)), 0.0)
    heading = np.cumsum(bends - (seed % 2) * np.concatenate(([0.0] * 3, bends))[: len(arc)])
    assert curvature_of(heading, arc).tobytes() == averaged_by_numpy(heading, arc).tobytes()


def averaged_by_numpy(heading: np.ndarray, arc: np.ndarray) -> np.ndarray:
    """The curvature of a line, all places at once."""
    n, spacing = len(arc), float(arc[-1]) / (len(arc) - 1)
    total = np.concatenate(([0.0], np.cumsum(0.5 * (heading[1:] + heading[:-1])))) * spacing
    result, wide = np.zeros(n), np.ones(n, dtype=np.bool_)
    for window in WINDOWS:
        low = np.maximum(np.arange(n) - window, 0)
        high = np.minimum(np.arange(n) + window, n - 1)
        width = np.maximum(arc[high] - arc[low], 1e-6)
        turn = heading[high] - heading[low]
        bulge = total[high] - total[low] - 0.5 * (heading[high] + heading[low]) * width
        wide &= (window == WINDOWS[0]) | (np.abs(turn) * width / 8.0 + 0.5 * np.abs(bulge) <= CUT)
        gentler = wide & (np.abs(turn / width) < np.abs(result))
        result = turn / width if window == WINDOWS[0] else np.where(gentler, turn / width, result)
        swerve = np.abs(turn) / width + SWERVE * np.abs(bulge) / width**2
        aside = [
            np.max(np.abs(total[a : b + 1] - total[a] - heading[a] * (arc[a : b + 1] - arc[a])))
            for a, b in zip(low, high, strict=True)
        ]
        swerves = (np.abs(turn) <= ALIKE) & (swerve < np.abs(result)) & (np.array(aside) <= JOG)
        result = np.where(swerves, np.copysign(swerve, result), result)
    return result
