"""Going: why the ego went when it did, and how close it would have been had it not slowed down.

The first is told by who had right of way at that moment, and by what they did. The second is no
simulation: it puts our recorded way, driven on at the speed before we slowed, beside the recorded
motion of the other.
"""

import math
from dataclasses import dataclass
from itertools import accumulate, pairwise

from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.domain.answers import Bystander
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.explain.facts.world import World
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.explain.history.ride import Ride

PASSED = 6.0  # [s] before a deed within which way was given for it
MEETING = 2.5  # [m] within which two lines meet
MOVING = 0.5  # [m/s] from which a vehicle drives along its line


@dataclass(frozen=True, slots=True)
class Crossing:
    """When two would have been where their ways meet."""

    ours: float  # [s] had we kept our speed
    theirs: float  # [s] as recorded


def bystanders(ride: Ride, world: World, time: float) -> tuple[Bystander, ...]:
    """Tell of those whose way crossed ours at a moment who goes first, and what they did."""
    trace = ride.at(time)
    found = [] if trace is None else [_one(ride, world, trace, time, v) for v in _met(trace)]
    known = {one.vehicle for one in found}
    waits = [e for e in ride.events if e.kind == "gave-way" and e.vehicle is not None]
    let_go = [e.vehicle for e in waits if time - PASSED <= e.sim_time <= time]
    gone = [v for v in dict.fromkeys(let_go) if v is not None and v not in known]
    return (*(Bystander(v, first="vehicle", gone=True) for v in gone), *found)


def _met(trace: PlanTrace) -> tuple[int, ...]:
    return () if trace.road is None else tuple(f.vehicle for f in trace.road.priority)


def _one(ride: Ride, world: World, trace: PlanTrace, time: float, vehicle: int) -> Bystander:
    facts = () if trace.road is None else trace.road.priority
    first = next(fact.who for fact in facts if fact.vehicle == vehicle)
    look = world.look(vehicle, time)
    motion = ride.motion(vehicle).until(time)
    return Bystander(vehicle, first, motion.trend, None if look is None else look.distance)


def unslowed(ride: Ride, vehicle: int, deed: Episode) -> Crossing | None:
    """Tell when we, had we not slowed, and a vehicle would have been where our ways meet.

    None where the record does not have both ways up to there.
    """
    speed = deed.speed_from
    ours, other = ride.motion(EGO), ride.motion(vehicle)
    start = ours.index(deed.begin)
    if speed is None or speed < MOVING or start is None:
        return None
    along = _along(ours, start)
    met = [
        (math.dist(ours.position[i], other.position[k]), along[i - start], other.time[k])
        for i in range(start, len(ours.time))
        for k in other.within(deed.begin - PASSED, ride.now)
        if other.speed[k] > MOVING
    ]
    close = [one for one in met if one[0] <= MEETING]
    if not close:
        return None
    _, distance, theirs = min(close, key=lambda one: (one[1], one[0]))
    return Crossing(deed.begin + distance / speed, theirs)


def _along(motion: Motion, start: int) -> list[float]:
    """The distance [m] driven since a sample, at each one from it on."""
    steps = [math.dist(a, b) for a, b in pairwise(motion.position[start:])]
    return list(accumulate(steps, initial=0.0))
