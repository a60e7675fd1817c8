import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from planner.kernels.along import place
from planner.kernels.collision import first_hit
from planner.kernels.limits import (
    ACCELERATION,
    COMFORT,
    EMERGENCY,
    FOLLOWING,
    JERK_DOWN,
    JERK_UP,
    MIN_GAP,
    STANDING_TIME,
    safe_speed,
)
from planner.manoeuvres.actions import ActionPlan, expand
from planner.motion.forward import DT, Drive, Lane, Motion, advance, drive
from planner.motion.obstacles import HOW, Obstacle, Traffic
from sim.roads.network import Direction
from tests.planner import crossroads
from tests.planner.nets import arc, drawn, lane, on_lane
from tests.planner.worlds import (
    LENGTH,
    SIZE,
    before_end,
    link,
    obstacle,
    plan_of,
    roads,
    row,
    situation,
)

HORIZON = 90  # steps: nobody gets to the end of the road
ALONG = row("s1", "main_in_0", "straight")  # a road without anybody to give way to
START = 20.0  # [m] from its beginning


def cruise(speed: float, obstacles: tuple[Obstacle, ...] = (), horizon: int = HORIZON) -> Drive:
    """Continue from START."""
    plan = plan_of("s1", situation("s1", ALONG[0], START, speed), "continue")
    return drive(plan, Motion(0.0, speed, 0.0), 0, Traffic.of(obstacles), SIZE, horizon)


def leader(gap: float, speed: float, braking: float, steps: int = HORIZON + 60) -> Obstacle:
    """A vehicle at a gap [m] ahead of START that brakes [m/s2] to a standstill."""
    motions = [Motion(START + gap + LENGTH, speed, 0.0)]
    for _ in range(steps):
        motions.append(advance(motions[-1], -braking, DT))
    return obstacle("s1", ALONG, [motion.arc for motion in motions])


def fronts(driven: Drive) -> np.ndarray:
    return driven.motion[:, 0]


def speeds(driven: Drive) -> np.ndarray:
    return driven.motion[:, 1]


def accelerations(driven: Drive) -> np.ndarray:
    return driven.motion[:, 2]


def held_up(driven: Drive) -> list[tuple[int, str, float]]:
    """Who held it up at every step, how, and at which speed [m/s]."""
    found = driven.hindrances
    how = [HOW[k] for k in found.how]
    return list(zip(found.vehicle.tolist(), how, found.speed.tolist(), strict=True))


def test_a_free_road_is_driven_at_its_limit() -> None:
    driven = cruise(5.0)
    limit = roads("s1").network.lanes[ALONG[0]].speed_limit
    assert driven.motion[0].tolist() == [0.0, 5.0, 0.0]
    assert np.all(np.diff(speeds(driven)) > -1e-6)
    assert speeds(driven)[-1] == pytest.approx(limit, abs=0.1)
    assert np.max(speeds(driven)) <= limit + 1e-6
    assert held_up(driven) == []


def test_who_comes_from_behind_round_a_bend_stays_behind() -> None:
    """One that is foreseen to drive on as if we were not there does not stop us ahead."""
    bend = drawn([lane("bend_0", (*arc(30.0, math.pi / 2.0, 1.0, 60.0), (90.0, 400.0)))])
    line, away = bend.line(("bend_0",)), 140.0
    arcs = np.minimum(80.0 + 25.0 * DT * np.arange(HORIZON + 60), away + 35.0)
    poses = [line.pose(at) for at in arcs.tolist()]
    places, headings = zip(*poses, strict=True)
    through = Obstacle(
        1, *SIZE, np.array(places), np.array(headings), np.gradient(arcs) / DT, frozenset()
    )
    plan = expand(bend, on_lane(bend, "bend_0", away, 2.0), "continue", None, 100.0)
    assert isinstance(plan, ActionPlan)
    alone, driven = (
        drive(plan, Motion(0.0, 2.0, 0.0), 0, Traffic.of(others), SIZE, 60)
        for others in ((), (through,))
    )
    assert fronts(driven)[-1] == pytest.approx(fronts(alone)[-1])
    assert held_up(driven) == []


@pytest.mark.parametrize("lane", ["from_s_0", "back_in_0"])
def test_bends_are_braked_for(lane: str) -> None:
    here = situation("s1", lane, before_end("s1", lane, 60.0), 11.0)
    plan = plan_of("s1", here, "exit-right")
    driven = drive(plan, Motion(0.0, 11.0, 0.0), 0, Traffic.of(()), SIZE, HORIZON)
    assert driven.finished
    allowed = np.interp(fronts(driven), plan.path.arc, plan.path.cap)
    assert np.max(speeds(driven) - allowed) < 0.6
    assert np.min(speeds(driven)) < 5.0
    assert np.min(accelerations(driven)) >= -FOLLOWING - 1e-6


