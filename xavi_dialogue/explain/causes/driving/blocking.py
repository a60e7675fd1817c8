"""Blocking: slow vehicles in the lane that we leave, and vehicles in a lane beside it."""

from planner.record.trace import Action
from sim.scene import EGO
from xavi_dialogue.domain.answers import MotionCause
from xavi_dialogue.domain.facts import Look
from xavi_dialogue.explain.causes.driving.roadside import limit_at
from xavi_dialogue.explain.causes.driving.slowness import in_lane_ahead
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.nearing import speed_at
from xavi_dialogue.explain.history.ride import Ride

HORIZON = 8.0  # [s] of driving within which a slow vehicle is a reason to leave the lane
SLOWER = 2.0  # [m/s] by which a slow vehicle is slower than we could drive
LEAST = 8.0  # [m/s] minimum speed that we would drive in the lane beside ours
OURS, MARGIN = 5.0, 2.0  # [m] our length, and the gap up to which vehicles are beside each other
AFTER = 1.5  # [s] after the decision in which a vehicle that it reckoned with may come into view


def blocking(ride: Ride, world: World, time: float, change: Action) -> MotionCause | None:
    """Find the vehicle next in our lane, if it is so slow that we decide to leave the lane.

    None if a vehicle in the lane that we change to is no faster.
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


def in_lane_beside(ride: Ride, world: World, time: float, change: Action) -> MotionCause | None:
    """Find a vehicle in the lane to one side: beside us, else ahead and slower than we drive."""
    looks = _beside(ride, world, time, change)
    for look in looks:
        if abs(look.ahead) <= (look.length + OURS) / 2.0 + MARGIN:
            return MotionCause("lane-beside", vehicle=look.vehicle)
    pace = max(speed_at(ride, time) or 0.0, LEAST)
    for look in looks:
        near = look.ahead > 0.0 and look.distance <= HORIZON * pace
        if near and look.speed <= pace - SLOWER:
            return MotionCause("lane-ahead", look.vehicle, speed=look.speed, value=look.distance)
    return None


def _slow_beside(ride: Ride, world: World, time: float, change: Action, speed: float) -> bool:
    """Check whether somebody ahead in the lane to one side is no faster than a speed [m/s]."""
    reach = HORIZON * (speed_at(ride, time) or 0.0)
    ahead = [look for look in _beside(ride, world, time, change) if look.ahead > 0.0]
    return any(look.distance <= reach and look.speed <= speed for look in ahead)


def _beside(ride: Ride, world: World, time: float, change: Action) -> list[Look]:
    """List the vehicles in the lane to one side of ours on our road, the nearest first."""
    trace = ride.at(time)
    places = {} if trace is None or trace.road is None else trace.road.places
    ours = places.get(EGO)
    if ours is None or ours.lane is None:
        return []
    target = ours.lane + (1 if change == "change-left" else -1)
    known = [(places.get(v), world.look(v, time)) for v in world.in_view(time)]
    looks = [
        look
        for place, look in known
        if place is not None and look is not None and not look.oncoming
        if (place.edge, place.lane) == (ours.edge, target)
    ]
    return sorted(looks, key=lambda look: look.distance)
