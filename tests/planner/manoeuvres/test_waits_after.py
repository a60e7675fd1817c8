"""Waiting lines that follow soon after the end of a macro action."""

import math

import numpy as np
import pytest

from planner.kernels.limits import COMFORT, STANDING
from planner.manoeuvres.actions import ActionPlan, GiveWay, expand
from planner.motion.forward import Motion, drive
from planner.motion.obstacles import Obstacle, Traffic
from planner.record.trace import Action
from planner.roads.trajectory import Roads
from sim.roads.network import Direction
from tests.planner.drives import LENGTH, SIZE, WIDTH
from tests.planner.nets import drawn, lane, link, on_lane

VIEW = 100.0  # [m]
STEPS = 150
FIRST = 7  # the index of the link that goes first at the second junction


def two_junctions(apart: float, direction: Action = "exit-right") -> Roads:
    """A road east, a bend of 8 m to the south, and a give-way line `apart` [m] beyond the bend."""
    side = -1.0 if direction == "exit-right" else 1.0
    steps = [0.5 * math.pi * k / 8 for k in range(9)]
    bend = [(100.0 + 8.0 * math.sin(t), side * 8.0 * (1.0 - math.cos(t))) for t in steps]
    y = [side * (8.0 + far) for far in (0.0, apart, apart + 10.0, apart + 300.0)]
    lanes = [
        lane("in_0", [(0.0, 0.0), (100.0, 0.0)]),
        lane(":J_0", bend, inside=True),
        lane(":K_0", [(100.0, 0.0), (110.0, 0.0)], inside=True),
        lane("on_0", [(110.0, 0.0), (300.0, 0.0)]),
        lane("short_0", [(108.0, y[0]), (108.0, y[1])]),
        lane(":S_0", [(108.0, y[1]), (108.0, y[2])], inside=True),
        lane("out_0", [(108.0, y[2]), (108.0, y[3])]),
    ]
    turn: Direction = "right" if side < 0.0 else "left"
    links = [
        link("in_0", "short_0", turn, (":J_0",), index=0),
        link("in_0", "on_0", "straight", (":K_0",), index=1),
        link("short_0", "out_0", "straight", (":S_0",), yields_to=(FIRST,), index=2),
    ]
    return drawn(lanes, links)


def turning(apart: float, action: Action = "exit-right") -> ActionPlan:
    """The turn, from 30 m before it."""
    roads = two_junctions(apart, action)
    plan = expand(roads, on_lane(roads, "in_0", 70.0, 8.0), action, None, VIEW)
    assert isinstance(plan, ActionPlan)
    return plan


def across(plan: ActionPlan, ahead: float) -> Obstacle:
    """Somebody with the right of way who stands on the way, beyond the line."""
    (x, y), heading = plan.path.pose(ahead, LENGTH)
    aside = heading + 0.5 * math.pi
    front = (x + 2.0 * math.cos(aside), y + 2.0 * math.sin(aside))
    return Obstacle(
        1,
        LENGTH,
        WIDTH,
        np.tile(front, (STEPS, 1)),
        np.full(STEPS, aside),
        np.zeros(STEPS),
        frozenset({("J", FIRST)}),
    )


@pytest.mark.parametrize("action", ["exit-right", "exit-left"])
@pytest.mark.parametrize("apart", [4.0, 6.0, 8.0])
def test_a_line_soon_after_a_turn_is_stopped_at(apart: float, action: Action) -> None:
    plan = turning(apart, action)
    (line,) = (m.stop for m in plan.manoeuvres if isinstance(m, GiveWay))
    assert line > plan.end - 1.0
    traffic = Traffic.of((across(plan, line + 5.0),))
    driven = drive(plan, Motion(0.0, 8.0, 0.0), 0, traffic, SIZE, STEPS - 60).motion
    arc, speed = driven[-1, :2]
    assert arc + speed**2 / (2.0 * COMFORT) < line + 0.5
    assert speed < STANDING or arc >= plan.end
    alone = drive(plan, Motion(0.0, 8.0, 0.0), 0, Traffic.of(()), SIZE, STEPS - 60).motion
    assert alone[-1, 1] > 4.0


def test_a_line_far_beyond_a_turn_is_left_to_the_next_action() -> None:
    assert not turning(60.0).give_ways
