from dataclasses import replace

import pytest

from planner.driving.driver import Driver
from planner.driving.memory import HIDDEN, HISTORY, Memory
from planner.record.trace import Settings, encode
from planner.record.trace_reading import decode
from sim.scene import EGO, Scene, VehicleState
from tests.planner.worlds import LENGTH, WIDTH, before_end, goal, roads, still

STEP = 0.1  # [s]
LANE = "main_in_1"


def at(lane: str, away: float, speed: float, kind: str = "car") -> VehicleState:
    """A vehicle at a distance [m] before the junction of s1."""
    state = still("s1", (lane,), before_end("s1", lane, away), speed).state
    size = (12.0, 2.5) if kind == "truck" else (LENGTH, WIDTH)
    return replace(state, kind=kind, length=size[0], width=size[1])


def scene(time: float, *, truck: bool = True, car: bool = True, speed: float = 8.0) -> Scene:
    """The ego, a truck ahead of it and a car ahead of the truck, in one lane."""
    moved = speed * time
    vehicles = {EGO: at(LANE, 150.0 - moved, speed)}
    if truck:
        vehicles[1] = at(LANE, 120.0 - moved, speed, "truck")
    if car:
        vehicles[2] = at(LANE, 95.0 - moved, speed)
    return Scene(round(time, 3), vehicles)


def seen_until(time: float) -> Memory:
    memory = Memory(roads("s1"))
    for k in range(round(time / STEP) + 1):
        memory.observe(scene(k * STEP))
    return memory


def test_who_is_hidden_is_taken_to_go_on() -> None:
    memory = seen_until(1.0)
    assert memory.unseen == {}
    for k in range(11, 31):
        memory.observe(scene(k * STEP, car=False))
    assert memory.unseen == {2: pytest.approx(1.0)}
    expected = scene(3.0).vehicles[2]
    assert memory.now[2].position == pytest.approx(expected.position, abs=0.1)
    assert memory.now[2].speed == pytest.approx(8.0)
    assert len(memory.track(2, 3.0).speed) == 16


def test_the_history_names_the_times_in_which_nothing_was_seen() -> None:
    memory = seen_until(1.0)
    for k in range(11, 21):
        memory.observe(scene(k * STEP, car=False))
    assert memory.recorded(2, 2.0).assumed == ((1.0, 2.0),)
    assert memory.recorded(1, 2.0).assumed == ()
    for k in range(21, 31):
        memory.observe(scene(k * STEP))
    assert memory.recorded(2, 3.0).assumed == ((1.0, 2.1),)
    for k in range(31, 131):
        memory.observe(scene(k * STEP))
    assert memory.recorded(2, 13.0).assumed == ()  # longer ago than a history reaches


def test_who_is_hidden_for_long_is_forgotten() -> None:
    memory = seen_until(1.0)
    for k in range(11, 11 + round(HIDDEN / STEP) + 2):
        memory.observe(scene(k * STEP, car=False))
    assert set(memory.now) == {EGO, 1}
    assert memory.unseen == {}


def test_who_should_be_seen_and_is_not_is_gone() -> None:
    memory = seen_until(1.0)
    memory.observe(scene(1.1, truck=False, car=False))
    assert set(memory.now) == {EGO}


def test_a_passenger_car_hides_nobody() -> None:
    memory = Memory(roads("s1"))
    small = {1: at(LANE, 120.0, 8.0), 2: at(LANE, 95.0, 8.0)}
    memory.observe(Scene(0.0, {EGO: at(LANE, 150.0, 8.0), **small}))
    memory.observe(Scene(0.1, {EGO: at(LANE, 149.2, 8.0), 1: at(LANE, 119.2, 8.0)}))
    assert set(memory.now) == {EGO, 1}


def test_who_comes_back_is_seen_again() -> None:
    memory = seen_until(1.0)
    memory.observe(scene(1.1, car=False))
    memory.observe(scene(1.2))
    assert memory.unseen == {}
    assert memory.now[2].position == pytest.approx(scene(1.2).vehicles[2].position, abs=0.01)


def test_a_decision_reckons_with_the_hidden_and_records_it() -> None:
    driver = Driver(roads("s1").network, goal("s1"), Settings(rollouts=10, min_rollouts=2), 0)
    driver.step(scene(0.0), STEP)
    traces = []
    for k in range(1, 12):
        step = driver.step(scene(k * STEP, car=False), STEP)
        traces += [step.trace] if step.trace else []
    assert traces[-1].unseen == {2: 0.0}
    assert 2 in traces[-1].scene
    assert [known.vehicle for known in traces[-1].predictions] == [1, 2]
    assert decode(encode(traces[-1])) == traces[-1]


def test_lights_are_remembered_with_the_moments_they_changed() -> None:
    memory = Memory(roads("s1"))
    shown = {0.0: (), 0.5: ("left",), 1.3: ("left", "brake"), 1.4: ("left",), 2.0: ()}
    lit: tuple[str, ...] = ()
    for k in range(31):
        now = scene(k * STEP)
        lit = shown.get(now.time, lit)
        vehicles = {**now.vehicles, 2: replace(now.vehicles[2], signals=lit)}
        memory.observe(Scene(now.time, vehicles))
    track = memory.recorded(2, 3.0)
    assert [(change.time, change.shown) for change in track.lights] == list(shown.items())
    assert [change.shown for change in memory.recorded(EGO, 3.0).lights] == [()]
    assert memory.track(2, 3.0).lights == ()


def test_lights_before_the_track_are_those_at_its_start() -> None:
    memory = Memory(roads("s1"))
    for k in range(round((HISTORY + 3.0) / STEP) + 1):
        now = scene(k * STEP, speed=2.0)
        lit = ("brake",) if now.time >= 1.0 else ()
        vehicles = {**now.vehicles, 2: replace(now.vehicles[2], signals=lit)}
        memory.observe(Scene(now.time, vehicles))
    track = memory.recorded(2, HISTORY + 3.0)
    assert track.start == pytest.approx(3.0)
    assert [(change.time, change.shown) for change in track.lights] == [(track.start, ("brake",))]


def test_a_decision_records_lights_and_the_road() -> None:
    driver = Driver(roads("s1").network, goal("s1"), Settings(rollouts=10, min_rollouts=2), 0)
    trace = driver.step(scene(0.0), STEP).trace
    assert trace is not None
    assert [len(track.lights) for track in trace.history.values()] == [1, 1, 1]
    assert trace.road is not None
    assert set(trace.road.places) == {0, 1, 2}
    assert decode(encode(trace)) == trace
