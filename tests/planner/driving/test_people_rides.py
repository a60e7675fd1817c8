"""Rides in SUMO among people on foot and on bicycles: slow tests."""

import math
from dataclasses import replace
from pathlib import Path

import pytest

from planner.counterfactuals.whatif import WhatIf, replan
from planner.driving.driver import Driver
from planner.record.trace import ON_FOOT, EgoGoal, PlanTrace, Settings, encode
from planner.record.trace_reading import decode
from sim.boxes import overlap
from sim.roads.netfile import read_network
from sim.roads.network import Network
from sim.scene import Scene
from sim.setup.scenario import load
from sim.sumo import Simulation
from tests.sim.footways import person, zebra_folder

pytestmark = pytest.mark.slow

QUICK = Settings(rollouts=30, min_rollouts=4)
ACROSS = person("one", "am", 107.0, "bm")
BICYCLE = (
    '<vType id="bike" vClass="bicycle" maxSpeed="4.5"/>'
    '<vehicle id="cyclist" type="bike" depart="0" departPos="40" departSpeed="4">'
    '<route edges="am mb"/></vehicle>'
)


class Ride:
    """One ride of a folder."""

    def __init__(self, folder: Path, lasting: float = 60.0) -> None:
        scenario = load(folder)
        self.network: Network = read_network(scenario.network)
        goal = EgoGoal(scenario.goal.edge, scenario.goal.position, scenario.goal.lane)
        driver = Driver(self.network, goal, QUICK, 0)
        self.scenes: list[Scene] = []
        self.traces: list[PlanTrace] = []
        self.events = []
        self.hit: set[int] = set()
        with Simulation(scenario) as simulation:
            scene = simulation.scene()
            while not driver.finished and scene.time < lasting:
                step = driver.step(scene, scenario.step)
                self.scenes.append(scene)
                self.traces += [step.trace] if step.trace else []
                self.events += step.events
                scene = simulation.step(step.command)
                self.hit |= set(simulation.collisions())
        self.finished = driver.finished

    def stopped(self) -> list[float]:
        """When [s] somebody who walked stopped right before the ego."""
        found = []
        for before, after in zip(self.scenes, self.scenes[1:], strict=False):
            for name, state in after.people.items():
                was = before.people.get(name)
                if was is None or was.speed < 0.7 or state.speed > 0.3:
                    continue
                (x, y), a = state.position, state.heading
                tip = (x + 2.0 * math.cos(a), y + 2.0 * math.sin(a))
                if overlap(replace(state, position=tip, length=2.0), after.ego):
                    found.append(after.time)
        return found


@pytest.fixture(scope="module")
def ride(tmp_path_factory: pytest.TempPathFactory) -> Ride:
    """A ride over a crossing that somebody walks over."""
    people = ACROSS + person("two", "bm", 107.0, "am") + person("three", "am", 90.0, "mb")
    return Ride(zebra_folder(tmp_path_factory.mktemp("zebra"), people))


def test_people_are_let_cross(ride: Ride) -> None:
    assert ride.finished
    assert ride.hit == set()
    assert ride.stopped() == []
    pairs = zip(ride.scenes, ride.scenes[1:], strict=False)
    assert min((b.ego.speed - a.ego.speed) / 0.1 for a, b in pairs) > -4.5


def test_giving_way_to_people_is_told(ride: Ride) -> None:
    told = [event.vehicle for event in ride.events if event.kind == "gave-way"]
    people = {name for scene in ride.scenes for name in scene.people}
    assert told
    assert set(told) <= people


def test_people_are_recorded(ride: Ride) -> None:
    crossing = 0
    for trace in ride.traces:
        assert decode(encode(trace)) == trace
        for known in trace.predictions:
            if trace.scene[known.vehicle].kind in ON_FOOT:
                kinds = {goal.kind for goal in known.goals}
                assert kinds <= {"cross", "continue", "stop"}
                crossing += "cross" in kinds
                assert trace.history[known.vehicle].lights == ()
    assert crossing > 3


def held(trace: PlanTrace) -> set[int]:
    """Who holds the ego up in rollouts by right of way."""
    return {x.vehicle for r in trace.rollouts for x in r.held_up if x.how == "right-of-way"}


def test_people_can_be_removed_and_supposed_to_stay(ride: Ride) -> None:
    trace = next(trace for trace in ride.traces if held(trace))
    people = [name for name, state in trace.scene.items() if state.kind in ON_FOOT]
    assert held(trace) <= set(people)
    alone = replan(trace, ride.network, WhatIf(removed=tuple(people)))
    assert held(alone) == set()
    first = min(held(trace))
    stays = replan(trace, ride.network, WhatIf(vehicle=first, goal="stop"))
    (goal,) = next(known.goals for known in stays.predictions if known.vehicle == first)
    assert (goal.kind, goal.probability) == ("stop", 1.0)
    assert first not in held(stays)


def test_a_bicycle_is_followed_or_passed_with_room(tmp_path: Path) -> None:
    ride = Ride(zebra_folder(tmp_path, BICYCLE, lanes=2))
    assert ride.finished
    for scene in ride.scenes:
        for state in scene.vehicles.values():
            if state.kind == "bicycle":
                along = scene.ego.position[0] - state.position[0]
                if -state.length < along < scene.ego.length:
                    aside = abs(scene.ego.position[1] - state.position[1])
                    assert aside - 0.5 * (state.width + scene.ego.width) >= 1.45
    assert ride.scenes[-1].time < 35.0
