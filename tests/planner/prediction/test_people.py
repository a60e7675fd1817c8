"""People on foot: what they may be up to, how they walk, and how vehicles let them pass."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from planner.driving.walkers import passing_speed
from planner.manoeuvres.actions import ActionPlan, Situation, expand
from planner.manoeuvres.footways import crossings_along, over
from planner.manoeuvres.plans import LetCross
from planner.motion.forward import Motion, drive
from planner.motion.obstacles import HOW, Obstacle, Traffic
from planner.motion.surroundings import Surroundings
from planner.motion.tracks import Observed
from planner.prediction.people import concerned, recognise_people
from planner.record.light_record import LightCourse, LightPrediction, Showing
from planner.record.trace import Settings
from planner.roads.routes import Refusal
from planner.roads.trajectory import Roads
from planner.traffic_lights.signals import DARK, Outlook
from sim.roads.network import Location
from sim.scene import Signal, VehicleState
from tests.planner.zebra import KEY, before, standing_at, stepping, walker, walking, zebra

NORTH, EAST, SOUTH = math.pi / 2.0, 0.0, -math.pi / 2.0
SIZE = (4.8, 1.8)
STEPS = 150


def chances(
    roads: Roads, person: Observed, outlook: Outlook = DARK, vehicles: Sequence[Observed] = ()
) -> dict[str, float]:
    """The probability of each kind of goal."""
    surroundings = Surroundings(roads, outlook, STEPS)
    found = recognise_people(surroundings, [person], vehicles, (), Settings())[person.vehicle]
    assert sum(belief.probability for belief in found) == pytest.approx(1.0)
    kinds: dict[str, float] = {}
    for belief in found:
        assert sum(way.probability for way in belief.trajectories) == pytest.approx(1.0)
        kinds[belief.goal.kind] = kinds.get(belief.goal.kind, 0.0) + belief.probability
    return kinds


def motion_of(
    roads: Roads,
    person: Observed,
    kind: str,
    outlook: Outlook = DARK,
    coasting: Sequence[Obstacle] = (),
) -> Obstacle:
    """The likeliest motion to a kind of goal."""
    surroundings = Surroundings(roads, outlook, STEPS)
    found = recognise_people(surroundings, [person], (), coasting, Settings())[person.vehicle]
    return next(belief.trajectories[0].motion for belief in found if belief.goal.kind == kind)


def enters(motion: Obstacle) -> float:
    """When [s] somebody comes beyond the kerb at y = -1.6; infinite if never."""
    beyond = np.flatnonzero(motion.position[:, 1] > -1.5)
    return float(beyond[0]) * 0.2 if len(beyond) else math.inf


def test_a_way_knows_the_crossings_that_it_leads_over() -> None:
    roads = zebra()
    (one,) = over(roads, roads.network.links[0])
    assert one.begin == pytest.approx(0.0, abs=0.3)
    assert one.end == pytest.approx(4.0, abs=0.3)
    (line,) = before(roads, 60.0, 10.0).crossings
    assert isinstance(line, LetCross)
    assert line.stop == pytest.approx(59.0, abs=0.3)
    assert line.clear == pytest.approx(64.0, abs=0.3)
    assert line.yields_to == {KEY}
    assert line.first
    assert not before(zebra(priority=False), 60.0, 10.0).crossings[0].first


def test_crossings_along_a_way_end_with_it() -> None:
    roads = zebra()
    ids = [x.id for x in crossings_along(roads, "in_0", ("in", "out"), 100.0)]
    assert ids == [":J_c0_0"]
    assert crossings_along(roads, "out_0", ("out",), 100.0) == ()


def test_who_walks_up_to_a_crossing_is_taken_to_cross_it() -> None:
    roads = zebra()
    at_kerb = chances(roads, walking(102.0, -2.2, NORTH))
    passing = chances(roads, walking(107.0, -2.6, EAST))
    assert at_kerb["cross"] > 0.4
    assert passing.get("cross", 0.0) < 0.05


def test_who_is_on_a_crossing_crosses_it() -> None:
    found = chances(zebra(), walking(102.0, 0.5, NORTH))
    assert found["cross"] >= 0.85
    assert set(found) == {"cross", "stop"}
    north = motion_of(zebra(), walking(102.0, 0.0, NORTH), "cross")
    south = motion_of(zebra(), walking(102.0, 0.0, SOUTH), "cross")
    assert np.nanmax(north.position[:, 1]) > 3.0
    assert np.nanmin(south.position[:, 1]) < -3.0


def test_who_has_crossed_does_not_go_back() -> None:
    assert "cross" not in chances(zebra(), walking(102.0, 1.8, NORTH))


def test_who_stands_at_a_crossing_though_it_is_free_has_no_mind_to_cross() -> None:
    soon = chances(zebra(), standing_at(102.0, -2.0, NORTH, samples=3))
    late = chances(zebra(), standing_at(102.0, -2.0, NORTH, samples=26))
    assert soon["cross"] > 0.25
    assert late["cross"] < 0.08


def test_waiting_for_who_makes_no_way_is_not_held_against_crossing() -> None:
    car = walker([(45.0 + 2.0 * k, 0.0) for k in range(26)], EAST, vehicle=1, kind="car")
    person = standing_at(102.0, -2.0, NORTH, samples=26)
    alone = chances(zebra(), person)["cross"]
    assert chances(zebra(), person, vehicles=[car])["cross"] > alone + 0.2


def light(*states: tuple[float, str]) -> Outlook:
    """The light of crossing and road, place 0, with states from times [s] on."""
    showings = tuple(Showing(time, state) for time, state in states)
    course = LightCourse(1.0, showings)
    return Outlook(0.0, (LightPrediction("L", (0,), showings[:1], (course,)),))


@pytest.mark.parametrize("away", [0.0, 0.004, 0.1, 0.6])
def test_who_stands_right_at_the_kerb_waits_for_green(away: float) -> None:
    roads, person = zebra(control=Signal("L", 0)), standing_at(102.0, -1.6 - away, NORTH)
    red = light((0.0, "r"), (8.0, "G"))
    surroundings = Surroundings(roads, red, STEPS)
    found = recognise_people(surroundings, [person], (), (), Settings())[person.vehicle]
    for belief in found:
        for way in belief.trajectories:
            assert enters(way.motion) >= 8.0
    assert enters(motion_of(roads, person, "cross", light((0.0, "G")))) < 1.0 + away


def test_who_walks_on_the_crossing_at_red_goes_on() -> None:
    roads, red = zebra(control=Signal("L", 0)), light((0.0, "r"))
    north = motion_of(roads, walking(102.0, -1.1, NORTH), "cross", red)
    assert np.nanmax(north.position[:15, 1]) > 1.6


def test_people_wait_at_red_and_are_not_thought_to_stay() -> None:
    roads = zebra(control=Signal("L", 0))
    red = light((0.0, "r"), (8.0, "G"))
    person = standing_at(102.0, -1.9, NORTH, samples=26)
    assert chances(roads, person, red)["cross"] > 0.3
    assert 8.0 <= enters(motion_of(roads, person, "cross", red)) <= 9.0


def test_who_has_no_priority_waits_for_a_gap() -> None:
    car = stepping(0.0, 0.0, steps=STEPS + 1)
    position = np.column_stack((80.0 + 2.0 * np.arange(STEPS + 1), np.zeros(STEPS + 1)))
    coming = Obstacle(1, 4.8, 1.8, position, car.speed * 0.0, car.speed + 10.0, frozenset())
    person = walking(102.0, -1.9, NORTH)
    gone = (104.0 + 4.8 - 80.0) / 10.0
    waits = motion_of(zebra(priority=False), person, "cross", coasting=[coming])
    goes = motion_of(zebra(), person, "cross", coasting=[coming])
    assert enters(goes) < 1.0
    assert gone - 0.5 <= enters(waits) <= gone + 1.5


def test_who_walks_straight_on_comes_to_the_road_and_no_farther() -> None:
    beside = motion_of(zebra(), walking(50.0, -4.0, NORTH), "continue")
    assert np.nanmax(beside.position[:, 1]) < -1.5
    on_it = motion_of(zebra(), walking(50.0, -1.0, NORTH), "cross")
    assert np.nanmax(on_it.position[:, 1]) > 3.0


def state(x: float, y: float, kind: str) -> VehicleState:
    return VehicleState((x, y), 0.0, 1.0, 0.0, 0.2, 0.5, kind)


def test_people_far_from_the_way_do_not_matter() -> None:
    roads = zebra()
    crossing = roads.network.crossings
    scene = {
        0: VehicleState((40.0, 0.0), 0.0, 10.0, 0.0, 4.8, 1.8),
        1: state(60.0, -4.0, "pedestrian"),  # on the pavement, far from the crossing
        2: state(102.0, -3.0, "pedestrian"),
        3: state(60.0, 0.5, "wheelchair"),  # on the road
        4: state(20.0, 0.0, "pedestrian"),  # behind
        5: state(102.0, -3.0, "car"),
    }
    assert concerned(roads, scene, crossing, 100.0) == [3, 2]
    assert concerned(roads, scene, (), 100.0) == [3]


@pytest.mark.parametrize("away", [25.0, 40.0, 60.0])
@pytest.mark.parametrize("start", [0, 8, 16])
def test_vehicles_let_people_cross(away: float, start: int) -> None:
    """Nobody is in the way of somebody on a crossing, nor stands there for ever."""
    roads = zebra()
    plan = before(roads, away, 10.0)
    person = stepping(-2.5, 1.3, start)
    driven = drive(plan, Motion(0.0, 10.0, 0.0), 0, Traffic.of([person]), SIZE, 119)
    for step, arc in enumerate(driven.motion[:, 0].tolist()):
        front = 100.0 - away + arc
        x, y = person.position[min(step, len(person.speed) - 1)].tolist()
        if front > 99.0 and front - SIZE[0] < 105.0:
            assert abs(y) > 0.5 * SIZE[1] + 0.5, f"at step {step}"
        assert x == 102.0
    assert driven.motion[-1, 0] > away + 10.0
    held = {HOW[how] for how in driven.hindrances.how.tolist()}
    assert held <= {"right-of-way"}
    assert np.min(np.diff(driven.motion[:, 1])) / 0.2 > -4.5


def test_nobody_waits_for_who_comes_later() -> None:
    roads = zebra()
    plan = before(roads, 20.0, 10.0)
    person = stepping(-8.0, 1.3)
    driven = drive(plan, Motion(0.0, 10.0, 0.0), 0, Traffic.of([person]), SIZE, 40)
    alone = drive(plan, Motion(0.0, 10.0, 0.0), 0, Traffic.of([]), SIZE, 40)
    assert driven.motion[-1, 0] == pytest.approx(alone.motion[-1, 0], abs=0.1)


def test_nobody_changes_lanes_where_people_cross() -> None:
    """Overtaking is for elsewhere."""
    roads = zebra(lanes=2)
    here = Situation(0.0, (40.0, 0.0), 0.0, 10.0, 0.0, Location("in_0", 40.0, 0.0))
    assert isinstance(expand(roads, here, "change-left", None, 100.0), ActionPlan)
    near = Situation(0.0, (85.0, 0.0), 0.0, 10.0, 0.0, Location("in_0", 85.0, 0.0))
    found = expand(roads, near, "change-left", None, 100.0)
    assert isinstance(found, Refusal)
    assert "crossing" in found.reason


def test_who_stands_beside_at_a_crossing_is_not_passed_fast() -> None:
    roads = zebra(lanes=2)
    plan, ego = before(roads, 20.0, 10.0), VehicleState((80.0, 0.0), 0.0, 10.0, 0.0, 4.8, 1.8)
    stood = replace(ego, position=(98.5, 3.2), speed=0.0)
    found = passing_speed(plan, Motion(0.0, 10.0, 0.0), {1: stood})
    assert found is not None
    assert found[0] < 10.0
    assert found[1] == 1
    for other in (
        replace(stood, speed=9.0),  # drives on
        replace(stood, heading=math.pi),  # comes towards us
        replace(stood, position=(80.0, 3.2)),  # far before the crossing
        replace(stood, position=(98.5, 0.0)),  # on our own lane: is followed
    ):
        assert passing_speed(plan, Motion(0.0, 10.0, 0.0), {1: other}) is None
