"""What a motion shows: changes of speed, standstills, turns and changes of lanes."""

import math
import runpy
from typing import Any

import pytest

from xavi_dialogue.explain.history import thresholds
from xavi_dialogue.explain.history.motion import (
    Motion,
    Sighting,
    bends,
)

PERIOD = 0.2  # [s]


def driving(*speeds: float, times: Any = None, heading: Any = None) -> Motion:
    """Straight on, with these speeds [m/s] every 0.2 s or at these times [s]."""
    time = tuple(round(PERIOD * k, 3) for k in range(len(speeds))) if times is None else times
    x, position = 0.0, []
    for k, speed in enumerate(speeds):
        position.append((x, 0.0))
        x += speed * (time[k + 1] - time[k] if k + 1 < len(time) else 0.0)
    return Motion(time, tuple(position), heading or (0.0,) * len(speeds), speeds)


def seen(action: Any, *speeds: float) -> list[tuple[int, int]]:
    """From which sample to which something was seen."""
    found = driving(*speeds).times(action)
    return [(round(s.start / PERIOD), round(s.end / PERIOD)) for s in found]


# --- speed --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("speeds", "slows", "speeds_up"),
    [
        ((10, 10, 10, 9, 8, 7, 7, 7), [(2, 5)], []),
        ((7, 7, 8, 9, 10, 10), [], [(1, 4)]),
        ((10, 8, 8.1, 6, 6), [(0, 3)], []),  # a waver ends nothing
        ((10, 8, 8.2, 6, 6), [(0, 3)], []),
        ((10, 8, 8.4, 6, 6), [(0, 1), (2, 3)], []),
        ((10, 8.4, 9, 9), [(0, 1)], [(1, 2)]),
        ((10, 8.6, 9, 9), [], [(1, 2)]),  # by 1.4 m/s, and not at the end
        ((10, 9.5), [(0, 1)], []),  # it goes on at the end
        ((10, 9.7), [], []),
        ((10, 9.9, 9.9, 9.9, 8), [(3, 4)], []),  # the flat beginning is no part of it
        ((10, 10.1, 10.1, 9), [(2, 3)], []),
        ((10, 9.8, 9.8, 8), [(0, 3)], []),
        ((8, 10, 8), [(1, 2)], [(0, 1)]),
        ((10, 10, 10), [], []),
        ((10,), [], []),
        ((), [], []),
        ((5, 5.1, 5.2, 5.3, 5.4), [], [(1, 4)]),
        ((12, 11, 10, 10.2, 10.2, 12), [(0, 2)], [(2, 5)]),
        ((10, 12, 11.9, 9, 12), [(2, 3)], [(0, 1), (3, 4)]),
        ((10, 8, 8, 8), [(0, 1)], []),
    ],
)
def test_changes_of_speed_are_seen_from_where_they_begin(
    speeds: Any, slows: Any, speeds_up: Any
) -> None:
    assert seen("slow-down", *speeds) == slows
    assert seen("speed-up", *speeds) == speeds_up


@pytest.mark.parametrize(
    ("speeds", "stops"),
    [
        ((5, 3, 0, 0, 0, 2, 4), [(2, 5)]),
        ((5, 0.13, 0, 5), [(1, 3)]),
        ((5, 0.14, 5), []),
        ((5, 0, 0), [(1, 2)]),
        ((0, 0, 5), []),  # it stood when it came into view
        ((5, 0, 5, 0, 0.2), [(1, 2), (3, 4)]),
    ],
)
def test_standstills_are_seen_from_when_it_stands_to_when_it_drives(
    speeds: Any, stops: Any
) -> None:
    assert seen("stop", *speeds) == stops
    assert seen("give-way", *speeds) == stops


