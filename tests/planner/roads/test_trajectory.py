import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.motion.forward import Lane
from planner.record.trace import EgoGoal
from planner.roads.routes import onward
from planner.roads.trajectory import LATERAL_ACCELERATION, Path
from sim.roads.network import Direction, angle_between, point_at, project
from sim.scene import Point
from tests.planner.nets import arc, drawn, lane, on_lane, shipped
from tests.planner.nets import link as link_to
from tests.planner.worlds import before_end, link, roads, row, situation

LANE = "main_in_0"
BEND = ("from_s_0", "right")

MOST = 1.12 * LATERAL_ACCELERATION  # [m/s2]: the driver lags behind the caps a little


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
    for at in np.arange(begins[lanes[1]], begins[lanes[2]] + 6.0, 0.5):
        (x, y), heading = line.pose(float(at), length)
        rear = (x - length * math.cos(heading), y - length * math.sin(heading))
        gap = np.min(np.hypot(*(line.points - np.array(rear)).T))
        assert gap < 0.8, at
    turned = line.pose(begins[lanes[1]] + 5.0)[1] - line.pose(begins[lanes[1]] + 5.0, length)[1]
    assert turned < -0.1  # the front points further into the right turn than the body


def test_both_ends_of_a_long_body_are_on_the_line() -> None:
    lanes = row("s1", *BEND)
    line, length = roads("s1").line(lanes), 12.0
    begin = dict(line.lanes)[lanes[1]]
    for at in np.arange(begin, begin + 20.0, 0.5):
        (x, y), heading = line.pose(float(at), length)
        behind, _ = line.pose(float(at) - length)
        along, aside = behind[0] - x, behind[1] - y
        assert along * math.sin(heading) - aside * math.cos(heading) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("radius", [8.0, 12.0, 20.0, 40.0, 150.0])
@pytest.mark.parametrize("step", [0.6, 2.0, 5.0])
def test_a_bend_is_driven_as_fast_as_its_radius_allows(radius: float, step: float) -> None:
    angle = min(math.pi / 2.0, 60.0 / radius)
    line = arc(radius, angle, step)
    roads = drawn([lane("bend_0", line, 50.0)])
    path = roads.path(("bend_0",), (0.0, 0.0), 0.0, 12.0, 500.0)
    middle = 30.0 + 0.5 * radius * angle
    around = np.abs(path.arc - middle) < 0.2 * radius * angle
    slowest = float(np.min(path.cap[around]))
    assert slowest == pytest.approx(math.sqrt(LATERAL_ACCELERATION * radius), rel=0.15)


@pytest.mark.parametrize("kink", [0.01, 0.03, 0.05])
def test_a_kink_in_a_straight_road_costs_little_speed(kink: float) -> None:
    end = (100.0 + 100.0 * math.cos(kink), 100.0 * math.sin(kink))
    roads = drawn([lane("road_0", [(0.0, 0.0), (100.0, 0.0), end], 50.0)])
    path = roads.path(("road_0",), (0.0, 0.0), 0.0, 12.0, 500.0)
    assert np.min(path.cap) > 26.0


def test_a_step_aside_between_two_lanes_costs_no_speed() -> None:
    lanes = [lane("a_0", [(0.0, 0.0), (50.0, 0.0)]), lane("b_0", [(50.02, 0.15), (100.0, 0.15)])]
    roads = drawn(lanes, [link_to("a_0", "b_0")])
    path = roads.path(("a_0", "b_0"), (0.0, 0.0), 0.0, 12.0, 500.0)
    assert np.min(path.cap) == pytest.approx(13.89)


def test_a_quick_chicane_is_a_bend() -> None:
    points = [(0.0, 0.0), (40.0, 0.0), (43.5, 1.2), (47.0, 2.4), (90.0, 2.4)]
    roads = drawn([lane("road_0", points, 50.0)])
    path = roads.path(("road_0",), (0.0, 0.0), 0.0, 12.0, 500.0)
    assert np.min(path.cap) < 8.5


def test_the_lanes_of_a_path_keep_their_places_across_gaps() -> None:
    lanes = [lane("a_0", [(0.0, 0.0), (50.0, 0.0)]), lane("b_0", [(62.0, 0.0), (100.0, 0.0)])]
    roads = drawn(lanes, [link_to("a_0", "b_0")])
    assert roads.line(("a_0", "b_0")).lanes == (("a_0", 0.0), ("b_0", pytest.approx(62.0)))


def test_a_path_that_comes_by_again_begins_where_the_vehicle_is() -> None:
    roads = shipped("s3")
    ring = [x for x in roads.network.lanes.values() if x.edge == "ring_east"]
    row = onward(roads, (ring[0].id,), 300.0)
    assert row.count(ring[0].id) > 1
    here = on_lane(roads, ring[0].id, 3.0)
    path = roads.path(row, here.position, here.heading, 12.0, 200.0)
    assert path.lanes[0] == (ring[0].id, pytest.approx(-3.0, abs=0.1))


@pytest.mark.parametrize(
    ("name", "rows"),
    [
        ("s1", [("from_s_0", "left"), ("from_s_0", "right"), ("main_in_0", "right")]),
        ("s2", [("south_in_0", "left"), ("west_in_0", "left"), ("south_in_0", "right")]),
    ],
)
def test_who_drives_at_the_caps_is_never_pushed_aside_hard(
    name: str, rows: list[tuple[str, Direction]]
) -> None:
    for start, direction in rows:
        assert pushed_aside(roads(name).line(row(name, start, direction)).lanes, name) < MOST


def test_who_drives_at_the_caps_goes_round_a_roundabout_smoothly() -> None:
    way = onward(shipped("s3"), ("south_in_0",), 250.0, EgoGoal("west_out", 60.0, None))
    assert "ring_north_0" in way
    sides = 8.0  # [m] a little more than those of the polygons that draw its arms
    assert pushed_aside(shipped("s3").line(way).lanes, "s3", sides) < MOST


def pushed_aside(lanes: tuple[tuple[str, float], ...], name: str, over: float = 4.0) -> float:
    """The largest sideways acceleration [m/s2] of who drives at the caps.

    Bends ahead are braked for in time, and speed grows by 2 m/s2 behind them. Turning is measured
    over a length `over` [m].
    """
    network = shipped(name)
    path = network.path(
        tuple(lane for lane, _ in lanes),
        network.network.lanes[lanes[0][0]].centreline[0],
        float(network.line((lanes[0][0],)).heading[0]),
        12.0,
        500.0,
    )
    near = np.arange(0.0, path.length - over, 0.5)
    speeds = Lane(path).caps.copy()
    for k in range(1, len(speeds)):
        speeds[k] = min(speeds[k], math.sqrt(speeds[k - 1] ** 2 + 2.0 * 2.0))
    middle = np.interp(near + 0.5 * over, np.arange(len(speeds)), speeds)
    after, before = np.interp([near + over, near], path.arc, path.heading)
    return float(np.max(middle**2 * np.abs(after - before) / over))
