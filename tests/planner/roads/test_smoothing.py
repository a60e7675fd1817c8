"""Wide bends that a map draws with few corners."""

import math

import numpy as np
import pytest

from planner.roads.smoothing import AWAY, curvature_of, smoothed

RADIUS = 65.0  # [m]


def circle(side: float, count: int = 8) -> np.ndarray:
    """The corners of a polygon on a circle, with sides of a length [m]."""
    angles = 2.0 * math.asin(side / 2.0 / RADIUS) * np.arange(count)
    return RADIUS * np.column_stack((np.sin(angles), 1.0 - np.cos(angles)))


def test_a_polygon_on_a_circle_becomes_the_circle() -> None:
    points, index = smoothed(circle(14.0))
    inner = points[index[1] : index[-2] + 1]
    away = np.hypot(inner[:, 0], inner[:, 1] - RADIUS) - RADIUS
    assert np.max(np.abs(away)) < 0.02
    heading = np.unwrap(np.arctan2(*np.diff(inner, axis=0).T[::-1]))
    turning = np.diff(heading) / np.hypot(*np.diff(inner, axis=0)[1:].T)
    assert turning == pytest.approx(1.0 / RADIUS, rel=0.1)


def test_corners_stay_where_they_are() -> None:
    corners = circle(14.0)
    points, index = smoothed(corners)
    assert points[index] == pytest.approx(corners)


def test_a_curve_leads_away_from_its_sides_by_a_little_at_most() -> None:
    corners = circle(30.0)
    points, index = smoothed(corners)
    for a, b, first, last in zip(corners, corners[1:], index, index[1:], strict=False):
        along = (b - a) / np.hypot(*(b - a))
        offset = points[first : last + 1] - a
        aside = offset[:, 0] * along[1] - offset[:, 1] * along[0]
        assert np.max(np.abs(aside)) <= AWAY + 1e-9


@pytest.mark.parametrize(
    "corners",
    [
        [(0.0, 0.0), (50.0, 0.0)],
        [(0.0, 0.0), (50.0, 0.0), (50.0, 50.0)],  # a corner, no bend
        [(0.0, 0.0), (100.0, 0.0), (101.0, 0.1), (102.0, 0.3)],  # drawn with many corners
        [(0.0, 0.0), (100.0, 0.0), (110.0, 3.0)],  # a straight road before a bend
        [(0.0, 0.0), (20.0, 0.0), (40.0, 0.0)],
    ],
)
def test_what_is_no_polygon_of_a_bend_stays_as_it_is(corners: list[tuple[float, float]]) -> None:
    points, index = smoothed(np.array(corners))
    assert points.tolist() == [list(x) for x in corners]
    assert index.tolist() == list(range(len(corners)))


def sharpest(corners: list[tuple[float, float]]) -> float:
    """The greatest curvature [1/m] of a line with these corners."""
    raw = np.array(corners)
    at = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(raw, axis=0).T))))
    arc = np.linspace(0.0, at[-1], math.ceil(at[-1]) + 1)
    x, y = (np.interp(arc, at, raw[:, k]) for k in (0, 1))
    heading = np.unwrap(np.arctan2(np.gradient(y), np.gradient(x)))
    return float(np.max(np.abs(curvature_of(heading, arc))))


@pytest.mark.parametrize(("aside", "length", "low", "high"), [
    (0.9, 3.0, 0.0, 0.012),  # a jog between two lanes: swerved about
    (3.5, 3.0, 0.05, 1.0),  # too far aside for that
    (0.5, 60.0, 0.0, 0.002),  # a road that narrows
])  # fmt: skip
def test_a_small_jog_of_a_straight_road_is_no_bend(
    aside: float, length: float, low: float, high: float
) -> None:
    before, beyond = 60.0, 60.0 + length
    corners = [(0.0, 0.0), (before, 0.0), (beyond, aside), (beyond + 60.0, aside)]
    assert low <= sharpest(corners) <= high


def test_a_road_that_goes_aside_and_comes_back_is_bent() -> None:
    assert sharpest([(0.0, 0.0), (60.0, 0.0), (64.0, 3.0), (68.0, 0.0), (128.0, 0.0)]) > 0.05