def test_what_was_seen_stands_in_order_and_the_last_can_be_asked_for() -> None:
    motion = driving(10, 8, 10, 7)
    assert [s.action for s in motion.sightings()] == ["slow-down", "speed-up", "slow-down"]
    assert motion.last("slow-down") == Sighting("slow-down", 0.4, 0.6)
    assert motion.last("stop") is None
    assert [s.angle for s in motion.sightings()] == [0.0] * 3
    assert motion.sightings()[1].span == (0.2, 0.4)


@pytest.mark.parametrize(
    ("speeds", "trend"),
    [
        ((), None),
        ((10,), "steady"),
        ((5, 3, 0.1), "standing"),
        (tuple(10 + 0.1 * k for k in range(11)), "speeding-up"),  # 0.5 m/s2
        (tuple(10 - 0.1 * k for k in range(11)), "slowing"),
        (tuple(10 + 0.07 * k for k in range(11)), "steady"),  # 0.35 m/s2
        ((14, 13, 12, 11, 10, 10, 10, 10, 10, 10), "steady"),  # for a second
        ((10, 10, 10, 10, 10, 10, 10, 10, 10, 10.5), "speeding-up"),
    ],
)
def test_the_trend_is_of_the_last_second(speeds: Any, trend: Any) -> None:
    assert driving(*speeds).trend == trend


def test_acceleration_is_over_the_neighbours_on_both_sides() -> None:
    assert driving(10, 10.2, 10.6).rate == pytest.approx((1.0, 1.5, 2.0))
    apart = driving(10, 12, 14, times=(0.0, 0.2, 1.2))
    assert apart.rate == pytest.approx((10.0, 0.0, 0.0))  # a second without a sample
    near = driving(10, 12, 14, times=(0.0, 0.2, 0.8))
    assert near.rate == pytest.approx((10.0, 5.0, 2.0 / 0.6))
    assert driving(10).rate == (0.0,)


def test_the_thresholds_are_in_order() -> None:
    table = runpy.run_path(thresholds.__file__)
    rising = ("STANDING", "BEGINNING", "MOVING", "CHANGED")
    assert [table[name] for name in rising] == sorted(table[name] for name in rising)
    assert table["WAVER"] < table["BEGINNING"]
    assert table["BEGUN"] < table["ALONG"] < table["SLANT"] < table["TURNED"]
    assert table["LANE_SHIFT"][0] < table["LANE_SHIFT"][1]
    assert table["BRAKING"] < table["HARD"]
    assert table["SAME_WAY"] < table["OPPOSITE"]
    assert table["SMALL"] < table["BIG"]


# --- parts --------------------------------------------------------------------------------------


def test_a_motion_is_cut_where_it_was_not_seen() -> None:
    whole = driving(1, 2, 3, 4, times=(0.0, 0.2, 0.7, 0.9))
    assert whole.parts() == (whole,)
    cut = driving(1, 2, 3, 4, times=(0.0, 0.2, 0.8, 1.0))
    assert [part.speed for part in cut.parts()] == [(1, 2), (3, 4)]
    assert [part.time for part in cut.parts()] == [(0.0, 0.2), (0.8, 1.0)]
    assert [len(part.position) for part in cut.parts()] == [2, 2]
    assert [len(part.heading) for part in cut.parts()] == [2, 2]
    assert driving().parts() == ()
    braked = driving(10, 10, 5, 5, times=(0.0, 0.2, 0.8, 1.0))
    assert braked.sightings() == ()  # not while it was seen


def test_a_time_picks_samples() -> None:
    motion = driving(1, 2, 3, 4)
    assert motion.until(0.4).speed == (1, 2, 3)
    assert motion.until(0.39).speed == (1, 2)
    assert motion.until(0.39).time == (0.0, 0.2)
    assert motion.until(5.0) is motion
    assert [motion.index(t) for t in (-0.1, 0.0, 0.3, 0.4, 9.0)] == [None, 0, 1, 2, 3]
    assert motion.within(0.2, 0.4) == range(1, 3)
    assert motion.within(0.1, 0.3) == range(1, 2)
    assert motion.within(-1.0, 9.0) == range(4)