def test_the_speed_ahead_of_a_bend_allows_comfortable_braking() -> None:
    lane = "from_s_0"
    here = situation("s1", lane, before_end("s1", lane, 60.0), 11.0)
    plan = plan_of("s1", here, "exit-right")
    prepared = Lane(plan.path)
    squares = (prepared.caps**2).tolist()
    falls = [(a - b) / 2.0 for a, b in itertools.pairwise(squares)]
    assert max(falls) <= COMFORT + 0.2
    assert prepared.speed(1e6) == prepared.caps[-1]


gaps = st.floats(MIN_GAP + 1.0, 70.0)
velocities = st.floats(0.0, 13.8)


@given(gaps, velocities, velocities, st.floats(0.0, FOLLOWING))
def test_a_leader_is_never_touched(gap: float, own: float, its: float, braking: float) -> None:
    assume(own <= safe_speed(gap - MIN_GAP, its, FOLLOWING))
    ahead = leader(gap, its, braking)
    driven = cruise(own, (ahead,))
    rear = np.hypot(*(ahead.position - np.array(roads("s1").line(ALONG).points[0])).T) - LENGTH
    arcs = START + fronts(driven)
    assert np.all(rear[: len(arcs)] - arcs > 0.3)


@given(gaps, velocities, velocities, st.floats(0.0, FOLLOWING))
def test_motion_keeps_within_its_limits(gap: float, own: float, its: float, braking: float) -> None:
    driven = cruise(own, (leader(gap, its, braking),))
    assert np.all(np.diff(fronts(driven)) >= 0.0)
    assert np.all(speeds(driven) >= 0.0)
    for before, after in itertools.pairwise(accelerations(driven)):
        assert -EMERGENCY <= after <= ACCELERATION
        assert after - before >= -JERK_DOWN * DT - 1e-9
        if after > 0.0:
            assert after - max(before, 0.0) <= JERK_UP * DT + 1e-9


@given(gaps, velocities)
def test_who_stands_in_the_way_is_waited_for(gap: float, own: float) -> None:
    assume(own <= safe_speed(gap - MIN_GAP, 0.0, FOLLOWING))
    driven = cruise(own, (leader(gap, 0.0, 0.0),))
    assert speeds(driven)[-1] < 0.3
    assert gap - fronts(driven)[-1] == pytest.approx(MIN_GAP, abs=1.2)
    assert {(who, how) for who, how, _ in held_up(driven)} <= {(1, "blocked")}


def test_a_slow_leader_is_followed_and_named() -> None:
    driven = cruise(10.0, (leader(30.0, 5.0, 0.0),))
    assert speeds(driven)[-1] == pytest.approx(5.0, abs=0.2)
    assert {(who, how) for who, how, _ in held_up(driven)} == {(1, "leader")}
    assert {round(speed, 1) for _, _, speed in held_up(driven)} == {5.0}


def test_nobody_brakes_for_who_comes_from_behind() -> None:
    behind = obstacle("s1", ALONG, [2.0 + 12.0 * DT * k for k in range(HORIZON)])
    np.testing.assert_array_equal(cruise(5.0, (behind,)).motion, cruise(5.0).motion)


def test_nobody_brakes_for_who_is_in_another_lane() -> None:
    beside = obstacle("s1", ("main_in_1",), [START + 15.0] * HORIZON)
    np.testing.assert_array_equal(cruise(10.0, (beside,)).motion, cruise(10.0).motion)


def test_stopping_ends_after_a_while_at_a_standstill() -> None:
    here = situation("s1", ALONG[0], START, 10.0)
    plan = plan_of("s1", here, "stop")
    driven = drive(plan, Motion(0.0, 10.0, 0.0), 0, Traffic.of(()), SIZE, HORIZON)
    assert driven.finished
    assert speeds(driven)[-1] == pytest.approx(0.0, abs=0.001)
    standing = int(np.sum(speeds(driven) < 0.1))
    assert standing * DT == pytest.approx(STANDING_TIME, abs=2 * DT)
    assert np.min(accelerations(driven)) >= -COMFORT - 1e-9
    assert fronts(driven)[-1] == pytest.approx(10.0**2 / (2.0 * COMFORT), abs=6.0)


