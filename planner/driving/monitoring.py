"""Monitoring on a drive: the possible courses of lights, and others who surprise."""

import math
from collections.abc import Iterator, Sequence
from itertools import zip_longest

import numpy as np

from planner.kernels.limits import GAP_HORIZON, OPEN
from planner.manoeuvres.plans import ActionPlan
from planner.motion.obstacles import Obstacle
from planner.record.light_record import LightPrediction
from planner.roads.trajectory import Roads
from planner.traffic_lights.cycles import foresee
from planner.traffic_lights.observations import Watched
from planner.traffic_lights.signals import MEANING, STEP, Lights
from sim.scene import PersonState, Scene, Signal, VehicleState

SURPRISE = 1.2  # [m/s] difference from the foreseen speed that is a surprise
STRAY = 2.0  # [m] the same for the place of a person; setting off or stopping explains less


def light_courses(
    roads: Roads, watched: Sequence[Watched], time: float, horizon: float, edges: Sequence[str]
) -> tuple[LightPrediction, ...]:
    """Return the possible courses of the lights in view.

    Args:
        roads: the road network.
        watched: the observations of each controller in view.
        time: [s] now.
        horizon: [s] for which courses are needed.
        edges: those along which the ego drives; several courses are distinguished only for the
            controller that it comes to next.
    """
    known = {one.controller for one in watched}
    coming = next((name for name in _along(roads, edges) if name in known), None)
    lasting = horizon + GAP_HORIZON * STEP
    return tuple(
        foresee(roads, one, time, lasting, closely=one.controller == coming) for one in watched
    )


def _along(roads: Roads, edges: Sequence[str]) -> Iterator[str]:
    """Yield the controllers of the junctions between edges and after the last one, in order.

    A way may end before a light: its queue matters all the same.
    """
    network = roads.network
    for edge, after in zip_longest(edges, edges[1:]):
        for lane in network.edge_lanes(edge):
            for link in network.links_from(lane.id):
                leads = after is None or network.lanes[link.to_lane].edge == after
                if leads and isinstance(link.control, Signal):
                    yield link.control.controller


def shown_now(scene: Scene) -> Lights:
    """Return the lights in view, as if they stayed as they are."""
    return Lights(
        {
            light.signal: np.full(1, MEANING.get(light.state.value, OPEN), np.int8)
            for light in scene.lights
        }
    )


def changed(plan: ActionPlan, scene: Scene, known: Sequence[LightPrediction]) -> bool:
    """Check whether a light on a plan's way shows something else than at the decision."""
    before = {one.controller: one for one in known}
    for ahead in plan.obey_lights:
        light, then = scene.light(ahead.signal), before.get(ahead.signal.controller)
        if light is None or then is None:
            continue
        if light.state.value != then.state(ahead.signal.index):
            return True
    return False


def as_foreseen(state: VehicleState | PersonState, motion: Obstacle, step: int) -> bool:
    """Check whether a road user moves as foreseen: as fast or, on foot, near the place."""
    at = min(step, len(motion.speed) - 1)
    if isinstance(state, PersonState):
        x, y = motion.position[at].tolist()
        return math.dist((x, y), state.position) <= STRAY
    return abs(float(motion.speed[at]) - state.speed) <= SURPRISE