def test_the_way_driven_adds_up() -> None:
    assert driving(10, 10, 20).arc == pytest.approx((0.0, 2.0, 4.0))
    assert driving().arc == ()
    headings = driving(1, 1, heading=(3.1, -3.1)).arrays[3]
    assert headings[1] - headings[0] == pytest.approx(2.0 * math.pi - 6.2)


# --- turns and changes of lanes -----------------------------------------------------------------


def along(*legs: tuple[float, float], speed: float = 10.0, begin: float = 0.0) -> Motion:
    """A path of legs: length [m], and by how much [degrees] it bends to the left over it."""
    x, y, angle = 0.0, 0.0, math.radians(begin)
    position, heading = [(x, y)], [angle]
    for length, bend in legs:
        count = round(length / (PERIOD * speed))
        for _ in range(count):
            turn = math.radians(bend) / count
            angle += turn
            x += PERIOD * speed * math.cos(angle - turn / 2.0)
            y += PERIOD * speed * math.sin(angle - turn / 2.0)
            position.append((x, y))
            heading.append(math.remainder(angle, 2.0 * math.pi))
    time = tuple(round(PERIOD * k, 3) for k in range(len(position)))
    return Motion(time, tuple(position), tuple(heading), (speed,) * len(position))


@pytest.mark.parametrize(
    ("legs", "turns"),
    [
        (((40, 0), (16, 90), (40, 0)), [("exit-left", 90)]),
        (((40, 0), (16, -90), (40, 0)), [("exit-right", -90)]),
        (((40, 0), (16, 52), (40, 0)), [("exit-left", 52)]),
        (((40, 0), (16, 48), (40, 0)), []),
        (((40, 0), (100, 90), (40, 0)), []),  # a bend: 40 degrees within 45 m
        (((40, 0), (40, 60), (40, 0)), [("exit-left", 60)]),
        (((40, 0), (16, 90), (60, 0), (16, -90), (40, 0)),
         [("exit-left", 90), ("exit-right", -90)]),
        (((40, 0), (16, 90), (60, 0), (16, 90), (40, 0)), [("exit-left", 90), ("exit-left", 90)]),
        (((16, -90), (40, 0)), [("exit-right", -90)]),
        (((40, 0), (16, 90)), [("exit-left", 90)]),
        (((40, 0), (16, 60), (2, 0), (16, 30), (40, 0)), [("exit-left", 90)]),  # one, in two steps
        (((80, 0),), []),
    ],
)  # fmt: skip
def test_a_turn_is_seen_by_the_heading(legs: Any, turns: Any) -> None:
    found = [s for s in along(*legs).sightings() if s.action.startswith("exit")]
    assert [(s.action, round(math.degrees(s.angle))) for s in found] == turns
    slanted = [s for s in along(*legs, begin=170.0).sightings() if s.action.startswith("exit")]
    assert [s.action for s in slanted] == [action for action, _ in turns]


def test_a_turn_lasts_from_its_first_degrees_to_its_end() -> None:
    (turn,) = along((40, 0), (20, 90), (40, 0)).times("exit-left")
    # 9 degrees a sample: 8 of them are turned by the first sample of the bend, at 4.2 s
    assert (turn.start, turn.end) == (4.2, 6.0)
    (slanted,) = along((40, 0), (20, 90), (40, 0), begin=30.0).times("exit-left")
    assert slanted.span == turn.span
    (flat,) = along((40, 0), (40, 90), (40, 0)).times("exit-left")
    assert flat.start == pytest.approx(4.4)  # 4.5 degrees a sample
    assert flat.end == pytest.approx(8.0, abs=0.21)


