"""The facts of the road, against what a plain reading of the net files says."""

import math
import xml.etree.ElementTree as ET
from dataclasses import replace
from functools import cache
from itertools import pairwise

import pytest

from planner.record.light_record import LightCourse, LightPrediction, Showing
from planner.record.places import PriorityFact, RoadFacts, RouteStep
from planner.record.trace import EgoGoal, PlannedAction
from planner.search.decide import decide
from planner.search.inputs import Root
from planner.search.road_facts import place, road_facts
from sim.roads.network import Location, angle_between, point_at
from sim.scene import Signal, VehicleState
from sim.setup.scenario import load
from tests.planner.nets import drawn, lane, on_lane, shipped
from tests.planner.worlds import QUICK, before_end, changing, driven, frame, moment, still

VIEW = 100.0  # [m]
NAMES = ("s1", "s3", "town", "motorway")


@cache
def net(name: str) -> ET.Element:
    return ET.parse(load(name).network).getroot()


def car_lanes(name: str, edge: str) -> list[ET.Element]:
    found = next(x for x in net(name).iter("edge") if x.get("id") == edge)
    return [x for x in found.iter("lane") if "passenger" not in x.get("disallow", "").split()]


def facts(
    name: str,
    lane: str,
    offset: float,
    goal: EgoGoal,
    others: dict[int, tuple[str, float]],
    lights: tuple[LightPrediction, ...] = (),
    kind: str = "car",
) -> RoadFacts:
    """The facts with the ego on a lane, and others by lane and offset; -1 is 1 m before the end."""
    roads = shipped(name)
    here = on_lane(roads, lane, offset)
    scene = {0: VehicleState(here.position, here.heading, 8.0, 0.0, 4.8, 1.8)}
    for vehicle, (where, at) in others.items():
        there = on_lane(roads, where, at)
        state = VehicleState(there.position, there.heading, 8.0, 0.0, 4.8, 1.8)
        scene[vehicle] = replace(state, kind=kind)
    return road_facts(roads, scene, Root(here), (), goal, VIEW, lights)


def goal_of(name: str) -> EgoGoal:
    goal = load(name).goal
    return EgoGoal(goal.edge, goal.position, goal.lane)


@pytest.mark.parametrize("name", NAMES)
def test_places_have_the_lanes_and_limits_of_the_net(name: str) -> None:
    network = shipped(name).network
    for one in network.lanes.values():
        if one.internal:
            continue
        listed = car_lanes(name, one.edge)
        found = place(network, Location(one.id, 0.5 * one.length, 0.0))
        assert (found.edge, found.lanes, found.in_junction) == (one.edge, len(listed), False)
        assert found.lane is not None
        assert listed[found.lane].get("id") == one.id
        assert found.limit == float(listed[found.lane].get("speed", ""))
        assert found.roundabout == one.edge.startswith("ring_")


@pytest.mark.parametrize("name", NAMES)
def test_who_is_inside_a_junction_is_in_no_lane(name: str) -> None:
    network = shipped(name).network
    for one in network.lanes.values():
        link = network.link_via(one.id)
        if link is not None:
            ends = [{x.get("from"), x.get("to")} for x in net(name).iter("edge")]
            beside = set().union(*(both for both in ends if link.junction in both))
            found = place(network, Location(one.id, 0.5 * one.length, 0.0))
            assert found.in_junction == (len(beside - {link.junction}) > 2), one.id
            assert (found.lane is None) == found.in_junction


def test_lanes_that_cars_may_not_use_do_not_count() -> None:
    line = ((0.0, 0.0), (100.0, 0.0))
    network = drawn([lane("road_1", line), lane("road_2", line, 20.0)]).network  # 0 is for bicycles
    found = place(network, Location("road_2", 10.0, 0.0))
    assert (found.lane, found.lanes, found.limit) == (1, 2, 20.0)


