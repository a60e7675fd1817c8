"""The simulation: placement, determinism, names, errors."""

import dataclasses
import hashlib
import importlib
import math
import os
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

from sim import engine
from sim.roads.netfile import read_network
from sim.scene import EGO, Command, Scene, VehicleState
from sim.setup.scenario import Scenario, load
from sim.sumo import EgoGone, Simulation, SimulationRunning, SumoFailed, SumoMissing
from tests.sim.driver import LaneFollower, lane_line

pytestmark = pytest.mark.slow

S1, S2 = load("s1"), load("s2")
RIDE = """
from sim.setup.scenario import load
from sim.sumo import Simulation
with Simulation(load("s1", 5)) as world:
    print([world.step(None) for _ in range(80)])
"""


def ride(scenario: Scenario, seed: int, steps: int) -> list[Scene]:
    with Simulation(dataclasses.replace(scenario, seed=seed)) as world:
        return [world.scene(), *(world.step(None) for _ in range(steps))]


def test_a_seed_gives_one_ride() -> None:
    assert ride(S1, 4, 100) == ride(S1, 4, 100)
    assert ride(S1, 4, 0) != ride(S1, 5, 0)


def test_a_ride_does_not_depend_on_hash_order(root: Path) -> None:
    digests = set()
    for hash_seed in ("0", "1"):
        environment = {**os.environ, "PYTHONHASHSEED": hash_seed, "PYTHONPATH": str(root)}
        done = subprocess.run(
            [sys.executable, "-c", RIDE], env=environment, capture_output=True, check=True
        )
        digests.add(hashlib.sha256(done.stdout).hexdigest())
    assert len(digests) == 1


@pytest.mark.parametrize("seed", range(5))
def test_the_first_scene_shows_the_starts_that_the_seed_gives(seed: int) -> None:
    with Simulation(dataclasses.replace(S2, seed=seed)) as world:
        scene = world.scene()
        assert scene.time == world.time == 0.0
    assert list(scene.vehicles) == [0, 1]  # vehicle 2 is not in view yet
    ego, first = scene.ego, scene.vehicles[1]
    assert ego.position == pytest.approx((1.75, -62.0), abs=5.0)
    assert first.position == pytest.approx((-42.0, -1.75), abs=5.0)
    assert ego.heading == pytest.approx(math.pi / 2)
    assert first.heading == pytest.approx(0.0)
    assert all(5.0 <= state.speed <= 10.0 for state in scene.vehicles.values())
    assert (ego.colour, first.colour, first.kind) == ("white", "blue", "car")


def test_time_passes_by_the_step() -> None:
    assert [scene.time for scene in ride(S1, 0, 5)] == [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]


def test_the_ego_takes_exactly_the_pose_it_is_given() -> None:
    """Through a lane change, off the lane centres, and through the turn."""
    network = read_network(S1.network)
    with Simulation(S1) as world:
        x, y = world.scene().ego.position
        speed = world.scene().ego.speed
        for k in range(60):
            before = speed
            speed = max(speed + 0.07 * math.sin(k), 0.0)
            heading = 0.2 * math.sin(math.pi * k / 60)
            x, y = x + speed * 0.1 * math.cos(heading), y + speed * 0.1 * math.sin(heading)
            ego = world.step(Command((x, y), heading, speed)).ego
            assert ego.position == pytest.approx((x, y), abs=1e-6)
            assert ego.heading == pytest.approx(heading, abs=1e-6)
            assert ego.speed == pytest.approx(speed, abs=1e-6)
            assert ego.acceleration == pytest.approx((speed - before) / 0.1)
        driver = LaneFollower(lane_line(network, "main_in_0", ":J_9_0", "exit_s_0"), 0.1)
        for _ in range(150):
            command = driver.command(world.scene())
            ego = world.step(command).ego
            assert ego.position == pytest.approx(command.position, abs=1e-6)
            assert math.cos(ego.heading - command.heading) == pytest.approx(1.0, abs=1e-9)
    assert network.locate(ego.position, ego.heading)[0].lane == "exit_s_0"


TWO = """<routes>
  <vType id="slow" length="4.8" width="1.8" maxSpeed="12" sigma="0" speedFactor="1" speedDev="0"/>
  <vType id="fast" length="4.8" width="1.8" color="white"/>
  <vehicle id="ego" type="fast" depart="0" departLane="{ego}" departPos="60" departSpeed="12">
    <route edges="road exit_lane road_on"/></vehicle>
  <vehicle id="1" type="slow" depart="0" departLane="0" departPos="90" departSpeed="12">
    <route edges="road exit_lane road_on"/></vehicle>
</routes>"""


