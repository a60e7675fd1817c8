"""What SUMO makes of the scenarios with lights and people, seed by seed."""

import math
from collections.abc import Iterator
from dataclasses import replace

import pytest

from sim.scene import LightState, PersonState, Scene, Signal
from sim.setup.scenario import load
from sim.sumo import Simulation

pytestmark = pytest.mark.slow

JUNCTION = load("junction")
TURN = Signal("J", 17)  # of the ego's right turn, in the controller's state
LINE = -18.0  # [m] x of the ego's stop line
SOUTH = -17.35  # [m] y of the middle of the crossing of the south arm
ZEBRA = -110.0  # [m] y of the middle of the zebra crossing
HALF_ROAD = 4.85  # [m] from the middle of the main road to the kerb


def scenes(seed: int) -> list[Scene]:
    """The ride with an ego that SUMO drives, up to the zebra crossing."""
    found = []
    with Simulation(replace(JUNCTION, seed=seed)) as world:
        while world.time < 70.0 and world.scene().ego.position[1] > ZEBRA - 10.0:
            found.append(world.step(None))
            assert world.collisions() == ()
    return found


def on_the_west_crossing(scene: Scene) -> Iterator[PersonState]:
    for person in scene.people.values():
        x, y = person.position
        if -18.5 < x < -13.5 and abs(y) < HALF_ROAD:
            yield person


@pytest.mark.parametrize("seed", range(10))
def test_people_cross_before_the_ego_while_its_light_is_red(seed: int) -> None:
    story = scenes(seed)
    near = [x for x in story if LINE - 25.0 < x.ego.position[0] < LINE]
    crossed = [x for x in near if any(on_the_west_crossing(x))]
    assert len(crossed) > 30  # for 3 s at least
    for scene in crossed:
        light = scene.light(TURN)
        assert light is not None
        assert light.state is LightState.RED


@pytest.mark.parametrize("seed", range(10))
def test_the_light_of_the_ego_turns_green_after_it_has_stood_for_a_while(seed: int) -> None:
    stood = [x for x in scenes(seed) if x.ego.speed < 0.1 and x.ego.position[0] < LINE + 1.0]
    assert stood
    assert stood[-1].time - stood[0].time > 3.0
    assert 25.5 < stood[-1].time < 27.5


@pytest.mark.parametrize("seed", range(10))
def test_a_cyclist_rides_beside_the_ego_straight_on_at_green(seed: int) -> None:
    beside = [
        scene
        for scene in scenes(seed)
        if scene.time > 26.0
        and 3 in scene.vehicles
        and math.dist(scene.vehicles[3].position, scene.ego.position) < 8.0
    ]
    assert beside
    assert all(scene.vehicles[3].kind == "bicycle" for scene in beside)


def on_foot_across(scene: Scene, middle: float) -> bool:
    """Whether somebody is on a crossing of the side road, by the y [m] of its middle."""
    places = [person.position for person in scene.people.values()]
    return any(abs(y - middle) < 2.5 and abs(x) < 3.5 for x, y in places)


@pytest.mark.parametrize("seed", range(10))
def test_somebody_crosses_the_south_arm_and_the_zebra_before_the_ego(seed: int) -> None:
    story = scenes(seed)
    for middle in (SOUTH, ZEBRA):
        coming = [x for x in story if middle + 2.0 < x.ego.position[1] < middle + 30.0]
        assert any(on_foot_across(scene, middle) for scene in coming), middle