@pytest.mark.parametrize(("name", "lane"), [("s1", "main_in_0"), ("town", "west_A3_0")])
def test_the_distance_left_falls_by_what_is_driven(name: str, lane: str) -> None:
    length = shipped(name).network.lanes[lane].length
    found = [facts(name, lane, float(k), goal_of(name), {}) for k in range(1, int(length), 9)]
    left = [x.distance for x in found if x.distance is not None]
    times = [x.free_time for x in found if x.free_time is not None]
    assert len(left) == len(times) == len(found)
    for before, after in pairwise(left):
        assert before - after == pytest.approx(9.0, abs=0.11)
    assert times == sorted(times, reverse=True)
    limit = shipped(name).network.lanes[lane].speed_limit
    assert times[0] - times[-1] == pytest.approx((left[0] - left[-1]) / limit, rel=0.05)
    steps = [x.route[0].distance for x in found]
    for k, step in enumerate(steps):
        assert step == pytest.approx(length - 1.0 - 9.0 * k, abs=1.0)


def test_there_may_be_no_way_to_the_destination() -> None:
    found = facts("s1", "main_out_0", 20.0, EgoGoal("main_in", 10.0, None), {})
    assert (found.distance, found.free_time, found.route) == (None, None, ())


def test_on_the_last_road_only_the_rest_of_it_is_left() -> None:
    found = facts("s1", "main_out_0", 20.0, EgoGoal("main_out", 50.0, None), {})
    assert found.distance == 30.0
    assert found.free_time == pytest.approx(30.0 / 13.89, abs=0.1)


def test_the_light_at_the_end_of_the_last_road_is_ahead() -> None:
    """The destination lies before it, and still its queue may hold us."""
    network = shipped("junction").network
    link = next(one for one in network.links if isinstance(one.control, Signal))
    assert isinstance(link.control, Signal)
    lane = network.lanes[link.from_lane]
    red = (Showing(0.0, "r"),)
    seen = LightPrediction(
        link.control.controller, (link.control.index,), red, (LightCourse(1.0, red),)
    )
    goal = EgoGoal(lane.edge, lane.length - 1.0, None)
    found = facts("junction", lane.id, lane.length - 30.0, goal, {}, (seen,))
    assert found.route == ()
    assert [(one.place, one.distance) for one in found.lights] == [(link.control.index, 30.0)]


def exit_number(name: str, before: str, after: str, arms: dict[str, str]) -> int:
    """Which exit it is, by going round: how many arms lie anticlockwise from one to another."""
    network = shipped(name).network
    centre = [0.0, 0.0] if name == "s3" else [304.0, 104.0]

    def bearing(edge: str, *, end: bool) -> float:
        line = network.edge_lanes(edge)[0].centreline
        x, y = line[-1] if end else line[0]
        return math.atan2(y - centre[1], x - centre[0])

    start = bearing(before, end=True)
    turned = {
        edge: (bearing(edge, end=False) - start) % (2.0 * math.pi) or 2.0 * math.pi
        for edge in arms.values()
    }
    back = arms[before]
    turned[back] = 2.0 * math.pi  # the road back comes last
    return 1 + sorted(turned, key=lambda edge: turned[edge]).index(after)


S3 = {f"{side}_in": f"{side}_out" for side in ("east", "north", "west", "south")}
TOWN = {"C2_D2": "D2_C2", "D1_D2": "D2_D1", "E2_D2": "D2_E2", "D3_D2": "D2_D3"}
ROUND = [
    (name, before, after)
    for name, arms in (("s3", S3), ("town", TOWN))
    for before in arms
    for after in arms.values()
    if after != arms[before]  # no shortest way leads back
]


@pytest.mark.parametrize(("name", "before", "after"), ROUND)
def test_exits_of_a_roundabout_are_counted_round_it(name: str, before: str, after: str) -> None:
    arms = S3 if name == "s3" else TOWN
    found = facts(name, f"{before}_0", -30.0, EgoGoal(after, 20.0, None), {})
    step = found.route[0]
    assert (step.kind, step.exits, step.arms, step.rule) == ("roundabout", 4, 4, "give-way")
    number = exit_number(name, before, after, arms)
    assert step.exit == number
    assert step.turn == {1: "exit-right", 2: "exit-straight", 3: "exit-left"}[number]
    assert step.distance == pytest.approx(30.0, abs=0.1)


