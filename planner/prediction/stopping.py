"""The motion of a vehicle that brakes to stop on the road and stays there."""

import math

import numpy as np

from planner.manoeuvres.actions import COMFORT, ActionPlan, Situation, Stop
from planner.motion.forward import Motion, drive
from planner.motion.obstacles import Obstacle, Traffic
from planner.motion.tracks import Observed, berth_of, links_of, sample_path
from planner.roads.routes import onward
from planner.rollouts.rollout import Task

STOPPING = 100.0  # [m] minimum length of road on which a vehicle may stop


def stopping(frame: Task, here: Situation, observed: Observed, others: Traffic) -> Obstacle | None:
    """Return the motion of braking to a standstill; None if it ends inside a junction.

    Args:
        frame: the task of planning from now on.
        here: where the vehicle is now.
        observed: its track.
        others: the others' motions.
    """
    reach = max(STOPPING, here.speed**2 / COMFORT)  # twice what the braking takes
    row = onward(frame.roads, (here.location.lane,), here.location.offset + reach)
    path = frame.roads.path(row, here.position, here.heading, 12.0, reach, reach)
    plan = ActionPlan("stop", path, (Stop(0.0, COMFORT),), path.length, math.inf, None)
    driven = drive(plan, Motion(0.0, here.speed, 0.0), 0, others, frame.size, frame.horizon)
    arcs, speed = driven.motion[:, 0], driven.motion[:, 1]
    if frame.roads.network.lanes[path.lane_at(float(arcs[-1]))[0]].internal:
        return None
    position, heading = sample_path(path, arcs, observed.length)
    rest = frame.horizon + 1 - len(arcs)
    return Obstacle(
        observed.vehicle,
        observed.length,
        observed.width,
        np.vstack((position, np.repeat(position[-1:], rest, axis=0))),
        np.concatenate((heading, np.repeat(heading[-1:], rest))),
        np.concatenate((speed, np.zeros(rest))),
        links_of(frame.roads, [lane for lane, start in path.lanes if start <= arcs[-1]]),
        berth_of(frame.roads, observed),
    )
