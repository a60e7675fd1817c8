"""What a rollout comes to that runs out of time before a red light: the exit under way counts."""

import pytest

from planner.motion.forward import Motion
from planner.motion.obstacles import Traffic
from planner.record.trace import Action, EgoGoal
from planner.rollouts.rollout import Leg, Task, take
from planner.rollouts.waypoints import cost_by, cost_left
from tests.planner.crossroads import EAST_WEST, before, crossroads, plan, shown

HORIZON = 60  # steps of 0.2 s
RIGHT_OF_US = EgoGoal("east_out", 100.0, None)  # from the south
HERE = before(60.0, 10.0)


def waited(action: Action, goal: EgoGoal = RIGHT_OF_US) -> Leg:
    """An action before a light that stays red."""
    task = Task(crossroads(), goal, (4.8, 1.8), 0.0, HORIZON, 100.0)
    chosen = plan(HERE, action)
    traffic = Traffic.of((), shown([(0.0, EAST_WEST)]))
    return take(task, chosen, Motion(0.0, 10.0, 0.0), 0, traffic)


def test_an_exit_away_from_the_goal_has_lost_it_while_it_waits() -> None:
    assert waited("exit-right").outcome == "termination"
    assert waited("exit-left").outcome == "dead"
    assert waited("exit-left", EgoGoal("west_out", 100.0, None)).outcome == "termination"


def test_whoever_waits_has_the_rest_of_its_exit_before_it() -> None:
    leg = waited("exit-right")
    assert leg.end.location.lane == "south_in_0"
    assert [lane for lane, _ in leg.ahead][:2] == ["south_in_0", ":south_right_0"]
    first = crossroads().network.lanes["south_in_0"].length - leg.end.location.offset
    assert leg.ahead[0][1] == pytest.approx(first, abs=0.2)


def test_the_rest_of_an_exit_on_the_shortest_way_costs_what_that_way_does() -> None:
    leg, roads = waited("exit-right"), crossroads()
    here = leg.end.location
    assert cost_by(roads, here, leg.ahead, RIGHT_OF_US) == pytest.approx(
        cost_left(roads, here, RIGHT_OF_US), rel=0.02
    )
    assert cost_by(roads, here, (), RIGHT_OF_US) == cost_left(roads, here, RIGHT_OF_US)