def test_within_a_ring_exits_are_counted_from_the_car_on() -> None:
    found = facts("s3", "ring_east_0", 2.0, goal_of("s3"), {})
    (step,) = found.route
    assert (step.kind, step.exit, step.turn, step.rule) == (
        *("roundabout", 1, "exit-right", "priority"),
    )
    assert found.places[0].roundabout
    before = facts("s3", "ring_south_east_0", 2.0, goal_of("s3"), {})
    assert before.route[0].exit == 2
    assert before.route[0].distance > step.distance


def test_the_motorways_bend_and_added_lane_are_no_junctions() -> None:
    found = facts("motorway", "road_0", 100.0, goal_of("motorway"), {})
    assert [step.kind for step in found.route] == ["junction"]
    assert found.route[0].arms == 2
    assert (found.route[0].turn, found.route[0].rule) == ("exit-straight", "priority")
    network = shipped("motorway").network
    left = sum(network.lanes[x].length for x in ("road_0", "exit_lane_1")) - 100.0
    assert found.route[0].distance == pytest.approx(left, abs=10.0)
    assert found.places[0].lanes == 3


def test_equal_is_where_the_net_says_right_before_left() -> None:
    found = facts("town", "west_A3_0", 20.0, goal_of("town"), {})
    rules = [step.rule for step in found.route]
    assert "equal" in rules
    assert len(rules) <= 8
    types = {x.get("id"): x.get("type") for x in net("town").iter("junction")}
    network = shipped("town").network
    assert network.equal == {x for x, kind in types.items() if kind == "right_before_left"}
    assert not any(shipped(name).network.equal for name in ("s1", "s3", "motorway"))


def test_turns_lead_where_the_road_does() -> None:
    for after, turn in (("exit_s", "exit-right"), ("main_out", "exit-straight")):
        found = facts("s1", "main_in_0", 20.0, EgoGoal(after, 10.0, None), {})
        step = found.route[0]
        assert isinstance(step, RouteStep)
        assert (step.kind, step.turn, step.exit, step.exits) == ("junction", turn, None, None)


def bits(name: str, junction: str, kind: str) -> dict[tuple[str, str], set[tuple[str, str]]]:
    """Of each connection (from lane, to edge), those it yields to, or meets; from the file."""
    node = next(x for x in net(name).iter("junction") if x.get("id") == junction)
    ways: list[tuple[str, str]] = []
    for start in node.get("incLanes", "").split():
        for x in net(name).iter("connection"):
            if f"{x.get('from')}_{x.get('fromLane')}" == start:
                ways.append((start, x.get("to", "")))
    rows = {int(x.get("index", "")): x.get(kind, "")[::-1] for x in node.iter("request")}
    return {
        way: {ways[k] for k, bit in enumerate(rows[index]) if bit == "1"}
        for index, way in enumerate(ways)
    }


def answer(name: str, junction: str, mine: tuple[str, str], lane: str) -> str | None:
    """Who goes first, by the matrix in the file: of the ego's way and all from another lane."""
    response, foes = bits(name, junction, "response"), bits(name, junction, "foes")
    back = {
        (f"{x.get('from')}_{x.get('fromLane')}", x.get("to", ""))
        for x in net(name).iter("connection")
        if x.get("dir") == "t"
    }
    found = set()
    for theirs in (way for way in response if way[0] == lane and way not in back):
        if theirs in foes[mine] or mine in foes[theirs]:
            first = {theirs in response[mine]: "vehicle", mine in response[theirs]: "ego"}
            found.add(first.get(True, "depends") if len(first) == 2 else "depends")
    return None if not found else found.pop() if len(found) == 1 else "depends"


