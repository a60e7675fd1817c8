"""Recognition of those who stand behind others, on roads drawn by hand."""

from dataclasses import replace

import numpy as np
import pytest

from planner.record.trace import Settings
from tests.planner.drives import SIZE, avenue, eastward
from tests.planner.prediction.test_recognise_drawn import beliefs, chances


def moved_off(lead: int, follower: int) -> dict[str, float]:
    """Chances of one that stands behind another, which has just driven off, seen for so long."""
    one = eastward(99.0, [0.0] * (lead - 12) + np.linspace(0.0, 4.0, 12).tolist(), vehicle=2)
    other = replace(eastward(88.0, [0.0] * follower), vehicle=1)
    return chances(beliefs(one, other)[1])


def test_what_was_seen_of_others_before_a_track_began_does_not_matter() -> None:
    known = moved_off(30, 30)
    assert moved_off(50, 30) == pytest.approx(known)
    # It has waited for the other: standing does not speak for stopping.
    assert known["stop"] < 0.05
    alone = chances(beliefs(eastward(88.0, [0.0] * 30))[1])
    assert alone["stop"] > 2.0 * known["stop"]


def test_who_stands_at_the_head_of_a_queue_is_expected_to_drive_off() -> None:
    head = eastward(90.0, [0.0] * 20, vehicle=2)
    behind = eastward(83.0, [0.0] * 20)
    going = [b for b in beliefs(head, behind)[1] if b.goal.kind == "continue"]
    motion = going[0].trajectories[0].motion
    assert np.nanmax(motion.position[:, 0]) > 150.0
    assert {(h.vehicle, h.since) for h in going[0].trajectories[0].held_up} == {(2, 40.0)}


def test_a_goal_that_others_keep_one_from_is_driven_to_as_far_as_they_let_it() -> None:
    parked = replace(eastward(60.0, [2.5] * 3), vehicle=2)
    blocked = replace(parked, position=np.tile((60.0, 0.0), (3, 1)), speed=np.full(3, 0.0))
    ego = replace(blocked, vehicle=0)  # nobody knows where it goes: it is taken to stand
    found = beliefs(ego, eastward(30.0, [8.0] * 3))[1]
    (on_,) = [b for b in found if b.goal.kind == "continue"]
    (way,) = on_.trajectories
    assert way.actions == ("continue",)
    assert 45.0 < np.nanmax(way.motion.position[:, 0]) < 60.0 - SIZE[0]
    (stretch,) = way.held_up
    assert stretch.vehicle == 0
    assert stretch.until == pytest.approx(70.2, abs=0.25)


def test_of_ways_that_are_all_blocked_only_the_best_is_expected() -> None:
    steps = np.zeros(3)
    ego = replace(eastward(70.0, steps.tolist(), y=1.75), vehicle=0, width=6.0)  # in both lanes
    planned = Settings(rationality=0.5)
    found = beliefs(ego, eastward(30.0, [8.0] * 3), roads=avenue(), planned=planned)[1]
    (on_,) = [b for b in found if b.goal.kind == "continue"]
    (way,) = on_.trajectories
    assert way.actions == ("continue",)
    assert np.nanmax(way.motion.position[:, 0]) < 70.0 - SIZE[0]


def test_the_ego_is_left_out_and_the_others_keep_their_order() -> None:
    row = [replace(eastward(90.0 - 20.0 * k, [8.0]), vehicle=v) for k, v in enumerate((5, 0, 3))]
    assert list(beliefs(*row)) == [5, 3]


def test_those_behind_are_taken_to_make_room_for_a_lane_change() -> None:
    slower = eastward(100.0, [15.0, 15.0])
    faster = replace(eastward(88.0, [20.0, 20.0], y=3.5), vehicle=2)
    found = beliefs(slower, faster, roads=avenue(), planned=Settings(rationality=0.5))[1]
    ways = {way.actions for b in found if b.goal.kind == "continue" for way in b.trajectories}
    assert ways == {("continue",), ("change-left", "continue")}
