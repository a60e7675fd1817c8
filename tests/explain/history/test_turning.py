"""Predicted ways named by the turns and exits that they lead through."""

from typing import Any

import pytest

from planner.record.trace import GoalPrediction, TrajectoryPrediction, VehiclePrediction
from xavi_dialogue.explain.history.turning import by_turns

RING = "the next exit of the roundabout"


def goal(kind: Any, place: str, *ways: Any) -> GoalPrediction:
    found = tuple(TrajectoryPrediction(1.0, actions, (), ()) for actions in ways)
    return GoalPrediction(kind, place, "edge", 1.0, 1.0, 1.0, found)


def actions(*goals: GoalPrediction) -> list[Any]:
    known = by_turns(VehiclePrediction(1, goals))
    return [[way.actions for way in one.trajectories] for one in known.goals]


@pytest.mark.parametrize("kind", ["exit-left", "exit-right", "exit-straight"])
def test_a_vehicle_within_its_turn_takes_it(kind: Any) -> None:
    within = goal(kind, "the road", ("continue",), (kind,))
    assert actions(within) == [[(kind,), (kind,)]]


def test_other_ways_keep_their_actions() -> None:
    on = goal("continue", "the road straight on", ("continue",))
    lane = goal("exit-left", "the road to the left", ("change-left", "exit-left"))
    halt = goal("stop", "where it comes to a stop", ("stop",))
    assert actions(on, lane, halt) == [
        [("continue",)],
        [("change-left", "exit-left")],
        [("stop",)],
    ]


def test_exits_are_counted_from_where_it_may_be_leaving() -> None:
    now = goal("exit-right", "the road to the right", ("exit-right",))
    later = goal("exit-right", RING, ("exit-right",))
    assert actions(now, later) == [[("exit-right",)], [("continue-next-exit", "exit-right")]]
    assert actions(later) == [[("exit-right",)]]