def test_the_horizon_ends_what_is_not_finished() -> None:
    driven = cruise(5.0, horizon=10)
    assert not driven.finished
    assert len(driven.motion) == 11
    assert driven.goal_time is None


def test_passing_the_goal_is_timed_between_the_samples() -> None:
    here = situation("s1", "main_out_0", 90.0, 10.0)
    plan = plan_of("s1", here, "continue", aim=True)
    driven = drive(plan, Motion(0.0, 10.0, 0.0), 0, Traffic.of(()), SIZE, HORIZON)
    assert plan.goal == pytest.approx(10.0)
    assert driven.goal_time is not None
    assert (len(driven.motion) - 2) * DT <= driven.goal_time <= (len(driven.motion) - 1) * DT
    assert driven.goal_time == pytest.approx(0.95, abs=0.06)


@given(st.floats(0.0, 100.0), velocities, st.floats(0.5, 7.0))
def test_the_safe_speed_leaves_room_to_react_and_brake(
    gap: float, its: float, braking: float
) -> None:
    speed = safe_speed(gap, its, braking)
    assert speed >= 0.0
    reacting = speed * 0.9 + speed**2 / (2.0 * braking)
    assert reacting == pytest.approx(gap + its**2 / (2.0 * braking), abs=1e-6)
    assert safe_speed(gap + 1.0, its, braking) > speed


@given(st.floats(0.0, 15.0), st.floats(-7.0, 2.0), st.floats(0.01, 1.0))
def test_nobody_rolls_back(speed: float, acceleration: float, dt: float) -> None:
    motion = advance(Motion(3.0, speed, 0.0), acceleration, dt)
    assert motion.speed >= 0.0
    assert motion.arc >= 3.0


# Giving way: the ego of s2 turns right from the minor road; vehicle 1 comes from the left.
WEST = "west_in_0"
TURN = ("south_in_0", "exit-right")
STEPS = HORIZON + 60


def turn_right(*others: Obstacle, distance: float = 25.0, speed: float = 7.0) -> Drive:
    here = situation("s2", TURN[0], before_end("s2", TURN[0], distance), speed)
    plan = plan_of("s2", here, "exit-right")
    return drive(plan, Motion(0.0, speed, 0.0), 0, Traffic.of(others), SIZE, HORIZON)


def from_west(direction: Direction, away: float, speed: float) -> Obstacle:
    """A vehicle at a distance [m] before the junction, at a steady speed."""
    lanes = row("s2", WEST, direction)
    first = before_end("s2", WEST, away)
    return obstacle("s2", lanes, [first + speed * DT * k for k in range(STEPS)])


def entered(driven: Drive, distance: float = 25.0) -> float:
    """When [s] the front came into the junction."""
    return int(np.argmax(fronts(driven) > distance)) * DT


def test_a_line_is_crossed_where_nobody_comes() -> None:
    driven = turn_right()
    assert driven.finished
    assert held_up(driven) == []
    assert np.min(speeds(driven)) > 2.5


def test_a_line_is_a_place_to_wait_for_who_has_priority() -> None:
    other = from_west("straight", 50.0, 10.0)
    driven = turn_right(other)
    assert driven.finished
    assert {(who, how) for who, how, _ in held_up(driven)} >= {(1, "right-of-way")}
    # The ego's way joins that of the other where the junction ends.
    through = link("s2", WEST, "straight").via
    clear = (50.0 + roads("s2").network.lanes[through[0]].length) / 10.0
    assert entered(driven) > entered(turn_right())
    assert (len(driven.motion) - 1) * DT > clear
    assert fronts(driven)[-1] > 25.0


def test_nobody_waits_for_who_turns_off() -> None:
    for direction in ("left", "right"):
        turning = from_west(direction, 50.0, 8.0)
        np.testing.assert_array_equal(turn_right(turning).motion, turn_right().motion)


def test_nobody_waits_for_who_has_passed() -> None:
    passed = from_west("straight", -30.0, 12.0)
    assert entered(turn_right(passed)) == entered(turn_right())


def test_who_waits_stays_behind_the_line() -> None:
    standing = obstacle("s2", row("s2", WEST, "straight"), [before_end("s2", WEST, -15.0)] * STEPS)
    driven = turn_right(standing)
    assert not driven.finished
    assert speeds(driven)[-1] < 0.05
    assert fronts(driven)[-1] <= 25.0
    assert {who for who, _, _ in held_up(driven)} == {1}


