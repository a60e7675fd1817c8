"""What SUMO makes of the shipped scenarios, seed by seed."""

import pytest

from sim.netfile import read_network
from sim.scenario import load
from sim.scene import Command, Scene
from sim.sumo import Simulation
from tests.sim.driver import LaneFollower, lane_line

pytestmark = pytest.mark.slow

S1, S2 = load("s1"), load("s2")
LANE_BOUNDARY = -3.5  # [m] y between the eastbound lanes of s1
STOP_LINE = 40.5  # [m] x where main_in ends in s1


def ride_in_lane(seed: int, acceleration: float = 2.0) -> list[Scene]:
    """Scenes of s1 with an ego that stays in the right lane."""
    network = read_network(S1.network)
    line = lane_line(network, "main_in_0", ":J_10_0", "main_out_0")
    driver = LaneFollower(line, S1.step, acceleration=acceleration)
    scenes = []
    with Simulation(S1, seed) as world:
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
    with Simulation(S2, seed) as world:
        x, y = world.scene().ego.position
        pose = Command((x, y), world.scene().ego.heading, 0.0)
        scenes = [world.step(pose) for _ in range(140)]
    standing = [x for x in scenes if 1 in x.vehicles and x.vehicles[1].speed < 0.1]
    assert standing[-1].time - standing[0].time >= 2.0


def ride_by_sumo(seed: int) -> list[Scene]:
    """Scenes of s2 with an ego that SUMO drives."""
    with Simulation(S2, seed) as world:
        scenes = []
        while world.time < 14.0:
            scenes.append(world.step(None))
            assert world.collisions() == ()
    return scenes
