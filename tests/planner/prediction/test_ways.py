"""Ways to a goal on straight roads, where their costs can be worked out on paper."""

from collections.abc import Sequence

import numpy as np
import pytest

from planner.manoeuvres.actions import Situation
from planner.motion.forward import DT
from planner.motion.obstacles import NOBODY, Obstacle, Traffic
from planner.prediction.astar import Solution, held, ways
from planner.record.trace import EgoGoal
from planner.roads.trajectory import Roads
from planner.rollouts.rollout import Leg, Task
from sim.roads.network import Location
from tests.planner.drives import LENGTH, SIZE, WIDTH, avenue
from tests.planner.nets import drawn, lane

FAST, SLOW = avenue(), avenue(limit=10.0)
GOAL = EgoGoal("road", 300.0, None)
START = 5.0  # [s]
CHANGE = 3.0  # [s] that a lane change costs


def at(x: float, speed: float, y: float = 0.0) -> Situation:
    """On the road, in the lane that is nearest."""
    index = round(y / 3.5)
    place = Location(f"road_{index}", x, y - 3.5 * index)
    return Situation(START, (x, y), 0.0, speed, 0.0, place)


def task(roads: Roads = SLOW, goal: EgoGoal = GOAL, horizon: int = 150) -> Task:
    return Task(roads, goal, SIZE, START, horizon, 100.0, yielding=True)


def found(
    here: Situation, roads: Roads = SLOW, others: Sequence[Obstacle] = (), wanted: int = 9
) -> list[Solution]:
    return ways(task(roads), (here,), Traffic.of(others), wanted)


def ahead(x: float, speed: float, y: float = 0.0, stands: int = 0) -> Obstacle:
    """A vehicle that stands for some steps, and then drives at a speed [m/s]."""
    steps = np.arange(400)
    driven = x + speed * DT * np.maximum(steps - stands, 0)
    place = np.column_stack((driven, np.full(400, y)))
    pace = np.where(steps < stands, 0.0, speed)
    return Obstacle(2, LENGTH, WIDTH, place, np.zeros(400), pace, frozenset())


def test_on_a_free_road_the_way_straight_on_costs_its_time() -> None:
    straight, aside = found(at(100.0, 10.0))
    assert (straight.actions, aside.actions) == (("continue",), ("change-left", "continue"))
    assert straight.cost == pytest.approx(200.0 / 10.0)
    # Moving over by 3.5 m makes the way hardly longer.
    assert aside.cost == pytest.approx(20.0 + CHANGE, abs=0.1)
    assert straight.waits == aside.waits == ()


def test_no_more_ways_are_looked_for_than_are_wanted() -> None:
    assert [way.actions for way in found(at(100.0, 10.0), wanted=1)] == [("continue",)]


def test_nobody_stops_on_the_way_or_changes_back() -> None:
    # From 2 m/s a stop would cost but a few seconds.
    assert [way.actions for way in found(at(100.0, 2.0))] == [
        ("continue",),
        ("change-left", "continue"),
    ]


@pytest.mark.parametrize(
    ("y", "first", "lanes"),
    [
        (0.7, "continue", 0.2),
        (0.7, "change-left", 0.8),
        (-0.7, "continue", 0.2),
        (-0.7, "change-left", 1.2),
        (2.8, "continue", 0.2),
        (2.8, "change-right", 0.8),
        (4.2, "change-right", 1.2),
    ],
)
def test_the_first_action_costs_what_is_left_of_a_lane_change(
    y: float, first: str, lanes: float
) -> None:
    (way,) = [way for way in found(at(100.0, 10.0, y)) if way.actions[0] == first]
    assert way.cost == pytest.approx(20.0 + CHANGE * lanes, abs=0.1)


@pytest.mark.parametrize(("begin", "changes"), [(3, 0), (2, 1), (1, 2), (0, None)])
def test_every_further_lane_costs_the_same_and_three_actions_are_the_most(
    begin: int, changes: int | None
) -> None:
    lanes = [lane(f"road_{k}", [(0.0, 3.5 * k), (900.0, 3.5 * k)], 10.0) for k in range(4)]
    there = task(drawn(lanes), EgoGoal("road", 300.0, 3))
    known = ways(there, (at(100.0, 10.0, 3.5 * begin),), NOBODY, 9)
    if changes is None:
        assert known == []
    else:
        (way,) = known
        assert way.actions == (*["change-left"] * changes, "continue")
        assert way.cost == pytest.approx(20.0 + CHANGE * changes, abs=0.1)


@pytest.mark.parametrize(("y", "speed", "driven"), [(0.5, 20.0, 2), (1.4, 20.0, 1), (1.4, 10.0, 2)])
def test_a_bend_that_no_car_could_drive_is_no_way(y: float, speed: float, driven: int) -> None:
    # Back to the lane within 12 m: at a third of them the bend is 60 y / 12^2 2/27 = 0.031 y [1/m].
    # At 20 m/s that is 6 m/s2 for 0.5 m and 17 m/s2 for 1.4 m; a car cannot do 12.
    roads = FAST if speed > 10.0 else SLOW
    assert len(found(at(100.0, speed, y), roads)) == driven


