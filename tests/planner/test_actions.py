import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.actions import (
    CLEAR,
    LANE_CHANGE_LENGTH,
    LANE_CHANGE_TIME,
    GiveWay,
    LaneChange,
    LaneFollow,
    Stop,
    Turn,
    expand,
)
from planner.routes import Refusal, onward, straight_on
from planner.trace import ACTIONS, Action
from sim.network import Direction, project
from tests.planner.worlds import VIEW, before_end, goal, link, plan_of, roads, situation

NO_ROUNDABOUT = "there is no roundabout ahead"
NO_JUNCTION = "there is no junction in view ahead"
INSIDE = "it is already inside the junction"
NOT_INSIDE = "lanes are not changed inside a junction"
NO_NEED = "going straight on needs no giving way here"


def reasons(name: str, lane: str, offset: float, speed: float = 8.0) -> dict[Action, str | None]:
    """For each action why it does not apply, None where it does."""
    here = situation(name, lane, offset, speed)
    found = {a: expand(roads(name), here, a, goal(name), VIEW) for a in ACTIONS}
    return {a: x.reason if isinstance(x, Refusal) else None for a, x in found.items()}


@pytest.mark.parametrize(
    ("name", "lane", "away", "refused"),
    [
        (
            "s1",
            "main_in_0",
            70.0,
            {
                "change-right": "there is no lane to the right",
                "exit-left": "its lane does not lead to the left",
                "exit-straight": NO_NEED,
            },
        ),
        (
            "s1",
            "main_in_1",
            70.0,
            {
                "change-left": "there is no lane to the left",
                "exit-right": "its lane does not lead to the right",
                "exit-straight": NO_NEED,
            },
        ),
        (
            "s1",
            "main_in_0",
            VIEW + 10.0,
            {
                "change-right": "there is no lane to the right",
                "exit-left": NO_JUNCTION,
                "exit-right": NO_JUNCTION,
                "exit-straight": NO_JUNCTION,
            },
        ),
        (
            "s1",
            "main_in_0",
            20.0,
            {
                "change-left": "the lane ends too soon to change",
                "change-right": "there is no lane to the right",
                "exit-left": "its lane does not lead to the left",
                "exit-straight": NO_NEED,
                "stop": "it would come to a stop inside the junction",
            },
        ),
        (
            "s2",
            "south_in_0",
            60.0,
            {
                "continue": "a junction comes first, where it has to give way",
                "change-left": "there is no lane to the left",
                "change-right": "there is no lane to the right",
            },
        ),
        (
            "s2",
            "east_out_0",
            60.0,
            {
                "change-left": "there is no lane to the left",
                "change-right": "there is no lane to the right",
                "exit-left": NO_JUNCTION,
                "exit-right": NO_JUNCTION,
                "exit-straight": NO_JUNCTION,
            },
        ),
    ],
)
def test_what_applies_on_a_road(
    name: str, lane: str, away: float, refused: dict[Action, str]
) -> None:
    expected: dict[Action, str | None] = dict.fromkeys(ACTIONS)
    expected |= {"continue-next-exit": NO_ROUNDABOUT, **refused}
    assert reasons(name, lane, before_end(name, lane, away)) == expected


@pytest.mark.parametrize(
    ("name", "lane", "direction", "applicable"),
    [
        ("s1", "main_in_0", "straight", "continue"),
        ("s1", "main_in_0", "right", "exit-right"),
        ("s2", "west_in_0", "left", "exit-left"),
    ],
)
def test_what_applies_inside_a_junction(
    name: str, lane: str, direction: Direction, applicable: Action
) -> None:
    found = reasons(name, link(name, lane, direction).via[-1], 3.0)
    assert [action for action, reason in found.items() if reason is None] == [applicable]
    assert found["change-left"] == found["change-right"] == NOT_INSIDE
    assert found["stop"] == "it must not stop inside a junction"
    if applicable != "continue":
        assert found["continue"] == "it is turning at the junction"
        assert found["exit-straight"] == INSIDE
    else:
        assert found["exit-left"] == found["exit-right"] == INSIDE


@given(st.floats(1.0, 190.0), st.sampled_from(["main_in_0", "main_in_1", "from_s_0", "exit_n_0"]))
def test_some_action_applies_everywhere_on_the_road(offset: float, lane: str) -> None:
    found = reasons("s1", lane, min(offset, before_end("s1", lane, 1.0)))
    assert None in found.values()
    assert all(reason is None or reason.islower() for reason in found.values())


