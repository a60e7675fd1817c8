"""Where a vehicle is said to be: it comes from a side only while it heads for us from there."""

import math

import pytest

from planner.record.places import RoadPlace
from sim.scene import VehicleState
from xavi_dialogue.explain.facts.bearings import (
    Offset,
    aside,
    bearing,
    centre,
    lane_side,
    offset,
    oncoming,
)


def seen(ahead: float, left: float, turn: float = 0.0) -> Offset:
    """Somebody as long as we are, who is abreast within 5 m; the turn in degrees."""
    return Offset(ahead, left, math.radians(turn), 5.0)


@pytest.mark.parametrize(
    ("ahead", "left", "turn", "word"),
    [
        (30.0, 40.0, -90.0, "crossing-left"),
        (30.0, -40.0, 90.0, "crossing-right"),
        (30.0, -40.0, -90.0, "ahead-right"),  # it has crossed, and moves away
        (-30.0, 12.0, -90.0, "behind-left"),
        (-5.0, 12.0, -90.0, "crossing-left"),  # beside us, and still heading for our line
        (-5.1, 12.0, -90.0, "left"),
        (20.0, 5.0, -51.0, "crossing-left"),
        (20.0, 5.0, -49.0, "ahead-left"),
        (20.0, 5.0, -129.0, "crossing-left"),
        (10.0, 5.0, -131.0, "oncoming"),
        (30.0, 0.4, -60.0, "crossing-left"),
        (30.0, 0.4, 60.0, "ahead"),
        (20.0, 30.0, -85.0, "crossing-left"),
    ],
)
def test_who_heads_across(ahead: float, left: float, turn: float, word: str) -> None:
    assert bearing(seen(ahead, left, turn)) == word


@pytest.mark.parametrize(
    ("ahead", "left", "word"),
    [
        (30.0, 0.5, "ahead"),
        (30.0, 2.0, "ahead"),
        (30.0, -2.0, "ahead"),
        (0.5, 0.5, "ahead"),
        (-0.5, 0.5, "behind"),
        (30.0, 2.1, "ahead-left"),
        (30.0, -2.1, "ahead-right"),
        (-30.0, 1.0, "behind"),
        (-30.0, 2.1, "behind-left"),
        (-30.0, -2.1, "behind-right"),
        (5.0, 3.0, "beside-left"),
        (5.1, 3.0, "ahead-left"),
        (-5.0, -3.0, "beside-right"),
        (-5.1, -3.0, "behind-right"),
    ],
)
def test_who_goes_our_way(ahead: float, left: float, word: str) -> None:
    assert bearing(seen(ahead, left)) == word


@pytest.mark.parametrize(
    ("ahead", "left", "word"),
    [
        (60.0, 3.5, "oncoming"),
        (10.0, 8.0, "oncoming"),
        (10.0, -8.0, "oncoming"),
        (10.0, 8.1, "ahead-left"),
        (10.0, -8.1, "ahead-right"),
        (40.0, 19.0, "oncoming"),  # far ahead, its road may lead into ours
        (40.0, -19.0, "oncoming"),
        (40.0, 21.0, "ahead-left"),
        (20.0, -14.0, "ahead-right"),
        (-10.0, 1.0, "behind"),
        (0.5, 3.0, "oncoming"),
    ],
)
def test_who_comes_towards_us(ahead: float, left: float, word: str) -> None:
    assert bearing(seen(ahead, left, 180.0)) == word
    assert oncoming(seen(ahead, left, 180.0)) == (word == "oncoming")
    assert not oncoming(seen(ahead, left, 120.0))


@pytest.mark.parametrize(
    ("ahead", "left", "word"),
    [
        (20.0, 4.0, "ahead"),
        (20.0, -4.0, "ahead"),
        (0.5, 0.5, "ahead-left"),
        (-0.5, 0.5, "behind-left"),
        (0.1, 0.5, "left"),
        (50.0, 4.1, "ahead-left"),  # nearly straight on, and not on our line
        (10.0, 3.5, "ahead-left"),  # atan(0.35) is 19 degrees
        (10.0, -3.5, "ahead-right"),
        (-20.0, 3.9, "behind"),
        (-20.0, -3.9, "behind"),
        (-50.0, 4.1, "behind-left"),
        (-10.0, -3.5, "behind-right"),
        (10.0, 21.0, "ahead-left"),  # 64.5 degrees
        (10.0, 22.0, "left"),  # 65.6 degrees
        (10.0, -22.0, "right"),
        (-10.0, 22.0, "left"),
        (-10.0, 21.0, "behind-left"),
        (-10.0, -21.0, "behind-right"),
    ],
)
def test_the_direction_in_which_somebody_is(ahead: float, left: float, word: str) -> None:
    assert aside(seen(ahead, left)) == word