@pytest.mark.parametrize(("speed", "both"), [(9.0, True), (8.0, False)])
def test_a_way_that_costs_much_more_is_left_out(speed: float, both: bool) -> None:
    # Overtaking takes 14.4 s. Behind the other one arrives 4 m, 2 m and 0.9 s after it:
    # after 20.4 s at 9 m/s, and 22.9 s at 8 m/s. More than 8 s are too much.
    known = found(at(100.0, 20.0), FAST, [ahead(130.0, speed)])
    assert [way.actions for way in known] == [("change-left", "continue"), ("continue",)][
        : 1 + both
    ]
    assert known[0].cost == pytest.approx(14.4, abs=0.1)
    if both:
        assert known[1].cost == pytest.approx((170.0 + 6.0) / 9.0 + 0.9, abs=0.1)
        assert known[1].waits == ()


@pytest.mark.parametrize("speed", [3.0, 10.0])
def test_waiting_is_standing_because_of_another(speed: float) -> None:
    both = [ahead(106.0, speed, stands=25), ahead(106.0, speed, 3.5, stands=25)]
    way = next(
        way
        for way in ways(
            task(goal=EgoGoal("road", 130.0, None)), (at(100.0, 0.0),), Traffic.of(both), 9
        )
        if len(way.actions) == 1
    )
    assert way.waits[:25] == tuple(range(25))
    # Then it takes about 1.3 s to get to 2 m/s, from which on it drives rather than waits.
    assert 25 <= len(way.waits) <= 33


def test_starts_are_tried_alike() -> None:
    both = ways(task(), (at(100.0, 10.0), at(150.0, 10.0, 3.5)), NOBODY, 2)
    assert [way.cost for way in both] == pytest.approx([15.0, 15.0 + CHANGE], abs=0.1)
    assert [way.actions for way in both] == [("continue",), ("change-right", "continue")]


def test_where_no_way_leads_there_is_none() -> None:
    assert ways(task(goal=EgoGoal("road", 50.0, None)), (at(100.0, 10.0),), NOBODY, 2) == []
    assert ways(task(horizon=99), (at(100.0, 10.0),), NOBODY, 2) == []
    assert len(ways(task(horizon=101), (at(100.0, 10.0),), NOBODY, 2)) == 2


def told(legs: Sequence[Leg]) -> list[tuple[str, int, str | None]]:
    return [(leg.action, leg.first, leg.outcome) for leg in legs]


def test_actions_are_held_to_as_far_as_others_let_it_drive() -> None:
    (leg,) = held(task(), (at(100.0, 10.0),), ("continue",), Traffic.of([ahead(150.0, 0.0)]))
    assert leg.outcome == "termination"
    assert leg.position[0].tolist() == [100.0, 0.0]
    assert 140.0 < leg.position[-1, 0] < 150.0 - LENGTH
    assert len(leg.speed) == 151


def test_held_actions_follow_one_another() -> None:
    legs = held(task(), (at(100.0, 10.0),), ("change-left", "continue", "continue"), NOBODY)
    # A change takes 3 s, so 30 m, and ends within the step in which they are driven.
    assert told(legs) == [("change-left", 0, None), ("continue", 15, "done")]
    assert legs[1].position[0].tolist() == pytest.approx(legs[0].position[-1].tolist(), abs=0.01)
    assert legs[0].position[-1].tolist() == pytest.approx([130.0, 3.5], abs=0.5)
    assert legs[1].speed[0] == legs[0].speed[-1]


def test_what_cannot_be_held_to_is_left_out() -> None:
    here, left = at(100.0, 10.0), at(100.0, 10.0, 3.5)
    assert held(task(), (here,), ("change-right", "continue"), NOBODY) == ()
    assert held(task(), (), ("continue",), NOBODY) == ()
    first = held(task(), (here,), ("change-left", "change-left", "continue"), NOBODY)
    assert told(first) == [("change-left", 0, None)]
    other = held(task(), (here, left), ("change-right", "continue"), NOBODY)
    assert told(other) == [("change-right", 0, None), ("continue", 15, "done")]
    assert other[0].position[0].tolist() == [100.0, 3.5]


def test_a_drive_that_ends_in_a_collision_is_not_held_to() -> None:
    blocked = Traffic.of([ahead(107.0, 0.0)])
    near, far = at(100.0, 10.0), at(50.0, 10.0)
    assert held(task(), (near,), ("continue",), blocked) == ()
    # Where it may be farther away as well, it can still brake.
    (leg,) = held(task(), (near, far), ("continue",), blocked)
    assert leg.position[0].tolist() == [50.0, 0.0]
    assert leg.outcome == "termination"
