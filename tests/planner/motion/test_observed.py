"""What is read off a track, and how it is carried on, on straight roads."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from planner.manoeuvres.actions import Situation
from planner.motion.forward import DT
from planner.motion.obstacles import NOBODY
from planner.motion.tracks import (
    aligned,
    coast,
    drive_on,
    indicating,
    lanes_at,
    leads,
    links_of,
    queued,
)
from sim.roads.network import Location
from sim.scene import VehicleState
from tests.planner.drives import (
    SIZE,
    avenue,
    corner,
    crossing,
    eastward,
    seen,
    standing,
    turned,
)
from tests.planner.nets import drawn, lane, link, on_lane

NO_LINKS: frozenset[tuple[str, int]] = frozenset()


@pytest.mark.parametrize(
    ("speeds", "pace"),
    [
        ([10.0] * 16, 10.5),
        ([10.0] * 15, math.inf),  # not for long enough
        ([12.0] + [10.0] * 15, 12.5),  # it drove faster before
        ([12.0] * 2 + [10.0] * 14, math.inf),  # it has only just slowed down
        ([10.0, 10.4] * 8, 10.9),
        ([10.0, 10.8] * 8, math.inf),  # not steady
        ([3.5] * 16, 4.0),
        ([2.5] * 16, math.inf),  # nobody wants to drive that slowly
    ],
)
def test_who_drives_steadily_wants_to_drive_no_faster(speeds: list[float], pace: float) -> None:
    track = eastward(100.0, speeds)
    assert track.elapsed == len(speeds) - 1
    assert track.pace == pytest.approx(pace)
    assert replace(track, paced=False).pace == math.inf


@pytest.mark.parametrize(
    ("speed", "stands"), [(0.0, True), (1.9, True), (2.1, False), (3.9, False)]
)
def test_who_crawls_now_stands(speed: float, stands: bool) -> None:
    assert eastward(50.0, [9.0, speed]).standing is stands


def test_where_a_vehicle_was_at_a_sample() -> None:
    track = seen([(10.0, 0.2), (12.0, 0.1), (14.0, 0.0)], [9.0, 8.0, 7.0], 0.02)
    (then,) = track.situation(avenue(), 1, 3.5)
    aside: Any = pytest.approx(0.1)
    place = Location("road_0", 12.0, aside)
    assert then == Situation(3.5, (12.0, 0.1), 0.02, 8.0, 0.0, place)


@pytest.mark.parametrize(
    ("signals", "sides"),
    [(("brake", "left"), {"left"}), (("right",), {"right"}), ((), set()), (("brake",), set())],
)
def test_indicators_are_told_from_other_lights(signals: tuple[str, ...], sides: set[str]) -> None:
    assert indicating(VehicleState((0.0, 0.0), 0.0, 0.0, 0.0, 4.0, 2.0, signals=signals)) == sides


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.5, -1.6])
@pytest.mark.parametrize(
    ("place", "before"),
    [
        ((5.0, 0.0), True),
        ((-5.0, 0.0), False),
        ((59.0, 0.0), True),
        ((61.0, 0.0), False),
        ((20.0, 1.9), True),  # each is 2 m wide: they overlap up to 2 m aside
        ((20.0, 2.1), False),
        ((20.0, -1.9), True),
        ((20.0, -2.1), False),
    ],
)
def test_a_leader_is_in_ones_track(place: tuple[float, float], before: bool, angle: float) -> None:
    track = seen([turned((-9.0, 4.0), angle), (0.0, 0.0)], [0.0, 0.0], angle)
    other = seen([(0.0, 0.0), turned(place, angle)], [0.0, 0.0], angle)
    assert leads(track, other) is before


def test_the_width_of_either_counts() -> None:
    track, other = eastward(0.0, [0.0]), eastward(20.0, [0.0], y=2.6)
    assert not leads(track, other)
    assert not leads(replace(track, width=3.1), replace(other, width=2.0))
    assert leads(replace(track, width=3.3), other)
    assert leads(track, replace(other, width=3.3))


def test_those_who_stand_come_before_those_who_drive() -> None:
    speeds = {1: 0.0, 2: 8.0, 4: 1.0, 3: 0.0, 5: 7.0}
    places = {2: 90.0, 3: 40.0, 4: 30.0, 1: 20.0, 5: 5.0}
    tracks = [eastward(places[v], [speed], vehicle=v) for v, speed in speeds.items()]
    assert [track.vehicle for track in queued(tracks)] == [3, 4, 1, 2, 5]


def rival_ways() -> list[tuple[str, float]]:
    """Ways through a junction from x = 100, by the bearing at which they part."""
    return [(":J_0", 0.0), (":K_0", 0.09), (":L_0", -0.3)]


def test_lanes_that_a_pose_may_belong_to() -> None:
    inside = [
        lane(name, [(100.0, 0.0), (110.0, 10.0 * math.tan(angle))], inside=True)
        for name, angle in rival_ways()
    ]
    roads = drawn([lane("in_0", [(0.0, 0.0), (100.0, 0.0)]), *inside])
    # At 105 m the ways lie 0, 0.45 and -1.54 m aside; a rival may be 1 m farther away.
    assert [x.lane for x in lanes_at(roads, (105.0, 0.0), 0.0)] == [":J_0", ":K_0"]
    # At -1.2 m the last one is nearest (0.33 m); the first is 0.87 m farther, the other is not.
    assert [x.lane for x in lanes_at(roads, (105.0, -1.2), -0.1)] == [":L_0", ":J_0"]
    assert [x.lane for x in lanes_at(roads, (100.2, 0.0), 0.0)] == ["in_0"]


def test_a_lane_before_the_junction_counts_unless_one_inside_is_much_nearer() -> None:
    lanes = [
        lane("in_0", [(0.0, 0.0), (100.0, 0.0)]),
        lane(":J_0", [(99.0, 0.6), (110.0, 0.6)], inside=True),
    ]
    roads = drawn(lanes)
    found = {y: [x.lane for x in lanes_at(roads, (99.5, y), 0.0)] for y in (0.4, 0.5)}
    # 0.4 m from the one and 0.2 m from the other; 0.5 m and 0.1 m.
    assert found == {0.4: ["in_0"], 0.5: [":J_0", "in_0"][:1]}


def test_who_turns_sharply_is_looked_for_farther_away() -> None:
    roads = avenue()
    assert [x.lane for x in lanes_at(roads, (50.0, -4.0), 1.2)] == ["road_0"]
    assert lanes_at(roads, (50.0, -4.0), 1.6) == ()
    assert lanes_at(roads, (50.0, -5.5), 0.0) == ()


def test_the_links_of_a_row_of_lanes() -> None:
    roads = crossing()
    assert links_of(roads, ("in_0", ":J_0", ":J2_0", "out_0")) == {("J", 0)}
    assert links_of(roads, ("in_0",)) == NO_LINKS
    ends = [
        lane(f"{name}_0", [(10.0 * k, 0.0), (10.0 * k + 10.0, 0.0)]) for k, name in enumerate("abc")
    ]
    touching = drawn(ends, [link("a_0", "b_0", index=3), link("a_0", "c_0", index=4)])
    assert links_of(touching, ("a_0", "b_0")) == {("J", 3)}


@pytest.mark.parametrize(
    ("speeds", "after"),
    [
        ([5.0], [5.0, 5.0, 5.0]),
        # Half a metre per second in the last second: a tenth more in each step.
        ([2.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.5], [5.6, 5.7, 5.8]),
        ([5.0, 5.1, 5.3], [5.45, 5.6, 5.75]),  # 0.3 in 0.4 s: 0.15 in a step
        ([5.0, 5.0, 5.0, 5.0, 5.0, 5.2], [5.2, 5.2, 5.2]),  # hardly any faster
        ([5.0, 5.0, 5.0, 5.0, 5.0, 5.4], [5.48, 5.56, 5.64]),
        ([9.0, 8.0], [8.0, 8.0, 8.0]),
        ([19.0, 19.7], [20.0, 20.0, 20.0]),  # to the limit
        ([21.0, 22.0], [22.0, 22.0, 22.0]),  # beyond it
    ],
)
def test_speeding_up_goes_on_to_the_limit(speeds: list[float], after: list[float]) -> None:
    motion = coast(avenue(), eastward(100.0, speeds), 3, past=False)
    assert motion.speed.tolist() == pytest.approx([speeds[-1], *after])
    arcs = 100.0 + DT * np.cumsum([0.0, *after])
    assert motion.position[:, 0].tolist() == pytest.approx(arcs.tolist())
    assert motion.position[:, 1].tolist() == pytest.approx([0.0] * 4)


def test_off_the_road_one_goes_on_straight_and_no_faster() -> None:
    track = seen([(50.0, 89.0), (50.0, 90.0)], [4.0, 5.0], math.pi / 2.0)
    motion = coast(avenue(), track, 2, past=False)
    assert motion.position.tolist() == pytest.approx(
        np.array([[50.0, 90.0], [50.0, 91.0], [50.0, 92.0]])
    )
    assert motion.speed.tolist() == [5.0, 5.0, 5.0]
    assert motion.heading.tolist() == pytest.approx([math.pi / 2.0] * 3)
    assert motion.links == NO_LINKS
    assert (motion.vehicle, motion.length, motion.width) == (1, *SIZE)


@pytest.mark.parametrize(
    ("x", "rest"),
    [
        (80.0, 99.5),
        (95.0, 99.5),  # from 5 m/s it takes 25 / 6 = 4.2 m
        (96.0, None),
        (99.8, None),
        (102.0, None),
    ],
)
def test_one_waits_at_a_line_that_one_can_still_stop_at(x: float, rest: float | None) -> None:
    motion = coast(crossing(), eastward(x, [5.0]), 40, past=False)
    assert motion.position[-1, 0] == pytest.approx(rest or x + 40.0)
    assert motion.speed[-1] == (0.0 if rest else 5.0)
    going = motion.position[:, 0] < (rest or 1e3) - 1e-6
    assert np.all(motion.speed[going] == 5.0)
    assert motion.links == {("J", 0)}


def test_without_anybody_to_give_way_to_there_is_no_line() -> None:
    motion = coast(crossing(yields=False), eastward(80.0, [5.0]), 40, past=False)
    assert motion.position[-1, 0] == pytest.approx(120.0)


def test_the_past_of_a_track_comes_before_its_future() -> None:
    track = seen([(60.0 + 10.0 * k, 0.0) for k in range(7)], [10.0] * 7)
    now = coast(crossing(), track, 5, past=False)
    past = coast(crossing(), track, 5, past=True)
    assert now.position[:, 0].tolist() == pytest.approx([120.0 + 2.0 * k for k in range(6)])
    np.testing.assert_allclose(past.position[:6], track.position[:6])
    np.testing.assert_allclose(past.position[6:], now.position)
    assert len(past.speed) == len(past.heading) == 12
    # Of the past, every fifth sample tells a lane: that at 110 m is the exit. Now it is beyond.
    assert now.links == NO_LINKS


def test_a_link_that_was_driven_counts_with_the_past_alone() -> None:
    track = seen([(102.0 + 2.0 * k, 0.0) for k in range(10)], [10.0] * 10)
    assert coast(crossing(), track, 5, past=False).links == NO_LINKS
    assert coast(crossing(), track, 5, past=True).links == {("J", 0)}


def test_of_rival_ways_through_a_junction_the_nearest_was_driven() -> None:
    track = seen([(99.0 + 0.5 * k, 0.0) for k in range(6)], [2.5] * 6)
    assert coast(corner(), track, 3, past=True).links == {("J", 1)}


def test_a_long_vehicle_turns_later() -> None:
    # In a bend of 8 m; its rear is still on the straight road before it.
    (short, long) = (
        drive_on(corner(), on_lane(corner(), ":R_0", 0.0, 5.0), 0, NOBODY, (length, 2.0), 5)[1]
        for length in (2.0, 12.0)
    )
    assert np.all(np.diff(long) < 0.0)
    assert np.all(long[2:] > short[2:] + 0.1)
    assert np.all(np.diff(short) < -0.03)


@pytest.mark.parametrize(
    ("shift", "places"),
    [
        (0, [0.0, 1.0, 2.0]),
        (1, [math.nan, 0.0, 1.0]),
        (-1, [1.0, 2.0, 3.0]),
        (-2, [2.0, 3.0, math.nan]),
        (2, [math.nan, math.nan, 0.0]),
    ],
)
def test_a_motion_is_moved_in_time(shift: int, places: list[float]) -> None:
    track = seen([(float(k), 0.0) for k in range(4)], [7.0] * 4, 0.5)
    one = replace(
        standing(0.0, steps=4),
        position=track.position,
        heading=track.heading,
        speed=track.speed,
        links=frozenset({("J", 1)}),
    )
    moved = aligned(one, shift, 2)
    np.testing.assert_allclose(moved.position[:, 0], places)
    there = ~np.isnan(moved.position[:, 0])
    np.testing.assert_allclose(moved.heading, np.where(there, 0.5, 0.0))
    np.testing.assert_allclose(moved.speed, np.where(there, 7.0, 0.0))
    assert (moved.vehicle, moved.links) == (2, frozenset({("J", 1)}))