@given(st.floats(0.0, 14.0))
def test_a_lane_change_takes_its_time(speed: float) -> None:
    here = situation("s1", "main_in_0", 20.0, speed)
    plan = plan_of("s1", here, "change-left")
    shortest, longest = LANE_CHANGE_LENGTH
    (change,) = plan.manoeuvres
    assert change == LaneChange(0.0, plan.end, "left")
    assert shortest <= plan.end <= longest
    if shortest < plan.end < longest:
        assert plan.end == pytest.approx(speed * LANE_CHANGE_TIME)
    assert plan.commit == 0.0
    assert plan.changes_lane
    position, _ = plan.path.pose(plan.end + 1.0)
    target = roads("s1").network.lanes["main_in_1"].centreline
    assert abs(project(target, position)[1]) < 0.05
    assert plan.path.lane_at(plan.end)[0] == "main_in_1"


@pytest.mark.parametrize("action", ["exit-left", "exit-right", "exit-straight"])
def test_an_exit_gives_way_turns_and_ends_beyond_the_junction(action: Action) -> None:
    here = situation("s2", "south_in_0", before_end("s2", "south_in_0", 40.0))
    plan = plan_of("s2", here, action)
    follow, wait, turn = plan.manoeuvres
    assert isinstance(follow, LaneFollow)
    assert isinstance(wait, GiveWay)
    assert isinstance(turn, Turn)
    assert turn.direction == action.removeprefix("exit-")
    assert (follow.start, follow.end, turn.start) == (0.0, turn.start, pytest.approx(40.0))
    assert 39.0 <= wait.stop <= turn.start
    assert wait.clear == turn.end
    assert plan.end == turn.end + CLEAR
    assert plan.commit == turn.start
    exit_lane = link("s2", "south_in_0", turn.direction).to_lane
    assert plan.path.lane_at(plan.end) == (exit_lane, turn.end)
    assert plan.goal is None
    foes = link("s2", "south_in_0", turn.direction).yields_to
    assert wait.yields_to == {("J", index) for index in foes}


def test_who_has_priority_does_not_give_way() -> None:
    here = situation("s2", "west_in_0", before_end("s2", "west_in_0", 40.0))
    assert plan_of("s2", here, "exit-right").give_ways == ()
    (waiting,) = plan_of("s2", here, "exit-left").give_ways
    inside = link("s2", "west_in_0", "left")
    assert inside.waits_inside
    length = roads("s2").network.lanes[inside.via[0]].length
    assert waiting.stop == pytest.approx(40.0 + length - 0.5, abs=0.1)


def test_an_action_that_comes_past_the_goal_ends_there() -> None:
    aim = goal("s1")
    here = situation("s1", "main_in_0", before_end("s1", "main_in_0", 60.0))
    plan = plan_of("s1", here, "continue", aim=True)
    through = roads("s1").network.lanes[link("s1", "main_in_0", "straight").via[0]].length
    assert plan.goal == plan.end == pytest.approx(60.0 + through + aim.position, abs=0.1)
    assert plan_of("s1", here, "continue").goal is None
    assert plan_of("s1", here, "change-left", aim=True).goal is None


def test_nothing_reaches_a_goal_that_lies_behind() -> None:
    here = situation("s1", "main_out_0", goal("s1").position + 10.0)
    assert plan_of("s1", here, "continue", aim=True).goal is None


def test_continue_cannot_be_taken_back_by_being_driven() -> None:
    here = situation("s1", "main_in_0", 20.0)
    assert plan_of("s1", here, "continue").commit == math.inf
    stop = plan_of("s1", here, "stop")
    assert stop.stops
    assert stop.manoeuvres == (Stop(0.0),)
    assert stop.commit == math.inf


def test_straight_on_needs_priority() -> None:
    through = straight_on(roads("s1"), "main_in_0")
    assert not isinstance(through, Refusal)
    assert through.to_lane == "main_out_0"
    refused = straight_on(roads("s2"), "south_in_0")
    assert refused == Refusal("a junction comes first, where it has to give way")
    assert isinstance(straight_on(roads("s2"), "east_out_0"), Refusal)


def test_onward_goes_straight_on_as_far_as_asked_or_the_road_goes() -> None:
    network = roads("s1").network
    row = onward(roads("s1"), ("main_in_0",), 250.0)
    through = link("s1", "main_in_0", "straight")
    assert row == ("main_in_0", *through.via, through.to_lane)
    assert onward(roads("s1"), ("main_in_0",), 10.0) == ("main_in_0",)
    everything = onward(roads("s1"), ("main_in_0",), 1e6)
    assert everything == row
    assert sum(network.lanes[lane].length for lane in everything) < 1e6
