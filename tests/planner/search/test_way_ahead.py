"""Which crossings for people lie on the ego's way, and how a prediction is recorded."""

from typing import Any

import numpy as np
import pytest

from planner.motion.forward import Motion
from planner.motion.obstacles import Motions, Obstacle
from planner.prediction.recognise import Trajectory
from planner.record.trace import EgoGoal, Settings
from planner.search import decide, recording
from planner.search.inputs import Frame, Moment, Root, root_at
from planner.search.recording import numbers, points
from sim.scene import VehicleState
from tests.planner.drives import avenue
from tests.planner.nets import on_lane
from tests.planner.rollouts.test_legs import plan_of, task
from tests.planner.zebra import zebra

ROADS = zebra()


def ahead(lane: str, x: float, edge: str = "out", view: float = 100.0, plan: Any = None) -> int:
    """How many crossings lie ahead from a place on a lane."""
    frame = Frame(ROADS, EgoGoal(edge, 80.0, None), Settings(view_radius=view), 0, "car")
    here = on_lane(ROADS, lane, x, 8.0)
    under_way = None if plan is None else (plan, Motion(0.0, 8.0, 0.0))
    root = Root(here, under_way)
    return len(decide._crossings_ahead(frame, Moment(0, 0.0, {}, {}, root)))


def test_the_crossing_on_our_way_is_ahead_until_it_is_passed() -> None:
    assert ahead("in_0", 10.0) == 1
    assert ahead(":J_0", 1.0) == 1
    assert ahead("out_0", 5.0) == 0
    assert ahead("in_0", 10.0, edge="in") == 0  # we arrive before it


def test_what_is_under_way_leads_over_what_is_on_its_path() -> None:
    frame = task(ROADS, EgoGoal("out", 80.0, None))
    plan = plan_of(frame, on_lane(ROADS, "in_0", 60.0, 8.0), "continue")
    assert ahead("in_0", 70.0, plan=plan) == 1
    assert ahead("out_0", 70.0, plan=plan) == 0


def test_only_what_is_there_of_a_predicted_motion_is_recorded() -> None:
    """Out of the network there is no place."""
    place = np.array([(0.04, 1.0), (2.06, 1.0), (np.nan, np.nan)])
    gone = Obstacle(1, 4.0, 2.0, place, np.zeros(3), np.array([9.96, 10.04, 0.0]), frozenset())
    way = Trajectory(0.123456789, ("continue",), Motions(gone))
    found = recording._trajectory(way)
    assert found.path == ((0.0, 1.0), (2.1, 1.0))
    assert found.speed == (10.0, 10.0)
    assert found.probability == pytest.approx(0.123457, abs=1e-9)
    assert points(place[:1]) == ((0.0, 1.0),)
    assert numbers(np.array([1.26])) == (1.3,)


@pytest.mark.parametrize(("y", "lane"), [(0.2, "road_0"), (3.4, "road_1"), (40.0, None)])
def test_where_the_ego_is_on_the_road(y: float, lane: str | None) -> None:
    state = VehicleState((50.0, y), 0.0, 9.0, 0.5, 4.8, 1.8)
    found = root_at(avenue(), state, 7.0)
    if lane is None:
        assert found is None
    else:
        assert found is not None
        assert (found.location.lane, found.time, found.speed) == (lane, 7.0, 9.0)
        assert found.acceleration == 0.5
