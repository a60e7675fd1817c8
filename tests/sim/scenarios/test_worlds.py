"""Every shipped scenario can be driven: SUMO's own driver takes the ego to its goal."""

from dataclasses import replace

import pytest

from sim.roads.netfile import read_network
from sim.scene import EGO, Scene
from sim.setup.routes import departures, parse
from sim.setup.scenario import Scenario, available, load
from sim.sumo import Simulation

pytestmark = pytest.mark.slow

SEEDS = range(10)
CONFIGURED = ("city",)  # by SUMO configurations of the package eclipse-sumo
OURS = [name for name in available() if name not in CONFIGURED]


def ride_to_goal(scenario: Scenario, seed: int) -> list[Scene]:
    """Scenes up to the goal, with an ego that SUMO drives; a collision fails."""
    network = read_network(scenario.network)
    lanes = {lane.id for lane in network.edge_lanes(scenario.goal.edge)}
    scenes = []
    with Simulation(replace(scenario, seed=seed)) as world:
        while world.time < scenario.duration:
            scenes.append(world.step(None))
            assert world.collisions() == ()
            assert world.sumo_collisions() == ()
            ego = scenes[-1].ego
            places = network.locate(ego.position, ego.heading)
            if any(x.lane in lanes and x.offset >= scenario.goal.position for x in places):
                return scenes
    pytest.fail(f"{scenario.name}, seed {seed}: no goal within {scenario.duration:g} s")


@pytest.mark.parametrize("name", OURS)
@pytest.mark.parametrize("seed", SEEDS)
def test_sumo_takes_the_ego_to_its_goal(name: str, seed: int) -> None:
    scenario = load(name)
    scenes = ride_to_goal(scenario, seed)
    assert scenes[-1].time < scenario.duration / 2.0  # time for a slower driver
    fastest: dict[int, float] = {}
    for scene in scenes:
        for vehicle, state in scene.vehicles.items():
            fastest[vehicle] = max(fastest.get(vehicle, 0.0), state.speed)
    moving = sum(speed > 2.0 for speed in fastest.values())
    assert moving >= 0.9 * len(fastest)  # some may wait for as long as they are in view


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("name", CONFIGURED)
def test_sumo_takes_the_ego_to_its_goal_among_people_and_bicycles(name: str, seed: int) -> None:
    scenes = ride_to_goal(load(name), seed)
    assert max(len(scene.people) for scene in scenes) > 5
    kinds = {state.kind for scene in scenes for state in scene.vehicles.values()}
    assert {"car", "bicycle"} <= kinds
    assert any(scene.lights for scene in scenes)


@pytest.mark.parametrize("name", OURS)
def test_the_route_of_the_ego_leads_to_its_goal(name: str) -> None:
    scenario = load(name)
    vehicles = departures(parse(scenario.routes))
    ego = next(vehicle for vehicle in vehicles if vehicle.id == scenario.ego)
    assert ego.edges[-1] == scenario.goal.edge


def test_twelve_vehicles_are_about_on_the_motorway() -> None:
    with Simulation(load("motorway", 0)) as world:
        ahead = world.step(None)
    assert len(ahead.vehicles) > 10
    kinds = {state.kind for name, state in ahead.vehicles.items() if name != EGO}
    assert {"car", "truck"} <= kinds
    speeds = [state.speed for state in ahead.vehicles.values()]
    assert max(speeds) - min(speeds) > 1.0


def test_the_town_is_a_town() -> None:
    scenario = load("town")
    network = read_network(scenario.network)
    crossings = {x.junction for x in network.links if x.foes and not x.junction.startswith(":")}
    assert len(crossings) >= 20
    assert len(departures(parse(scenario.routes))) == 60
    ego = next(x for x in departures(parse(scenario.routes)) if x.id == scenario.ego)
    assert len(ego.edges) > 6
    assert all(way.direction != "turnaround" for way in network.links)
