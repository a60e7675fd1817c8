"""How the others of a rollout react to the ego: on a straight road, where it can be foreseen."""

import math
from dataclasses import replace

import numpy as np
import pytest

from planner.kernels.collision import first_hit
from planner.kernels.limits import FIRM
from planner.kernels.reaction import DELAY, react
from planner.motion.forward import DT
from planner.motion.obstacles import Obstacle, Traffic
from planner.roads.levels import NOBODY_ELSEWHERE
from planner.roads.trajectory import Array

SIZE = (4.8, 1.8)
STEPS = 100
LANE = 3.5  # [m] wide


def straight(start: float, speeds: Array, aside: float | Array = 0.0) -> Array:
    """States [S, 4] eastwards from x = `start` [m] at speeds [m/s]."""
    x = start + np.concatenate(([0.0], np.cumsum(0.5 * (speeds[1:] + speeds[:-1])) * DT))
    y = np.broadcast_to(aside, x.shape)
    heading = np.arctan2(np.gradient(y), np.maximum(np.gradient(x), 1e-3))
    return np.column_stack((x, y, heading, speeds))


def steady(start: float, speed: float, aside: float = 0.0) -> Array:
    """States at one speed [m/s]."""
    return straight(start, np.full(STEPS, speed), aside)


def braking(start: float, speed: float, rate: float) -> Array:
    """States of a vehicle that brakes to a standstill at a rate [m/s2]."""
    return straight(start, np.maximum(speed - rate * DT * np.arange(STEPS), 0.0))


def cutting_in(start: float, speed: float, took: int = 15) -> Array:
    """States of a vehicle that moves from the lane to the right within some steps."""
    u = np.clip(np.arange(STEPS) / took, 0.0, 1.0)
    return straight(start, np.full(STEPS, speed), -LANE * (1.0 - u * u * (3.0 - 2.0 * u)))


def traffic(*states: Array) -> Traffic:
    """Vehicles 1, 2, ... in given motions."""
    return Traffic.of(
        [
            Obstacle(k, *SIZE, one[:, :2], one[:, 2], one[:, 3], frozenset())
            for k, one in enumerate(states, start=1)
        ]
    )


def hit(own: Array, others: Traffic) -> bool:
    """Whether anything overlaps, whoever is to blame."""
    return first_hit(own, SIZE, 0, others.states, others.sizes, True, FIRM)[1] >= 0


def rates(states: Array) -> Array:
    """Accelerations [m/s2] of states."""
    return np.diff(states[:, 3]) / DT


def test_a_follower_brakes_for_an_ego_that_stops() -> None:
    own, blind = braking(40.0, 13.0, 3.0), traffic(steady(10.0, 13.0))
    seeing = blind.reacting(own, SIZE, 0)
    assert hit(own, blind)
    assert not hit(own, seeing)
    assert seeing.braking.tolist() == [True]
    assert seeing.states[0, -1, 3] < 0.1
    assert 1.0 < own[-1, 0] - SIZE[0] - seeing.states[0, -1, 0] < 4.0


def test_nobody_reacts_to_an_ego_that_is_not_ahead() -> None:
    own = braking(40.0, 13.0, 3.0)
    for other in (steady(60.0, 13.0), steady(10.0, 13.0, LANE), steady(10.0, 13.0, -LANE)):
        blind = traffic(other)
        assert blind.reacting(own, SIZE, 0).states is blind.states


def test_a_follower_makes_room_for_an_ego_that_cuts_in() -> None:
    own, blind = cutting_in(30.0, 10.0), traffic(steady(8.0, 14.0))
    seeing = blind.reacting(own, SIZE, 0)
    assert hit(own, blind)
    assert not hit(own, seeing)


def test_a_collision_that_firm_braking_cannot_avoid_remains() -> None:
    own = cutting_in(20.0, 4.0, took=6)
    seeing = traffic(steady(0.0, 16.0)).reacting(own, SIZE, 0)
    room = own[0, 0] - SIZE[0] - 0.0
    assert room < (16.0 - 4.0) ** 2 / (2.0 * FIRM)  # even without any reaction time
    assert seeing.braking.tolist() == [True]
    assert hit(own, seeing)


@pytest.mark.parametrize("speed", [8.0, 12.0, 16.0])
@pytest.mark.parametrize("gap", [6.0, 10.0, 14.0, 20.0, 30.0, 40.0, 60.0])
def test_what_firm_braking_after_the_reaction_avoids_is_avoided(speed: float, gap: float) -> None:
    own = straight(gap + SIZE[0], np.full(STEPS, 3.0), -LANE)
    own[5:, 1] = 0.0  # it is there from one step to the next
    seeing = traffic(steady(0.0, speed)).reacting(own, SIZE, 0)
    closing = speed - 3.0
    left = gap - closing * (5 + DELAY) * DT
    if left > closing**2 / (2.0 * FIRM) + 1.5:
        assert not hit(own, seeing)
    if left < closing**2 / (2.0 * FIRM) - 1.5:
        assert hit(own, seeing)


def test_a_driver_needs_its_time_to_react() -> None:
    own = straight(15.0, np.full(STEPS, 5.0), -LANE)
    own[10:, 1] = 0.0
    states = traffic(steady(-30.0, 12.0)).reacting(own, SIZE, 0).states[0]
    late = np.flatnonzero(rates(states) < 0.0)
    assert late[0] == 10 + DELAY


