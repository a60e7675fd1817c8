import math

import pytest

from planner.prediction.goals import PLACES, STOP_PRIOR, goals_in_view
from planner.record.trace import Action, EgoGoal
from planner.roads.trajectory import Roads
from tests.planner.nets import drawn, lane, link, on_lane, shipped
from tests.planner.worlds import VIEW

ARMS = ("south", "east", "north", "west")  # in driving order round the ring


def seen(roads: Roads, name: str, offset: float) -> dict[str, tuple[Action, str]]:
    """Kind and place of the goals in view, by edge; without stopping."""
    goals = goals_in_view(roads, (on_lane(roads, name, offset),), VIEW)
    assert goals[-1].target is None
    assert goals[-1].prior == pytest.approx(STOP_PRIOR)
    assert math.isclose(sum(goal.prior for goal in goals), 1.0)
    return {g.target.edge: (g.kind, g.place) for g in goals if g.target is not None}


@pytest.mark.parametrize("arm", range(4))
@pytest.mark.parametrize("away", [60.0, 3.0])
def test_all_exits_of_a_roundabout_ahead_are_goals_but_the_way_back(arm: int, away: float) -> None:
    exits = [ARMS[(arm + k) % 4] for k in (1, 2, 3)]
    assert seen(shipped("s3"), f"{ARMS[arm]}_in_0", -away) == {
        f"{name}_out": ("exit-right", f"the {which} exit of the roundabout")
        for name, which in zip(exits, ("first", "second", "third"), strict=True)
    }


def test_in_a_roundabout_the_next_exit_comes_first() -> None:
    found = seen(shipped("s3"), "ring_east_north_0", 3.0)
    assert list(found) == ["north_out", "west_out", "south_out", "east_out"]
    assert found["north_out"] == ("exit-right", "the next exit of the roundabout")
    assert found["west_out"] == ("exit-right", "the second exit of the roundabout")


def test_who_is_leaving_a_roundabout_has_one_goal() -> None:
    roads = shipped("s3")
    (out,) = [x for x in roads.network.links if x.to_lane == "north_out_0"]
    assert list(seen(roads, out.via[0], 1.0)) == ["north_out"]


def test_a_roundabout_out_of_view_is_no_goal() -> None:
    assert seen(shipped("s3"), "south_in_0", 1.0) == {
        "south_in": ("continue", PLACES["continue"]),
    }


def fork() -> Roads:
    """A road from which another one parts, both straight on by name, behind a joint."""
    lanes = [
        lane("in_0", [(0.0, 0.0), (50.0, 0.0)], 30.0),
        lane("on_0", [(50.0, 0.0), (51.0, 0.0)], 30.0),
        lane("main_0", [(51.0, 0.0), (400.0, 0.0)], 30.0),
        lane("ramp_0", [(51.0, 0.0), (100.0, -8.0)], 20.0),
    ]
    return drawn(lanes, [link("in_0", "on_0"), link("on_0", "ramp_0"), link("on_0", "main_0")])


def test_of_two_roads_straight_on_the_lesser_one_is_an_exit() -> None:
    assert seen(fork(), "in_0", 10.0) == {
        "ramp": ("exit-right", PLACES["exit-right"]),
        "main": ("continue", PLACES["continue"]),
    }


def test_where_only_the_way_back_leads_on_it_is_a_goal() -> None:
    lanes = [
        lane("there_0", [(0.0, 0.0), (50.0, 0.0)]),
        lane("back_0", [(50.0, 3.5), (0.0, 3.5)]),
    ]
    roads = drawn(lanes, [link("there_0", "back_0", "turnaround")])
    assert seen(roads, "there_0", 10.0) == {"back": ("exit-left", "the way back")}


def test_where_the_road_ends_its_end_is_a_goal() -> None:
    roads = drawn([lane("in_0", [(0.0, 0.0), (50.0, 0.0)])])
    (on, _) = goals_in_view(roads, (on_lane(roads, "in_0", 10.0),), VIEW)
    assert on.target == EgoGoal("in", 49.0, None)


@pytest.mark.parametrize("number", range(4))
def test_a_road_that_branches_off_a_motorway_is_an_exit(number: int) -> None:
    assert seen(shipped("motorway"), f"exit_lane_{number}", -60.0) == {
        "ramp": ("continue", "the exit on the right"),
        "road_on": ("continue", "the road straight on"),
    }


def test_a_way_through_a_junction_that_is_not_for_cars_leads_nowhere() -> None:
    """An internal lane of no link: the link that it belonged to is not for cars."""
    roads = drawn([lane(":J_0_0", [(0.0, 0.0), (20.0, 0.0)], inside=True)])
    assert seen_anywhere(roads, ":J_0_0") == ["stop"]


def seen_anywhere(roads: Roads, name: str) -> list[Action]:
    """The kinds of the goals in view."""
    return [goal.kind for goal in goals_in_view(roads, (on_lane(roads, name, 5.0),), VIEW)]
