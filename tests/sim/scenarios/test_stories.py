"""What SUMO makes of the shipped scenarios, seed by seed."""

import math
from dataclasses import replace

import pytest

from sim.roads.netfile import read_network
from sim.scene import Command, Scene
from sim.setup.scenario import Scenario, load
from sim.sumo import Simulation
from tests.sim.driver import LaneFollower, lane_line

pytestmark = pytest.mark.slow

S1, S2, S3, S4 = (load(name) for name in ("s1", "s2", "s3", "s4"))
RING = 23.0  # [m] from the middle of s3: beyond it a vehicle has left the ring
LANE_BOUNDARY = -3.5  # [m] y between the eastbound lanes of s1
STOP_LINE = 40.5  # [m] x where main_in ends in s1


def ride_in_lane(seed: int, acceleration: float = 2.0) -> list[Scene]:
    """Scenes of s1 with an ego that stays in the right lane."""
    network = read_network(S1.network)
    line = lane_line(network, "main_in_0", ":J_10_0", "main_out_0")
    driver = LaneFollower(line, S1.step, acceleration=acceleration)
    scenes = []
    with Simulation(replace(S1, seed=seed)) as world:
        while world.scene().ego.position[0] < 159.5 and world.time < S1.duration:
            scenes.append(world.scene())
            world.step(driver.command(world.scene()))
            assert world.collisions() == ()
            assert world.sumo_collisions() == ()
    return scenes


@pytest.mark.parametrize("seed", range(30))
def test_vehicle_1_of_s1_cuts_in_and_slows_for_its_turn(seed: int) -> None:
    scenes = ride_in_lane(seed)
    cut = next(x for x in scenes if x.vehicles[1].position[1] < LANE_BOUNDARY)
    assert 2.0 <= cut.time <= 4.0
    ego, first = cut.ego, cut.vehicles[1]
    assert first.position[0] - first.length - ego.position[0] > 5.0  # ahead, with a gap
    assert STOP_LINE - ego.position[0] > 80.0
    slowing = next(x for x in scenes if "brake" in x.vehicles[1].signals)
    assert slowing.time > cut.time
    assert slowing.vehicles[1].speed > 12.0
    turning = next(x for x in scenes if 1 in x.vehicles and x.vehicles[1].position[1] < -8.0)
    assert turning.vehicles[1].speed < 4.0


@pytest.mark.parametrize("seed", range(30))
def test_the_left_lane_of_s1_stays_free(seed: int) -> None:
    for scene in ride_in_lane(seed):
        left = {
            name
            for name, state in scene.vehicles.items()
            if abs(state.position[1] + 1.75) < 1.75 and abs(state.heading) < 0.5
        }
        assert left <= {1}
        assert not left or scene.time < 4.5


@pytest.mark.parametrize("seed", range(10))
def test_vehicle_2_of_s1_waits_until_the_ego_has_come(seed: int) -> None:
    scenes = ride_in_lane(seed)
    waiting = [x for x in scenes if 2 in x.vehicles and x.vehicles[2].speed < 0.1]
    assert waiting
    gone = next(x for x in scenes if 2 in x.vehicles and x.vehicles[2].position[1] > -12.5)
    assert gone.ego.position[0] > STOP_LINE
    assert 1 not in gone.vehicles or gone.vehicles[1].position[1] < -7.0


@pytest.mark.parametrize("seed", range(10))
def test_staying_behind_vehicle_1_of_s1_costs_seconds(seed: int) -> None:
    free_ride = (159.5 + 100.0) / 13.89  # [s] at the limit from the mean start
    assert ride_in_lane(seed)[-1].time > free_ride + 3.0


@pytest.mark.parametrize("seed", range(10))
def test_vehicle_1_of_s2_stands_inside_the_junction_for_2_s(seed: int) -> None:
    scenes = ride_by_sumo(seed)
    standing = [x for x in scenes if 1 in x.vehicles and x.vehicles[1].speed < 0.1]
    since, until = standing[0].time, standing[-1].time
    assert until - since >= 2.0
    assert len(standing) == round((until - since) / S2.step) + 1  # in one piece
    assert all(-9.5 < x.vehicles[1].position[0] < 0.0 for x in standing)
    passing = next(x for x in scenes if 2 in x.vehicles and x.vehicles[2].position[0] < 0.0)
    assert since < passing.time < until + 1.5


@pytest.mark.parametrize("seed", range(10))
def test_the_ego_of_s2_comes_to_its_line_while_vehicle_1_slows_or_stands(seed: int) -> None:
    scenes = ride_by_sumo(seed)
    first = next(x for x in scenes if x.ego.position[1] > -11.5).vehicles[1]
    assert first.speed < 0.1 or "brake" in first.signals
    assert "left" in first.signals


