"""Who comes first to where our way meets another's: we drive east at 10 m/s for 6 s, from 20 s on.

Our line is recorded every 0.2 s, that is every 2 m.
"""

import math
from typing import Any

import pytest
from msgspec.structs import replace

from planner.record.trace import (
    SAMPLE_PERIOD,
    GoalPrediction,
    TrajectoryPrediction,
    VehiclePrediction,
)
from tests.explain.answers.given import plan
from tests.explain.answers.imagined import Drive, decided
from xavi_dialogue.explain.answers.expectations import precedence
from xavi_dialogue.explain.answers.expectations.precedence import first, into_our_road, is_apart

OURS = decided(("continue",), Drive(1.0, (10.0,) * 31))


def crossing(x: float, speed: float, *, wait: int = 0, begin: float = -20.0) -> Any:
    """Somebody who drives north across our way at x [m], after some samples at a standstill."""
    count = 40
    ys = [begin] * wait + [begin + SAMPLE_PERIOD * speed * k for k in range(count)]
    speeds = (0.0,) * wait + (speed,) * count
    return TrajectoryPrediction(1.0, ("continue",), tuple((x, y) for y in ys), speeds)


@pytest.mark.parametrize(
    ("way", "who"),
    [
        (crossing(40.0, 10.0), "they"),  # there after 1.8 s, we after 4 s
        (crossing(10.0, 5.0), "we"),
        (crossing(40.0, 4.5), "we"),  # there after 4.0 s, and we after 3.8 s at the latest
        (crossing(40.0, 4.8), "they"),
        (crossing(40.0, 10.0, wait=15), "we"),
        (crossing(80.0, 10.0), "nobody"),  # beyond our line, of 60 m
        (crossing(-5.0, 10.0), "nobody"),
        (crossing(61.9, 10.0), "they"),
        (crossing(62.1, 10.0), "nobody"),
        (crossing(40.0, 0.5), "nobody"),  # it stands
        (crossing(40.0, 10.0, begin=3.0), "nobody"),
        (crossing(40.0, 10.0, begin=-1.9), "they"),
    ],
)
def test_who_is_first_where_the_ways_meet(way: Any, who: str) -> None:
    assert first(OURS, way) == who


def test_without_a_line_nothing_is_known() -> None:
    way = crossing(40.0, 10.0)
    assert first(plan(20.0, "continue"), way) is None
    assert first(OURS, replace(way, path=())) is None
    assert first(OURS, replace(way, speed=())) is None
    assert into_our_road(plan(20.0, "continue"), way) is None


def test_only_drives_of_the_plan_count_and_the_longest_of_them() -> None:
    two = decided(("continue",), Drive(0.5, (10.0,) * 11), Drive(0.5, (10.0,) * 31))
    assert first(two, crossing(40.0, 10.0)) == "they"
    other = replace(OURS, plan=replace_first(OURS, "stop"))
    assert first(other, crossing(40.0, 10.0)) is None
    point = decided(("continue",), Drive(1.0, (10.0,)))
    assert first(point, crossing(0.0, 10.0)) is None
    turned = decided(("continue", "exit-right"), Drive(1.0, (10.0,) * 31))
    assert first(turned, crossing(40.0, 10.0)) == "they"


def replace_first(trace: Any, action: Any) -> Any:
    return (replace(trace.plan[0], action=action),)


def heading(degrees: float, x: float = 30.0, y: float = 0.0, length: float = 8.0) -> Any:
    """A way that ends at a place in a direction."""
    angle = math.radians(degrees)
    steps = [length * k / 4.0 - length for k in range(5)]
    path = tuple((x + s * math.cos(angle), y + s * math.sin(angle)) for s in steps)
    return TrajectoryPrediction(1.0, ("continue",), path, (5.0,) * 5)


@pytest.mark.parametrize(
    ("way", "into"),
    [
        (heading(0.0), True),
        (heading(34.0), True),
        (heading(36.0), False),
        (heading(-34.0), True),
        (heading(180.0), True),  # against us, on our road
        (heading(150.0), True),
        (heading(90.0), False),
        (heading(0.0, y=8.9), True),
        (heading(0.0, y=-8.9), True),
        (heading(0.0, y=9.1), False),
    ],
)
def test_a_way_leads_into_our_road_along_it_and_close_to_it(way: Any, into: bool) -> None:
    assert into_our_road(OURS, way) is into


def test_a_road_may_lead_north() -> None:
    path = tuple((0.0, 2.0 * k) for k in range(31))
    north = replace(OURS, rollouts=(replace(OURS.rollouts[0], path=path),))
    assert into_our_road(north, heading(90.0, x=8.9, y=30.0)) is True
    assert into_our_road(north, heading(90.0, x=9.1, y=30.0)) is False


