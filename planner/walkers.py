"""People who walk on the road now, on crossings or not: to be let pass in the coming step."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from planner.manoeuvres import ActionPlan, LetCross
from planner.obstacles import Obstacle, Traffic, occupancy
from planner.people import on_crossing
from planner.trajectory import Roads
from planner.walking import on_road
from sim.scene import VehicleState

AROUND = 60.0  # [m] within which people count
AHEAD = 20  # steps for which they are taken to go on as they do
SPACE = 1.5  # [m] before somebody at which to wait


def with_walkers(
    plan: ActionPlan, roads: Roads, seen: Sequence[Obstacle], ego: VehicleState
) -> tuple[ActionPlan, list[Obstacle]]:
    """A plan that lets those pass who are about to walk into its way, and how they go on.

    Args:
        plan: to drive.
        roads: the road network.
        seen: everybody else, from now on.
        ego: who drives.
    """
    walkers = [_going_on(one) for one in seen if one.on_foot and _on_a_road(roads, one)]
    if not walkers:
        return plan, []
    stretches = occupancy(plan.path, Traffic.of(walkers), ego.width, 0, AHEAD).stretches
    lines, found = [], []
    for m, walker in enumerate(walkers):
        low, high = stretches.low[m], stretches.high[m]
        if math.isnan(low[0]) and not np.all(np.isnan(low)):
            key = ("", walker.vehicle)
            stop = float(np.nanmin(low)) - SPACE
            lines.append(LetCross(stop, float(np.nanmax(high)), frozenset((key,)), None, True))
            found.append(replace(walker, links=frozenset((key,))))
    return replace(plan, manoeuvres=(*plan.manoeuvres, *lines)), found


def _on_a_road(roads: Roads, walker: Obstacle) -> bool:
    x, y = walker.position[0].tolist()
    return on_crossing(roads, (x, y)) or on_road(roads.network, (x, y))


def _going_on(walker: Obstacle) -> Obstacle:
    """The same walker for AHEAD steps."""
    steps = 0.2 * np.arange(AHEAD + 1, dtype=np.float64) * float(walker.speed[0])
    heading = float(walker.heading[0])
    ahead = np.array([math.cos(heading), math.sin(heading)])
    return replace(
        walker,
        position=walker.position[0] + steps[:, None] * ahead,
        heading=np.full(AHEAD + 1, heading),
        speed=np.full(AHEAD + 1, float(walker.speed[0])),
    )