def speeds_of_the_other(
    tmp_path: Path, lane: int, shift: float, since: float, later: float
) -> list[float]:
    """Speeds of vehicle 1, which the ego passes at 5 s.

    The ego moves `shift` m to the left in 4 s, and has the speed `later` [m/s] from 8 s on.
    """
    routes = tmp_path / "two.rou.xml"
    routes.write_text(TWO.format(ego=lane))
    speeds = []
    with Simulation(dataclasses.replace(load("motorway"), routes=routes, spawn=None)) as world:
        (x, start) = world.scene().ego.position
        y = start
        for k in range(1, 140):
            share = min(max((0.1 * k - since) / 4.0, 0.0), 1.0)
            aside = start + shift * share**2 * (3.0 - 2.0 * share)
            speed = 18.0 if k < 80 else later
            heading = math.atan2(aside - y, 0.1 * speed)
            x, y = x + 0.1 * speed, aside
            scene = world.step(Command((x, y), heading, speed))
            speeds.append(scene.vehicles[1].speed)
            assert (scene.ego.width, scene.ego.colour) == (1.8, "white")
        assert world.scene().ego.position[0] > world.scene().vehicles[1].position[0]
        assert world.step(None).ego.width == 1.8
    return speeds


def test_nobody_brakes_for_the_ego_that_overtakes(tmp_path: Path) -> None:
    assert min(speeds_of_the_other(tmp_path, lane=0, shift=3.75, since=1.0, later=18.0)) > 11.9


def test_others_brake_for_the_ego_that_cuts_in(tmp_path: Path) -> None:
    assert min(speeds_of_the_other(tmp_path, lane=1, shift=-3.75, since=4.5, later=8.0)) < 11.0


def test_a_new_way_is_told_as_soon_as_sumo_takes_the_ego_to_be_on_a_lane(tmp_path: Path) -> None:
    """It is decided on while the ego is off every lane, where SUMO accepts no other route."""
    file = tmp_path / "two.rou.xml"
    file.write_text(TWO.format(ego=0))
    motorway = dataclasses.replace(load("motorway"), routes=file, spawn=None)
    way, routes = ("exit_lane", "ramp"), []
    with Simulation(motorway) as world:
        told: list[tuple[float, tuple[str, ...]]] = [(-13.1, ()), (-150.0, ()), (-150.0, way)]
        for k, (y, known) in enumerate([*told, (-13.1, way), (-13.1, way)]):
            scene = world.step(Command((750.0 + 0.5 * k, y), 0.0, 5.0, known))
            assert scene.ego.position == pytest.approx((750.0 + 0.5 * k, y))
            routes.append(world._engine.api.vehicle.getRoute("ego")[-1])
    assert routes == ["road_on"] * 4 + ["ramp"]


def test_the_ego_can_be_given_back_to_sumo() -> None:
    with Simulation(S1) as world:
        ego = world.scene().ego
        x, y = ego.position
        for k in range(5):
            world.step(Command((x + 0.5 * (k + 1), y), 0.0, 5.0))
        speeds = [world.step(None).ego.speed for _ in range(40)]
    assert speeds[-1] > 9.0


def test_others_are_seen_within_the_radius_and_keep_their_names() -> None:
    seen: dict[int, list[float]] = {}
    near = dataclasses.replace(S1, view_radius=80.0)
    for scene in ride(near, 0, 150):
        assert list(scene.vehicles) == sorted(scene.vehicles)
        for name, state in scene.vehicles.items():
            distance = math.dist(state.position, scene.ego.position)
            assert distance <= 80.0
            seen.setdefault(name, []).append(scene.time)
    assert set(seen) == {0, 1, 2}
    assert seen[2][0] > 2.0


def test_a_scene_tells_what_can_be_seen_and_no_intent() -> None:
    assert {field.name for field in dataclasses.fields(VehicleState)} == {
        *("position", "heading", "speed", "acceleration"),
        *("length", "width", "kind", "colour", "signals"),
    }
    seen = {"time", "vehicles", "lights", "people", "unseen"}
    assert {field.name for field in dataclasses.fields(Scene)} == seen


def test_lights_are_seen() -> None:
    shown = {light for scene in ride(S1, 0, 100) for light in scene.vehicles[1].signals}
    assert shown == {"right", "brake"}