JUNCTIONS = [("s1", "J"), *(("town", x) for x in ("A3", "B3", "C3", "D3", "C1", "D1", "D4", "C2"))]


@pytest.mark.parametrize(("name", "junction"), JUNCTIONS)
def test_priority_is_that_of_the_matrix_in_the_file(name: str, junction: str) -> None:
    network = shipped(name).network
    links = [x for x in network.links if x.junction == junction and x.direction != "turnaround"]
    assert links
    lanes = dict.fromkeys(link.from_lane for link in links)
    told = set()
    for link in links:
        edge, after = network.lanes[link.from_lane].edge, network.lanes[link.to_lane].edge
        goal = EgoGoal(after, 0.5 * network.lanes[link.to_lane].length, None)
        others = {
            k: (lane, -8.0) for k, lane in enumerate(lanes, 1) if network.lanes[lane].edge != edge
        }
        found = facts(name, link.from_lane, -10.0, goal, others)
        mine = (link.from_lane, after)
        expected = {k: answer(name, junction, mine, lane) for k, (lane, _) in others.items()}
        known = {k: who for k, who in expected.items() if who is not None}
        assert {fact.vehicle: fact.who for fact in found.priority} == known
        told |= set(known.values())
    assert len(told) > 1


def test_the_rules_between_lanes_are_not_for_people_on_foot() -> None:
    ring = {1: ("ring_east_0", 2.0), 2: ("west_in_0", -20.0)}
    found = facts("s3", "south_in_0", -20.0, goal_of("s3"), ring, kind="pedestrian")
    assert found.priority == ()


def test_who_comes_to_a_roundabout_waits_for_those_in_it() -> None:
    ring = {1: ("ring_east_0", 2.0), 2: ("ring_west_south_0", 2.0), 3: ("west_in_0", -20.0)}
    found = facts("s3", "south_in_0", -20.0, goal_of("s3"), ring)
    assert found.priority == (PriorityFact(1, "vehicle"), PriorityFact(2, "vehicle"))


def test_who_is_in_a_roundabout_goes_before_those_that_come() -> None:
    others = {1: ("east_in_0", -10.0), 2: ("west_in_0", -10.0), 3: ("south_in_0", -10.0)}
    found = facts("s3", "ring_south_east_0", 2.0, goal_of("s3"), others)
    assert found.priority == (PriorityFact(1, "ego"),)


def test_a_decision_records_the_road() -> None:
    line = changing("s1", "main_in_1", "main_in_0", before_end("s1", "main_in_1", 85.0))
    scene = {
        0: still("s1", ("main_in_0",), before_end("s1", "main_in_0", 95.0)),
        1: driven(line, 12.0, [8.0] * 8),
    }
    trace = decide(frame("s1", QUICK), moment("s1", scene, time=2.0)).trace
    assert trace.road is not None
    assert set(trace.road.places) == {0, 1}
    assert trace.road.route[0].distance == pytest.approx(95.0, abs=0.1)
    assert trace.road.places[0].lanes == 2


def test_the_plan_decides_which_way_is_told() -> None:
    roads = shipped("town")
    here = on_lane(roads, "west_A3_0", -40.0)
    scene = {0: VehicleState(here.position, here.heading, 8.0, 0.0, 4.8, 1.8)}
    turns = set()
    for action in ("exit-right", "continue"):
        plan = (PlannedAction(action, 0.0, 1),)
        found = road_facts(roads, scene, Root(here), plan, goal_of("town"), VIEW)
        turns.add(found.route[0].turn)
        assert found.distance is not None
    assert turns == {"exit-right", "exit-straight"}


def test_headings_of_the_oracle_are_right() -> None:
    network = shipped("s3").network
    (_, into), (_, out) = (
        point_at(network.edge_lanes(edge)[0].centreline, 50.0) for edge in ("south_in", "north_out")
    )
    assert abs(angle_between(into, out)) < 0.1
