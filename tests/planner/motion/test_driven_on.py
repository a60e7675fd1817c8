"""How tracks are carried on along the road, on straight roads."""

import math
from dataclasses import replace

import numpy as np
import pytest

from planner.manoeuvres.actions import Situation
from planner.motion.obstacles import NOBODY, Traffic
from planner.motion.tracks import (
    Observed,
    coast,
    drive_on,
    sample_path,
)
from sim.roads.network import Location
from tests.planner import crossroads
from tests.planner.drives import (
    LENGTH,
    SIZE,
    crossing,
    eastward,
    standing,
)
from tests.planner.nets import drawn, lane


def here(x: float, speed: float, y: float = 0.0) -> Situation:
    return Situation(0.0, (x, y), 0.0, speed, 0.0, Location("in_0", x, y))


def test_driving_on_fills_the_time_to_the_horizon() -> None:
    position, heading, speed, row = drive_on(
        crossing(yields=False), here(10.0, 20.0), 4, NOBODY, SIZE, 14
    )
    assert position[:, 0].tolist() == pytest.approx([10.0 + 4.0 * k for k in range(1, 11)], abs=0.1)
    assert speed.tolist() == pytest.approx([20.0] * 10, abs=0.1)
    assert heading.tolist() == pytest.approx([0.0] * 10)
    # 2 s at 20 m/s and 20 m more: the road up to 70 m, so no lane beyond the first.
    assert row == ("in_0",)


def test_driving_on_ends_with_the_road() -> None:
    position, heading, speed, row = drive_on(
        crossing(yields=False),
        replace(here(390.0, 20.0), location=Location("out_0", 280.0, 0.0)),
        0,
        NOBODY,
        SIZE,
        10,
    )
    there = ~np.isnan(position[:, 0])
    assert position[there, 0].tolist() == pytest.approx([394.0, 398.0, 400.0], abs=0.5)
    assert np.all(there == (np.arange(10) < int(np.sum(there))))
    assert speed[~there].tolist() == heading[~there].tolist() == [0.0] * int(np.sum(~there))
    assert len(heading) == len(speed) == 10
    assert row == ("out_0",)


def test_driving_on_keeps_to_a_pace_and_behind_others() -> None:
    roads = crossing(yields=False)
    _, _, slow, _ = drive_on(roads, here(10.0, 8.0), 0, NOBODY, SIZE, 30, 9.0)
    assert np.max(slow) == pytest.approx(9.0, abs=0.05)
    blocked, _, _, _ = drive_on(roads, here(10.0, 8.0), 0, Traffic.of([standing(60.0)]), SIZE, 90)
    assert 50.0 < np.max(blocked[:, 0]) < 60.0 - LENGTH


@pytest.mark.parametrize("carried", ["driving on", "coasting"])
def test_who_is_aside_is_back_on_the_lane_after_12_m(carried: str) -> None:
    roads = crossing(yields=False)
    if carried == "coasting":
        track: Observed = eastward(10.0, [20.0], y=1.0)
        position = coast(roads, track, 20, past=False).position[1:]
    else:
        position, *_ = drive_on(roads, here(10.0, 20.0, 1.0), 0, NOBODY, SIZE, 20)
    aside = np.interp([16.0, 22.0], position[:, 0], position[:, 1])
    assert aside.tolist() == pytest.approx([0.5, 0.0], abs=0.08)


def test_a_vehicle_points_as_its_path_does_at_its_middle() -> None:
    bend = drawn([lane("bend_0", [(0.0, 0.0), (20.0, 0.0), (20.0, 30.0)])])
    path = bend.line(("bend_0",))
    position, heading = sample_path(path, np.array([5.0, 40.0]), LENGTH)
    assert position[0].tolist() == pytest.approx([5.0, 0.0], abs=0.05)
    assert heading.tolist() == pytest.approx([0.0, math.pi / 2.0], abs=0.05)
    (_, ahead), (_, behind) = (sample_path(path, np.array([19.0]), size) for size in (0.0, 16.0))
    assert behind[0] < ahead[0]


def test_driving_on_looks_as_far_ahead_as_one_may_get() -> None:
    position, _, _, row = drive_on(crossing(yields=False), here(50.0, 20.0), 0, NOBODY, SIZE, 20)
    # 4 s at 20 m/s and 20 m more: up to 150 m.
    assert row == ("in_0", ":J_0", ":J2_0", "out_0")
    assert position[-1, 0] == pytest.approx(130.0, abs=0.1)
    # In 2 s it is 40 m and 20 m more, and no farther: up to 95 m.
    *_, short = drive_on(crossing(yields=False), here(25.0, 20.0), 0, NOBODY, SIZE, 10)
    assert short == ("in_0",)


def test_driving_on_ends_at_a_light_that_stays_red_and_only_there() -> None:
    """Lights count at their lines; signs do not, as they are for those who plan."""
    south = Location("south_in_0", crossroads.ARM - 60.0, 0.0)
    place, heading = crossroads.crossroads().line(("south_in_0",)).pose(south.offset)
    start = Situation(0.0, place, heading, 10.0, 0.0, south)
    reached = {}
    for letters in (crossroads.EAST_WEST, crossroads.NORTH_SOUTH):
        traffic = Traffic.of((), crossroads.shown([(0.0, letters)]))
        position, _, speed, _ = drive_on(crossroads.crossroads(), start, 0, traffic, SIZE, 70)
        there = ~np.isnan(position[:, 0])
        reached[letters] = float(np.max(position[there, 1])), float(speed[there][-1])
    red, green = reached[crossroads.EAST_WEST], reached[crossroads.NORTH_SOUTH]
    assert -crossroads.HALF - 3.0 < red[0] < -crossroads.HALF
    assert red[1] == pytest.approx(0.0, abs=0.1)
    assert green[0] > crossroads.HALF
    assert green[1] > 9.0