def test_who_has_the_ego_ahead_from_the_beginning_reacts_at_once() -> None:
    own, blind = steady(15.0, 5.0), traffic(steady(0.0, 12.0))
    assert rates(blind.reacting(own, SIZE, 0).states[0])[0] < 0.0


def test_who_follows_a_vehicle_that_reacts_brakes_too() -> None:
    own = braking(40.0, 13.0, 3.0)
    blind = traffic(steady(15.0, 13.0), steady(-5.0, 13.0))
    seeing = blind.reacting(own, SIZE, 0)
    assert seeing.braking.tolist() == [True, True]
    gaps = seeing.states[0, :, 0] - SIZE[0] - seeing.states[1, :, 0]
    assert np.min(gaps) > 0.5


def test_a_vehicle_that_is_gone_before_one_arrives_is_not_braked_for() -> None:
    y = -10.0 + 8.0 * DT * np.arange(STEPS)
    own = np.column_stack((np.full(STEPS, 60.0), y, np.full(STEPS, math.pi / 2), np.full(STEPS, 8)))
    blind = traffic(steady(0.0, 10.0))
    assert blind.reacting(own, SIZE, 0).states is blind.states
    standing = own.copy()
    standing[:, 1], standing[:, 3] = 2.0, 0.0
    assert not hit(standing, blind.reacting(standing, SIZE, 0))


def test_a_driver_goes_on_as_predicted_once_the_ego_is_away() -> None:
    own = braking(40.0, 13.0, 3.0)[:40]
    predicted = straight(10.0, np.linspace(13.0, 8.0, STEPS))
    after = traffic(predicted).reacting(own, SIZE, 0).states[0]
    assert after[45, 3] < predicted[45, 3]
    path = np.interp(after[-10:, 0], predicted[:, 0], predicted[:, 3])
    np.testing.assert_allclose(after[-10:, 3], path, atol=0.3)


def test_a_late_driver_waits_where_it_was_predicted_to() -> None:
    speeds = np.concatenate((np.full(15, 10.0), np.linspace(10, 0, 26), np.zeros(20)))
    speeds = np.concatenate((speeds, np.linspace(0.0, 8.0, STEPS - len(speeds))))
    predicted = straight(0.0, speeds)
    own = straight(14.0, np.concatenate((np.full(15, 6.0), np.full(15, 12.0))))
    after = traffic(predicted).reacting(own, SIZE, 0).states[0]
    slow = [int(np.sum(states[:, 3] < 0.3)) for states in (predicted, after)]
    assert slow[1] == pytest.approx(slow[0], abs=3)
    assert after[-1, 0] < predicted[-1, 0]


def test_a_second_leg_goes_on_where_the_first_ended() -> None:
    own = braking(40.0, 13.0, 3.0)
    whole = traffic(steady(10.0, 13.0)).reacting(own, SIZE, 0)
    half = traffic(steady(10.0, 13.0)).reacting(own[:12], SIZE, 0)
    both = half.reacting(own[11:], SIZE, 11)
    np.testing.assert_allclose(both.states[0, :, 0], whole.states[0, :, 0], atol=1.0)
    assert not hit(own, both)


@pytest.mark.parametrize("seed", range(60))
def test_whatever_happens_drivers_keep_to_their_paths(seed: int) -> None:
    """Nobody gets ahead, leaves its line, brakes too hard or changes what was given."""
    rng = np.random.default_rng(seed)
    others = traffic(
        *(
            steady(rng.uniform(-40.0, 60.0), rng.uniform(0.0, 15.0), rng.choice((0.0, LANE)))
            for _ in range(5)
        )
    )
    turn = rng.uniform(-0.3, 0.3)
    own = cutting_in(20.0, rng.uniform(1.0, 12.0))
    own[:, 2] += turn
    given = (others.states.copy(), others.noticed.copy(), others.braking.copy())
    first = int(rng.integers(0, 20))
    them = (others.states, others.sizes, others.noticed, others.braking, NOBODY_ELSEWHERE)
    states, _, late = react(own, SIZE, first, *them)
    for before, after in zip(given, (others.states, others.noticed, others.braking), strict=True):
        np.testing.assert_array_equal(before, after)
    np.testing.assert_array_equal(states[:, :first], others.states[:, :first])
    np.testing.assert_array_equal(states[~late], others.states[~late])
    assert np.all(states[:, :, 0] <= others.states[:, :, 0] + 1e-9)
    np.testing.assert_allclose(states[:, :, 1], others.states[:, :, 1], atol=1e-9)
    assert np.min(np.diff(states[:, :, 3], axis=1)) >= -FIRM * DT - 1e-9
    again = react(own, SIZE, first, *them)
    np.testing.assert_array_equal(states, again[0])


def test_who_leaves_the_network_stays_away() -> None:
    predicted = steady(10.0, 13.0)
    predicted[60:, 0] = np.nan
    own = braking(40.0, 13.0, 1.0)[:30]
    after = traffic(predicted).reacting(own, SIZE, 0)
    gone = np.flatnonzero(np.isnan(after.states[0, :, 0]))
    assert gone[0] > 60
    assert np.all(np.isnan(after.states[0, gone[0] :, 0]))


def test_those_that_have_braked_are_remembered() -> None:
    own = steady(15.0, 5.0)
    others = replace(traffic(steady(0.0, 12.0), steady(0.0, 12.0, LANE)))
    assert others.reacting(own[:20], SIZE, 0).braking.tolist() == [True, False]
