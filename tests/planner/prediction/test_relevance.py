"""Whoever can meet the ego is planned for in a crowd; whoever cannot changes nothing."""

from planner.prediction.relevance import FEW, relevant
from planner.record.trace import EgoGoal, Settings, Track
from planner.search.decide import decide
from planner.search.inputs import Frame, Moment, Root
from sim.scene import VehicleState
from tests.planner.crossroads import ARM, before, crossroads
from tests.planner.nets import on_lane
from tests.planner.worlds import LENGTH, WIDTH

GOAL = EgoGoal("north_out", 100.0, None)
SETTINGS = Settings(rollouts=8, min_rollouts=2, comparisons=4, horizon=10.0)


def at(lane: str, offset: float, speed: float = 8.0) -> VehicleState:
    """A vehicle on a lane, at an offset [m] from its start, or from its end where negative."""
    here = on_lane(crossroads(), lane, offset, speed)
    return VehicleState(here.position, here.heading, speed, 0.0, LENGTH, WIDTH)


def crowd() -> dict[int, VehicleState]:
    """More than FEW that come to the junction, or are beyond it."""
    arms = ("east", "north", "west")
    coming = [at(f"{arm}_in_0", -15.0 - 20.0 * k) for k in range(2) for arm in arms]
    ahead = [at("north_out_0", 20.0), at("east_out_0", 30.0), at("south_in_0", -70.0)]
    scene = dict(enumerate([*coming, *ahead], 1))
    assert len(scene) > FEW
    return scene


def planned_for(others: dict[int, VehicleState]) -> frozenset[int]:
    return relevant(crossroads(), others, before(40.0, 8.0).location, GOAL, SETTINGS)


def moment(others: dict[int, VehicleState]) -> Moment:
    here = before(40.0, 8.0)
    ego = VehicleState(here.position, here.heading, here.speed, 0.0, LENGTH, WIDTH)
    scene = {0: ego, **others}
    history = {
        name: Track(0.0, (one.position,), (one.heading,), (one.speed,))
        for name, one in scene.items()
    }
    return Moment(0, 0.0, scene, history, Root(here))


def test_who_comes_to_the_junction_or_drives_on_the_roads_beyond_may_meet_the_ego() -> None:
    assert planned_for(crowd()) == frozenset(crowd())


def test_who_has_passed_and_drives_away_cannot_meet_the_ego() -> None:
    passed = {20: at("south_out_0", 30.0), 21: at("south_out_0", ARM - 20.0)}
    assert planned_for(crowd() | passed) == frozenset(crowd())


def test_who_turns_into_the_way_back_crosses_the_way_of_the_ego() -> None:
    inside = at(":west_right_0", 8.0)
    assert 20 not in planned_for(crowd() | {20: inside})
    crossing = at(":east_left_0", -3.0)
    assert 20 in planned_for(crowd() | {20: crossing})


def test_inside_the_junction_who_crosses_the_way_of_the_ego_may_meet_it() -> None:
    turning = on_lane(crossroads(), ":south_left_0", 8.0).location
    goal = EgoGoal("west_out", 100.0, None)
    oncoming, passing = at(":north_straight_0", 6.0), at(":east_right_0", 6.0)
    others = crowd() | {20: oncoming, 21: passing}
    assert {20, 21} & relevant(crossroads(), others, turning, goal, SETTINGS) == {20}


def test_who_is_on_no_lane_or_has_ways_of_its_own_may_be_anywhere() -> None:
    passed = at("south_out_0", 30.0)
    astray = VehicleState((500.0, 500.0), 0.0, 8.0, 0.0, LENGTH, WIDTH)
    bicycle = VehicleState(passed.position, passed.heading, 4.0, 0.0, 1.8, 0.6, kind="bicycle")
    assert {20, 21} <= planned_for(crowd() | {20: astray, 21: bicycle})


def test_where_there_are_few_all_are_planned_for() -> None:
    assert planned_for({20: at("south_out_0", 30.0)}) == {20}


def test_a_vehicle_that_cannot_meet_the_ego_does_not_change_the_decision() -> None:
    frame = Frame(crossroads(), GOAL, SETTINGS, 1, "car")
    alone = decide(frame, moment(crowd())).trace
    away = at("south_out_0", ARM - 5.0, speed=13.8)  # in nobody's way
    beside = decide(frame, moment(crowd() | {20: away})).trace
    assert 20 in beside.scene
    assert {known.vehicle for known in beside.predictions} == set(crowd())
    assert beside.predictions == alone.predictions
    assert beside.rollouts == alone.rollouts
    assert beside.plan == alone.plan
