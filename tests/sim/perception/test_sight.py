"""Who hides whom from the ego: pure geometry, and what scenes show of it."""

import math
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from sim.boxes import corners
from sim.perception.buildings import Buildings, Walls
from sim.perception.sight import Body, crosses, hidden
from sim.scene import EGO, Command, PersonState, VehicleState
from sim.setup.scenario import Scenario, load
from sim.sumo import Simulation
from tests.sim.crossroads import ROUTES, signalled


def vehicle(x: float, y: float, length: float = 4.8, width: float = 1.8) -> VehicleState:
    """A vehicle that looks east, with its middle at a place [m]."""
    return VehicleState((x + length / 2.0, y), 0.0, 10.0, 0.0, length, width)


EGO_CAR = vehicle(0.0, 0.0)
LORRY = Body(vehicle(20.0, 0.0, 14.0, 2.5), 4.0)
CAR_AHEAD = Body(vehicle(45.0, 0.0), 1.5)


def test_a_car_behind_a_lorry_is_hidden() -> None:
    assert hidden(EGO_CAR, CAR_AHEAD, [LORRY])
    assert hidden(EGO_CAR, CAR_AHEAD, [CAR_AHEAD, LORRY])
    assert not hidden(EGO_CAR, CAR_AHEAD, [])
    assert not hidden(EGO_CAR, LORRY, [LORRY, CAR_AHEAD])  # nobody hides itself


@pytest.mark.parametrize("aside", [-3.5, 3.5])
def test_a_car_whose_corner_stands_out_is_seen(aside: float) -> None:
    assert not hidden(EGO_CAR, Body(vehicle(45.0, aside), 1.5), [LORRY])
    assert hidden(EGO_CAR, Body(vehicle(45.0, aside / 4.0), 1.5), [LORRY])


def test_one_corner_is_enough() -> None:
    wide = Body(vehicle(60.0, 5.2, width=2.0), 1.5)  # its right edge is hidden, its left is not
    assert not hidden(EGO_CAR, wide, [LORRY])


def test_a_car_before_the_lorry_is_seen() -> None:
    assert not hidden(EGO_CAR, Body(vehicle(8.0, 0.0), 1.5), [LORRY])
    assert not hidden(EGO_CAR, Body(vehicle(-20.0, 0.0), 1.5), [LORRY])


def test_two_may_hide_one_together() -> None:
    left = Body(vehicle(20.0, 1.2, 14.0, 2.5), 4.0)
    right = Body(vehicle(20.0, -1.2, 14.0, 2.5), 4.0)
    across = Body(replace(vehicle(45.0, 0.0), heading=math.pi / 2, position=(45.0, 2.4)), 1.5)
    assert hidden(EGO_CAR, across, [left, right])
    assert not hidden(EGO_CAR, across, [left])
    assert not hidden(EGO_CAR, across, [right])


@pytest.mark.parametrize("height", [1.4, 1.5, 1.99])
def test_a_passenger_car_hides_nobody(height: float) -> None:
    assert not hidden(EGO_CAR, CAR_AHEAD, [replace(LORRY, height=height)])
    assert hidden(EGO_CAR, CAR_AHEAD, [replace(LORRY, height=2.0)])


def test_the_taller_one_is_seen_over_the_lower_one() -> None:
    assert not hidden(EGO_CAR, replace(CAR_AHEAD, height=4.5), [LORRY])


@given(
    heading=st.floats(-3.1, 3.1),
    x=st.floats(-30.0, 30.0),
    y=st.floats(-30.0, 30.0),
    share=st.floats(0.05, 0.95),
    beyond=st.floats(1.01, 3.0),
)
def test_a_line_through_the_inside_crosses(
    heading: float, x: float, y: float, share: float, beyond: float
) -> None:
    box = VehicleState((x, y), heading, 0.0, 0.0, 8.0, 2.5)
    (ax, ay), _, (bx, by), _ = corners(box)
    inside = (ax + (bx - ax) * share, ay + (by - ay) * share)
    eye = (90.0, 80.0)
    far = tuple(e + (i - e) * beyond for e, i in zip(eye, inside, strict=True))
    assert crosses(eye, (far[0], far[1]), box)
    short = tuple(e + (i - e) * 0.5 for e, i in zip(eye, inside, strict=True))
    assert not crosses(eye, (short[0], short[1]), box)


def test_a_line_along_a_side_only_touches() -> None:
    box = vehicle(20.0, 0.0, 10.0, 2.0)
    assert not crosses((0.0, 1.0), (50.0, 1.0), box)
    assert crosses((0.0, 0.99), (50.0, 0.99), box)
    assert not crosses((0.0, 0.0), (15.0, 0.0), box)


@pytest.mark.slow
def test_the_lorry_of_the_motorway_hides_the_car_ahead_until_the_ego_pulls_out() -> None:
    with Simulation(load("motorway", 0)) as world:
        scene = world.scene()
        assert 1 in scene.vehicles
        assert 2 not in scene.vehicles
        x, y = scene.ego.position
        for k in range(1, 40):
            aside = min(0.1 * k, 3.75)
            scene = world.step(Command((x + 2.1 * k, y + aside), 0.0, 21.0))
        assert scene.vehicles[2].colour == "red"
        assert scene.vehicles[2].position[0] > scene.vehicles[1].position[0]