def moving_over(left: float, time: float = 3.0, speed: float = 10.0, before: float = 3.0) -> Any:
    """The changes of lanes seen of a path that moves over evenly by so much in a time [s]."""
    count = round((2.0 * before + time) / PERIOD) + 1
    position, heading = [], []
    for k in range(count):
        share = min(max((PERIOD * k - before) / time, 0.0), 1.0)
        rate = left * math.pi / (2.0 * time) * math.sin(math.pi * share)
        position.append((PERIOD * k * speed, left * (1.0 - math.cos(math.pi * share)) / 2.0))
        heading.append(math.atan2(rate, speed))
    times = tuple(round(PERIOD * k, 3) for k in range(count))
    motion = Motion(times, tuple(position), tuple(heading), (speed,) * count)
    return [s.action for s in motion.sightings()], motion


@pytest.mark.parametrize(
    ("left", "time", "seen_"),
    [
        (3.5, 3.0, ["change-left"]),
        (-3.5, 3.0, ["change-right"]),
        (2.3, 3.0, ["change-left"]),
        (2.1, 3.0, []),
        (-2.1, 3.0, []),
        (3.5, 5.8, ["change-left"]),
        (3.5, 20.0, []),  # less than a lane's width within 6 s
        (0.0, 3.0, []),
    ],
)
def test_a_change_of_lanes_is_seen_by_a_lane_s_width(left: float, time: float, seen_: Any) -> None:
    assert moving_over(left, time)[0] == seen_


def test_a_change_of_lanes_lasts_while_it_moves_over() -> None:
    _, motion = moving_over(3.5)
    (change,) = motion.times("change-left")
    assert change.start == pytest.approx(3.0, abs=0.5)
    assert change.end == pytest.approx(5.5, abs=0.5)
    assert motion.times("overtake") == (change,)


@pytest.mark.parametrize("degrees", [30.0, -60.0, 175.0])
def test_a_change_of_lanes_is_seen_whichever_way_the_road_leads(degrees: float) -> None:
    _, motion = moving_over(3.5)
    angle = math.radians(degrees)
    cos, sin = math.cos(angle), math.sin(angle)
    position = tuple((x * cos - y * sin, x * sin + y * cos) for x, y in motion.position)
    heading = tuple(math.remainder(h + angle, 2.0 * math.pi) for h in motion.heading)
    turned = Motion(motion.time, position, heading, motion.speed)
    assert [s.action for s in turned.sightings()] == ["change-left"]
    assert turned.sightings()[0].span == motion.sightings()[0].span


def test_a_change_of_lanes_may_begin_with_the_record_and_end_with_it() -> None:
    _, motion = moving_over(2.3, before=0.0)
    assert [change.span for change in motion.times("change-left")] == [(0.0, 3.0)]


def test_neither_a_bend_nor_a_swing_is_a_change_of_lanes() -> None:
    assert along((20, 0), (60, 30), (20, 0)).sightings() == ()
    there_and_back = along((20, 0), (10, 12), (10, -12), (10, -12), (10, 12), (20, 0))
    assert there_and_back.times("overtake") == ()
    steep = along((20, 0), (4, 40), (4, -40), (20, 0))
    assert steep.times("overtake") == ()
    assert along((4, 0)).sightings() == ()


# --- bearing to a side ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("heading", "found"),
    [
        ((0.0, 0.0, 0.05, 0.12, 0.12), [(1, 3, 0.12)]),
        ((0.0, 0.0, -0.05, -0.12, 0.0), [(1, 3, -0.12), (3, 4, 0.12)]),  # and back again
        ((0.0, 0.03, 0.06, 0.09, 0.09), []),  # too little to be felt
        ((0.0, 0.06, 0.03, 0.09, 0.06), []),  # it wavers
        ((0.0,), []),
    ],
)
def test_bearing_to_a_side_is_a_lasting_change_of_heading(
    heading: tuple[float, ...], found: list[tuple[int, int, float]]
) -> None:
    motion = driving(*(10.0 for _ in heading), heading=heading)
    seen = sorted((round(s.start / PERIOD), round(s.end / PERIOD), s.angle) for s in bends(motion))
    assert [(a, b) for a, b, _ in seen] == [(a, b) for a, b, _ in found]
    assert [c for *_, c in seen] == pytest.approx([c for *_, c in found])
