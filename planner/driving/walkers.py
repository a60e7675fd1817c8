"""People who walk on the road now, on crossings or not, and who must be let pass."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from planner.kernels.limits import COMFORT
from planner.manoeuvres.plans import ActionPlan, LetCross
from planner.motion.forward import Motion
from planner.motion.kerbs import on_crossing
from planner.motion.obstacles import Obstacle, Traffic, occupancy
from planner.motion.walking import on_road
from planner.record.trace import ON_FOOT
from planner.roads.trajectory import Roads
from planner.traffic_lights.signals import STEP
from sim.scene import Signal, VehicleState

AROUND = 60.0  # [m] within which people count
AHEAD = 20  # steps for which they are assumed to go on as they do
PASSING = 2.5  # [m/s] at which to pass a vehicle that waits at a crossing
SLOW = 2.0  # [m/s] below which a vehicle waits
BESIDE = (2.0, 5.0)  # [m] least and greatest distance sideways of a vehicle on the next lane
QUEUE = 6.0  # [m] before a crossing within which a vehicle waits for people on it
ALIKE = 0.8  # least cosine of the angle between vehicles that drive in one direction
SPACE = 1.5  # [m] distance to a person at which to wait


def with_walkers(
    plan: ActionPlan, roads: Roads, seen: Sequence[Obstacle], ego: VehicleState
) -> tuple[ActionPlan, list[Obstacle]]:
    """Return a plan that lets people pass who are about to walk into its way, and their motions.

    Args:
        plan: the plan to drive.
        roads: the road network.
        seen: all others, from now on.
        ego: the state of the ego.
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


def passing_speed(
    plan: ActionPlan, motion: Motion, others: Mapping[int, VehicleState]
) -> tuple[float, int] | None:
    """Return the speed [m/s] at which to pass a vehicle that waits at a crossing, and its number.

    It stands on another lane, and may hide people that it lets cross. None if no vehicle waits
    there, or if a light controls the crossing.
    """
    found: tuple[float, int] | None = None
    for line in plan.crossings:
        gap = line.stop - motion.arc
        one = line.crossing
        signalled = one is not None and isinstance(one.control, Signal)
        if signalled or not line.first or not 0.0 < line.clear - motion.arc < AROUND:
            continue
        waits = (name for name, other in others.items() if _waits_beside(plan, line, other))
        first = next(waits, None)
        speed = math.sqrt(PASSING**2 + 2.0 * COMFORT * max(gap, 0.0))
        if first is not None and (found is None or speed < found[0]):
            found = speed, first
    return found


def _waits_beside(plan: ActionPlan, line: LetCross, other: VehicleState) -> bool:
    """Check whether a vehicle waits at a crossing on a lane beside a path."""
    if other.speed > SLOW or other.kind in ON_FOOT:
        return False
    path = plan.path
    k = int(np.argmin(np.hypot(*(path.points - np.array(other.position)).T)))
    (dx, dy), heading = np.array(other.position) - path.points[k], float(path.heading[k])
    aside = abs(dy * math.cos(heading) - dx * math.sin(heading))
    along = float(path.arc[k])
    alike = math.cos(other.heading - heading) > ALIKE
    return alike and BESIDE[0] < aside < BESIDE[1] and line.stop - QUEUE < along < line.clear


def _on_a_road(roads: Roads, walker: Obstacle) -> bool:
    x, y = walker.position[0].tolist()
    return on_crossing(roads, (x, y)) or on_road(roads.network, (x, y))


def _going_on(walker: Obstacle) -> Obstacle:
    """Return the motion of a walker for AHEAD steps."""
    steps = STEP * np.arange(AHEAD + 1, dtype=np.float64) * float(walker.speed[0])
    heading = float(walker.heading[0])
    ahead = np.array([math.cos(heading), math.sin(heading)])
    return replace(
        walker,
        position=walker.position[0] + steps[:, None] * ahead,
        heading=np.full(AHEAD + 1, heading),
        speed=np.full(AHEAD + 1, float(walker.speed[0])),
    )
