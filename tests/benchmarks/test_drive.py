"""Runs beside SUMO's own driver: who is to blame, what is counted, and who dies alone."""

import json
import math
import operator
import os
from dataclasses import replace
from functools import partial

import msgspec
import pytest
from typer.testing import CliRunner

from benchmarks.drive.drive import DriveReport, report, spread, tally, worst
from benchmarks.drive.fault import caused_by_ego, provoked_by_ego
from benchmarks.drive.monitor import Drive, Ended, Hit, Observer, reached
from benchmarks.drive.runs import Run, in_processes, run
from sim.roads.network import Lane, Link, Network
from sim.scene import Scene, VehicleState
from sim.setup import scenario
from sim.setup.scenario import Goal
from xavi_dialogue.__main__ import app

STEP = 0.1  # [s]


def lane(name: str, edge: str, index: int, y: float, *, internal: bool = False) -> Lane:
    line = ((0.0, y), (200.0, y))
    return Lane(
        name, edge, index, 3.5, 14.0, line, internal, 200.0, 200.0, frozenset({"passenger"})
    )


# Two lanes side by side, and a way through a junction that has to give way, apart from them.
ROADS = Network(
    {
        "a_0": lane("a_0", "a", 0, 0.0),
        "a_1": lane("a_1", "a", 1, 3.5),
        ":j": lane(":j", ":j", 0, 50.0, internal=True),
    },
    (Link("j", 0, "a_0", "a_1", (":j",), "straight", (1,), (1,), False),),
    "roads",
)


def car(
    x: float, y: float = 0.0, speed: float = 10.0, heading: float = 0.0, acceleration: float = 0.0
) -> VehicleState:
    return VehicleState((x, y), heading, speed, acceleration, 4.0, 1.8)


def scenes(*moments: tuple[VehicleState, VehicleState]) -> list[Scene]:
    return [Scene(round(k * STEP, 9), {0: ego, 1: other}) for k, (ego, other) in enumerate(moments)]


def blamed(*moments: tuple[VehicleState, VehicleState]) -> bool:
    *before, now = scenes(*moments)
    return caused_by_ego(before, now, 1, ROADS)


def rear_end(y: list[float], roads_y: float = 0.0) -> list[tuple[VehicleState, VehicleState]]:
    """Vehicle 1 runs into the rear of the ego, whose way sideways is `y`."""
    last = len(y) - 1
    return [
        (car(100.0 + k, roads_y + y[k]), car(96.5 + k - (last - k) * 0.6, roads_y + y[-1], 16.0))
        for k in range(len(y))
    ]


def test_who_is_run_into_while_standing_is_not_to_blame() -> None:
    crossing = [
        (car(50.0, speed=0.0), car(49.0, -1.0 - (12 - k), heading=math.pi / 2)) for k in range(13)
    ]
    assert not blamed(*crossing)
    assert blamed(*crossing[-3:])  # it had only just come to a stop
    moving = [(replace(ego, speed=1.0), other) for ego, other in crossing]
    assert blamed(*moving)


def test_who_is_hit_in_the_rear_in_its_lane_is_not_to_blame() -> None:
    assert not blamed(*rear_end([0.0] * 30))


def test_who_has_just_changed_lanes_is_to_blame_for_being_hit_in_the_rear() -> None:
    assert blamed(*rear_end([3.5] * 10 + [0.0] * 10))
    assert not blamed(*rear_end([3.5] * 10 + [0.0] * 40))  # that is long past


def test_who_sticks_out_of_its_lane_is_to_blame_for_being_hit_in_the_rear() -> None:
    assert blamed(*rear_end([1.2] * 30))


def test_who_came_from_where_it_had_to_give_way_is_to_blame() -> None:
    assert not blamed(*rear_end([0.0] * 30, roads_y=0.0))
    assert blamed(*rear_end([0.0] * 30, roads_y=50.0))


def test_who_runs_into_another_is_to_blame() -> None:
    ahead = [(car(50.0 + k), car(82.9 - 0.5 * (29 - k), speed=5.0)) for k in range(30)]
    assert blamed(*ahead)
    oncoming = [(car(50.0), car(52.0, heading=math.pi))] * 2
    assert blamed(*oncoming)


def test_a_vehicle_that_comes_from_nowhere_is_the_egos_fault() -> None:
    now = Scene(1.0, {0: car(50.0), 1: car(51.0)})
    assert caused_by_ego([Scene(0.9, {0: car(49.0)})], now, 1, ROADS)
    assert caused_by_ego([], now, 1, ROADS)