def test_the_ego_shows_the_lights_that_it_is_told_to() -> None:
    with Simulation(S1) as world:
        x, y = world.scene().ego.position
        for k, lights in enumerate([("left",), ("right", "brake"), (), ("brake",)], 1):
            command = Command((x + 0.8 * k, y), 0.0, 8.0, lights=lights)
            assert world.step(command).ego.signals == lights
        assert "brake" not in world.step(Command((x + 4.0, y), 0.0, 8.0)).ego.signals


def test_the_ego_gets_its_own_lights_back_from_sumo() -> None:
    with Simulation(S1) as world:
        x, y = world.scene().ego.position
        world.step(Command((x + 0.8, y), 0.0, 8.0, lights=("left", "right")))
        assert world.step(None).ego.signals != ("left", "right")


def test_collisions_are_told_by_boxes_even_across_lanes() -> None:
    with Simulation(S1) as world:
        assert world.collisions() == ()
        ahead = world.scene().vehicles[1]
        x, y = ahead.position
        # Beside vehicle 1, over the lane boundary: 0.6 m of both bodies overlap.
        world.step(Command((x + ahead.speed * 0.1, y - 1.2), 0.0, 5.0))
        assert world.collisions() == (1,)


def test_sumo_agrees_on_a_crash_within_a_lane() -> None:
    with Simulation(S1) as world:
        ahead = world.scene().vehicles[1]
        x, y = ahead.position
        world.step(Command((x - 2.0, y), 0.0, 5.0))
        assert world.collisions() == (1,)
        assert world.sumo_collisions() == (1,)


def test_one_simulation_per_process() -> None:
    with Simulation(S1), pytest.raises(SimulationRunning, match="in this process"):
        Simulation(dataclasses.replace(S1, seed=1))
    with Simulation(S2) as world:
        world.close()
        world.close()


def test_the_end_of_the_egos_route_is_told() -> None:
    with pytest.raises(EgoGone, match="not on the road at"):
        ride(S2, 0, 600)


@pytest.mark.parametrize(
    ("vehicle", "words"),
    [
        ('departPos="10" type="nix"><route edges="south_in east_out"/>', "nix"),
        ('departPos="10"><route edges="south_in west_in"/>', "No connection between edge"),
        ('departPos="10" departLane="7"><route edges="south_in east_out"/>', "departLane"),
        ('departPos="10" color="mauve"><route edges="south_in east_out"/>', "'ego'.*'mauve'"),
    ],
)
def test_errors_of_sumo_are_translated(
    tmp_path: Path, vehicle: str, words: str, capfd: pytest.CaptureFixture[str]
) -> None:
    routes = tmp_path / "broken.rou.xml"
    routes.write_text(f'<routes><vehicle id="ego" depart="0" {vehicle}</vehicle></routes>')
    with pytest.raises(SumoFailed, match=words) as caught:
        Simulation(dataclasses.replace(S2, routes=routes))
    assert str(caught.value).startswith(f"{routes}: ")
    assert capfd.readouterr() == ("", "")
    assert len(ride(S2, 0, 1)) == 2  # a failed start leaves nothing behind


def test_ids_that_are_no_numbers_get_names(tmp_path: Path) -> None:
    routes = tmp_path / "named.rou.xml"
    text = S1.routes.read_text().replace('id="1"', 'id="van"').replace('id="2"', 'id="1"')
    routes.write_text(text.replace(' color="blue"', ""))
    scenes = ride(dataclasses.replace(S1, routes=routes, view_radius=100.0), 0, 60)
    assert set(scenes[0].vehicles) == {EGO, 2}
    assert set(scenes[-1].vehicles) == {EGO, 1, 2}
    assert scenes[0].vehicles[2].colour is None
    assert scenes[-1].vehicles[1].colour == "red"


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (ModuleNotFoundError("No module named 'libsumo'"), "pip install libsumo"),
        (ImportError("libGL.so.1: cannot open shared object"), r"libGL.*apt-get install -y libgl1"),
    ],
)
def test_what_sumo_lacks_is_named(
    monkeypatch: pytest.MonkeyPatch, error: ImportError, words: str
) -> None:
    def refuse(name: str) -> ModuleType:
        raise error

    monkeypatch.setattr(importlib, "import_module", refuse)
    with pytest.raises(SumoMissing, match=words):
        Simulation(S1)
    assert not engine._running
