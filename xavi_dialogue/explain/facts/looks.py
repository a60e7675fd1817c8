"""Looks: what a vehicle looks like at a time, and whether any other one looks like it."""

from collections.abc import Mapping
from typing import TypeAlias, get_args

from msgspec.structs import replace

from planner.record.places import RoadPlace
from sim.scene import EGO, VehicleState
from xavi_dialogue.domain.facts import Look
from xavi_dialogue.domain.vocabulary import Kind
from xavi_dialogue.explain.facts.bearings import aside, bearing, offset, oncoming
from xavi_dialogue.explain.facts.bodies import distance
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.motion import EPSILON

_Places: TypeAlias = tuple[RoadPlace | None, RoadPlace | None]

STILL = 0.3  # [m/s] below which a vehicle stands
WIDE = 2.3  # [m] minimum width of a lorry: SUMO makes vans 2.16 m wide, lorries 2.4 m
KINDS: dict[str, Kind] = {kind: kind for kind in get_args(Kind)}


def kind_of(state: VehicleState) -> Kind:
    """Return the kind of vehicle that a passenger sees: a narrow lorry is a van."""
    if state.kind == "truck" and state.width < WIDE:
        return "van"
    return KINDS.get(state.kind, "vehicle")


def look(states: States, vehicle: int, time: float) -> Look | None:
    """Return a vehicle as it is seen at a time [s], or was seen last; None if it never was."""
    return states.memo(("look", vehicle, round(time, 3)), lambda: _look(states, vehicle, time))


def _look(states: States, vehicle: int, time: float) -> Look | None:
    seen = states.last_seen(vehicle, time)
    if seen is None or vehicle == EGO:
        return None
    state, ego = states.lately(vehicle, time), states.state(EGO, seen)
    if state is None or ego is None:
        return None
    places = states.place(EGO, seen), states.place(vehicle, seen)
    found = _seen(vehicle, seen, ego, state, places)
    in_view = seen >= time - EPSILON
    return replace(
        found,
        alone=_alone(states, vehicle, seen),
        in_view=in_view,
        seen=None if in_view else seen,
    )


def look_in(scene: Mapping[int, VehicleState], vehicle: int, time: float) -> Look | None:
    """Return a vehicle as it is seen in a scene without a record; None if it is not in it."""
    if vehicle == EGO or EGO not in scene or vehicle not in scene:
        return None
    mine = (kind_of(scene[vehicle]), scene[vehicle].colour)
    others = (state for name, state in scene.items() if name not in (EGO, vehicle))
    alone = all((kind_of(other), other.colour) != mine for other in others)
    return replace(_seen(vehicle, time, scene[EGO], scene[vehicle]), alone=alone)


def _seen(
    vehicle: int,
    time: float,
    ego: VehicleState,
    state: VehicleState,
    places: _Places = (None, None),
) -> Look:
    """Return a vehicle as it is seen from our car; `places` on the road are ours and its own."""
    where = offset(ego, state)
    if state.speed < STILL and not (where.same_way or where.opposite):
        place = aside(where)  # it stands, so it does not come from a side
    else:
        place = bearing(where, *places)
    return Look(
        vehicle,
        time,
        kind_of(state),
        state.colour,
        state.length,
        place,
        round(distance(ego, state), 2),
        round(where.ahead, 2),
        round(where.left, 2),
        state.speed,
        oncoming=oncoming(where),
    )


def _alone(states: States, vehicle: int, time: float) -> bool:
    """Check whether nobody else in view has a vehicle's kind and colour."""
    mine = _appearance(states, vehicle)
    return all(_appearance(states, v) != mine for v in states.in_view(time) if v != vehicle)


def _appearance(states: States, vehicle: int) -> tuple[str, str | None] | None:
    shape = states.shape(vehicle)
    return None if shape is None else (kind_of(shape), shape.colour)