def test_a_hard_brake_is_provoked_by_the_nearest_ahead() -> None:
    braking = car(0.0, acceleration=-6.0)
    near, far, aside, behind = car(20.0), car(70.0), car(20.0, 5.0), car(-10.0)
    assert provoked_by_ego(Scene(0.0, {0: near, 1: braking}), 1)
    for ego in (far, aside, behind):
        assert not provoked_by_ego(Scene(0.0, {0: ego, 1: braking}), 1)
    assert not provoked_by_ego(Scene(0.0, {0: near, 1: braking, 2: car(12.0)}), 1)
    assert provoked_by_ego(Scene(0.0, {0: near, 1: braking, 2: car(30.0)}), 1)


def test_an_observer_counts_beginnings() -> None:
    observer = Observer(ROADS, Goal("a", 150.0, None))
    hard, soft = -5.0, -1.0
    for k, pressed in enumerate((soft, hard, hard, soft, hard)):
        ego = car(50.0 + k, acceleration=pressed)
        others = {1: car(30.0 + k, acceleration=pressed), 2: car(150.0, acceleration=pressed)}
        observer.see(Scene(k * STEP, {0: ego, **others}))
    drive = observer.drive("duration")
    assert (drive.hard_brakes, drive.provoked, drive.hits) == (2, 2, ())
    assert drive.time == pytest.approx(0.4)


def test_an_observer_names_whom_the_ego_touches() -> None:
    observer = Observer(ROADS, Goal("a", 150.0, None))
    for scene in scenes((car(50.0), car(60.0, speed=0.0)), (car(57.0), car(60.0, speed=0.0))):
        observer.see(scene)
    assert observer.drive("collided").hits == (Hit(1, 0.1, True),)


@pytest.mark.parametrize(
    ("x", "y", "wanted", "there"),
    [
        (149.0, 0.0, None, False),
        (150.0, 0.0, None, True),
        (151.0, 3.5, None, True),
        (151.0, 3.5, 0, False),
        (151.0, 3.5, 1, True),
        (151.0, 50.0, None, False),
        (151.0, 90.0, None, False),
    ],
)
def test_a_goal_is_reached_on_its_edge_and_lane(
    x: float, y: float, wanted: int | None, there: bool
) -> None:
    assert reached(ROADS, Goal("a", 150.0, wanted), Scene(0.0, {0: car(x, y)})) == there


def drive(ended: Ended = "arrived", time: float = 20.0, **more: object) -> Drive:
    plain = Drive(ended, time, (), 0, 0)
    return msgspec.structs.replace(plain, **more)


def test_runs_are_counted() -> None:
    hit, struck = (Hit(1, 3.0, True),), (Hit(2, 4.0, False),)
    runs = [
        Run("s1", 0, drive(time=22.0, hard_brakes=2), drive(time=20.0, provoked=1)),
        Run("s1", 1, drive("collided", hits=hit), drive(time=20.0)),
        Run("s1", 2, drive("collided", hits=struck), drive("collided", hits=hit)),
        Run("s1", 3, drive("duration"), drive("left")),
        Run("s1", 4, drive(time=18.0), drive(time=20.0)),
        Run("s1", 5, error="SumoFailed: no"),
    ]
    found = tally("s1", runs)
    assert (found.runs, found.failed) == (6, 1)
    assert (found.collisions, found.caused, found.avoidable) == (2, 1, 1)
    assert (found.sumo_collisions, found.sumo_caused) == (1, 1)
    assert (found.hard_brakes, found.sumo_provoked) == (2, 1)
    assert (found.reached, found.sumo_reached, found.both) == (2, 3, 2)
    assert found.reached_share == pytest.approx(2 / 3, abs=1e-4)
    assert found.time_ratio == 1.0
    assert found.time_ratio_p90 == pytest.approx(1.08)


def test_nothing_reached_gives_no_ratio() -> None:
    found = tally("s1", [Run("s1", 0, drive("left"), drive("left"))])
    assert (found.reached_share, found.time_ratio, found.time_ratio_p90) == (None, None, None)
    assert "-" in report([Run("s1", 0, drive("left"), drive("left"))]).table()


