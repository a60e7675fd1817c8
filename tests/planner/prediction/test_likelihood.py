"""How much a track costs in excess of the best way to a goal, on straight roads.

Excesses are read off the likelihoods of two goals: the second has none, as it is right ahead.
"""

import math
from collections.abc import Sequence

import numpy as np
import pytest

from planner.motion.obstacles import NOBODY, Obstacle, Traffic
from planner.motion.tracks import Observed
from planner.prediction.goals import Goal
from planner.prediction.likelihood import NO_WAY, UNEXPLAINED, likelihoods
from planner.record.trace import EgoGoal, Settings
from planner.roads.trajectory import Roads
from planner.rollouts.rollout import Task
from tests.planner.drives import LENGTH, SIZE, WIDTH, avenue, crossing, eastward, seen

UP, DOWN = 2.3, 2.0  # [m/s2] how fast everybody speeds up and brakes
SLOW, FAST = avenue(limit=10.0), avenue()
ON = Goal("continue", "the road", EgoGoal("road", 300.0, None), 0.5)
STOP = Goal("stop", "there", None, 0.5)
MILD = Settings(rationality=0.1)


def like(
    track: Observed,
    goals: Sequence[Goal],
    left: Sequence[float | None],
    settings: Settings = MILD,
    roads: Roads = SLOW,
    before: Traffic = NOBODY,
    horizon: int = 150,
) -> list[float]:
    frame = Task(roads, EgoGoal("", 0.0, None), SIZE, 50.0, horizon, 100.0, yielding=True)
    return likelihoods(frame, track, goals, left, before, settings)


def excess(
    track: Observed,
    left: float,
    goal: Goal = ON,
    roads: Roads = SLOW,
    before: Traffic = NOBODY,
    horizon: int = 150,
) -> float:
    """The excess [s] of a goal to which `left` [s] are left."""
    near = goal if goal.target is not None else ON
    one, sure = like(track, [goal, near], [left, -50.0], MILD, roads, before, horizon)
    assert sure == pytest.approx(1.0)
    return -math.log((one - UNEXPLAINED) / (1.0 - UNEXPLAINED)) / MILD.rationality


@pytest.mark.parametrize(("rationality", "late"), [(1.5, 0.4), (1.5, 2.0), (0.1, 5.0)])
def test_a_goal_is_the_less_likely_the_more_the_track_costs(
    rationality: float, late: float
) -> None:
    track = eastward(140.0, [10.0] * 21)  # 4 s; 200 m from its start take 20 s
    settings = Settings(rationality=rationality)
    found = like(track, [ON, ON, ON], [16.0 + late, 16.0, None], settings)
    assert found == pytest.approx([0.97 * math.exp(-rationality * late) + 0.03, 1.0, 0.0])


def test_likelihoods_are_relative_to_the_best() -> None:
    track = eastward(140.0, [10.0] * 21)
    found = like(track, [ON, ON], [19.0, 18.0])
    assert found == pytest.approx([0.97 * math.exp(-0.1) + 0.03, 1.0])
    assert like(track, [ON, STOP], [None, None]) == [0.0, 0.0]


def test_a_goal_that_cannot_be_reached_from_the_start_of_the_track_costs_30_s() -> None:
    behind = Goal("continue", "behind", EgoGoal("road", 50.0, None), 0.5)
    nowhere = Goal("continue", "elsewhere", EgoGoal("road", 1.0, None), 0.5)
    track = eastward(140.0, [10.0] * 21)
    expected = [0.97 * math.exp(-0.1 * 30.0) + 0.03] * 2 + [1.0]
    assert NO_WAY == 30.0
    assert like(track, [behind, nowhere, ON], [1.0, 2.0, 16.0]) == pytest.approx(expected)


@pytest.mark.parametrize(("horizon", "known"), [(162, True), (155, False)])
def test_ways_from_the_start_may_last_until_the_horizon_counted_from_now(
    horizon: int, known: bool
) -> None:
    # 36 s from the start of the track are 180 steps, 20 of them up to now.
    goal = Goal("continue", "far", EgoGoal("road", 460.0, None), 0.5)
    found = excess(eastward(140.0, [10.0] * 21), 33.0, goal, horizon=horizon)
    assert found == pytest.approx(1.0 if known else 0.0, abs=0.01)


def test_driving_slower_than_needed_costs_the_time() -> None:
    # 40 m at 8 m/s take 5 s. From its start 200 m: the speed rises by 2 m/s meanwhile.
    found = excess(eastward(140.0, [8.0] * 26), 17.0)
    assert found == pytest.approx(5.0 + 17.0 - 20.2, abs=0.15)


@pytest.mark.parametrize(
    ("aside", "moved"),
    [
        ([0.0] * 8, 0.0),
        ([0.0, 0.2, 0.25, 0.1, 0.2, 0.0, 0.1, 0.2], 0.0),  # swaying is no movement
        ([0.0, 0.2, 0.4, 0.4, 0.4, 1.0, 1.2, 1.2], 1.0),  # 0.4 and 0.6; the rest is too little
        ([0.0, 1.0, 2.0, 3.0, 3.5, 3.5, 3.5, 3.5], 3.5),
        ([0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], 2.0),
        ([0.0, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0, -1.0], 1.0),
        ([0.0, 0.8, 0.8, 9.0, 9.0, 0.8, 0.8, 0.8], 0.8),  # off the road for a while
    ],
)
def test_moving_sideways_costs_what_a_lane_change_does(aside: list[float], moved: float) -> None:
    # Only every second sample is looked at; what lies between them is far off.
    ys = [y for pair in zip(aside, [50.0] * 8, strict=True) for y in pair]
    track = seen([(110.0 + 2.0 * k, y) for k, y in enumerate(ys)], [10.0] * 16)
    # 3 s up to now, 16.5 s on: half a second more than the 19 s from the start.
    assert excess(track, 16.5) == pytest.approx(0.5 + 3.0 * moved / 3.5, abs=0.01)