def test_a_way_that_leads_nowhere_is_not_known() -> None:
    assert into_our_road(OURS, replace(heading(0.0), path=((1.0, 1.0),))) is None
    assert into_our_road(OURS, heading(0.0, length=0.6)) is None
    assert into_our_road(OURS, heading(0.0, length=0.7)) is True
    stands = decided(("continue",), Drive(1.0, (0.1,) * 10))
    assert into_our_road(stands, heading(0.0)) is None


def test_our_road_is_the_way_of_our_next_metres() -> None:
    bend = tuple((2.0 * k, 0.0) for k in range(8)) + tuple((14.0, 2.0 * k) for k in range(1, 20))
    rollouts = (replace(OURS.rollouts[0], path=bend, speed=(10.0,) * len(bend)),)
    bent = replace(OURS, rollouts=rollouts)
    assert into_our_road(bent, heading(0.0)) is True
    assert into_our_road(bent, heading(90.0, x=5.0)) is False


@pytest.mark.parametrize(
    ("place", "apart"),
    [((2.0, 3.0), 3.0), ((-3.0, 4.0), 5.0), ((7.0, -4.0), 5.0), ((4.0, 0.0), 0.0)],
)
def test_a_place_is_as_far_as_the_nearest_point_of_a_line(place: Any, apart: float) -> None:
    assert precedence._apart((0.0, 0.0), (4.0, 0.0), place) == pytest.approx(apart)
    turned = (place[1], place[0])
    assert precedence._apart((0.0, 0.0), (0.0, 4.0), turned) == pytest.approx(apart)
    assert precedence._apart((1.0, 1.0), (1.0, 1.0), (4.0, 5.0)) == pytest.approx(5.0)
    slanted = precedence._apart((0.0, 0.0), (4.0, 4.0), (4.0, 0.0))
    assert slanted == pytest.approx(math.sqrt(8.0))
    away = precedence._apart((1.0, 2.0), (5.0, 2.0), (3.0, 5.0))
    assert away == pytest.approx(3.0)


def expecting(*ways: Any) -> Any:
    """Our decision, with the equally probable ways of a vehicle."""
    goals = tuple(
        GoalPrediction("continue", "the road", "edge", 1.0, 1.0, 1.0 / len(ways), (way,))
        for way in ways
    )
    return replace(OURS, predictions=(VehiclePrediction(1, goals),))


@pytest.mark.parametrize(
    ("ways", "apart"),
    [
        ((crossing(80.0, 10.0),), True),  # beyond our line
        ((crossing(40.0, 10.0),), False),
        ((crossing(40.0, 10.0), crossing(80.0, 10.0)), False),
        ((crossing(40.0, 10.0), *[crossing(80.0, 10.0)] * 11), True),  # 8 %
        ((crossing(80.0, 0.4),), False),  # it stands: where it goes then is not known
    ],
)
def test_whose_ways_hardly_meet_ours_passes_by(ways: Any, apart: bool) -> None:
    assert is_apart(expecting(*ways), 1) is apart


def test_who_drives_ahead_on_our_line_has_joined_it_already() -> None:
    line = tuple((30.0 + 2.0 * k, 0.5) for k in range(31))
    ahead = TrajectoryPrediction(1.0, ("continue",), line, (10.0,) * 31)
    assert is_apart(expecting(ahead), 1)
    back = replace(ahead, path=line[::-1])
    assert not is_apart(expecting(back), 1)


def test_nobody_is_apart_without_a_prediction() -> None:
    assert not is_apart(OURS, 1)


@pytest.mark.parametrize(("degrees", "into"), [(45.0, True), (225.0, True), (-45.0, False)])
def test_a_road_may_lead_anywhere(degrees: float, into: bool) -> None:
    path = tuple((1.5 * k, 1.5 * k) for k in range(31))
    slanted = replace(OURS, rollouts=(replace(OURS.rollouts[0], path=path),))
    assert into_our_road(slanted, heading(degrees, x=20.0, y=20.0)) is into
    assert into_our_road(slanted, heading(45.0, x=26.0, y=14.0)) is True  # 8.5 m beside it
    assert into_our_road(slanted, heading(45.0, x=27.0, y=13.0)) is False


@pytest.mark.parametrize(
    ("way", "before"),
    [
        (crossing(40.0, 10.0), True),  # there after 1.8 s, we after 4 s
        (crossing(50.0, 10.0), True),
        (crossing(60.0, 12.0), False),  # we come 4.2 s later
        (crossing(10.0, 5.0), False),  # behind us
        (crossing(80.0, 10.0), False),
        (crossing(40.0, 0.5), False),
    ],
)
def test_a_way_leads_across_shortly_before_us(way: Any, before: bool) -> None:
    assert precedence.before_us(OURS, way) is before
    assert precedence.before_us(plan(20.0, "continue"), way) is None
    assert precedence.before_us(OURS, replace(way, path=())) is None
    assert precedence.before_us(OURS, replace(way, speed=())) is None