@pytest.mark.parametrize("seed", range(10))
def test_vehicle_1_of_s2_stands_whatever_the_ego_does(seed: int) -> None:
    with Simulation(replace(S2, seed=seed)) as world:
        x, y = world.scene().ego.position
        pose = Command((x, y), world.scene().ego.heading, 0.0)
        scenes = [world.step(pose) for _ in range(140)]
    standing = [x for x in scenes if 1 in x.vehicles and x.vehicles[1].speed < 0.1]
    assert standing[-1].time - standing[0].time >= 2.0


def ride_by_sumo(seed: int) -> list[Scene]:
    """Scenes of s2 with an ego that SUMO drives."""
    return scenes_by_sumo(S2, seed, 14.0)


def scenes_by_sumo(scenario: Scenario, seed: int, until: float) -> list[Scene]:
    """Scenes up to a time [s] with an ego that SUMO drives."""
    with Simulation(replace(scenario, seed=seed)) as world:
        scenes = []
        while world.time < until:
            scenes.append(world.step(None))
            assert world.collisions() == ()
    return scenes


def bearing(scene: Scene, name: int) -> float:
    """Where a vehicle of s3 is [deg], anticlockwise from east round the middle of the ring."""
    x, y = scene.vehicles[name].position
    return math.degrees(math.atan2(y, x)) % 360.0


def distance(scene: Scene, name: int) -> float:
    """How far [m] a vehicle of s3 is from the middle of the ring."""
    return math.hypot(*scene.vehicles[name].position)


@pytest.mark.parametrize("seed", range(10))
def test_vehicle_1_of_s3_leaves_the_ring_before_the_entry_of_the_ego(seed: int) -> None:
    scenes = scenes_by_sumo(S3, seed, 20.0)
    entered = next(x for x in scenes if distance(x, 0) < RING)
    assert 195.0 < bearing(entered, 1) < 265.0
    for scene in scenes:
        if 1 in scene.vehicles and distance(scene, 1) < RING:
            assert bearing(scene, 1) < 270.0  # the entry of the ego is at 293
    gone = next(x for x in scenes if 1 in x.vehicles and x.vehicles[1].position[1] < -RING - 10.0)
    assert gone.vehicles[1].position[0] < 0.0  # by the exit of the same arm
    assert min(x.ego.speed for x in scenes) > 4.0  # the ego waits for nobody


@pytest.mark.parametrize("seed", range(10))
def test_vehicle_2_of_s3_goes_on_round_after_the_ego(seed: int) -> None:
    scenes = scenes_by_sumo(S3, seed, 20.0)
    entered = next(x.time for x in scenes if distance(x, 0) < RING)
    passed = next(
        x.time
        for x in scenes
        if 2 in x.vehicles and distance(x, 2) < RING and 290.0 < bearing(x, 2) < 340.0
    )
    assert 3.0 < passed - entered < 12.0


@pytest.mark.parametrize("seed", range(10))
def test_the_lorry_of_s4_stops_short_of_the_junction_and_the_ego_goes_first(seed: int) -> None:
    scenes = scenes_by_sumo(S4, seed, 40.0)
    standing = [x for x in scenes if 1 in x.vehicles and x.vehicles[1].speed < 0.1]
    assert standing[-1].time - standing[0].time >= 2.0
    assert len(standing) == round((standing[-1].time - standing[0].time) / S4.step) + 1
    assert all(-13.0 < x.vehicles[1].position[0] < -9.0 for x in standing)  # at its line
    assert all(x.vehicles[1].kind == "truck" for x in standing)
    merged = next(x for x in scenes if x.ego.position[0] > 10.0)
    assert merged.vehicles[1].speed < 1.0
    assert merged.vehicles[1].position[0] < -9.0
    queue = [merged.vehicles[name] for name in (2, 3, 4)]
    assert all(state.speed < 1.0 and state.position[0] > 10.0 for state in queue)


@pytest.mark.parametrize("seed", range(10))
def test_the_queue_of_s4_dissolves_once_vehicle_2_has_turned(seed: int) -> None:
    scenes = scenes_by_sumo(S4, seed, 40.0)
    waiting = [x for x in scenes if 2 in x.vehicles and x.vehicles[2].speed < 0.1]
    assert waiting[-1].time - waiting[0].time > 5.0
    assert all("left" in x.vehicles[2].signals for x in waiting)
    oncoming = [x.vehicles[name] for x in waiting for name in x.vehicles if name > 4]
    assert any(abs(state.heading) > 3.0 and state.position[0] > 44.0 for state in oncoming)
    assert scenes[-1].ego.position[0] > 120.0


@pytest.mark.parametrize("seed", range(10))
def test_the_ego_of_the_bend_goes_after_vehicle_1(seed: int) -> None:
    """Only with the right of way that the map states, and its conversion lost."""
    scenes = scenes_by_sumo(load("bend"), seed, 20.0)
    crossed = next(x for x in scenes if x.ego.position[0] < 0.0)
    assert crossed.vehicles[1].position[0] < crossed.ego.position[0] - 2.0
