import itertools
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import pytest

from planner.driving.driver import Driver, DriverError, DriveStep
from planner.kernels.limits import ACCELERATION, EMERGENCY
from planner.record.events import Event
from planner.record.trace import EgoGoal, PlanTrace, Settings, encode
from planner.roads.trajectory import Path
from sim.boxes import overlap
from sim.roads.network import angle_between
from sim.scene import EGO, Scene, VehicleState
from tests.planner.nets import drawn, lane
from tests.planner.worlds import (
    LENGTH,
    START,
    WIDTH,
    before_end,
    changing,
    goal,
    roads,
    row,
)

STEP = 0.1  # [s]
QUICK = Settings(rollouts=30, min_rollouts=4)


@dataclass(frozen=True)
class Coasting:
    """A vehicle that drives along a line at a steady speed, while it is in view."""

    line: Path
    start: float  # [m] arc at 0 s
    speed: float  # [m/s]
    until: float = math.inf  # [s]

    def at(self, time: float) -> VehicleState | None:
        arc = self.start + self.speed * time
        if time > self.until or arc > self.line.length:
            return None
        return VehicleState(*self.line.pose(arc), self.speed, 0.0, LENGTH, WIDTH)


@dataclass
class Ride:
    """What came of a drive in a world where the others coast."""

    name: str
    scenes: list[Scene] = field(default_factory=list)
    steps: list[DriveStep] = field(default_factory=list)
    finished: bool = False

    @property
    def events(self) -> list[Event]:
        return [event for step in self.steps for event in step.events]

    @property
    def traces(self) -> list[PlanTrace]:
        return [step.trace for step in self.steps if step.trace is not None]


def ego_at(name: str, away: float, speed: float = 8.0) -> VehicleState:
    """The ego at a distance [m] before its first junction."""
    lane = START[name]
    pose = roads(name).line((lane,)).pose(before_end(name, lane, away))
    return VehicleState(*pose, speed, 0.0, LENGTH, WIDTH)


def ride(
    name: str,
    others: Mapping[int, Coasting],
    *,
    away: float = 60.0,
    lasting: float = 40.0,
    settings: Settings = QUICK,
    target: EgoGoal | None = None,
    seen: Callable[[VehicleState], VehicleState] = lambda state: state,
) -> Ride:
    """Drive until the goal, or for some time [s]."""
    driver = Driver(roads(name).network, target or goal(name), settings, seed=0)
    ego, done = ego_at(name, away), Ride(name)
    for k in range(round(lasting / STEP)):
        time = round(k * STEP, 3)
        states = {vehicle: other.at(time) for vehicle, other in others.items()}
        present = {vehicle: state for vehicle, state in states.items() if state is not None}
        scene = Scene(time, {EGO: seen(ego), **present})
        step = driver.step(scene, STEP)
        done.scenes.append(scene)
        done.steps.append(step)
        command = step.command
        change = (command.speed - ego.speed) / STEP
        ego = VehicleState(command.position, command.heading, command.speed, change, LENGTH, WIDTH)
        if driver.finished:
            break
    done.finished = driver.finished
    return done


def along(name: str, lane: str, away: float, speed: float, until: float = math.inf) -> Coasting:
    """A vehicle that comes straight on from a distance [m] before a junction."""
    line = roads(name).line(row(name, lane, "straight"))
    return Coasting(line, before_end(name, lane, away), speed, until)


def slow_cutter() -> Coasting:
    """A vehicle that changes to the ego's lane ahead of it, and is slow."""
    line = changing("s1", "main_in_1", "main_in_0", before_end("s1", "main_in_1", 75.0))
    return Coasting(line, 0.0, 4.0)


@pytest.fixture(
    scope="module",
    params=["alone", "cut in", "minor road", "oncoming"],
)
def drive(request: pytest.FixtureRequest) -> Ride:
    match request.param:
        case "alone":
            return ride("s1", {})
        case "cut in":
            return ride("s1", {1: slow_cutter()}, away=95.0)
        case "minor road":
            return ride("s2", {1: along("s2", "west_in_0", 70.0, 9.0)})
        case _:
            return ride("s2", {2: along("s2", "east_in_0", 70.0, 12.0)})


