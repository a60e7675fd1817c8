import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.trajectory import LATERAL_ACCELERATION, Path
from sim.network import Direction, angle_between, point_at, project
from sim.scene import Point
from tests.planner.worlds import before_end, link, roads, row, situation

LANE = "main_in_0"
BEND = ("from_s_0", "right")


def beside(lane: str, offset: float, lateral: float, turned: float) -> tuple[Point, float]:
    """A pose beside a lane."""
    (x, y), heading = point_at(roads("s1").network.lanes[lane].centreline, offset)
    place = (x - lateral * math.sin(heading), y + lateral * math.cos(heading))
    return place, heading + turned


def blended(
    lanes: tuple[str, ...], offset: float, lateral: float, turned: float, blend: float
) -> Path:
    position, heading = beside(lanes[0], offset, lateral, turned)
    return roads("s1").path(lanes, position, heading, blend, blend + 40.0)


offsets = st.floats(5.0, 60.0)
laterals = st.floats(-3.5, 3.5)
turns = st.floats(-0.25, 0.25)
blends = st.floats(15.0, 50.0)


@given(offsets, laterals, turns, blends)
def test_a_blend_begins_where_the_vehicle_is(
    offset: float, lateral: float, turned: float, blend: float
) -> None:
    path = blended((LANE,), offset, lateral, turned, blend)
    position, heading = beside(LANE, offset, lateral, turned)
    start, direction = path.pose(0.0)
    assert math.dist(start, position) < 0.03
    assert abs(angle_between(direction, heading)) < 0.06


@given(offsets, laterals, turns, blends)
def test_a_blend_ends_on_the_centreline(
    offset: float, lateral: float, turned: float, blend: float
) -> None:
    path = blended((LANE,), offset, lateral, turned, blend)
    centreline = roads("s1").network.lanes[LANE].centreline
    for point, heading in zip(path.points, path.heading, strict=True):
        along, aside, direction = project(centreline, (float(point[0]), float(point[1])))
        if along > offset + blend:
            assert abs(aside) < 1e-6
            if along > offset + blend + 1.0:
                assert abs(angle_between(float(heading), direction)) < 1e-6


@given(laterals, turns, blends)
def test_heading_and_curvature_are_continuous(lateral: float, turned: float, blend: float) -> None:
    lanes = row("s1", *BEND)
    path = blended(lanes, before_end("s1", BEND[0], 30.0), lateral, turned, blend)
    steps = np.diff(path.arc)
    assert np.all(steps > 0.0)
    assert np.max(np.abs(np.diff(path.heading)) / np.maximum(steps, 0.25)) < 0.45
    assert np.max(np.abs(np.diff(path.curvature))) < 0.2


@given(offsets, laterals, turns, blends)
def test_caps_keep_lateral_acceleration_comfortable(
    offset: float, lateral: float, turned: float, blend: float
) -> None:
    path = blended((LANE,), offset, lateral, turned, blend)
    limit = roads("s1").network.lanes[LANE].speed_limit
    assert np.all(path.cap <= limit + 1e-9)
    assert np.all(path.cap**2 * np.abs(path.curvature) <= LATERAL_ACCELERATION + 1e-6)


@pytest.mark.parametrize(
    ("lane", "direction", "sign"),
    [("from_s_0", "left", 1), ("from_s_0", "right", -1), ("main_in_1", "left", 1)],
)
def test_left_turns_bend_to_the_left(lane: str, direction: Direction, sign: int) -> None:
    way = link("s1", lane, direction)
    line = roads("s1").line((lane, *way.via, way.to_lane))
    begins = dict(line.lanes)
    inside = (line.arc > begins[way.via[0]]) & (line.arc < begins[way.to_lane])
    turned = np.trapezoid(line.curvature[inside], line.arc[inside])
    assert np.isclose(turned, sign * math.pi / 2.0, atol=0.15)
    assert np.max(np.abs(line.curvature[line.arc < begins[way.via[0]] - 5.0])) < 0.01


def test_a_straight_lane_has_no_curvature_and_the_limit_as_its_cap() -> None:
    line = roads("s1").line((LANE,))
    assert np.allclose(line.curvature, 0.0, atol=1e-9)
    assert np.allclose(line.cap, roads("s1").network.lanes[LANE].speed_limit)


def test_lane_at_tells_the_lane_and_where_it_begins() -> None:
    lanes = row("s1", *BEND)
    here = situation("s1", lanes[0], before_end("s1", lanes[0], 20.0))
    path = roads("s1").path(lanes, here.position, here.heading, 12.0, 60.0)
    length = roads("s1").network.lanes[lanes[1]].length
    assert [lane for lane, _ in path.lanes] == list(lanes)
    assert path.lane_at(0.0)[0] == lanes[0]
    assert path.lane_at(0.0)[1] == pytest.approx(20.0 - roads("s1").network.lanes[lanes[0]].length)
    assert path.lane_at(19.0)[0] == lanes[0]
    assert path.lane_at(21.0) == (lanes[1], pytest.approx(20.0, abs=0.1))
    assert path.lane_at(21.0 + length) == (lanes[2], pytest.approx(20.0 + length, abs=0.2))
    assert path.lane_at(1e6)[0] == lanes[2]


@given(st.floats(0.0, 40.0))
def test_the_pose_at_an_arc_lies_that_far_along_the_lane(arc: float) -> None:
    here = situation("s1", LANE, 30.0)
    path = roads("s1").path((LANE,), here.position, here.heading, 12.0, 60.0)
    position, heading = path.pose(arc)
    expected, direction = point_at(roads("s1").network.lanes[LANE].centreline, 30.0 + arc)
    assert math.dist(position, expected) < 1e-6
    assert abs(angle_between(heading, direction)) < 1e-6


def test_a_path_at_the_very_end_of_a_road_goes_straight_on() -> None:
    lane = roads("s1").network.lanes["main_out_0"]
    end = situation("s1", lane.id, lane.length)
    path = roads("s1").path((lane.id,), end.position, end.heading, 12.0, 50.0)
    assert path.length > 0.0
    assert np.all(np.isfinite(path.points))


def test_lines_are_kept() -> None:
    assert roads("s1").line((LANE,)) is roads("s1").line((LANE,))


def test_the_rear_follows_the_front_through_a_bend() -> None:
    lanes = row("s1", *BEND)
    line, length = roads("s1").line(lanes), 4.8
    begins = dict(line.lanes)
    for arc in np.arange(begins[lanes[1]], begins[lanes[2]] + 6.0, 0.5):
        (x, y), heading = line.pose(float(arc), length)
        rear = (x - length * math.cos(heading), y - length * math.sin(heading))
        gap = np.min(np.hypot(*(line.points - np.array(rear)).T))
        assert gap < 0.8, arc
    turned = line.pose(begins[lanes[1]] + 5.0)[1] - line.pose(begins[lanes[1]] + 5.0, length)[1]
    assert turned < -0.1  # the front points further into the right turn than the body
