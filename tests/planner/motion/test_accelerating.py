"""How hard to accelerate in the next step, and what is in the way, on straight roads."""

import math
from collections.abc import Sequence

import numpy as np
import pytest

from planner.kernels.limits import ACCELERATION, GAP_HORIZON
from planner.manoeuvres.actions import ActionPlan
from planner.motion.forward import DT, Hindrance, Keeping, Motion, accelerate, lane_of
from planner.motion.obstacles import Obstacle, Occupancy, Traffic, occupancy
from planner.motion.tracks import lanes_at
from planner.roads.trajectory import KEPT
from planner.traffic_lights.signals import NO_LIGHTS, Lights
from sim.scene import Signal
from tests.planner import crossroads
from tests.planner.drives import LENGTH, WIDTH, avenue
from tests.planner.rollouts.test_legs import at, plan_of, task

STEPS = GAP_HORIZON + 1
OPEN_ROAD = plan_of(task(), at(100.0, 8.0), "continue")


def moving(x: float, speed: float, y: float = 0.0, vehicle: int = 3) -> Obstacle:
    """A vehicle that drives east."""
    place = np.column_stack((x + speed * DT * np.arange(STEPS), np.full(STEPS, y)))
    return Obstacle(
        vehicle, LENGTH, WIDTH, place, np.zeros(STEPS), np.full(STEPS, speed), frozenset()
    )


def occupied(plan: ActionPlan, others: Sequence[Obstacle], lights: Lights = NO_LIGHTS) -> Occupancy:
    return occupancy(plan.path, Traffic.of(others, lights), WIDTH, 0, GAP_HORIZON)


def step(
    plan: ActionPlan,
    motion: Motion,
    seen: Sequence[Obstacle] = (),
    crossing: Sequence[Obstacle] = (),
    foreseen: Sequence[Obstacle] = (),
    lights: Lights = NO_LIGHTS,
) -> tuple[float, Keeping]:
    return accelerate(
        plan,
        lane_of(plan.path),
        motion,
        occupied(plan, seen, lights),
        occupied(plan, crossing, lights),
        occupied(plan, foreseen),
        LENGTH,
        DT,
    )


SLOW = Motion(0.0, 8.0, 0.0)  # where 10 m/s are allowed


def test_a_free_road_lets_one_speed_up() -> None:
    gained, keeping = step(OPEN_ROAD, SLOW)
    assert 0.0 < gained <= ACCELERATION
    assert keeping == Keeping(None, None)
    steady, _ = step(OPEN_ROAD, Motion(0.0, 10.0, 0.0))
    assert steady == pytest.approx(0.0, abs=0.05)


def test_a_slow_leader_is_told_with_its_speed() -> None:
    gained, keeping = step(OPEN_ROAD, SLOW, [moving(240.0, 9.0, vehicle=5), moving(112.0, 4.0)])
    assert gained < 0.0
    assert keeping == Keeping(Hindrance(3, "leader", 4.0), None)
    beside, free = step(OPEN_ROAD, SLOW, [moving(112.0, 4.0, y=3.5)])
    assert beside > 0.0
    assert free.hindrance is None


def test_who_stands_in_the_way_blocks_it() -> None:
    gained, keeping = step(OPEN_ROAD, SLOW, [moving(116.0, 0.0)])
    assert gained < 0.0
    assert keeping.hindrance == Hindrance(3, "blocked", 0.0)


def test_nobody_creeps_on_beside_one_that_crawls() -> None:
    halting = Motion(0.0, 0.2, -0.4)
    beside = moving(102.0, 1.0, y=1.9)  # 0.1 m beside the body, its rear behind our front
    gained, keeping = step(OPEN_ROAD, halting, [beside])
    assert gained == pytest.approx(-0.4, abs=0.01)
    assert keeping.hindrance is not None
    ahead, _ = step(OPEN_ROAD, halting, [moving(100.0 + LENGTH + 2.5, 1.0)])
    assert ahead > gained


def test_who_is_foreseen_to_come_in_is_made_room_for() -> None:
    steps = np.arange(STEPS)
    aside = np.maximum(3.5 - 1.5 * DT * steps, 0.0)  # it moves over to our lane
    place = np.column_stack((109.0 + 5.0 * DT * steps, aside))
    heading = np.where(aside > 0.0, math.atan2(-1.5, 5.0), 0.0)
    comes = Obstacle(7, LENGTH, WIDTH, place, heading, np.full(STEPS, 5.0), frozenset())
    gained, keeping = step(OPEN_ROAD, SLOW, [moving(300.0, 9.0, vehicle=5)], foreseen=[comes])
    assert gained < step(OPEN_ROAD, SLOW)[0]
    assert keeping.hindrance == Hindrance(7, "cut-in", 5.0)


TURN = crossroads.plan(crossroads.before(8.0, 5.0), "exit-left")


def lit(letters: str) -> Lights:
    return crossroads.shown([(0.0, letters)])


def test_a_red_light_is_what_keeps_one_back() -> None:
    gained, keeping = step(TURN, Motion(0.0, 5.0, 0.0), lights=lit(crossroads.EAST_WEST))
    assert gained < 0.0
    own = Signal(crossroads.CONTROLLER, crossroads.place("south", "left"))
    assert keeping == Keeping(None, own)
    _, green = step(TURN, Motion(0.0, 5.0, 0.0), lights=lit(crossroads.NORTH_SOUTH))
    assert green.light is None


def test_who_comes_on_is_given_way_to() -> None:
    arcs = [130.0 + 10.0 * DT * k for k in range(STEPS)]
    oncoming = crossroads.driving("north", "straight", arcs, 4)
    others = [crossroads.driving("east", "straight", [10.0] * STEPS, 6), oncoming]
    green = lit(crossroads.NORTH_SOUTH)
    gained, keeping = step(TURN, Motion(5.0, 4.0, 0.0), crossing=others, lights=green)
    assert gained < step(TURN, Motion(5.0, 4.0, 0.0), lights=green)[0]
    assert keeping.light is None
    assert keeping.hindrance is not None
    assert (keeping.hindrance.vehicle, keeping.hindrance.how) == (4, "right-of-way")
    assert keeping.hindrance.speed == pytest.approx(10.0)


def test_places_are_looked_up_once_and_forgotten_when_there_are_too_many() -> None:
    roads = avenue()
    found = lanes_at(roads, (50.0, 0.0), 0.0)
    assert found[0].lane == "road_0"
    assert lanes_at(roads, (50.0, 0.0), 0.0) is found
    for k in range(KEPT):
        lanes_at(roads, (60.0 + 0.1 * k, 0.0), 0.0)
    assert len(roads.located) <= KEPT
    assert lanes_at(roads, (50.0, 0.0), 0.0) == found
