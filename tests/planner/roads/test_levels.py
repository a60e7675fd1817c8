"""Bridges: who drives above or below the ego's road is not in its way."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from planner.driving.walkers import with_walkers
from planner.manoeuvres.actions import ActionPlan, expand
from planner.manoeuvres.clearance import first_touch
from planner.motion.forward import Motion
from planner.motion.obstacles import Obstacle, Traffic, occupancy
from planner.motion.tracks import lanes_at
from planner.record.trace import EgoGoal
from planner.roads.levels import Levels
from planner.roads.routes import Refusal
from planner.roads.trajectory import Roads
from planner.rollouts.rollout import Leg, Task, take
from sim.roads.network import Lane, Link, Network
from sim.scene import Point, VehicleState
from tests.planner.nets import drawn, lane, link, on_lane

SIZE = (4.8, 1.8)
NORTH = math.pi / 2.0
STEPS = 120
EAST = lane("east_0", [(0.0, 0.0), (300.0, 0.0)])
BRIDGE: list[Point] = [(100.0, -100.0), (100.0, 100.0)]
OVER = lane("over_0", BRIDGE)


def crossing(degrees: float) -> Lane:
    """A lane that crosses the road east at x = 100 m at an angle."""
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lane("over_0", [(100.0 - 90.0 * cos, -90.0 * sin), (100.0 + 90.0 * cos, 90.0 * sin)])


def body(
    x: float, y: float, heading: float, speed: float = 0.0, *, on_foot: bool = False
) -> Obstacle:
    """Vehicle 1, or somebody on foot, who goes straight on from a place [m]."""
    arcs = 0.2 * speed * np.arange(STEPS, dtype=np.float64)
    position = np.column_stack((x + arcs * math.cos(heading), y + arcs * math.sin(heading)))
    heading_of, speed_of = np.full(STEPS, heading), np.full(STEPS, speed)
    size = (0.3, 0.5) if on_foot else SIZE
    return Obstacle(1, *size, position, heading_of, speed_of, frozenset(), on_foot=on_foot)


def plan_on(roads: Roads, name: str = "east_0", at: float = 50.0) -> ActionPlan:
    """The plan to go on from a place [m] on a lane."""
    found = expand(roads, on_lane(roads, name, at, 10.0), "continue", None, 100.0)
    assert not isinstance(found, Refusal), found.reason
    return found


def driven(roads: Roads, *others: Obstacle) -> Leg:
    """The drive east from x = 50 m at 10 m/s, among others who react."""
    task = Task(roads, EgoGoal("east", 200.0, None), SIZE, 0.0, STEPS - 41, 100.0, reacting=True)
    plan = plan_on(roads)
    return take(task, plan, Motion(0.0, 10.0, 0.0), 0, Traffic.of(others))


@pytest.mark.parametrize("degrees", [90.0, 50.0, 20.0, 130.0, 160.0])
def test_who_stands_on_a_bridge_holds_nobody_up_below(degrees: float) -> None:
    roads = drawn([EAST, crossing(degrees)])
    cos, sin = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    alone = driven(roads)
    for away in (-4.0, 0.0, 2.0, 5.0):
        other = body(100.0 + away * cos, away * sin, math.radians(degrees))
        leg = driven(roads, other)
        assert leg.collided_with is None
        assert len(leg.hindrances.step) == 0
        np.testing.assert_array_equal(leg.speed, alone.speed)


def test_who_stands_on_the_road_itself_does() -> None:
    for heading in (0.0, math.pi, NORTH):  # the last one is off the bridge
        leg = driven(drawn([EAST, OVER]), body(130.0 if heading == NORTH else 100.0, 1.0, heading))
        assert len(leg.hindrances.step) > 0
    assert len(driven(drawn([EAST]), body(100.0, 2.0, NORTH)).hindrances.step) > 0


def test_who_drives_over_a_bridge_does_not_brake_for_who_is_below() -> None:
    roads = drawn([EAST, OVER])
    path = plan_on(roads).path
    own = np.column_stack((np.full(60, 102.0), np.zeros(60), np.zeros(60), np.zeros(60)))
    traffic = Traffic.of([body(100.0, -60.0, NORTH, 13.0)])
    assert traffic.reacting(own, SIZE, 0, path).states is traffic.states
    flat = plan_on(drawn([EAST])).path
    assert traffic.reacting(own, SIZE, 0, flat).braking.tolist() == [True]


def test_who_stands_above_is_not_touched() -> None:
    ego = VehicleState((50.0, 0.0), 0.0, 5.0, 0.0, *SIZE)
    above = VehicleState((100.0, 2.0), NORTH, 0.0, 0.0, *SIZE)
    path = plan_on(drawn([EAST, OVER])).path
    assert first_touch(path, 0.0, 80.0, ego, {1: above}) is None
    assert first_touch(plan_on(drawn([EAST])).path, 0.0, 80.0, ego, {1: above}) is not None


def pavement(name: str, points: Sequence[Point]) -> Lane:
    """A lane for people on foot."""
    return replace(lane(name, points), permits=frozenset({"pedestrian"}))


def test_people_who_walk_over_a_bridge_are_not_waited_for() -> None:
    network = Network({"east_0": EAST}, (), "x", other_lanes={"p_0": pavement("p_0", BRIDGE)})
    ego = VehicleState((50.0, 0.0), 0.0, 5.0, 0.0, *SIZE)
    for heading in (NORTH, -NORTH):
        seen = [body(100.0, -1.55 * math.sin(heading), heading, 1.3, on_foot=True)]
        assert with_walkers(plan_on(Roads(network)), Roads(network), seen, ego)[1] == []
        assert with_walkers(plan_on(drawn([EAST])), drawn([EAST]), seen, ego)[1] != []
        # People who walk beneath a bridge for cars are on the road there.
        assert with_walkers(plan_on(drawn([EAST, OVER])), drawn([EAST, OVER]), seen, ego)[1] != []


def junction_below() -> tuple[list[Lane], list[Link]]:
    """A road that the road east crosses at a junction, where somebody drives north as well."""
    lanes = [
        lane("west_0", [(0.0, 0.0), (90.0, 0.0)]),
        lane(":J_0_0", [(90.0, 0.0), (110.0, 0.0)], inside=True),
        lane("out_0", [(110.0, 0.0), (300.0, 0.0)]),
        lane("south_0", [(103.0, -90.0), (103.0, -10.0)]),
        lane(":J_1_0", [(103.0, -10.0), (103.0, 10.0)], inside=True),
        lane("north_0", [(103.0, 10.0), (103.0, 90.0)]),
    ]
    links = [
        link("west_0", "out_0", via=(":J_0_0",), foes=(1,)),
        link("south_0", "north_0", via=(":J_1_0",), foes=(0,), index=1),
    ]
    return lanes, links


def test_ways_of_one_junction_are_on_one_level() -> None:
    lanes, links = junction_below()
    levels = drawn(lanes, links).levels
    assert levels.across([x.id for x in lanes[:3]]) == ()


def test_below_a_viaduct_who_may_be_at_our_level_counts() -> None:
    """Seen from above, nothing tells whoever is on it from who is on the road below it."""
    lanes, links = junction_below()
    assert drawn([*lanes, OVER], links).levels.across([x.id for x in lanes[:3]]) == ()
    away = lane("over_0", [(60.0, -100.0), (60.0, 100.0)])
    assert drawn([*lanes, away], links).levels.across(["west_0"]) != ()


def test_lanes_that_just_overlap_near_their_junction_are_on_one_level() -> None:
    lanes = [
        lane("one_0", [(0.0, 0.0), (101.0, 0.0)]),
        lane("two_0", [(0.0, -60.0), (100.0, 0.5)]),
        lane("on_0", [(104.0, 0.0), (200.0, 0.0)]),
    ]
    links = [link("one_0", "on_0"), link("two_0", "on_0", index=1)]
    assert drawn(lanes, links).levels.across(["one_0"]) == ()
    assert drawn(lanes).levels.across(["one_0"]) != ()


def test_a_loop_that_comes_onto_the_bridge_meets_who_is_on_it() -> None:
    lanes = [EAST, lane("loop_0", [(300.0, 0.0), (300.0, -100.0), (100.0, -100.0)]), OVER]
    links = [link("east_0", "loop_0"), link("loop_0", "over_0")]
    levels = drawn(lanes, links).levels
    assert levels.across(["east_0"]) != ()
    assert levels.across(["east_0", "loop_0", "over_0"]) == ()


def test_who_leaves_the_bridge_reaches_back_onto_it() -> None:
    lanes = [
        EAST,
        lane("up_0", [(100.0, -100.0), (100.0, 1.0)]),
        lane("down_0", [(100.0, 1.0), (100.0, 90.0)]),
    ]
    roads = drawn(lanes, [link("up_0", "down_0")])
    for y in (0.5, 2.0, 4.5):
        other = Traffic.of([body(100.0, y, NORTH)])
        found = occupancy(plan_on(roads).path, other, SIZE[1], 0, 10)
        assert np.all(np.isnan(found.stretches.low))


def test_a_vehicle_is_on_the_lane_that_leads_where_it_points() -> None:
    roads = drawn([EAST, crossing(20.0)])
    for degrees, name in ((20.0, "over_0"), (1.0, "east_0")):
        for x in (99.0, 100.0, 101.0):
            (found,) = lanes_at(roads, (x, 0.0), math.radians(degrees))
            assert found.lane == name


def test_a_network_without_bridges_has_none() -> None:
    lanes, links = junction_below()
    levels = Levels(drawn(lanes, links).network)
    assert all(levels.across([x.id]) == () for x in lanes)
