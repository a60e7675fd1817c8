"""One macro action driven, and what came of it, on straight roads."""

import math
from dataclasses import replace

import numpy as np
import pytest

from planner.manoeuvres.actions import ActionPlan, Situation, expand
from planner.motion.forward import DT, Hindrances, Lane, Motion, advance
from planner.motion.obstacles import NOBODY, Obstacle, Traffic
from planner.record.trace import Action, EgoGoal
from planner.roads.routes import Refusal
from planner.roads.trajectory import Roads
from planner.rollouts import rollout
from planner.rollouts.rollout import Leg, Task, summarise, take
from sim.roads.network import Location
from tests.planner.drives import LENGTH, SIZE, WIDTH, avenue, corner, standing
from tests.planner.nets import on_lane

ROAD = avenue(limit=10.0)
GOAL = EgoGoal("road", 300.0, None)
START = 50.0  # [s]


def task(roads: Roads = ROAD, goal: EgoGoal = GOAL, horizon: int = 150) -> Task:
    return Task(roads, goal, SIZE, START, horizon, 100.0)


def at(x: float, speed: float, y: float = 0.0) -> Situation:
    index = round(y / 3.5)
    return Situation(START, (x, y), 0.0, speed, 0.0, Location(f"road_{index}", x, y - 3.5 * index))


def plan_of(frame: Task, here: Situation, action: Action) -> ActionPlan:
    plan = expand(frame.roads, here, action, frame.goal, frame.view)
    assert not isinstance(plan, Refusal), plan.reason
    return plan


def leg(
    frame: Task, here: Situation, action: Action, traffic: Traffic = NOBODY, first: int = 0
) -> Leg:
    return take(frame, plan_of(frame, here, action), Motion(0.0, here.speed, 0.0), first, traffic)


def test_a_leg_ends_where_the_goal_is_passed() -> None:
    found = leg(task(), at(291.0, 10.0), "continue", first=7)
    assert (found.action, found.outcome, found.first) == ("continue", "done", 7)
    assert found.goal_time == pytest.approx(7 * DT + 0.9)
    assert found.position[:, 0].tolist() == pytest.approx(
        [291.0, 293.0, 295.0, 297.0, 299.0, 301.0]
    )
    assert found.speed.tolist() == pytest.approx([10.0] * 6)
    assert (found.lanes, found.collided_with) == (("road_0",), None)
    assert found.end.time == pytest.approx(START + 12 * DT)
    assert found.end.location.offset == pytest.approx(301.0)
    assert found.end.speed == pytest.approx(10.0)
    assert len(found.heading) == len(found.acceleration) == len(found.curvature) == 6


def test_a_leg_that_ends_before_the_goal_leads_on() -> None:
    found = leg(task(), at(100.0, 10.0), "change-left")
    assert (found.outcome, found.goal_time) == (None, None)
    assert found.end.location.lane == "road_1"
    assert found.end.location.lateral == 0.0
    assert found.lanes == ("road_1",)


def test_time_may_run_out() -> None:
    found = leg(task(horizon=20), at(100.0, 10.0), "continue")
    assert (found.outcome, found.goal_time, len(found.speed)) == ("termination", None, 21)
    assert found.end.location.offset == pytest.approx(140.0)


def test_a_collision_ends_a_leg() -> None:
    found = leg(task(), at(100.0, 10.0), "continue", Traffic.of([standing(107.0, vehicle=4)]))
    assert (found.outcome, found.collided_with, found.goal_time) == ("collision", 4, None)
    # Its rear is at 103 m; the brakes cannot help any more.
    assert found.position[-2, 0] < 103.0 <= found.position[-1, 0]
    assert len(found.speed) == len(found.heading) == len(found.curvature) < 5
    assert found.end.location.offset == pytest.approx(found.position[-1, 0])
    assert np.max(found.hindrances.step) < len(found.speed)


def test_who_holds_up_is_told_by_step() -> None:
    found = leg(task(horizon=60), at(100.0, 10.0), "continue",
                Traffic.of([standing(150.0, vehicle=4)]), first=10)  # fmt: skip
    assert set(found.hindrances.vehicle.tolist()) == {4}
    assert set(found.hindrances.speed.tolist()) == {0.0}
    assert 10 < found.hindrances.step[0] < 40
    assert found.hindrances.step[-1] == 59
    assert len(found.speed) == 51


def turning(goal: EgoGoal, action: Action, x: float = 95.0) -> Leg:
    frame = task(corner(), goal)
    return leg(frame, on_lane(frame.roads, "in_0", x, 5.0), action)


def test_who_turns_off_from_the_way_to_the_goal_has_no_way_left() -> None:
    off = turning(EgoGoal("on", 100.0, None), "exit-right")
    assert (off.outcome, off.lanes) == ("dead", ("in_0", ":R_0", "south_0"))
    right = turning(EgoGoal("south", 100.0, None), "exit-right")
    assert right.outcome is None
    assert right.end.location.lane == "south_0"
    past = turning(EgoGoal("south", 2.0, None), "exit-right")
    assert past.outcome == "done"


@pytest.mark.parametrize(("action", "outcome"), [("exit-right", None), ("continue", "dead")])
def test_inside_a_junction_the_road_beyond_counts(action: Action, outcome: str | None) -> None:
    frame = task(corner(), EgoGoal("south", 200.0, None))
    lane = ":R_0" if action == "exit-right" else ":J_0"
    found = leg(frame, on_lane(frame.roads, lane, 1.0, 5.0), action)
    assert found.outcome == outcome