def test_the_goal_is_reached(drive: Ride) -> None:
    assert drive.finished
    last = drive.steps[-1].command.position
    wanted = goal(drive.name)
    lanes = roads(drive.name).network.edge_lanes(wanted.edge)
    poses = [roads(drive.name).line((lane.id,)).pose(wanted.position) for lane in lanes]
    assert min(math.dist(last, place) for place, _ in poses) < 2.0


def test_nobody_is_hit(drive: Ride) -> None:
    for scene in drive.scenes:
        for vehicle, state in scene.vehicles.items():
            if vehicle != EGO:
                assert not overlap(scene.ego, state), (scene.time, vehicle)


def test_commands_are_continuous(drive: Ride) -> None:
    for scene, step in zip(drive.scenes, drive.steps, strict=True):
        before, command = scene.ego, step.command
        moved = math.dist(before.position, command.position)
        assert moved == pytest.approx(0.5 * (before.speed + command.speed) * STEP, abs=0.08)
        turned = angle_between(command.heading, before.heading)
        assert abs(turned) <= 0.45 * moved + 0.01
        change = (command.speed - before.speed) / STEP
        # What is decided anew starts from speeds as they are recorded, to the cm/s.
        assert -EMERGENCY - 0.06 <= change <= ACCELERATION + 0.06
        assert command.speed >= 0.0


def test_decisions_are_at_most_a_period_apart(drive: Ride) -> None:
    times = [trace.sim_time for trace in drive.traces]
    assert times[0] == 0.0
    gaps = [b - a for a, b in itertools.pairwise(times)]
    assert max(gaps) <= QUICK.period + 1e-6
    assert [trace.decision for trace in drive.traces] == list(range(len(times)))


def test_events_come_in_order(drive: Ride) -> None:
    events = drive.events
    assert [event.sim_time for event in events] == sorted(event.sim_time for event in events)
    current: str | None = None
    committed = False
    restraint: tuple[object, ...] = ()
    for event in events:
        match event.kind:
            case "restrained":
                assert event.action == current
                assert (event.by, event.vehicle, event.light) != restraint
                restraint = (event.by, event.vehicle, event.light)
            case "action-started":
                assert current is None
                current, committed = event.action, False
            case "action-committed":
                assert event.action == current
                assert not committed
                committed = True
            case "action-ended":
                assert event.action == current
                current = None
            case "gave-way":
                assert event.action == current
                assert event.vehicle is not None
            case _:
                assert event.kind == "arrived"
                assert event is events[-1]
    assert current is None
    assert events[-1].kind == "arrived"


def test_what_restrains_the_ego_is_recorded() -> None:
    """By the speed that it drives: it is at the limit, or slower for what is named."""
    cut_in = ride("s1", {1: slow_cutter()}, away=95.0, lasting=6.0)
    assert ("cut-in", 1) in restraints(cut_in) or ("leader", 1) in restraints(cut_in)
    crossing = ride("s2", {1: along("s2", "west_in_0", 70.0, 9.0)})
    assert ("right-of-way", 1) in restraints(crossing)
    assert {by for by, _ in restraints(ride("s1", {}))} <= {"nothing", "limit", "bend"}


def restraints(done: Ride) -> set[tuple[object, int | None]]:
    return {(e.by, e.vehicle) for e in done.events if e.kind == "restrained"}


def test_events_name_the_decision_that_chose(drive: Ride) -> None:
    traces = {trace.decision: trace for trace in drive.traces}
    for event in drive.events:
        if event.kind == "action-started":
            assert event.decision is not None
            chosen = traces[event.decision]
            assert chosen.plan[0].action == event.action
            assert chosen.sim_time == event.sim_time


def test_history_is_at_five_hertz_and_ten_seconds_long(drive: Ride) -> None:
    for trace in drive.traces:
        for vehicle, track in trace.history.items():
            last = track.start + 0.2 * (len(track.speed) - 1)
            assert last == pytest.approx(trace.sim_time, abs=1e-6)
            assert len(track.speed) == min(51, round(trace.sim_time / 0.2 - 0.01) + 1)
            assert track.position[-1] == trace.scene[vehicle].position


def test_what_is_committed_is_marked_under_way(drive: Ride) -> None:
    spans = []
    for event in drive.events:
        if event.kind == "action-committed":
            spans.append([event.sim_time, math.inf, event.action])
        elif event.kind == "action-ended" and spans and spans[-1][1] == math.inf:
            spans[-1][1] = event.sim_time
    for trace in drive.traces:
        inside = [action for a, b, action in spans if a <= trace.sim_time < b]
        assert ([trace.under_way.action] if trace.under_way else []) == inside
        if trace.under_way is not None:
            assert {rollout.actions[0].action for rollout in trace.rollouts} == set(inside)


