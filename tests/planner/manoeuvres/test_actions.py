import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.manoeuvres.actions import (
    CLEAR,
    COMFORT,
    LANE_CHANGE_LENGTH,
    LANE_CHANGE_TIME,
    ActionPlan,
    GiveWay,
    LaneChange,
    LaneFollow,
    Stop,
    Turn,
    expand,
)
from planner.manoeuvres.plans import KeepClear
from planner.record.trace import ACTIONS, Action, EgoGoal
from planner.roads.routes import Refusal, onward, straight_on
from planner.roads.trajectory import LATERAL_ACCELERATION, Roads
from sim.roads.network import Direction, project
from tests.planner.nets import drawn, lane, on_lane, shipped
from tests.planner.nets import link as link_to
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
            },
        ),
        (
            "s1",
            "main_in_0",
            6.0,
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


@pytest.mark.parametrize(
    ("name", "lane", "away", "speed"),
    [
        ("s2", "south_in_0", 0.1, 0.0),  # past the line, and still before the junction
        ("s2", "south_in_0", 0.2, 0.5),
        ("s2", "south_in_0", 1.0, 1.5),
        ("s2", "west_in_0", 0.1, 0.4),  # comes to rest with the bumper in the junction
    ],
)
def test_who_stands_or_crawls_at_a_line_can_stop_there(
    name: str, lane: str, away: float, speed: float
) -> None:
    assert reasons(name, lane, before_end(name, lane, away), speed)["stop"] is None


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
    follow, room, wait, turn = plan.manoeuvres
    assert isinstance(follow, LaneFollow)
    assert isinstance(room, KeepClear)
    assert (room.stop, room.out) == (pytest.approx(39.5), turn.end)
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
    assert stop.manoeuvres == (Stop(0.0, COMFORT),)
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


ARMS = ("south", "east", "north", "west")  # of s3, in driving order round the ring


@pytest.mark.parametrize("arm", range(4))
@pytest.mark.parametrize("number", [1, 2, 3, 4])
def test_the_nth_exit_of_a_roundabout_is_reached_by_n_actions(arm: int, number: int) -> None:
    ring = shipped("s3")
    out = f"{ARMS[(arm + number) % 4]}_out"
    here, aim = on_lane(ring, f"{ARMS[arm]}_in_0", -40.0), EgoGoal(out, 3.0, None)
    for k in range(number):
        action: Action = "exit-right" if k == number - 1 else "continue-next-exit"
        plan = expand(ring, here, action, aim, VIEW)
        assert isinstance(plan, ActionPlan)
        assert len(plan.give_ways) == (1 if k == 0 else 0)
        assert plan.goal is None or k == number - 1
        lane, begin = plan.path.lane_at(plan.end)
        here = on_lane(ring, lane, plan.end - begin)
    assert plan.goal is not None
    assert lane == f"{out}_0"


def test_a_roundabout_is_entered_by_giving_way_to_those_in_the_ring() -> None:
    ring = shipped("s3")
    plan = expand(ring, on_lane(ring, "south_in_0", -40.0), "continue-next-exit", None, VIEW)
    assert isinstance(plan, ActionPlan)
    follow, room, wait, entry, *around = plan.manoeuvres
    assert isinstance(follow, LaneFollow)
    assert isinstance(room, KeepClear)
    assert isinstance(wait, GiveWay)
    assert isinstance(entry, Turn)
    assert {type(part) for part in around} <= {KeepClear, LaneFollow}
    assert plan.commit == entry.start == pytest.approx(40.0, abs=0.02)
    circling = [x for x in ring.network.links if x.from_lane == "ring_south_0"]
    assert wait.yields_to == {(x.junction, x.index) for x in circling}
    left_behind = next(start for lane, start in plan.path.lanes if lane == "ring_east_0")
    next_exit = next(start for lane, start in plan.path.lanes if lane == "ring_east_north_0")
    assert left_behind < plan.end < next_exit + ring.network.lanes["ring_east_north_0"].length


@pytest.mark.parametrize(
    ("lane", "offset", "applicable"),
    [
        ("south_in_0", -40.0, {"continue-next-exit", "exit-right", "stop"}),
        ("south_in_0", 2.0, {"continue", "stop"}),
        ("ring_east_0", 2.0, {"continue-next-exit", "exit-right"}),
        ("north_out_0", 5.0, {"continue", "stop"}),
    ],
)
def test_what_applies_around_a_roundabout(lane: str, offset: float, applicable: set[str]) -> None:
    ring = shipped("s3")
    here = on_lane(ring, lane, offset)
    found = {action: expand(ring, here, action, None, VIEW) for action in ACTIONS}
    assert {a for a, x in found.items() if isinstance(x, ActionPlan)} - {"stop"} == (
        applicable - {"stop"}
    )
    refused = {a: x.reason for a, x in found.items() if isinstance(x, Refusal)}
    if "continue-next-exit" in applicable:
        assert refused["exit-left"] == "a roundabout is left to the right"
        inside = lane.startswith("ring")
        comes = "an exit of the roundabout" if inside else "a roundabout"
        assert refused["continue"] == f"{comes} comes first"
    else:
        assert refused["continue-next-exit"] == NO_ROUNDABOUT


def merge() -> Roads:
    """A lane that ends beside one that leads on."""
    lanes = [
        lane("on_0", [(0.0, 0.0), (150.0, 0.0)]),
        lane("on_1", [(0.0, 3.5), (150.0, 3.5)]),
        lane("off_0", [(150.0, 3.5), (400.0, 3.5)]),
    ]
    return drawn(lanes, [link_to("on_1", "off_0")])


def test_who_continues_on_a_lane_that_ends_keeps_room_to_leave_it() -> None:
    roads = merge()
    plan = expand(roads, on_lane(roads, "on_0", 60.0), "continue", None, VIEW)
    assert isinstance(plan, ActionPlan)
    there = on_lane(roads, "on_0", 60.0 + plan.end)
    assert isinstance(expand(roads, there, "change-left", None, VIEW), ActionPlan)
    late = on_lane(roads, "on_0", 130.0)
    assert expand(roads, late, "continue", None, VIEW) == Refusal("its lane ends")
    assert isinstance(expand(roads, late, "stop", None, VIEW), ActionPlan)


def test_who_changes_onto_a_lane_that_ends_too_stays_on_the_road() -> None:
    lanes = [lane(f"in_{k}", [(0.0, 3.5 * k), (150.0, 3.5 * k)]) for k in range(3)]
    lanes += [lane("on_0", [(150.0, 0.0), (400.0, 0.0)])]
    roads = drawn(lanes, [link_to("in_0", "on_0")])
    for offset in range(60, 150):
        here = on_lane(roads, "in_1", float(offset))
        plan = expand(roads, here, "change-left", None, VIEW)
        assert isinstance(plan, ActionPlan) == (offset <= 121)  # 3 s at 8 m/s, and 5 m to spare
        if isinstance(plan, ActionPlan):
            assert plan.path.points[np.searchsorted(plan.path.arc, plan.end), 0] <= 150.0
        over = expand(roads, here, "change-right", None, VIEW)  # onto one that leads on
        assert isinstance(over, ActionPlan) == (offset <= 131)


def test_the_lane_that_does_not_lead_there_is_the_reason() -> None:
    lanes = [
        lane("in_0", [(0.0, 0.0), (50.0, 0.0)]),
        lane("in_1", [(0.0, 3.5), (50.0, 3.5)]),
        lane("left_0", [(50.0, 3.5), (60.0, 60.0)]),
        lane("on_0", [(50.0, 0.0), (90.0, 0.0)]),
    ]
    links = [link_to("in_0", "on_0"), link_to("in_1", "left_0", "left")]
    roads = drawn(lanes, links)
    found = expand(roads, on_lane(roads, "in_0", 10.0), "exit-left", None, VIEW)
    assert found == Refusal("its lane does not lead to the left")


def blocks(count: int, *, free: bool) -> Roads:
    """Crossroads in a row, 80 m apart, with a side road to the left at each."""
    lanes, links = [], []
    for k in range(count + 1):
        x = 80.0 * k
        lanes.append(lane(f"b{k}_0", [(x, 0.0), (x + 80.0, 0.0)]))
        lanes.append(lane(f"side{k}_0", [(x + 80.0, 0.0), (x + 80.0, 60.0)]))
        due = () if free else (1,)
        if k < count:
            links.append(link_to(f"b{k}_0", f"b{k + 1}_0", yields_to=due, foes=(1,)))
        links.append(link_to(f"b{k}_0", f"side{k}_0", "left", foes=(1,)))
    return drawn(lanes, links)


@pytest.mark.parametrize("turn", [0, 1, 2, 3])
@pytest.mark.parametrize("free", [True, False])
def test_any_turn_of_a_row_of_blocks_is_reached_one_junction_after_another(
    turn: int, *, free: bool
) -> None:
    roads = blocks(4, free=free)
    here, aim = on_lane(roads, "b0_0", 30.0), EgoGoal(f"side{turn}", 30.0, None)
    straight: Action = "continue" if free else "exit-straight"
    while here.location.lane != f"b{turn}_0":
        plan = expand(roads, here, straight, aim, VIEW)
        assert isinstance(plan, ActionPlan)
        name, begin = plan.path.lane_at(plan.end)
        assert name != here.location.lane
        here = on_lane(roads, name, plan.end - begin)
    assert here.location.lane == f"b{turn}_0"
    plan = expand(roads, here, "exit-left", aim, VIEW)
    assert isinstance(plan, ActionPlan)
    assert plan.path.lane_at(plan.end)[0] == f"side{turn}_0"


def test_a_bend_of_the_road_is_no_junction() -> None:
    lanes = [
        lane("a_0", [(0.0, 0.0), (50.0, 0.0)]),
        lane("b_0", [(50.0, 0.0), (50.0, 50.0)]),
        lane("c_0", [(50.0, 50.0), (120.0, 60.0)]),
        lane("d_0", [(50.0, 50.0), (0.0, 60.0)]),
    ]
    links = [link_to("a_0", "b_0", "left"), link_to("b_0", "c_0", "right")]
    roads = drawn(lanes, [*links, link_to("b_0", "d_0", "left")])
    plan = expand(roads, on_lane(roads, "a_0", 20.0), "exit-right", None, VIEW)
    assert isinstance(plan, ActionPlan)
    assert [type(x) for x in plan.manoeuvres] == [LaneFollow, Turn]
    assert plan.path.lane_at(plan.end)[0] == "c_0"


@pytest.mark.parametrize("speed", [5.0, 14.0, 25.0, 36.0])
@pytest.mark.parametrize("radius", [math.inf, 900.0])
def test_a_lane_change_is_as_long_as_the_speed_needs(speed: float, radius: float) -> None:
    outer = [bend(radius, 10.0 * k, 0.0) for k in range(60)]
    inner = [bend(radius, 10.0 * k, 3.5) for k in range(60)]
    roads = drawn([lane("road_0", outer, 40.0), lane("road_1", inner, 40.0)])
    plan = expand(roads, on_lane(roads, "road_0", 50.0, speed), "change-left", None, VIEW)
    assert isinstance(plan, ActionPlan)
    assert 2.5 * speed <= plan.end <= max(15.0, 5.5 * speed)
    pushed = speed**2 * np.abs(plan.path.curvature[plan.path.arc < plan.end])
    assert np.max(pushed) < 1.1 * LATERAL_ACCELERATION
    line = roads.line(("road_1",))
    away = min(math.dist(plan.path.pose(plan.end + 2.0)[0], point) for point in line.points)
    assert away < 0.6


def bend(radius: float, along: float, aside: float) -> tuple[float, float]:
    """A place beside a bend to the left."""
    if math.isinf(radius):
        return along, aside
    angle = along / radius
    return (radius - aside) * math.sin(angle), radius - (radius - aside) * math.cos(angle)


def exit_lane(long: float) -> Roads:
    """A road at 100 km/h on which a lane opens to the right that alone leads off it."""
    fast = 27.78
    lanes = [
        lane("road_0", ((0.0, 0.0), (200.0, 0.0)), fast),
        lane("wide_1", ((200.0, 0.0), (200.0 + long, 0.0)), fast),
        lane("wide_0", ((200.0, -3.5), (200.0 + long, -3.5)), fast),
        lane("on_0", ((200.0 + long, 0.0), (600.0 + long, 0.0)), fast),
        lane("off_0", ((200.0 + long, -3.5), (400.0 + long, -60.0)), fast),
    ]
    links = [link_to("road_0", "wide_1"), link_to("wide_1", "on_0")]
    links.append(link_to("wide_0", "off_0", index=1))
    return drawn(lanes, links)


@pytest.mark.parametrize("long", [60.0, 165.0, 400.0])
@pytest.mark.parametrize("offset", [0.0, 120.0, 190.0])
def test_who_leaves_by_a_lane_that_opens_keeps_room_to_change_to_it(
    offset: float, long: float
) -> None:
    roads = exit_lane(long)
    here = on_lane(roads, "road_0", offset, 25.0)
    plan = expand(roads, here, "continue", EgoGoal("off", 50.0, None), VIEW)

    assert isinstance(plan, ActionPlan)
    name, begin = plan.path.lane_at(plan.end)
    assert name == "wide_1"
    assert begin + long - plan.end >= min(0.5 * long, 110.0)


def test_at_the_very_end_of_the_road_one_can_still_continue_and_stop() -> None:
    roads = drawn([lane("in_0", [(0.0, 0.0), (50.0, 0.0)])])
    for offset in (45.0, 49.9, 50.0):
        for action in ("continue", "stop"):
            plan = expand(roads, on_lane(roads, "in_0", offset, 10.0), action, None, VIEW)
            assert isinstance(plan, ActionPlan)
            assert 0.0 < plan.end <= plan.path.length
    stopping = plan_of_stop(roads)
    assert stopping.path.length >= 10.0**2 / (2.0 * COMFORT)


def plan_of_stop(roads: Roads) -> ActionPlan:
    plan = expand(roads, on_lane(roads, "in_0", 49.0, 10.0), "stop", None, VIEW)
    assert isinstance(plan, ActionPlan)
    return plan
