"""Rides in SUMO to a crossroads with a house at the corner: slow tests."""

from dataclasses import dataclass
from pathlib import Path

import pytest

from planner.counterfactuals.whatif import WhatIf, replan
from planner.driving.driver import Driver
from planner.record.trace import EgoGoal, PlanTrace, Settings, encode
from planner.record.trace_reading import decode
from sim.roads.netfile import read_network
from sim.roads.network import Network
from sim.sumo import Simulation
from tests.planner.corner import OTHER, at_the_corner

pytestmark = pytest.mark.slow

QUICK = Settings(rollouts=30, min_rollouts=4)


@dataclass(frozen=True)
class Ride:
    """One ride."""

    network: Network
    traces: tuple[PlanTrace, ...]
    slowest: float  # [m/s]
    collisions: int
    arrived: float | None  # [s]

    @property
    def hidden(self) -> list[PlanTrace]:
        """The decisions in which somebody was imagined."""
        return [trace for trace in self.traces if trace.phantoms]


def ridden(folder: Path, *, house: bool, others: str = "") -> Ride:
    scenario = at_the_corner(folder, house=house, others=others)
    network = read_network(scenario.network)
    goal = EgoGoal(scenario.goal.edge, scenario.goal.position, scenario.goal.lane)
    driver = Driver(network, goal, QUICK, 0)
    traces: list[PlanTrace] = []
    speeds, collisions = [], 0
    with Simulation(scenario) as world:
        scene = world.scene()
        while not driver.finished and scene.time < 45.0:
            step = driver.step(scene, scenario.step)
            traces += [step.trace] if step.trace else []
            speeds.append(scene.ego.speed)
            scene = world.step(step.command)
            collisions += len(world.collisions())
    arrived = scene.time if driver.finished else None
    return Ride(network, tuple(traces), min(speeds), collisions, arrived)


@pytest.fixture(scope="module")
def empty(tmp_path_factory: pytest.TempPathFactory) -> Ride:
    return ridden(tmp_path_factory.mktemp("empty"), house=True)


@pytest.fixture(scope="module")
def open_field(tmp_path_factory: pytest.TempPathFactory) -> Ride:
    return ridden(tmp_path_factory.mktemp("open"), house=False)


def test_behind_a_house_it_slows_down_though_nobody_comes(empty: Ride, open_field: Ride) -> None:
    assert empty.collisions == open_field.collisions == 0
    assert open_field.slowest > 11.0
    assert open_field.hidden == []
    assert 1.0 < empty.slowest < 5.0
    assert len(empty.hidden) >= 3
    for trace in empty.hidden:
        assert {one.behind for one in trace.phantoms} == {None}
        assert {one.lanes[0] for one in trace.phantoms} == {"west_in_0"}


def test_it_does_not_wait_there_for_nobody(empty: Ride, open_field: Ride) -> None:
    assert empty.arrived is not None
    assert open_field.arrived is not None
    assert 1.0 < empty.arrived - open_field.arrived < 7.0
    assert empty.traces[-1].phantoms == ()


def test_what_it_imagined_is_why_it_slowed(empty: Ride) -> None:
    trace = empty.hidden[1]
    assert decode(encode(trace)) == trace
    assert any(held.phantom == 0 for r in trace.rollouts for held in r.held_by_hidden)
    again = replan(trace, empty.network, WhatIf(seen_past=tuple(range(len(trace.phantoms)))))
    assert again.phantoms == ()
    assert again.plan[0].value > trace.plan[0].value + 1.0


@pytest.mark.parametrize("place", [38, 62, 77])
def test_somebody_who_does_come_is_met_by_nobody(tmp_path: Path, place: int) -> None:
    # At 77 m, who drives on as if the hidden road were empty is hit.
    ride = ridden(tmp_path, house=True, others=OTHER.format(depart=0, place=place))
    assert ride.collisions == 0
    assert ride.arrived is not None