def test_a_lane_change_is_indicated_while_it_is_driven(drive: Ride) -> None:
    """The lights commanded agree with the manoeuvres and the braking of the drive."""
    changing: str | None = None
    for scene, step in zip(drive.scenes, drive.steps, strict=True):
        for event in step.events:
            if event.kind == "action-started" and event.action in ("change-left", "change-right"):
                changing = event.action.removeprefix("change-")
            elif event.kind == "action-ended":
                changing = None
        lights = step.command.lights
        assert lights is not None
        if changing is not None:
            assert changing in lights
        slowing = (step.command.speed - scene.ego.speed) / STEP < -0.5 - 1e-6
        assert "brake" in lights or not slowing
        assert not {"left", "right"} <= set(lights)


def test_the_road_ahead_shrinks_as_it_is_driven(drive: Ride) -> None:
    roads_ahead = [trace.road for trace in drive.traces]
    left = [road.distance for road in roads_ahead if road is not None and road.distance is not None]
    assert len(left) == len(drive.traces)
    assert left == sorted(left, reverse=True)
    for trace, distance in zip(drive.traces[1:], left[1:], strict=True):
        track = trace.history[EGO].position
        driven = sum(math.dist(a, b) for a, b in itertools.pairwise(track[-6:]))
        assert distance <= left[0] - driven + 1.0


def test_a_slow_vehicle_that_cuts_in_is_passed() -> None:
    done = ride("s1", {1: slow_cutter()}, away=95.0)
    started = [event.action for event in done.events if event.kind == "action-started"]
    assert "change-left" in started
    assert started[-1] == "continue"


def test_who_has_priority_is_given_way_to() -> None:
    done = ride("s2", {1: along("s2", "west_in_0", 75.0, 9.0)}, away=60.0)
    gave = [event for event in done.events if event.kind == "gave-way"]
    assert [event.vehicle for event in gave] == [1]
    assert gave[0].action == "exit-right"


def test_a_vehicle_may_vanish_in_mid_drive() -> None:
    others = {1: along("s2", "west_in_0", 75.0, 9.0, until=3.0)}
    done = ride("s2", others)
    assert done.finished
    late = [trace for trace in done.traces if trace.sim_time > 3.2]
    assert late
    for trace in late:
        assert list(trace.scene) == list(trace.history) == [EGO]


def test_a_vehicle_may_appear_in_mid_drive() -> None:
    done = ride("s1", {1: along("s1", "main_in_0", 20.0, 9.0)})
    entry = [len(trace.history[1].speed) for trace in done.traces if 1 in trace.history]
    assert entry[0] == 1
    assert done.finished


def test_driving_is_deterministic() -> None:
    one, other = (ride("s1", {1: slow_cutter()}, away=95.0, lasting=4.0) for _ in range(2))
    assert [encode(trace) for trace in one.traces] == [encode(trace) for trace in other.traces]
    assert [step.command for step in one.steps] == [step.command for step in other.steps]


def test_off_the_road_nothing_can_be_driven() -> None:
    with pytest.raises(DriverError, match=r"on no lane at 0\.0 s"):
        ride("s1", {}, seen=lambda state: replace(state, position=(500.0, 500.0)))


def test_beyond_its_goal_the_car_drives_on_without_further_events() -> None:
    driver = Driver(roads("s1").network, goal("s1"), QUICK, seed=0)
    here = roads("s1").line(("main_out_0",)).pose(goal("s1").position - 5.0)
    ego, kinds = VehicleState(*here, 10.0, 0.0, LENGTH, WIDTH), []
    for k in range(15):
        step = driver.step(Scene(round(k * STEP, 3), {EGO: ego}), STEP)
        kinds += [event.kind for event in step.events if event.kind != "restrained"]
        command = step.command
        ego = VehicleState(command.position, command.heading, command.speed, 0.0, LENGTH, WIDTH)
    assert driver.finished
    assert kinds == ["action-started", "action-ended", "arrived"]
    assert ego.position[0] > here[0][0] + 10.0


def test_a_goal_out_of_reach_does_not_stop_the_car_from_deciding() -> None:
    done = ride("s1", {}, away=60.0, lasting=3.0, target=EgoGoal("from_s", 50.0, None))
    assert not done.finished
    assert {rollout.outcome for trace in done.traces for rollout in trace.rollouts} == {"dead"}


