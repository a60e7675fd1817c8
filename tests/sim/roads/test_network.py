"""Queries of the lane graph and the geometry below them."""

import math

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from sim.roads.netfile import read_network
from sim.roads.network import angle_between, cumulative, point_at, project
from sim.setup.scenario import load

S1 = read_network(load("s1").network)
LINES = st.sampled_from([lane.centreline for lane in S1.lanes.values()])


def test_locate_finds_the_lane_first_and_its_neighbour_by_reach() -> None:
    near = S1.locate((-90.0, -5.0), 0.0)
    assert [place.lane for place in near] == ["main_in_0"]
    assert near[0].offset == pytest.approx(60.0)
    assert near[0].lateral == pytest.approx(0.25)
    both = S1.locate((-90.0, -4.0), 0.0)
    assert [place.lane for place in both] == ["main_in_0", "main_in_1"]
    assert both[1].lateral == pytest.approx(-2.25)


def test_locate_minds_the_heading() -> None:
    assert [place.lane for place in S1.locate((-90.0, 1.75), math.pi)] == ["back_out_0"]
    assert S1.locate((-90.0, 1.75), math.pi / 2) == ()
    assert S1.locate((-90.0, 50.0), 0.0) == ()


def test_locate_inside_the_junction_lists_every_way() -> None:
    here = {place.lane for place in S1.locate((41.0, -5.25), 0.0)}
    assert here >= {":J_9_0", ":J_10_0"}
    assert S1.link_via(":J_9_0") == next(
        way for way in S1.links_from("main_in_0") if way.direction == "right"
    )


def test_neighbours() -> None:
    left = S1.left_of("main_in_0")
    assert left is not None
    assert left.id == "main_in_1"
    assert S1.right_of("main_in_0") is None
    assert S1.left_of("main_in_1") is None
    assert S1.left_of(":J_10_0") is None
    assert [lane.id for lane in S1.edge_lanes("main_in")] == ["main_in_0", "main_in_1"]


def test_distances_lead_to_the_edge_and_no_other_way() -> None:
    distances = S1.distance_to("main_out")
    assert distances["main_out"] == 0.0
    assert distances["main_in"] == pytest.approx(19.0)
    assert "back_in" not in distances
    assert "exit_s" not in distances


@given(line=LINES, share=st.floats(0.0, 1.0))
def test_project_undoes_point_at(line: tuple[tuple[float, float], ...], share: float) -> None:
    offset = share * cumulative(line)[-1]
    point, heading = point_at(line, offset)
    found, lateral, direction = project(line, point)
    assert found == pytest.approx(offset, abs=1e-6)
    assert lateral == pytest.approx(0.0, abs=1e-6)
    assert abs(angle_between(direction, heading)) < 0.5


@given(share=st.floats(0.0, 1.0), aside=st.floats(-5.0, 5.0))
def test_left_of_a_line_is_positive(share: float, aside: float) -> None:
    line = S1.lanes["back_out_0"].centreline
    (x, y), heading = point_at(line, share * cumulative(line)[-1])
    left = (x - math.sin(heading) * aside, y + math.cos(heading) * aside)
    assert project(line, left)[1] == pytest.approx(aside, abs=1e-9)


def test_project_goes_on_beyond_both_ends() -> None:
    line = ((0.0, 0.0), (10.0, 0.0))
    assert project(line, (-3.0, 1.0))[:2] == pytest.approx((-3.0, 1.0))
    assert project(line, (14.0, -1.0))[:2] == pytest.approx((14.0, -1.0))


@given(a=st.floats(-10.0, 10.0), b=st.floats(-10.0, 10.0))
def test_angle_between_turns_b_into_a(a: float, b: float) -> None:
    turn = angle_between(a, b)
    assert -math.pi < turn <= math.pi
    assert math.cos(b + turn) == pytest.approx(math.cos(a), abs=1e-9)
    assert math.sin(b + turn) == pytest.approx(math.sin(a), abs=1e-9)


@given(a=st.floats(-3.0, 3.0), b=st.floats(-3.0, 3.0))
def test_angle_between_is_antisymmetric(a: float, b: float) -> None:
    assume(abs(abs(angle_between(a, b)) - math.pi) > 1e-9)
    assert angle_between(a, b) == pytest.approx(-angle_between(b, a))