def test_the_worst_runs_are_listed_worst_first_and_can_be_driven_again() -> None:
    hit, struck = (Hit(1, 3.0, True),), (Hit(2, 4.0, False),)
    fine = drive()
    runs = [
        Run("s1", 0, fine, fine),
        Run("s1", 1, drive(time=30.0), fine),
        Run("s1", 2, drive(time=40.0), fine),
        Run("s1", 3, drive(hard_brakes=1), fine),
        Run("s1", 4, drive("duration"), fine),
        Run("s1", 5, drive("collided", hits=struck), fine),
        Run("s1", 6, drive("collided", hits=hit), fine),
        Run("/my/folder", 7, error="SumoFailed: no"),
        Run("s1", 8, drive("duration"), drive("left")),
    ]
    listed = worst(runs)
    assert [bad.seed for bad in listed] == [7, 6, 5, 4, 3, 2, 1]
    assert listed[0].what == "SumoFailed: no"
    assert listed[0].reproduce == "xavi drive --scenario /my/folder --seed 7"
    assert worst(runs[:1]) == ()


def test_runs_are_spread_evenly_from_seed_0_on() -> None:
    tasks = spread(["s1", "s2", "s3"], 8)
    assert tasks == [(n, k) for n, count in (("s1", 3), ("s2", 3), ("s3", 2)) for k in range(count)]


def test_reports_keep_the_shape_of_all_benchmarks() -> None:
    fine = drive()
    found = report([Run("s1", 0, fine, fine, None, (1.0, 3.0)), Run("s2", 0, fine, fine)])
    read = json.loads(msgspec.json.encode(found))
    assert read["bench"] == "drive"
    [times] = read["figures"]
    assert times == {"name": "s1", "unit": "ms", "n": 2, "p50": 2.0, "p99": 2.98, "most": 3.0}
    assert [one["scenario"] for one in read["scenarios"]] == ["s1", "s2"]
    assert msgspec.json.decode(msgspec.json.encode(found), type=DriveReport) == found
    assert "xavi drive" not in found.table()


@pytest.mark.slow
def test_a_process_that_dies_costs_its_own_task_alone() -> None:
    tasks = [partial(abs, -k) for k in range(4)]
    tasks[2:2] = [partial(os._exit, 3)]
    found = list(in_processes(operator.call, tasks, 2, lambda _: "died"))
    assert found == [0, 1, "died", 2, 3]


@pytest.mark.slow
def test_a_run_that_cannot_be_driven_is_told_as_failed() -> None:
    found = run(("nowhere", 3))
    assert (found.ours, found.sumo) == (None, None)
    assert found.error is not None
    assert found.error.startswith("ScenarioNotFound: there is no scenario 'nowhere'")


@pytest.mark.slow
def test_a_run_is_driven_twice_and_the_same_every_time() -> None:
    once, again = run(("s2", 0)), run(("s2", 0))
    assert once.error is None
    assert once.ours is not None
    assert once.sumo is not None
    assert (once.ours, once.sumo) == (again.ours, again.sumo)
    assert once.ours.ended == once.sumo.ended == "arrived"
    assert len(once.decisions) >= int(once.ours.time)
    assert once.sumo.time < scenario.load("s2").duration


@pytest.mark.slow
def test_the_command_prints_one_object() -> None:
    arguments = ["bench", "drive", "--runs", "1", "--scenario", "s2", "--jobs", "1", "--json"]
    done = CliRunner().invoke(app, arguments)
    assert done.exit_code == 0
    found = json.loads(done.stdout)
    assert (found["all"]["runs"], found["all"]["failed"]) == (1, 0)


def test_a_scenario_that_is_not_there_is_wrong_usage() -> None:
    done = CliRunner().invoke(app, ["bench", "drive", "--scenario", "nowhere"])
    assert (done.exit_code, done.stdout) == (2, "")


def test_a_drive_misses_its_targets_by_a_provoked_brake_or_a_failed_run() -> None:
    fine = drive(time=10.0)
    assert report([Run("s1", 0, fine, fine)]).met
    provoking = report([Run("s1", 0, drive(time=10.0, provoked=1), fine)])
    assert [one.name for one in provoking.targets if not one.met] == ["hard brakes provoked"]
    late = report([Run("s1", 0, drive(time=10.4), fine)])
    assert [one.name for one in late.targets if not one.met] == ["time ratio"]
    failed = report([Run("s1", 0, fine, fine), Run("s1", 1, error="SumoFailed: no")])
    assert [one.name for one in failed.targets if not one.met] == ["runs that failed"]
