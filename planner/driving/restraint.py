"""Restraint: what keeps the ego from driving faster in one step of control."""

import math
from dataclasses import dataclass

import numpy as np

from planner.kernels.giving_way import stands_first
from planner.kernels.limits import COMFORT, HINDERED, RELAXATION
from planner.manoeuvres.plans import ActionPlan
from planner.motion.forward import Keeping, Lane, Motion
from planner.motion.obstacles import Occupancy
from planner.record.events import RestraintKind
from planner.roads.trajectory import Roads
from sim.scene import Signal

SLACK = 0.1  # [m/s] by which a speed may fall short of the limit and still be the limit


@dataclass(frozen=True, slots=True)
class Restraint:
    """What keeps the ego from driving faster."""

    by: RestraintKind
    vehicle: int | None = None
    light: Signal | None = None


@dataclass(frozen=True, slots=True)
class Controlled:
    """The acceleration chosen for a step, and what it rests on."""

    acceleration: float  # [m/s2]
    keeping: Keeping
    restraint: Restraint

    def slowed(self, braking: float, restraint: Restraint) -> "Controlled":
        """Return the control with a lower acceleration [m/s2] and its reason; else the same."""
        if braking >= self.acceleration:
            return self
        return Controlled(braking, self.keeping, restraint)


def restraint_of(
    plan: ActionPlan,
    lane: Lane,
    motion: Motion,
    keeping: Keeping,
    crossing: Occupancy,
    roads: Roads,
) -> Restraint:
    """Return what keeps the ego from driving faster on its way.

    Args:
        plan: what is being driven.
        lane: its path, prepared.
        motion: where on the path the ego is.
        keeping: who or what is in the way.
        crossing: motions that the ego must give way to.
        roads: the road network.
    """
    hindrance = keeping.hindrance
    if hindrance is not None:
        return Restraint(hindrance.how, hindrance.vehicle, keeping.light)
    if keeping.light is not None:
        return Restraint("light", None, keeping.light)
    if plan.stops:
        return Restraint("stop")
    reach = motion.arc + motion.speed * RELAXATION
    free = lane.speed(reach)
    ready, who = stands_first(
        motion.arc, plan.line_arcs, crossing.stretches, crossing.firsts(plan.lines), 0
    )
    if who >= 0 and ready <= motion.speed + HINDERED and ready < free:
        return Restraint("stands-first", crossing.vehicle(who))
    if motion.speed < free - HINDERED:
        return Restraint("nothing")
    return Restraint(_on_road(plan, lane, reach, roads))


def _on_road(plan: ActionPlan, lane: Lane, reach: float, roads: Roads) -> RestraintKind:
    """Return what on the road ahead of an arc [m] demands the speed of there."""
    path = plan.path
    first = min(int(np.searchsorted(path.arc, reach)), len(path.arc) - 1)
    gaps = np.maximum(path.arc[first:] - reach, 0.0)
    allowed = np.sqrt(path.cap[first:] ** 2 + 2.0 * COMFORT * gaps)
    at = int(np.argmin(allowed))
    if math.isfinite(lane.end):
        room = max(lane.end - reach, 0.0)
        if math.sqrt(2.0 * COMFORT * room) < float(allowed[at]):
            return "road-end"
    name, _ = path.lane_at(float(path.arc[first + at]))
    limit = roads.network.lanes[name].speed_limit
    return "bend" if float(path.cap[first + at]) < limit - SLACK else "limit"