def test_another_action_than_the_one_decided_on_can_be_carried_out() -> None:
    driver = Driver(roads("s1").network, goal("s1"), QUICK, seed=0)
    ego = ego_at("s1", 95.0)
    scene = Scene(0.0, {EGO: ego})
    step = driver.step(scene, STEP)
    assert step.trace is not None
    assert step.trace.plan[0].action == "continue"
    command = driver.carry_out("change-left", scene, STEP).command
    done = []
    for k in range(1, 80):
        time = round(k * STEP, 3)
        ego = VehicleState(command.position, command.heading, command.speed, 0.0, LENGTH, WIDTH)
        step = driver.step(Scene(time, {EGO: ego}), STEP)
        told = [event for event in step.events if event.kind != "restrained"]
        done += [(event.kind, event.action) for event in told]
        command = step.command
    assert done[:2] == [("action-ended", "change-left"), ("action-started", "continue")]
    assert command.position[1] - ego_at("s1", 95.0).position[1] == pytest.approx(3.5, abs=0.1)


def test_only_what_was_just_decided_can_be_replaced_and_only_by_what_applies() -> None:
    driver = Driver(roads("s1").network, goal("s1"), QUICK, seed=0)
    scene = Scene(0.0, {EGO: ego_at("s1", 95.0)})
    with pytest.raises(DriverError, match="no decision was made"):
        driver.carry_out("stop", scene, STEP)
    driver.step(scene, STEP)
    with pytest.raises(DriverError, match="change-right does not apply"):
        driver.carry_out("change-right", scene, STEP)


@pytest.mark.parametrize("away", [3.0, 8.0])
def test_who_goes_first_and_stands_for_good_is_not_waited_for_forever(away: float) -> None:
    """After you, then me: a car with priority that waits at the junction lets the ego go."""
    done = ride("s2", {1: along("s2", "west_in_0", away, 0.0)}, lasting=45.0)
    assert done.finished


def rushing(start: float, speed: float, target: str = "away") -> tuple[Scene, float, bool]:
    """Drive for a while on a road of 60 m that leads nowhere.

    Args:
        start: [m] on it.
        speed: [m/s]
        target: edge of the goal, which the ego cannot reach, or has passed.

    Returns:
        The last scene, the hardest braking [m/s2], and whether the ego has arrived.
    """
    lanes = [lane("dead_0", [(0.0, 0.0), (60.0, 0.0)]), lane("away_0", [(0.0, 50.0), (60.0, 50.0)])]
    driver = Driver(drawn(lanes).network, EgoGoal(target, 10.0, None), QUICK, seed=0)
    ego, hardest = VehicleState((start, 0.0), 0.0, speed, 0.0, LENGTH, WIDTH), 0.0
    for k in range(80):
        scene = Scene(round(k * STEP, 3), {EGO: ego})
        command = driver.step(scene, STEP).command
        change = (command.speed - ego.speed) / STEP
        hardest = max(hardest, -change)
        ego = VehicleState(command.position, command.heading, command.speed, change, LENGTH, WIDTH)
    return scene, hardest, driver.finished


@pytest.mark.parametrize("target", ["away", "dead"])
@pytest.mark.parametrize(("speed", "firm"), [(8.0, 3.1), (14.0, 4.4), (18.0, EMERGENCY)])
def test_a_dead_end_is_braked_for_as_hard_as_it_takes(
    target: str, speed: float, firm: float
) -> None:
    scene, hardest, arrived = rushing(30.0, speed, target)
    assert not arrived
    assert scene.ego.speed == pytest.approx(0.0, abs=0.01)
    assert 58.0 < scene.ego.position[0] <= 60.0
    assert hardest <= firm + 1e-6


def test_who_cannot_stop_before_a_dead_end_stops_beyond_it() -> None:
    scene, hardest, arrived = rushing(50.0, 20.0)
    assert not arrived
    assert hardest == pytest.approx(EMERGENCY)
    assert scene.ego.speed == pytest.approx(0.0, abs=0.01)
    assert 60.0 < scene.ego.position[0] < 50.0 + 20.0**2 / (2.0 * EMERGENCY) + 20.0 * 0.6
    assert scene.ego.position[1] == pytest.approx(0.0, abs=0.01)