def test_a_goal_in_another_lane_that_is_left_behind_is_out_of_reach() -> None:
    frame = task(goal=EgoGoal("road", 120.0, 1), horizon=150)
    assert leg(frame, at(125.0, 10.0), "change-left").outcome == "dead"


def behind(x: float, speed: float, y: float) -> Traffic:
    steps = np.arange(300)
    place = np.column_stack((x + speed * DT * steps, np.full(300, y)))
    return Traffic.of(
        [Obstacle(3, LENGTH, WIDTH, place, np.zeros(300), np.full(300, speed), frozenset())]
    )


def test_who_moves_in_before_another_hits_it_unless_those_behind_yield() -> None:
    faster = behind(80.0, 16.0, 3.5)
    careless = leg(task(), at(100.0, 10.0), "change-left", faster)
    assert (careless.outcome, careless.collided_with) == ("collision", 3)
    yielding = replace(task(), yielding=True)
    assert leg(yielding, at(100.0, 10.0), "change-left", faster).outcome is None
    # Who stays in its lane is not to blame for who runs into it.
    assert leg(task(), at(100.0, 10.0), "continue", behind(90.0, 16.0, 0.0)).outcome == "done"


def test_a_slower_pace_is_kept() -> None:
    found = leg(replace(task(), pace=7.0), at(100.0, 6.0), "continue")
    assert np.max(found.speed) == pytest.approx(7.0, abs=0.05)


def test_nothing_driven_has_no_components() -> None:
    assert set(summarise(task(), ()).values()) == {0.0}


def test_components_are_those_of_all_legs() -> None:
    frame = task()
    first = leg(frame, at(100.0, 10.0), "change-left")
    after = leg(frame, first.end, "continue", first=len(first.speed) - 1)
    both = summarise(frame, [first, after])
    assert after.outcome == "done"
    assert both["time"] == after.goal_time == pytest.approx(20.0, abs=0.1)
    curvature = np.concatenate((first.curvature, after.curvature))
    assert both["curvature"] == pytest.approx(float(np.mean(np.abs(curvature))))
    # Before the goal it is the time that was driven.
    assert summarise(frame, [first])["time"] == pytest.approx(3.0)
    assert summarise(frame, [first])["curvature"] > both["curvature"]


def test_hindrances_before_a_step() -> None:
    columns = (
        np.array([3, 4, 7]),
        np.array([1, 2, 1]),
        np.array([0, 0, 3]),
        np.array([5.0, 6.0, 0.0]),
    )
    found = Hindrances(*columns).before(7)
    assert found.step.tolist() == [3, 4]
    assert found.vehicle.tolist() == [1, 2]
    assert found.how.tolist() == [0, 0]
    assert found.speed.tolist() == [5.0, 6.0]
    assert Hindrances(*columns).before(8).how.tolist() == [0, 0, 3]


@pytest.mark.parametrize(
    ("arc", "speed"),
    [(0.0, 20.0), (50.9, math.sqrt(200.0)), (75.0, 10.0), (75.9, 10.0), (100.0, 0.0), (1e6, 0.0)],
)
def test_where_a_path_ends_one_can_stop_comfortably(arc: float, speed: float) -> None:
    # Every metre, at 2 m/s2: sqrt(2 x 2 x 25 m) = 10 m/s.
    path = avenue().path(("road_0",), (0.0, 0.0), 0.0, 12.0, 200.0)
    assert Lane(path, 100.0).speed(arc) == pytest.approx(speed, abs=1e-6)
    assert Lane(path).speed(arc) == pytest.approx(20.0)


@pytest.mark.parametrize(
    ("acceleration", "dt", "arc", "speed"),
    [(2.0, 0.5, 5.25, 5.0), (-2.0, 1.0, 6.0, 2.0), (-10.0, 1.0, 5.0, 0.0), (0.0, 1.0, 7.0, 4.0)],
)
def test_moving_on_at_constant_acceleration(
    acceleration: float, dt: float, arc: float, speed: float
) -> None:
    # From 3 m at 4 m/s; the mean of both speeds is driven.
    found = advance(Motion(3.0, 4.0, 9.0), acceleration, dt)
    assert (found.arc, found.speed) == pytest.approx((arc, speed))
    assert found.acceleration == acceleration


@pytest.mark.parametrize(("turn", "place", "matters"), [
    (math.pi / 2.0, (0.0, 10.0), True), (math.pi / 2.0, (0.0, -10.0), False),
    (math.pi / 2.0, (10.0, -1.0), False), (0.0, (10.0, -30.0), True), (math.pi, (10.0, 0.0), False),
])  # fmt: skip
def test_who_brakes_behind_us_on_an_open_road_makes_no_difference(
    turn: float, place: tuple[float, float], matters: bool
) -> None:
    """We stand at (0, 0) and head some way; somebody brakes at a place."""
    traffic = Traffic.of([standing(*place)])
    traffic = replace(traffic, braking=np.array([True]))
    ours = np.array([[0.0, 0.0, turn, 0.0]])
    open_road = plan_of(task(), at(50.0, 10.0), "continue")
    assert not open_road.lines
    assert rollout._matters(open_road, ours, 0, traffic) is matters
    calm = replace(traffic, braking=np.array([False]))
    assert rollout._matters(open_road, ours, 0, calm) is False