def lane(number: int | None, edge: str = "main") -> RoadPlace:
    return RoadPlace(edge, number, 3, 14.0, False, False)


@pytest.mark.parametrize(
    ("ahead", "left", "mine", "theirs", "word"),
    [
        (40.0, 3.0, lane(1), lane(1), "ahead"),  # the road bends
        (40.0, 0.5, lane(0), lane(1), "ahead-left"),
        (40.0, 0.5, lane(0), lane(2), "ahead-left"),
        (40.0, 0.5, lane(1), lane(0), "ahead-right"),
        (-40.0, 0.5, lane(1), lane(0), "behind-right"),
        (10.0, 3.0, lane(1), lane(1), "ahead-left"),  # so near, it is where it is seen
        (-10.0, 3.0, lane(1), lane(1), "behind-left"),
        (10.1, 3.0, lane(1), lane(1), "ahead"),
        (40.0, 3.0, lane(1), lane(1, "other"), "ahead-left"),
        (40.0, 3.0, lane(None), lane(1), "ahead-left"),
        (40.0, 3.0, lane(1), lane(None), "ahead-left"),
        (40.0, 3.0, None, lane(1), "ahead-left"),
        (40.0, 3.0, lane(1), None, "ahead-left"),
    ],
)
def test_lanes_count_where_both_are_on_one_road_and_apart(
    ahead: float, left: float, mine: RoadPlace | None, theirs: RoadPlace | None, word: str
) -> None:
    assert bearing(seen(ahead, left), mine, theirs) == word


def test_lanes_have_sides() -> None:
    assert lane_side(seen(40.0, 3.0), None, None) == 1
    assert lane_side(seen(40.0, -3.0), None, None) == -1
    assert lane_side(seen(40.0, 0.0), lane(0), lane(2)) == 1
    assert lane_side(seen(40.0, 0.0), lane(2), lane(0)) == -1


def test_a_slanted_eye_turns_what_it_sees() -> None:
    """Heading 30 degrees to the left of east, with someone 20 m along that and 5 m aside."""
    cos, sin = math.cos(math.pi / 6.0), 0.5
    eye = VehicleState((3.0, 4.0), math.pi / 6.0, 0.0, 0.0, 4.0, 1.8)
    place = (3.0 + 20.0 * cos - 5.0 * sin, 4.0 + 20.0 * sin + 5.0 * cos)
    found = offset(eye, VehicleState(place, math.pi / 6.0, 0.0, 0.0, 4.0, 1.8))
    assert (found.ahead, found.left) == pytest.approx((20.0, 5.0))
    assert found.turn == pytest.approx(0.0)


def test_a_vehicle_is_where_its_middle_is() -> None:
    eye = VehicleState((10.0, 5.0), math.pi / 2.0, 0.0, 0.0, 4.0, 1.8)
    other = VehicleState((10.0, 30.0), math.pi, 0.0, 0.0, 10.0, 2.5)
    assert centre(eye) == pytest.approx((10.0, 3.0))
    assert centre(other) == pytest.approx((15.0, 30.0))
    found = offset(eye, other)
    assert (found.ahead, found.left) == pytest.approx((27.0, -5.0))
    assert found.turn == pytest.approx(math.pi / 2.0)
    assert found.clear == 7.0
    assert found.distance == pytest.approx(math.sqrt(27.0**2 + 25.0))


@pytest.mark.parametrize(
    ("turn", "same", "opposite"),
    [(49.0, True, False), (-51.0, False, False), (129.0, False, False), (-131.0, False, True)],
)
def test_which_way_somebody_heads(turn: float, same: bool, opposite: bool) -> None:
    assert seen(9.0, 0.0, turn).same_way is same
    assert seen(9.0, 0.0, turn).opposite is opposite
