"""Rides in SUMO through a junction with lights: slow tests."""

from dataclasses import dataclass
from pathlib import Path

import pytest

from planner.counterfactuals.whatif import NotInView, WhatIf, WhatIfError, replan
from planner.driving.driver import Driver
from planner.manoeuvres.actions import STANDING_TIME
from planner.motion.tracks import lanes_at
from planner.record.events import Event, LightPlace
from planner.record.light_record import LightSupposed
from planner.record.trace import EgoGoal, PlanTrace, Settings, encode
from planner.record.trace_reading import decode
from planner.roads.trajectory import Roads
from sim.roads.netfile import read_network
from sim.roads.network import Network
from sim.scene import EGO, LightState, Scene, Signal
from sim.setup.scenario import load
from sim.sumo import Simulation
from tests.sim.crossroads import ROUTES, TOML, signalled

pytestmark = pytest.mark.slow

QUICK = Settings(rollouts=30, min_rollouts=4)
GOING = (LightState.GREEN, LightState.GREEN_YIELD)


@dataclass(frozen=True)
class Ride:
    """One ride."""

    network: Network
    scenes: tuple[Scene, ...]
    traces: tuple[PlanTrace, ...]
    events: tuple[Event, ...]
    collisions: tuple[int, ...]
    finished: bool
    passed: tuple[tuple[float, float, LightState | None, float], ...]
    """Of every line passed: when [s], how fast [m/s], what it showed, and since when [s]."""


def drive(folder: Path, *, lasting: float) -> Ride:
    """Drive a folder's scenario, and note what lights showed when the front passed their line."""
    scenario = load(folder)
    network = read_network(scenario.network)
    goal = EgoGoal(scenario.goal.edge, scenario.goal.position, scenario.goal.lane)
    driver, roads = Driver(network, goal, QUICK, 0), Roads(network)
    scenes: list[Scene] = []
    traces: list[PlanTrace] = []
    events: list[Event] = []
    collisions: list[int] = []
    passed = []
    with Simulation(scenario) as simulation:
        scene = simulation.scene()
        while not driver.finished and scene.time < lasting:
            step = driver.step(scene, scenario.step)
            scenes.append(scene)
            traces += [step.trace] if step.trace else []
            events += step.events
            after = simulation.step(step.command)
            collisions += simulation.collisions()
            signal = entered(roads, scene, after)
            if signal is not None:
                light = scene.light(signal)
                state = None if light is None else light.state
                since = scene.time if light is None else light.since
                passed.append((scene.time, scene.ego.speed, state, since))
            scene = after
    return Ride(
        network,
        (*scenes, scene),
        tuple(traces),
        tuple(events),
        tuple(collisions),
        driver.finished,
        tuple(passed),
    )


def entered(roads: Roads, before: Scene, after: Scene) -> Signal | None:
    """The light whose line the ego's front passed between two scenes."""
    here, there = (
        lanes_at(roads, scene.ego.position, scene.ego.heading) for scene in (before, after)
    )
    if not here or not there or roads.network.lanes[here[0].lane].internal:
        return None
    link = roads.network.link_via(there[0].lane)
    return link.control if link is not None and isinstance(link.control, Signal) else None


