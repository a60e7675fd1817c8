"""The stories of s1 and s2 driven in SUMO: slow tests."""

import itertools
import xml.etree.ElementTree as ET
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import msgspec
import pytest

from planner.counterfactuals.whatif import WhatIf, replan
from planner.driving.driver import Driver
from planner.record.events import Event
from planner.record.trace import ROOM, Action, EgoGoal, PlanTrace, Settings, encode
from planner.roads.trajectory import Roads
from planner.search.decide import decide
from planner.search.inputs import Frame, Moment, Root, root_at
from sim.roads.netfile import read_network
from sim.scene import EGO, Scene
from sim.setup.scenario import Scenario, load
from sim.sumo import Simulation

pytestmark = pytest.mark.slow

SEEDS = range(10)
MOST = 8  # of ten
HARD_BRAKE = -4.5  # [m/s2]


@dataclass(frozen=True)
class Ride:
    """One ride in SUMO."""

    scenes: tuple[Scene, ...]
    traces: tuple[PlanTrace, ...]
    events: tuple[Event, ...]
    collisions: tuple[int, ...]
    finished: bool

    @property
    def started(self) -> list[Action | None]:
        """The macro actions of the ego, in order."""
        return [event.action for event in self.events if event.kind == "action-started"]


def drive(scenario: Scenario, seed: int) -> Ride:
    goal = EgoGoal(scenario.goal.edge, scenario.goal.position, scenario.goal.lane)
    driver = Driver(read_network(scenario.network), goal, Settings(), seed)
    scenes, traces, events, collisions = [], [], [], []
    with Simulation(replace(scenario, seed=seed)) as simulation:
        scene = simulation.scene()
        while not driver.finished and scene.time < scenario.duration:
            step = driver.step(scene, scenario.step)
            scenes.append(scene)
            traces += [step.trace] if step.trace else []
            events += step.events
            scene = simulation.step(step.command)
            collisions += simulation.collisions()
    return Ride((*scenes, scene), tuple(traces), tuple(events), tuple(collisions), driver.finished)


@cache
def ride(name: str, seed: int) -> Ride:
    return drive(load(name), seed)


@cache
def roads(name: str) -> Roads:
    return Roads(read_network(load(name).network))


def lane_change(seed: int) -> PlanTrace | None:
    """The decision of s1 to change left."""
    return next((t for t in ride("s1", seed).traces if t.plan[0].action == "change-left"), None)


def decided_again(trace: PlanTrace, settings: Settings) -> PlanTrace:
    """The decision that the recorded scene and history lead to."""
    here = root_at(roads("s1"), trace.scene[EGO], trace.sim_time)
    assert here is not None
    frame = Frame(roads("s1"), trace.goal, settings, trace.seed, trace.vehicle)
    moment = Moment(
        trace.decision,
        trace.sim_time,
        trace.scene,
        trace.history,
        Root(here, driving=trace.driving),
    )
    return decide(frame, moment).trace


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("name", ["s1", "s2"])
def test_the_goal_is_reached_without_a_collision(name: str, seed: int) -> None:
    done = ride(name, seed)
    assert done.collisions == ()
    assert done.finished
    assert done.events[-1].kind == "arrived"
    assert "stop" not in done.started
    assert max(len(encode(trace)) for trace in done.traces) <= ROOM
    speeds = [scene.ego.speed for scene in done.scenes]
    step = load(name).step
    changes = [(b - a) / step for a, b in itertools.pairwise(speeds)]
    assert min(changes) > HARD_BRAKE


def test_s1_changes_left_once_and_continues() -> None:
    stories = [ride("s1", seed).started for seed in SEEDS]
    assert stories.count(["continue", "change-left", "continue"]) >= MOST
    assert all(story.count("change-left") <= 1 for story in stories)


def test_s1_foresees_that_vehicle_1_turns_right_when_it_changes_lane() -> None:
    foreseen = []
    for trace in filter(None, map(lane_change, SEEDS)):
        goals = next(known.goals for known in trace.predictions if known.vehicle == 1)
        foreseen.append(sum(goal.probability for goal in goals if goal.kind == "exit-right"))
    assert sum(probability >= 0.7 for probability in foreseen) >= MOST
    assert min(foreseen) > 0.5


def test_a_decision_can_be_taken_again_from_its_trace() -> None:
    for trace in filter(None, map(lane_change, SEEDS[:3])):
        assert encode(decided_again(trace, trace.settings)) == encode(trace)


def test_without_recognition_s1_decides_otherwise() -> None:
    firsts = []
    for trace in filter(None, map(lane_change, SEEDS)):
        naive = msgspec.structs.replace(trace.settings, recognition=False)
        firsts.append(decided_again(trace, naive).plan[0].action)
    assert sum(action != "change-left" for action in firsts) > len(firsts) / 2


def test_without_vehicle_1_s1_plans_no_lane_change() -> None:
    network = roads("s1").network
    for trace in filter(None, map(lane_change, SEEDS)):
        assert replan(trace, network, WhatIf(removed=1)).plan[0].action == "continue"


def test_without_vehicle_1_s1_drives_straight_on(tmp_path: Path) -> None:
    scenario = load("s1")
    for file in scenario.folder.iterdir():
        (tmp_path / file.name).write_bytes(file.read_bytes())
    routes = ET.parse(scenario.routes)
    removed = [x for x in routes.getroot().iter("vehicle") if x.get("id") == "1"]
    routes.getroot().remove(removed[0])
    routes.write(tmp_path / scenario.routes.name)
    done = drive(load(tmp_path), seed=0)
    assert done.finished
    assert done.started == ["continue"]


def overtaken_in_the_junction(done: Ride) -> bool:
    """Whether the ego of s2 has left the junction while vehicle 1 is still inside."""
    network = roads("s2").network
    turned = next(event.sim_time for event in done.events if event.kind == "action-ended")
    scene = next(scene for scene in done.scenes if scene.time >= turned - 1e-6)
    if 1 not in scene.vehicles:
        return False
    other = scene.vehicles[1]
    found = network.locate(other.position, other.heading)
    return bool(found) and any(network.lanes[place.lane].internal for place in found)


def test_s2_turns_right_ahead_of_the_waiting_vehicle_1() -> None:
    rides = [ride("s2", seed) for seed in SEEDS]
    assert all(done.started == ["exit-right", "continue"] for done in rides)
    assert sum(map(overtaken_in_the_junction, rides)) >= MOST


def test_s2_knows_why_vehicle_1_waits() -> None:
    sure = 0
    for seed in SEEDS:
        standing = [
            goal.probability
            for trace in ride("s2", seed).traces
            for known in trace.predictions
            for goal in known.goals
            if known.vehicle == 1
            and goal.kind == "exit-left"
            and max(trace.history[1].speed[-6:]) < 0.1  # for a second
        ]
        sure += bool(standing) and min(standing) > 0.7
    assert sure >= MOST
