"""What a path's occupancy means, shown on the plain reference; the kernels agree with it."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.kernels.projection import AFTER, BEFORE, SIDE_MARGIN
from planner.motion.obstacles import Obstacle
from planner.roads.trajectory import Path
from sim.boxes import overlap
from sim.scene import VehicleState
from tests.planner.reference import Occupancy, occupancy
from tests.planner.worlds import LENGTH, SIZE, WIDTH, obstacle, plan_of, roads, row, situation

LANES = row("s1", "main_in_0", "straight")
REACH = 100.0  # [m]


def path() -> Path:
    here = situation("s1", LANES[0], 20.0)
    return roads("s1").path(LANES, here.position, here.heading, 12.0, REACH)


def beside(arc: float, aside: float, turned: float, speed: float = 5.0) -> Obstacle:
    """A body whose centre stands beside the path, turned against it."""
    (x, y), heading = path().pose(arc)
    x, y, angle = x - aside * math.sin(heading), y + aside * math.cos(heading), heading + turned
    front = (x + 0.5 * LENGTH * math.cos(angle), y + 0.5 * LENGTH * math.sin(angle))
    once = np.array([front, front])
    return Obstacle(1, LENGTH, WIDTH, once, np.full(2, angle), np.full(2, speed), frozenset())


def seen(body: Obstacle) -> Occupancy:
    return occupancy(path(), body, SIZE, 0, 0)


@pytest.mark.parametrize(
    ("turned", "low", "high"),
    [
        (0.0, 50.0 - LENGTH / 2.0, 50.0 + LENGTH / 2.0),
        (math.pi, 50.0 - LENGTH / 2.0, 50.0 + LENGTH / 2.0),
        (math.pi / 2.0, 50.0 - WIDTH / 2.0, 50.0 + WIDTH / 2.0),
    ],
)
def test_a_body_on_the_path_takes_its_own_extent(turned: float, low: float, high: float) -> None:
    found = seen(beside(50.0, 0.0, turned))
    assert found.gap(30.0, 0, LENGTH) == pytest.approx(low - 30.0, abs=1e-6)
    assert found.meets(high - 0.1, high + 5.0, 0) == pytest.approx(low, abs=1e-6)
    assert found.meets(high + 0.1, high + 5.0, 0) is None


def test_a_body_that_reaches_in_with_a_corner_takes_that_corner_alone() -> None:
    aside = 3.0  # to the left, turned to the right: the front right corner reaches in
    turned = -math.pi / 4.0
    found = seen(beside(50.0, aside, turned))
    corner = (LENGTH + WIDTH) / 2.0 * math.sqrt(0.5)  # below the centre
    depth = 0.5 * WIDTH + SIDE_MARGIN - (aside - corner)
    tip = 50.0 + (LENGTH - WIDTH) / 2.0 * math.sqrt(0.5)
    assert found.gap(30.0, 0, LENGTH) == pytest.approx(tip - depth - 30.0, abs=1e-6)
    assert found.meets(tip + depth - 0.01, 90.0, 0) is not None
    assert found.meets(tip + depth + 0.01, 90.0, 0) is None


@given(st.floats(45.0, 55.0), st.floats(-5.0, 5.0), st.floats(-math.pi, math.pi))
def test_who_would_be_touched_is_in_the_way(arc: float, aside: float, turned: float) -> None:
    body = beside(arc, aside, turned)
    other = VehicleState(tuple(body.position[0]), body.heading[0], 0.0, 0.0, LENGTH, WIDTH)
    found = seen(body)
    for front in np.arange(42.0, 64.0, 1.0):
        place, heading = path().pose(float(front))
        own = VehicleState(place, heading, 0.0, 0.0, LENGTH, WIDTH)
        if overlap(own, other):
            assert found.meets(float(front) - LENGTH, float(front), 0) is not None


@given(st.floats(45.0, 55.0), st.floats(-6.0, 6.0), st.floats(-math.pi, math.pi))
def test_a_stretch_is_no_longer_than_the_body(arc: float, aside: float, turned: float) -> None:
    found = seen(beside(arc, aside, turned))
    gap = found.gap(0.0, 0, LENGTH)
    if gap is not None:
        diagonal = math.hypot(LENGTH, WIDTH)
        assert arc - diagonal / 2.0 - 1e-6 <= gap <= arc + diagonal / 2.0 + 1e-6


@pytest.mark.parametrize("room", [0.05, -0.1])
def test_a_body_beside_a_bend_is_on_the_path_if_a_side_is_in_the_corridor(room: float) -> None:
    """An oncoming body stands outside a left turn; the path leaves it from its front on."""
    turn = plan_of("s2", situation("s2", "south_in_0", 30.0), "exit-left").path
    arcs = [0.5 * k for k in range(round(2.0 * turn.length))]
    arc = next(a for a in arcs if turn.pose(a)[1] - turn.pose(0.0)[1] > 0.1)
    (x, y), heading = turn.pose(arc)
    aside = 0.5 * WIDTH + SIDE_MARGIN + 0.5 * WIDTH + room
    front = np.array([(x + aside * math.sin(heading), y - aside * math.cos(heading))])
    once, away = (np.array([value]) for value in (heading + math.pi, 0.0))
    body = Obstacle(1, LENGTH, WIDTH, front, once, away, frozenset())
    gap = occupancy(turn, body, SIZE, 0, 0).gap(arc - 5.0, 0, LENGTH)
    assert (gap is None) == (room > 0.0)


def test_who_is_far_aside_or_gone_takes_nothing() -> None:
    for aside in (3.5, -3.5):
        assert seen(beside(50.0, aside, 0.0)).gap(0.0, 0, LENGTH) is None
    gone = beside(50.0, 0.0, 0.0)
    gone.position[:] = np.nan
    assert seen(gone).gap(0.0, 0, LENGTH) is None
    assert seen(gone).meets(0.0, REACH, 0) is None


def test_who_is_behind_is_not_ahead() -> None:
    found = seen(beside(50.0, 0.0, 0.0))
    assert found.gap(54.0, 0, LENGTH) is None
    assert found.follows(51.0, 0)
    assert not found.follows(49.0, 0)


def test_only_who_drives_along_the_path_leads() -> None:
    assert seen(beside(50.0, 0.0, 0.2)).leads(40.0, 0)
    assert not seen(beside(50.0, 0.0, 1.2)).leads(40.0, 0)
    assert not seen(beside(50.0, 0.0, math.pi)).leads(40.0, 0)
    assert not seen(beside(50.0, 0.0, 0.0)).leads(60.0, 0)


def test_its_speed_counts_along_the_path() -> None:
    assert seen(beside(50.0, 0.0, 0.0)).speed_along(0) == pytest.approx(5.0)
    assert seen(beside(50.0, 0.0, math.pi / 3.0)).speed_along(0) == pytest.approx(2.5)
    assert seen(beside(50.0, 0.0, math.pi)).speed_along(0) == 0.0
    assert seen(beside(50.0, 0.0, math.pi)).speed(0) == 5.0


def test_a_gap_must_be_free_a_while_before_and_after() -> None:
    arcs = [20.0 + 10.0 * 0.2 * k for k in range(60)]
    passing = obstacle("s1", LANES, [arc + 20.0 for arc in arcs])
    found = occupancy(path(), passing, SIZE, 0, 50)
    there = [k for k in range(50) if found.meets(45.0, 46.0, k) is not None]
    bare = [k for k in range(50) if arcs[k] > 45.0 and arcs[k] - LENGTH < 46.0]
    assert there == list(range(bare[0] - AFTER, bare[-1] + BEFORE + 1))


def test_how_somebody_is_in_the_way() -> None:
    aside = [3.5] * 5 + [3.5 - 0.35 * k for k in range(11)] + [0.0] * 30
    (x, y), _ = path().pose(40.0)
    where = np.array([(x + 1.0 * k, y + lateral) for k, lateral in enumerate(aside)])
    count = len(aside)
    moving = Obstacle(1, LENGTH, WIDTH, where, np.zeros(count), np.full(count, 5.0), frozenset())
    found = occupancy(path(), moving, SIZE, 0, count)
    assert found.manner(14) == "cut-in"
    assert found.manner(40) == "leader"
    standing = Obstacle(1, LENGTH, WIDTH, where, np.zeros(count), np.zeros(count), frozenset())
    assert occupancy(path(), standing, SIZE, 0, count).manner(40) == "blocked"


@pytest.mark.parametrize("beyond", [4.0, 6.0, 9.0, 12.0, 15.0])
def test_a_long_body_in_a_bend_takes_its_front_and_its_rear(beyond: float) -> None:
    lanes = row("s1", "from_s_0", "right")
    way, length = roads("s1").line(lanes), 12.0
    front = dict(way.lanes)[lanes[1]] + beyond
    place, heading = way.pose(front, length)
    once = np.array([place, place])
    body = Obstacle(1, length, 2.5, once, np.full(2, heading), np.zeros(2), frozenset())
    found = occupancy(way, body, SIZE, 0, 0)
    assert found.meets(front - 1.0, front + 5.0, 0) is not None
    assert found.meets(front + 1.0, front + 5.0, 0) is None
    assert found.gap(front - length - 20.0, 0, LENGTH) == pytest.approx(19.0, abs=1.2)
