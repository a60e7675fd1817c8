"""Caution: a slow approach to places where vehicles with priority may come from hidden roads."""

import math
from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np

from planner.hidden_areas.phantoms import View, imagined, reach_of
from planner.kernels.limits import COMFORT, READY
from planner.manoeuvres.layout import BEFORE_LINE
from planner.manoeuvres.plans import ActionPlan, GiveWay, LaneFollow
from planner.motion.forward import DT, Drive, Motion, drive, lane_of
from planner.motion.obstacles import NOBODY, Obstacle
from planner.motion.tracks import links_of, sample_path
from planner.record.hidden_record import HeldByHidden, Phantom
from planner.record.trace import HeldUp
from planner.roads.routes import onward
from planner.roads.trajectory import Array, Roads

CAUTION = 0.08  # minimum probability of a vehicle for which the ego slows down
CREEPING = 1.5  # [m/s] at which the ego goes on without a view
SLOWER = 0.5  # [m/s] minimum reduction of speed that counts as a hold-up by caution
GRACE = 3  # maximum difference of steps within one stretch
SIZE = (4.8, 1.8)  # [m] length and width of a phantom, a car

Careful: TypeAlias = tuple[tuple[tuple[str, int], int], ...]  # links approached slowly, and steps


def cautious(phantoms: Sequence[Phantom]) -> dict[tuple[str, int], float]:
    """Return links (junction, index) to approach slowly, with the place [m] behind the line.

    This is the place at which the way of a vehicle that may come begins.
    """
    nobody: dict[tuple[str, int], float] = {}
    first: dict[tuple[str, int], float] = {}
    for one in phantoms:
        for key, meets in one.met.items():
            nobody[key] = nobody.get(key, 1.0) * (1.0 - one.probability)
            first[key] = min(first.get(key, math.inf), meets)
    return {key: first[key] for key, chance in nobody.items() if 1.0 - chance >= CAUTION}


def caution(plan: ActionPlan, slow: Mapping[tuple[str, int], float], count: int) -> Array:
    """Return the highest speed [m/s] at each metre along a plan's path, for `count` metres.

    It is not known when the view will open. It is assumed to do so in time for READY.

    Args:
        plan: the plan that is driven.
        slow: links to approach slowly, with the place [m] behind the line.
        count: number of metres.
    """
    caps = np.full(count, math.inf)
    arcs = np.arange(count, dtype=np.float64)
    for line in plan.give_ways if slow else ():
        if key_of(line) in slow:
            gap = line.stop + BEFORE_LINE + slow[key_of(line)] - arcs
            allowed = np.sqrt(CREEPING * CREEPING + 2.0 * COMFORT * np.maximum(gap, 0.0))
            caps = np.where(gap > 0.0, np.minimum(caps, np.maximum(allowed, READY)), caps)
    return caps


def allowed_speed(view: View, plan: ActionPlan, arc: float) -> float:
    """Return the allowed speed [m/s] towards the next line; infinite if there is no such risk.

    Args:
        view: what is seen, and what is hidden.
        plan: the plan that is driven.
        arc: [m] where on its path the ego's front is.
    """
    lines = [x for x in plan.give_ways if x.clear > arc] if view.unseen else []
    line = min(lines, key=lambda x: x.stop, default=None)
    if line is None or line.stop - arc > reach_of(view.ego.speed):
        return math.inf
    slow = cautious(imagined(view, (line.link,))).get(key_of(line))
    if slow is None:
        return math.inf
    gap = line.stop + BEFORE_LINE + slow - arc
    return math.sqrt(CREEPING * CREEPING + 2.0 * COMFORT * gap) if gap > 0.0 else math.inf


def key_of(line: GiveWay) -> tuple[str, int]:
    """Return the link of a line, as (junction, index)."""
    return line.link.junction, line.link.index


def coming(roads: Roads, one: Phantom, name: int, steps: int) -> Obstacle:
    """Return the motion of a phantom from now on, as fast as bends allow.

    Args:
        roads: the road network.
        one: the phantom.
        name: its number among the others.
        steps: number of steps.
    """
    reach = one.speed * steps * DT + 20.0
    ahead = sum(roads.network.lanes[lane].length for lane in one.lanes)
    row = (*one.lanes[:-1], *onward(roads, (one.lanes[-1],), max(reach - ahead, 0.0) + one.end))
    path = roads.path(row, one.position, one.heading, 1.0, reach)
    follow = (LaneFollow(0.0, path.length),)
    plan = ActionPlan("continue", path, follow, path.length, math.inf, None)
    start = Motion(0.0, one.speed, 0.0)
    driven = drive(plan, start, 0, NOBODY, SIZE, steps, one.speed).motion
    position, heading = sample_path(path, driven[:, 0], SIZE[0])
    missing = steps + 1 - len(driven)
    return Obstacle(
        name,
        *SIZE,
        np.vstack((position, np.full((missing, 2), np.nan))),
        np.concatenate((heading, np.zeros(missing))),
        np.concatenate((driven[:, 1], np.zeros(missing))),
        links_of(roads, row),
    )


def name_of(phantom: int) -> int:
    """Return the number of a phantom among the others: negative, as theirs are positive."""
    return -1 - phantom


def careful_steps(
    plan: ActionPlan, slow: Mapping[tuple[str, int], float], driven: Drive, count: int
) -> Careful:
    """Return the steps of a drive in which caution before hidden areas made the ego slower.

    Args:
        plan: the plan that was driven.
        slow: links to approach slowly, with the place [m] behind the line.
        driven: the drive.
        count: number of its steps that count.
    """
    keys = [key_of(line) for line in plan.give_ways if key_of(line) in slow]
    if not keys:
        return ()
    free = lane_of(plan.path).caps
    most = caution(plan, slow, len(free))
    arcs = np.minimum(driven.motion[:count, 0].astype(np.int64), len(free) - 1)
    bound = most[arcs] < free[arcs] - SLOWER
    bound &= driven.motion[:count, 1] > most[arcs] - SLOWER
    return tuple((keys[0], driven.first + int(k)) for k in np.flatnonzero(bound))


def held_by_hidden(
    phantoms: Sequence[Phantom], hindered: Sequence[HeldUp], careful: Careful, start: float
) -> tuple[HeldByHidden, ...]:
    """Return the stretches in which hidden parts of the road made a rollout slower, in order.

    Args:
        phantoms: the phantoms of the decision.
        hindered: stretches in which others, phantoms included, held the ego up.
        careful: steps in which the ego approached a link slowly.
        start: [s] time of step 0.
    """
    found = [
        HeldByHidden(-1 - stretch.vehicle, True, stretch.since, stretch.until)
        for stretch in hindered
        if stretch.vehicle < 0
    ]
    runs: list[tuple[tuple[str, int], int, int]] = []
    for key, step in careful:
        if runs and runs[-1][0] == key and step - runs[-1][2] <= GRACE:
            runs[-1] = (key, runs[-1][1], step)
        else:
            runs.append((key, step, step))
    for key, first, last in runs:
        since, until = round(start + first * DT, 2), round(start + (last + 1) * DT, 2)
        mine = (k for k, one in enumerate(phantoms) if key in one.met)
        found += [HeldByHidden(k, False, since, until) for k in mine]
    return tuple(sorted(found, key=lambda one: (one.since, one.phantom, one.comes)))