def sights(scenario: Scenario, steps: int) -> list[tuple[int, ...]]:
    """Who is in view, step by step, with an ego that SUMO drives."""
    with Simulation(scenario) as world:
        return [tuple(world.step(None).vehicles) for _ in range(steps)]


@pytest.mark.slow
def test_a_name_is_kept_when_its_vehicle_is_seen_again() -> None:
    views = sights(load("s4"), 200)
    seen = [5 in view for view in views]
    first = seen.index(True)
    lost = seen.index(False, first)
    assert True in seen[lost:]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["s1", "s2"])
def test_cars_alone_hide_nobody(name: str) -> None:
    scenario = load(name)
    with Simulation(replace(scenario, view_radius=500.0)) as world:
        scenes = [world.step(None) for _ in range(60)]
    assert all(set(scene.vehicles) == {EGO, 1, 2} for scene in scenes)


HOUSE = ("building.yes", ((10.0, 5.0), (30.0, 5.0), (30.0, 25.0), (10.0, 25.0)))


def walls(*polygons: tuple[str, tuple[tuple[float, float], ...]]) -> Walls:
    return Buildings(polygons).around(EGO_CAR, 100.0)


def test_a_building_hides_what_is_behind_it() -> None:
    behind = Body(vehicle(60.0, 42.0), 4.0)  # even a lorry
    beside = Body(vehicle(60.0, 0.0), 1.5)
    assert hidden(EGO_CAR, behind, [], walls(HOUSE))
    assert not hidden(EGO_CAR, behind, [])
    assert not hidden(EGO_CAR, beside, [], walls(HOUSE))


def test_a_person_behind_a_corner_is_hidden_until_seen() -> None:
    def walker(y: float) -> Body[PersonState]:
        return Body(PersonState((40.0, y), 0.0, 1.4, 0.2, 0.5), 1.7)

    assert hidden(EGO_CAR, walker(15.0), [], walls(HOUSE))
    assert not hidden(EGO_CAR, walker(5.0), [], walls(HOUSE))


@pytest.mark.parametrize("kind", ["landuse.grass", "building.roof", "", "water"])
def test_what_is_no_building_hides_nothing(kind: str) -> None:
    assert not hidden(EGO_CAR, Body(vehicle(60.0, 42.0), 1.5), [], walls((kind, HOUSE[1])))


def test_a_building_that_the_road_leads_through_hides_nothing() -> None:
    around = ("building", ((-20.0, -20.0), (50.0, -20.0), (50.0, 20.0), (-20.0, 20.0)))
    assert not hidden(EGO_CAR, Body(vehicle(80.0, 0.0), 1.5), [], walls(around))
    assert hidden(EGO_CAR, Body(vehicle(60.0, 42.0), 1.5), [], walls(around, HOUSE))


def test_walls_far_away_are_left_out() -> None:
    assert len(Buildings([HOUSE]).around(vehicle(500.0, 0.0), 100.0).starts) == 0
    assert len(Buildings([HOUSE]).around(EGO_CAR, 100.0).starts) == 4
    assert not Buildings([]).around(EGO_CAR, 100.0).between((0.0, 0.0), (9.0, 9.0))


@given(
    a=st.tuples(st.floats(-50.0, 5.0), st.floats(-50.0, 50.0)),
    b=st.tuples(st.floats(35.0, 50.0), st.floats(-50.0, 50.0)),
)
def test_a_line_crosses_a_house_where_it_crosses_its_box(
    a: tuple[float, float], b: tuple[float, float]
) -> None:
    box = VehicleState((30.0, 15.0), 0.0, 0.0, 0.0, 20.0, 20.0)
    assert walls(HOUSE).between(a, b) == crosses(a, b, box)


@pytest.mark.slow
def test_people_are_in_the_scene_and_houses_hide_them(tmp_path: Path) -> None:
    walks = '<walk edges="top0A0 A0bottom0"/></person>'
    routes = ROUTES.replace("</routes>", f'<person id="ego" depart="0">{walks}</routes>')
    guessed = ("--sidewalks.guess", "--crossings.guess")
    scenario = load(signalled(tmp_path, routes, *guessed))
    with Simulation(scenario) as world:
        assert world.scene().people == {}
        while not world.scene().people:
            scene = world.step(None)
    assert set(scene.people) == {1}
    assert set(scene.vehicles) == {EGO}  # a person may have the id of a vehicle
    person = scene.people[1]
    assert (person.kind, person.speed > 0.5) == ("pedestrian", True)
    assert (person.length, person.width) == (pytest.approx(0.215), pytest.approx(0.478))
    assert abs(person.heading + math.pi / 2.0) < 0.2  # to the south
    assert math.dist(person.position, scene.ego.position) <= scenario.view_radius
