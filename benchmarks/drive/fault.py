"""The causes of collisions and hard brakes, determined from scenes alone.

A collision is a moment at which the ego's box overlaps another's. The ego caused it, unless

- it had been standing for at least a second, or
- the other ran into its rear (in the step before, the other's front was behind the ego's rear
  bumper, in its track and with much the same heading), and for the last three seconds the ego
  had kept its lane: it neither changed lanes, nor stuck out of its lane, nor came from a
  junction where it had to give way.

The ego provokes a hard brake of another vehicle if it is the nearest vehicle ahead of the other,
within fifty metres and the width of a lane to each side, when the other begins to brake.
"""

import math
from collections.abc import Sequence

from sim.roads.network import Lane, Location, Network, angle_between
from sim.scene import EGO, Scene, VehicleState

STANDING = 0.1  # [m/s] below which a vehicle stands
STOOD = 1.0  # [s] for which it must have stood
KEPT = 3.0  # [s] for which it must have kept its lane
ALIGNED = math.pi / 4  # [rad] greatest difference of headings of a vehicle that follows
AHEAD = 50.0  # [m] within which a vehicle can make another brake
ASIDE = 3.5  # [m] greatest distance to the side of the vehicle that brakes
EPSILON = 1e-6  # [s]


def caused_by_ego(before: Sequence[Scene], now: Scene, vehicle: int, network: Network) -> bool:
    """Check whether the ego caused a collision, by the rule above.

    Args:
        before: the scenes of the last seconds before the collision, oldest first.
        now: the first scene in which the boxes overlap.
        vehicle: the other's name.
        network: the roads.
    """
    if stood([*before, now]):
        return False
    last = before[-1].vehicles if before else {}
    struck = EGO in last and vehicle in last and follows(last[vehicle], last[EGO])
    return not struck or intruded([*before, now], network)


def stood(scenes: Sequence[Scene]) -> bool:
    """Check whether the ego stood throughout the last second of some scenes."""
    recent = _since(scenes, STOOD)
    long = recent[-1].time - recent[0].time >= STOOD - EPSILON
    return long and all(scene.ego.speed < STANDING for scene in recent)


def follows(other: VehicleState, ego: VehicleState) -> bool:
    """Check whether the other's front is behind the ego's rear bumper, in its track."""
    along, aside = _seen_from(ego, other)
    near = abs(aside) <= (ego.width + other.width) / 2.0
    return along <= -ego.length and near and _aligned(other, ego)


def intruded(scenes: Sequence[Scene], network: Network) -> bool:
    """Check whether the ego moved into its lane in the last seconds, or sticks out of it."""
    places = [_place(network, scene.ego) for scene in _since(scenes, KEPT)]
    known = [(network.lanes[place.lane], place) for place in places if place is not None]
    if not known:
        return True
    lane, place = known[-1]
    if abs(place.lateral) + scenes[-1].ego.width / 2.0 > lane.width / 2.0:
        return True
    lanes = {lane.id: lane for lane, _ in known}
    return any(_gives_way(network, lane) for lane in lanes.values()) or _changed(lanes)


def provoked_by_ego(scene: Scene, vehicle: int) -> bool:
    """Check whether a vehicle that brakes hard has the ego as the nearest one ahead."""
    braking = scene.vehicles[vehicle]
    ahead: dict[int, float] = {}
    for name, other in scene.vehicles.items():
        along, aside = _seen_from(braking, other)
        if name != vehicle and 0.0 < along <= AHEAD + other.length and abs(aside) <= ASIDE:
            ahead[name] = along
    return EGO in ahead and min(ahead, key=lambda name: ahead[name]) == EGO


def _since(scenes: Sequence[Scene], seconds: float) -> list[Scene]:
    """Return the scenes of the last seconds."""
    return [scene for scene in scenes if scene.time >= scenes[-1].time - seconds - EPSILON]


def _seen_from(observer: VehicleState, other: VehicleState) -> tuple[float, float]:
    """Return the other's front [m]: ahead of the observer's front, and to its left."""
    dx, dy = (b - a for a, b in zip(observer.position, other.position, strict=True))
    cos, sin = math.cos(observer.heading), math.sin(observer.heading)
    return dx * cos + dy * sin, dy * cos - dx * sin


def _aligned(a: VehicleState, b: VehicleState) -> bool:
    return abs(angle_between(a.heading, b.heading)) <= ALIGNED


def _place(network: Network, state: VehicleState) -> Location | None:
    return next(iter(network.locate(state.position, state.heading)), None)


def _gives_way(network: Network, lane: Lane) -> bool:
    link = network.link_via(lane.id)
    return link is not None and bool(link.yields_to)


def _changed(lanes: dict[str, Lane]) -> bool:
    """Check whether two of the lanes lie side by side."""
    edges = [lane.edge for lane in lanes.values() if not lane.internal]
    return len(edges) != len(set(edges))
