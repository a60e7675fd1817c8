"""Blocking: who stood or crept in our lane when we decided to leave it."""

from planner.trace import Action
from sim.scene import EGO
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.facts import Look
from xavi_dialogue.explain.causes.roadside import limit_at
from xavi_dialogue.explain.causes.slowness import in_lane_ahead
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.nearing import speed_at
from xavi_dialogue.explain.history.ride import Ride

HORIZON = 8.0  # [s] of driving within which somebody slow is a reason to leave the lane
SLOWER = 2.0  # [m/s] by which somebody is slower than we could be
AFTER = 1.5  # [s] after the decision within which one may come into view whom it reckoned with


def blocking(ride: Ride, world: World, time: float, change: Action) -> MotionCause | None:
    """Find the nearest in our lane who is slower than we could drive, when we decide to leave it.

    None where somebody in the lane that we change to is no faster.
    """
    for moment in (time, min(time + AFTER, ride.now)):
        found = _slower(ride, world, time, moment)
        if found is not None and not _slow_beside(ride, world, moment, change, found.speed):
            return MotionCause("leader", vehicle=found.vehicle, speed=found.speed)
    return None


def _slower(ride: Ride, world: World, time: float, moment: float) -> Look | None:
    speed, limit = speed_at(ride, time) or 0.0, limit_at(ride, time)
    pace = max(speed, limit or 0.0)
    for look in in_lane_ahead(ride, world, moment, HORIZON * speed, at=time):
        return look if look.speed <= pace - SLOWER else None
    return None


def _slow_beside(ride: Ride, world: World, time: float, change: Action, speed: float) -> bool:
    """Whether somebody ahead in the lane to one side is no faster than a speed [m/s]."""
    trace = ride.at(time)
    places = {} if trace is None or trace.road is None else trace.road.places
    ours = places.get(EGO)
    if ours is None or ours.lane is None:
        return False
    target = ours.lane + (1 if change == "change-left" else -1)
    reach = HORIZON * (speed_at(ride, time) or 0.0)
    for vehicle in world.in_view(time):
        place, look = places.get(vehicle), world.look(vehicle, time)
        if place is None or look is None or (place.edge, place.lane) != (ours.edge, target):
            continue
        if look.ahead > 0.0 and look.distance <= reach and look.speed <= speed:
            return True
    return False
