"""Tracks: where all road users were, also between samples."""

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, replace

from planner.motion.road_users import road_users_in
from sim.roads.network import angle_between
from sim.scene import EGO, Scene, VehicleState
from xavi_dialogue.explain.facts.bodies import distance
from xavi_dialogue.explain.history.motion import EPSILON, Motion
from xavi_dialogue.explain.history.ride import Ride
from xavi_dialogue.report.figures import Source
from xavi_dialogue.report.ridden import Ridden

APART = 0.5  # [s] between samples from which nothing is known in between
NOTHING = Motion((), (), (), ())


@dataclass(frozen=True)
class Tracks:
    """Where everybody was, by the histories of decisions, and the scenes after the last one."""

    motions: dict[int, Motion]
    shapes: dict[int, VehicleState]  # the last recorded state of each, for what does not change
    late: float  # [s] from which on scenes are used; infinite: none are

    def motion(self, vehicle: int) -> Motion:
        """Return the motion of a road user."""
        return self.motions.get(vehicle, NOTHING)

    def state(self, vehicle: int, time: float) -> VehicleState | None:
        """Return the state of a road user at a time [s], also between samples; None: unknown."""
        motion, shape = self.motion(vehicle), self.shapes.get(vehicle)
        k = motion.index(time)
        if k is None or shape is None:
            return None
        rest = time - motion.time[k]
        (x, y), heading, speed = motion.position[k], motion.heading[k], motion.speed[k]
        if rest > EPSILON:
            if k + 1 >= len(motion.time) or motion.time[k + 1] - motion.time[k] > APART:
                return None
            share = rest / (motion.time[k + 1] - motion.time[k])
            there = motion.position[k + 1]
            x, y = x + share * (there[0] - x), y + share * (there[1] - y)
            heading += share * angle_between(motion.heading[k + 1], heading)
            speed += share * (motion.speed[k + 1] - speed)
        return replace(
            shape,
            position=(x, y),
            heading=math.remainder(heading, math.tau),
            speed=speed,
            acceleration=motion.rate[k],
        )

    def gap(self, vehicle: int, time: float) -> float | None:
        """Return the distance [m] between the bodies of the car and another; None: unknown."""
        ours, theirs = self.state(EGO, time), self.state(vehicle, time)
        return None if ours is None or theirs is None else distance(ours, theirs)

    def times(self, vehicle: int, since: float, until: float) -> list[float]:
        """Return the times [s] of the samples of a road user in an interval."""
        motion = self.motion(vehicle)
        return [motion.time[k] for k in motion.within(since, until)]

    def source(self, name: str, *vehicles: int, how: str = "") -> Source:
        """Return the source of what is read from the motion of road users."""
        places = ", ".join(f"history.{vehicle}.{name}" for vehicle in vehicles)
        joined = "joined over all decisions"
        if self.late < math.inf:
            joined += f", and of scenes after {self.late:g} s"
        return Source("ride", places, how=f"{how}; {joined}" if how else joined)


def tracks_of(ridden: Ridden, until: float) -> Tracks:
    """Join the histories of all decisions up to a time [s] with the scenes after the last one."""
    ride = Ride(replace(ridden.as_known(until), scene=None))
    last = ride.traces[-1].sim_time if ride.traces else -math.inf
    times = [scene.time for scene in ridden.scenes]
    tail = ridden.scenes[bisect_right(times, last + EPSILON) : bisect_right(times, until + EPSILON)]
    shapes = {v: state for trace in ride.traces for v, state in trace.scene.items()}
    for scene in tail:
        shapes.update(road_users_in(scene))
    known = sorted({EGO, *ride.vehicles, *(v for scene in tail for v in road_users_in(scene))})
    motions = {vehicle: _extended(ride.motion(vehicle), vehicle, tail) for vehicle in known}
    return Tracks(motions, shapes, last if tail else math.inf)


def _extended(motion: Motion, vehicle: int, tail: Sequence[Scene]) -> Motion:
    """Return a motion with the states in further scenes."""
    seen = [(s.time, road_users_in(s)[vehicle]) for s in tail if vehicle in road_users_in(s)]
    seen = [(t, state) for t, state in seen if not motion.time or t > motion.time[-1] + EPSILON]
    if not seen:
        return motion
    return Motion(
        (*motion.time, *(t for t, _ in seen)),
        (*motion.position, *(state.position for _, state in seen)),
        (*motion.heading, *(state.heading for _, state in seen)),
        (*motion.speed, *(state.speed for _, state in seen)),
    )
