"""Road users who have set off across the way of somebody who goes first, and will not stop again.

By the rules, a driver who could still stop would do so. One who speeds up instead, beyond the
place where to wait, has taken the gap.
"""

from collections.abc import Sequence

import numpy as np

from planner.manoeuvres.actions import Situation
from planner.motion.tracks import Observed
from planner.rollouts.rollout import Leg
from sim.roads.network import Network

LATELY = 2  # steps over which a driver must have sped up
GAIN = 0.3  # [m/s] by this much
SOON = 5  # steps ahead in which the rules would have the driver brake
LOSS = 0.2  # [m/s] by this much


def insists(
    network: Network, starts: Sequence[Situation], observed: Observed, legs: Sequence[Leg]
) -> bool:
    """Check whether a driver beyond the place where to wait speeds up instead of braking.

    Args:
        network: the road network.
        starts: situations that the vehicle may be in now.
        observed: its track.
        legs: how it would drive on by the rules.
    """
    if not legs or observed.elapsed < LATELY:
        return False
    now = float(observed.speed[-1])
    gained = now - float(observed.speed[-1 - LATELY])
    by_rules = float(np.min(legs[0].speed[: SOON + 1]))
    if gained < GAIN or by_rules > now - LOSS:
        return False
    return any(_beyond(network, start.location.lane) for start in starts)


def _beyond(network: Network, lane: str) -> bool:
    """Check whether a lane lies inside a junction, beyond the place where to wait."""
    link = network.link_via(lane)
    if link is None:
        return False
    return not (link.waits_inside and len(link.via) > 1 and lane == link.via[0])