@given(st.floats(0.0, 90.0), st.floats(3.0, 13.0))
def test_giving_way_never_ends_in_a_collision(away: float, speed: float) -> None:
    other = from_west("straight", away, speed)
    here = situation("s2", TURN[0], before_end("s2", TURN[0], 25.0), 7.0)
    plan = plan_of("s2", here, "exit-right")
    driven = drive(plan, Motion(0.0, 7.0, 0.0), 0, Traffic.of((other,)), SIZE, HORIZON)
    path, traffic = plan.path, Traffic.of((other,))
    own, _ = place(path.points, path.arc, path.heading, path.curvature, driven.motion, SIZE[0])
    # Who runs into the ego from behind does not count: the other does not react.
    assert first_hit(own, SIZE, 0, traffic.states, traffic.sizes, False, 0.0) == (-1, -1)


@pytest.mark.parametrize(
    ("turned", "hits"),
    [(0.0, False), (0.5, False), (1.2, True), (-1.2, True), (2.4, True), (math.pi, True)],
)
def test_only_who_heads_the_same_way_is_a_follower(turned: float, hits: bool) -> None:
    own = np.array([[0.0, 0.0, 0.0, 3.0]])
    rear = (-SIZE[0] + 0.5, 0.0)  # inside our body, behind its middle
    front = np.array([rear])
    other = Obstacle(1, 12.0, 2.5, front, np.array([turned]), np.array([5.0]), frozenset())
    traffic = Traffic.of((other,))
    found = first_hit(own, SIZE, 0, traffic.states, traffic.sizes, False, 0.0)
    assert (found == (0, 0)) == hits


def test_who_has_gone_first_is_followed_and_not_waited_for() -> None:
    slow = from_west("straight", -26.0, 3.0)  # on the exit already, and slower than the ego
    driven = turn_right(slow)
    assert {how for _, how, _ in held_up(driven)} <= {"leader", "cut-in"}
    assert entered(driven) == entered(turn_right())


def test_a_late_conflict_stops_the_ego_inside_the_junction_if_it_still_can() -> None:
    here = situation("s2", TURN[0], before_end("s2", TURN[0], 25.0), 2.0)
    plan = plan_of("s2", here, "exit-right")
    line = plan.give_ways[0].stop
    other = from_west("straight", 27.0, 10.0)
    for beyond in (0.3, 0.8, 2.0):
        start = Motion(line + beyond, 1.0, 0.0)
        driven = drive(plan, start, 0, Traffic.of((other,)), SIZE, HORIZON)
        assert np.min(speeds(driven)[:15]) < 0.2
        assert driven.finished
        assert held_up(driven)[0][1] == "right-of-way"
    start = Motion(line + 8.0, 4.0, 0.0)  # in the way of the other: it had better clear it
    driven = drive(plan, start, 0, Traffic.of((other,)), SIZE, HORIZON)
    assert np.min(speeds(driven)) > 3.0


def test_who_cannot_stop_at_the_line_brakes_harder_before_who_crosses() -> None:
    plan = crossroads.plan(crossroads.before(4.0, 10.0), "continue")
    across = crossroads.driving("north", "left", [154.0 + 0.8 * k for k in range(STEPS)], 1)
    path, traffic = plan.path, Traffic.of((across,))
    driven = drive(plan, Motion(0.0, 10.0, 0.0), 0, traffic, SIZE, HORIZON)
    assert FOLLOWING + 0.1 < -np.min(accelerations(driven)) <= EMERGENCY
    own, _ = place(path.points, path.arc, path.heading, path.curvature, driven.motion, SIZE[0])
    assert first_hit(own, SIZE, 0, traffic.states, traffic.sizes, False, 0.0) == (-1, -1)


def test_being_in_the_way_of_one_does_not_excuse_from_waiting_for_another() -> None:
    turn = crossroads.plan(crossroads.before(10.0, 3.0), "exit-left")
    start = Motion(23.0, 0.5, 0.0)  # across the lane of who comes on
    ahead = crossroads.driving("north", "straight", [142.0 + 1.6 * k for k in range(STEPS)], 1)
    right = crossroads.driving("north", "right", [135.0 + 1.4 * k for k in range(STEPS)], 2)
    for others, waits in (((ahead,), set()), ((right,), {2}), ((ahead, right), {2})):
        driven = drive(turn, start, 0, Traffic.of(others), SIZE, HORIZON)
        assert {who for who, how, _ in held_up(driven) if how == "right-of-way"} == waits
        assert (np.min(speeds(driven)[:15]) < 0.1) == bool(waits)
