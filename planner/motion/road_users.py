"""All road users of a scene, people on foot included, and their motions from now on."""

import numpy as np

from planner.kernels.projection import SIDE_MARGIN
from planner.motion.obstacles import Obstacle
from planner.motion.tracks import Observed, berth_of, coast
from planner.motion.walking import straight
from planner.record.trace import ON_FOOT
from planner.roads.classes import roads_of
from planner.roads.trajectory import Roads
from sim.scene import PersonState, Scene, VehicleState


def road_users_in(scene: Scene) -> dict[int, VehicleState]:
    """Return vehicles and people by number, in increasing order; people differ by their kind."""
    people = {name: _as_traffic(state) for name, state in scene.people.items()}
    return dict(sorted({**scene.vehicles, **people}.items()))


def going_on(roads: Roads, track: Observed, steps: int) -> Obstacle:
    """Return the motion of a road user that goes on: along its lane or, on foot, straight ahead."""
    if track.kind in ON_FOOT:
        return straight(track, steps + 1)
    return coast(roads_of(roads, track.kind), track, steps, past=False)


def standing(roads: Roads, vehicle: int, state: VehicleState) -> Obstacle:
    """Return a road user that stays at its present place, for one step."""
    position, heading = np.array([state.position]), np.array([state.heading])
    speed, on_foot = np.array([state.speed]), state.kind in ON_FOOT
    size, berth = (state.length, state.width), SIDE_MARGIN
    if not on_foot:
        track = Observed(vehicle, *size, position, heading, speed, kind=state.kind)
        berth = berth_of(roads_of(roads, state.kind), track)
    return Obstacle(vehicle, *size, position, heading, speed, frozenset(), berth, on_foot)


def _as_traffic(person: PersonState) -> VehicleState:
    return VehicleState(
        position=person.position,
        heading=person.heading,
        speed=person.speed,
        acceleration=0.0,
        length=person.length,
        width=person.width,
        kind=person.kind,
    )