def world(folder: Path, ego_to: str, flows: dict[tuple[str, str], int]) -> Path:
    """A crossroads with vehicles that depart every so many seconds between arms."""
    lines = [
        f'<vehicle id="ego" depart="0" departPos="20" departSpeed="10">'
        f'<route edges="left0A0 A0{ego_to}0"/></vehicle>'
    ]
    departs = []
    for k, ((start, end), period) in enumerate(sorted(flows.items())):
        for n in range(60 // period):
            departs.append((n * period + 0.3 * k, f"{start}0A0", f"A0{end}0", f"x{k}_{n}"))
    lines += [
        f'<vehicle id="{name}" depart="{time:.1f}" departSpeed="max">'
        f'<route edges="{start} {end}"/></vehicle>'
        for time, start, end, name in sorted(departs)
    ]
    made = signalled(folder, f"<routes>{''.join(lines)}</routes>")
    toml = TOML.replace("A0right0", f"A0{ego_to}0").replace("duration = 60.0", "duration = 120.0")
    (made / "scenario.toml").write_text(toml, encoding="utf-8")
    return made


@pytest.fixture(scope="module", params=["right", "top", "bottom"])
def ride(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Ride:
    """Straight on, to the left, to the right, among others from all sides."""
    flows = {("right", "left"): 10, ("right", "top"): 25, ("top", "bottom"): 15}
    folder = tmp_path_factory.mktemp(request.param)
    return drive(world(folder, request.param, flows), lasting=100.0)


def test_the_goal_is_reached_without_a_collision(ride: Ride) -> None:
    assert ride.finished
    assert ride.collisions == ()


def test_no_red_light_is_passed(ride: Ride) -> None:
    assert len(ride.passed) == 1
    for _, speed, state, since in ride.passed:
        assert state in (*GOING, LightState.AMBER)
        if state is LightState.AMBER:
            time = ride.passed[0][0]
            assert (time - since) * speed < speed**2 / (2.0 * 3.0)


def test_green_is_used(ride: Ride) -> None:
    """Nobody stands at a green of his own that gives way to none for longer than a reaction."""
    waited = 0.0
    for scene in ride.scenes:
        here = ride.network.locate(scene.ego.position, scene.ego.heading)
        lane = ride.network.lanes[here[0].lane] if here else None
        if lane is None or lane.internal or lane.length - here[0].offset > 4.0:
            continue
        states = [
            light.state
            for link in ride.network.links_from(lane.id)
            if isinstance(link.control, Signal) and (light := scene.light(link.control)) is not None
        ]
        if states and all(state is LightState.GREEN for state in states):
            waited += 0.1 if scene.ego.speed < 0.1 else 0.0
    assert waited < 1.5


def test_stops_at_lights_are_told(ride: Ride) -> None:
    stood = any(
        scene.ego.speed < 0.05 and any(light.state is LightState.RED for light in scene.lights)
        for scene in ride.scenes
    )
    told = [event for event in ride.events if event.kind == "stopped-at-light"]
    assert bool(told) == stood
    for event in told:
        assert isinstance(event.light, LightPlace)
        assert event.light.controller == "A0"


def test_traces_with_lights_are_read_again(ride: Ride) -> None:
    for trace in ride.traces:
        assert decode(encode(trace)) == trace
        for rollout in trace.rollouts:
            varying = [one.controller for one in trace.lights if len(one.courses) > 1]
            assert [light.controller for light in rollout.lights] == varying


def test_what_held_the_car_up_is_recorded(ride: Ride) -> None:
    """While it stands at red, every rollout of the plan is held by that light.

    So it is from the beginning; where the plan is to stop, from the end of that stop.
    """
    for trace in ride.traces:
        lights = () if trace.road is None else trace.road.lights
        standing = trace.scene[EGO].speed < 0.05
        if standing and lights and lights[0].state == "r" and lights[0].distance < 4.0:
            for rollout in trace.rollouts:
                ways = (
                    [one.action for one in actions[:2]] for actions in (rollout.actions, trace.plan)
                )
                if next(ways) != next(ways):
                    continue
                held = rollout.held_by_lights
                assert held
                assert held[0].place == lights[0].place
                stops = STANDING_TIME if trace.plan[0].action == "stop" else 0.0
                assert held[0].since <= trace.sim_time + stops + 0.5


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> Ride:
    """A ride among nobody, which has to stop at red."""
    return drive(signalled(tmp_path_factory.mktemp("alone"), ROUTES), lasting=60.0)


def at_red(ride: Ride) -> PlanTrace:
    """A decision while the ride stands at red."""
    return next(
        trace
        for trace in ride.traces
        if trace.road is not None
        and trace.road.lights
        and trace.road.lights[0].state == "r"
        and trace.scene[EGO].speed < 0.1
    )


def times(trace: PlanTrace) -> list[float]:
    """The times [s] to the goal of the rollouts that reach it."""
    found = [rollout.components["time"] for rollout in trace.rollouts]
    return [time for time in found if time is not None]


def test_a_light_supposed_green_is_driven_through(alone: Ride) -> None:
    trace = at_red(alone)
    assert trace.road is not None
    light = trace.road.lights[0]
    wanted = LightSupposed(light.controller, light.place, "G")
    again = replan(trace, alone.network, WhatIf(lights=(wanted,)))
    assert again.what_if == WhatIf(lights=(wanted,))
    assert all(held.place != light.place for r in again.rollouts for held in r.held_by_lights)
    assert min(times(again)) < min(times(trace), default=60.0)


def test_a_light_that_is_not_in_view_cannot_be_supposed(alone: Ride) -> None:
    trace = at_red(alone)
    with pytest.raises(NotInView, match="'nowhere'"):
        replan(trace, alone.network, WhatIf(lights=(LightSupposed("nowhere", 0, "G"),)))
    with pytest.raises(WhatIfError, match="'x' is not a state"):
        replan(trace, alone.network, WhatIf(lights=(LightSupposed("A0", 0, "x"),)))


def test_the_same_decision_is_taken_again_from_the_record(alone: Ride) -> None:
    """More rollouts of the plan, planned from the trace alone, come to what was recorded."""
    trace = at_red(alone)
    first = trace.plan[0].action
    again = replan(trace, alone.network, WhatIf(actions=(first,), rollouts=6))
    known = {(r.samples, r.lights, tuple(x.action for x in r.actions)): r for r in trace.rollouts}
    more = again.rollouts[len(trace.rollouts) :]
    assert more
    for rollout in more:
        key = (rollout.samples, rollout.lights, tuple(x.action for x in rollout.actions))
        if key in known:
            assert rollout.reward == pytest.approx(known[key].reward, abs=0.05)
