"""What the predicted way of a vehicle contains."""

from typing import Any

import pytest

from planner.prediction.goals import BRANCHES
from planner.record.trace import GoalPrediction, TrajectoryPrediction
from xavi_dialogue.explain.history.motion import branches_off, foresees, foretold, steps

BRANCH = next(iter(BRANCHES.values()))


def way(*actions: Any, speed: Any = (10.0, 10.0, 10.0)) -> TrajectoryPrediction:
    return TrajectoryPrediction(1.0, actions, ((0.0, 0.0),) * len(speed), speed)


def goal(place: str = "the road") -> GoalPrediction:
    return GoalPrediction("continue", place, "edge", 1.0, 1.0, 1.0, ())


@pytest.mark.parametrize(
    ("speed", "action", "foreseen"),
    [
        ((10, 9, 8.4), "slow-down", True),
        ((10, 9, 8.6), "slow-down", False),
        ((8, 12, 9), "slow-down", False),
        ((8, 9, 9.6), "speed-up", True),
        ((8, 9, 9.4), "speed-up", False),
        ((10, 5, 7), "speed-up", True),
        ((10, 5, 0), "stop", True),
        ((10, 5, 0.13), "give-way", True),
        ((10, 5, 0.2), "stop", False),
        ((0, 0, 0), "stop", True),  # it stands already, and stays
        ((0, 0.1, 5), "stop", False),
        ((0, 5, 0), "stop", True),
        ((10, 10), "continue", True),
        ((10, 10), "exit-straight", True),
        ((10, 10), "exit-left", False),
        ((10, 10), "overtake", False),
    ],
)
def test_changes_of_speed_are_foreseen_by_the_speeds(
    speed: Any, action: Any, foreseen: bool
) -> None:
    assert foresees(way("continue", speed=speed), action) is foreseen


@pytest.mark.parametrize(
    ("actions", "action", "foreseen"),
    [
        (("stop",), "stop", True),
        (("stop",), "give-way", True),
        (("change-left", "continue"), "overtake", True),
        (("change-right",), "overtake", True),
        (("exit-straight",), "continue", True),
        (("exit-left",), "exit-left", True),
        (("exit-left",), "exit-right", False),
    ],
)
def test_other_actions_are_foreseen_by_name(actions: Any, action: Any, foreseen: bool) -> None:
    assert foresees(way(*actions), action) is foreseen
    assert foresees(way(*actions, speed=()), action) is foreseen


def test_without_a_line_only_the_actions_are_known() -> None:
    assert foresees(way("continue", speed=()), "slow-down") is False
    assert foresees(way("stop", speed=()), "slow-down") is False


def test_where_a_road_branches_off_going_on_is_leaving() -> None:
    on, turning = way("change-right", "continue"), way("continue", "exit-right")
    assert branches_off(goal(BRANCH), on)
    assert branches_off(goal(BRANCH), way("continue"))
    assert not branches_off(goal(BRANCH), turning)
    assert not branches_off(goal(BRANCH), way("exit-right", "continue", "stop"))
    assert not branches_off(goal(), on)
    assert steps(goal(BRANCH), on) == ("change-right", "leave")
    assert steps(goal(), on) == ("change-right", "continue")
    for action, there, elsewhere in (
        ("leave", True, False),
        ("continue", False, True),
        ("exit-straight", False, True),
        ("change-right", True, True),
        ("change-left", False, False),
    ):
        assert foretold(goal(BRANCH), on, action) is there  # type: ignore[arg-type]
        assert foretold(goal(), on, action) is elsewhere  # type: ignore[arg-type]