def test_only_what_is_moved_on_the_present_road_counts() -> None:
    roads = crossing(yields=False, limit=10.0)
    aside = {90.0: 0.0, 94.0: 1.0, 98.0: 1.0, 102.0: 1.0, 106.0: 0.0, 111.5: 0.0, 115.5: 0.7}
    points = [(x + dx, y) for x, y in aside.items() for dx in (0.0, 2.0)]
    track = seen(points, [10.0] * len(points))
    goal = Goal("continue", "the road", EgoGoal("out", 100.0, None), 0.5)
    # From x = 90 to 210 it is 12 s; 2.6 s up to now. On the exit it moved by 0.7 m: 0.6 s.
    assert excess(track, 10.0, goal, roads) == pytest.approx(0.6 + 0.6, abs=0.02)


def queue(stands: int) -> Traffic:
    """On both lanes one that stands at 100 m for some steps, and then drives off."""
    steps = np.arange(600)
    x = 100.0 + 2.0 * np.maximum(steps - stands, 0)
    pace = np.where(steps < stands, 0.0, 10.0)
    return Traffic.of(
        [
            Obstacle(2 + k, LENGTH, WIDTH, np.column_stack((x, np.full(600, 3.5 * k))),
                     np.zeros(600), pace, frozenset())
            for k in range(2)
        ]
    )  # fmt: skip


BRAKED = [10.0, 10.0, 8.0, 5.0, 2.5]


@pytest.mark.parametrize(
    ("standing", "forgiven"), [(3, 0.0), (4, 0.6), (5, 0.8), (11, 2.0), (21, 4.0)]
)
def test_waiting_for_others_is_not_held_against_a_goal(standing: int, forgiven: float) -> None:
    # Samples at a standstill; up to the first two steps count as driving.
    track = eastward(94.0, BRAKED + [0.0] * standing)
    alone = excess(track, 21.5)
    still = track.elapsed
    assert excess(track, 21.5, before=queue(still)) == pytest.approx(alone - forgiven)
    if forgiven:  # that they will go on standing matters no more
        assert excess(track, 21.5, before=queue(still + 10)) == pytest.approx(alone - forgiven)


def test_who_has_stood_since_it_was_seen_has_waited_too() -> None:
    track = eastward(94.0, [0.0] * 21)
    # On a free road it could have driven off 4 s ago: standing was of its own accord.
    alone = excess(track, 22.7)
    assert alone == pytest.approx(4.0 + 22.7 - 206.0 / 10.0 - 2.4, abs=0.2)
    assert excess(track, 22.7, before=queue(20)) < 0.6


def test_waiting_longer_than_others_do_is_held_against_a_goal() -> None:
    track = eastward(94.0, BRAKED + [0.0] * 21)
    alone = excess(track, 21.5)
    # The others drive off 3 s ago; it takes about 0.7 s until nobody is in the way any more.
    found = excess(track, 21.5, before=queue(track.elapsed - 15))
    assert alone - found == pytest.approx(1.0 + 0.7, abs=0.3)


def quickest(distance: float, speed: float) -> float:
    """The shortest time [s] to come to rest after a distance [m]: speed up, and then brake."""
    peak = math.sqrt((2.0 * distance + speed**2 / UP) / (1.0 / UP + 1.0 / DOWN))
    return (peak - speed) / UP + peak / DOWN


@pytest.mark.parametrize(
    ("speeds", "roads", "expected"),
    [
        # 20 m up to now and 25 m to brake over.
        ([10.0] * 11, FAST, 2.0 + 5.0 - quickest(45.0, 10.0)),
        ([10.0] * 11, SLOW, 0.0),  # no faster way at the limit
        ([12.0] * 11, SLOW, 0.0),  # who drives faster may go on to
        (np.linspace(10.0, 0.0, 26).tolist(), FAST, 0.0),
        (np.linspace(10.0, 0.0, 26).tolist() + [0.0] * 30, FAST, 0.0),  # and stands
        ([1.0] * 11 + [0.0] * 20, FAST, 2.0 - quickest(2.1, 1.0)),
        # 1.17 m in 7.8 s, and 0.006 m more to brake over.
        ([0.15] * 40, FAST, 7.875 - quickest(1.175625, 0.15)),
        # From 0.05 m/s on it counts as standing.
        ([0.15] * 20 + [0.05] * 20, FAST, 3.825 - quickest(0.780625, 0.15)),
    ],
)
def test_stopping_costs_what_it_takes_longer_than_needed(
    speeds: list[float], roads: Roads, expected: float
) -> None:
    track = eastward(140.0, speeds)
    assert excess(track, 5.0, STOP, roads) == pytest.approx(expected, abs=0.01)
