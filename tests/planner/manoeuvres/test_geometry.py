"""Every macro action, everywhere on networks of many kinds."""

import itertools
import math
import random
from pathlib import Path

import numpy as np
import pytest

from planner.manoeuvres.actions import ActionPlan, Situation, expand
from planner.prediction.goals import goals_in_view
from planner.record.trace import ACTIONS, EgoGoal
from planner.roads.routes import Refusal
from planner.roads.trajectory import LATERAL_ACCELERATION, Roads
from sim.roads.network import Network
from tests.planner.nets import GENERATED, SCENARIOS, generate, on_lane, shipped
from tests.planner.worlds import VIEW

MOST_LANES = 120
SHARPEST = 0.45  # [rad/m] of heading where a line does not turn back
NEAR = 0.6  # [m] from a vehicle at which its path may begin, in the sharpest corners


def connected(network: Network, before: str, after: str) -> bool:
    """Whether one lane leads straight into another."""
    inside = network.link_via(before)
    if inside is not None:
        row = (*inside.via, inside.to_lane)
        return row[row.index(before) + 1] == after
    return any((*way.via, way.to_lane)[0] == after for way in network.links_from(before))


def check(roads: Roads, here: Situation, plan: ActionPlan) -> None:
    path = plan.path
    steps = np.diff(path.arc)
    assert np.all(steps > 0.0)
    assert np.all(np.hypot(*np.diff(path.points, axis=0).T) > 1e-4)
    for values in (path.points, path.heading, path.curvature, path.cap):
        assert np.all(np.isfinite(values))
    assert math.dist(path.points[0], here.position) < NEAR
    assert 0.0 < plan.end <= path.length + 1e-6
    assert np.all(path.cap**2 * np.abs(path.curvature) <= LATERAL_ACCELERATION + 1e-6)
    names = [name for name, _ in path.lanes]
    for before, after in itertools.pairwise(names):
        assert connected(roads.network, before, after), (before, after)
    turns_back = {
        via
        for way in roads.network.links
        if way.direction == "turnaround"
        for via in (*way.via, way.to_lane)
    }
    if not turns_back & set(names):
        assert np.max(np.abs(np.diff(path.heading)) / np.maximum(steps, 0.5)) < SHARPEST


def check_everywhere(roads: Roads, *, sharp: bool = False) -> None:
    draw = random.Random(1)
    lanes = list(roads.network.lanes.values())
    edges = sorted({lane.edge for lane in lanes if not lane.internal})
    for lane in draw.sample(lanes, min(MOST_LANES, len(lanes))):
        for share in (0.0, 0.1, 0.6, 1.0):
            for speed in (0.0, lane.speed_limit):
                here = on_lane(roads, lane.id, share * lane.length, speed)
                goal = EgoGoal(draw.choice(edges), 1.0, None) if draw.random() < 0.7 else None
                found = [expand(roads, here, action, goal, VIEW) for action in ACTIONS]
                plans = [plan for plan in found if isinstance(plan, ActionPlan)]
                assert plans, (lane.id, share)
                assert all(x.reason.islower() for x in found if isinstance(x, Refusal))
                if not sharp:
                    for plan in plans:
                        check(roads, here, plan)
                goals = goals_in_view(roads, (here,), VIEW)
                assert len(goals) > 1
                assert math.isclose(sum(goal.prior for goal in goals), 1.0)


@pytest.mark.parametrize("name", SCENARIOS)
def test_every_action_is_planned_or_refused_everywhere(name: str) -> None:
    check_everywhere(shipped(name))


@pytest.mark.parametrize("name", [name for name in GENERATED if name != "open"])
def test_every_action_is_planned_or_refused_on_generated_roads(name: str, tmp_path: Path) -> None:
    check_everywhere(generate(name, tmp_path))


def test_junctions_without_lanes_of_their_own_do_no_harm(tmp_path: Path) -> None:
    roads = generate("open", tmp_path)
    assert not any(lane.internal for lane in roads.network.lanes.values())
    check_everywhere(roads, sharp=True)
