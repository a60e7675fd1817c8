"""What is looked out for on a drive: lights, how they may go on, and others who surprise."""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from planner.kernels.driving import GAP_HORIZON, OPEN
from planner.manoeuvres.plans import ActionPlan
from planner.motion.obstacles import Obstacle
from planner.record.light_record import LightPrediction
from planner.roads.trajectory import Roads
from planner.traffic_lights.cycles import Watched, foresee
from planner.traffic_lights.signals import MEANING, STEP, Lights
from sim.scene import PersonState, Scene, Signal, VehicleState

SURPRISE = 1.2  # [m/s] by which a speed must differ from what was foreseen
STRAY = 2.0  # [m] by which a place on foot must, more than who sets off or stops explains


def lookout(
    roads: Roads, watched: Sequence[Watched], time: float, horizon: float, edges: Sequence[str]
) -> tuple[LightPrediction, ...]:
    """Return how the lights in view may go on.

    Args:
        roads: the road network.
        watched: what was seen of each controller in view.
        time: [s] now.
        horizon: [s] for which that is needed.
        edges: along which the ego drives; of the controller that it comes to next, several
            courses are distinguished.
    """
    known = {one.controller for one in watched}
    coming = next((name for name in _along(roads, edges) if name in known), None)
    lasting = horizon + GAP_HORIZON * STEP
    return tuple(
        foresee(roads, one, time, lasting, closely=one.controller == coming) for one in watched
    )


def _along(roads: Roads, edges: Sequence[str]) -> Iterator[str]:
    """Yield the controllers of the junctions between edges, in order."""
    network = roads.network
    for edge, after in pairwise(edges):
        for lane in network.edge_lanes(edge):
            for link in network.links_from(lane.id):
                if network.lanes[link.to_lane].edge == after and isinstance(link.control, Signal):
                    yield link.control.controller


def shown_now(scene: Scene) -> Lights:
    """What the lights in view mean to who comes to them, as long as they stay as they are."""
    return Lights(
        {
            light.signal: np.full(1, MEANING.get(light.state.value, OPEN), np.int8)
            for light in scene.lights
        }
    )


def changed(plan: ActionPlan, scene: Scene, known: Sequence[LightPrediction]) -> bool:
    """Whether a light that a plan comes to shows something else than when it was decided on."""
    before = {one.controller: one for one in known}
    for ahead in plan.obey_lights:
        light, then = scene.light(ahead.signal), before.get(ahead.signal.controller)
        if light is None or then is None:
            continue
        if light.state.value != then.state(ahead.signal.index):
            return True
    return False


def as_foreseen(state: VehicleState | PersonState, motion: Obstacle, step: int) -> bool:
    """Check whether somebody moves as a motion says: as fast; on foot, about there."""
    at = min(step, len(motion.speed) - 1)
    if isinstance(state, PersonState):
        x, y = motion.position[at].tolist()
        return math.dist((x, y), state.position) <= STRAY
    return abs(float(motion.speed[at]) - state.speed) <= SURPRISE
