"""Replays: whether the car on another line would have touched another that drives as recorded.

After the last sample of the other, it is carried on straight. For a second its speed changes as it
did in the second before; from then on, it stays. It does not react.
"""

import math
from collections.abc import Callable
from dataclasses import replace

from planner.kernels.limits import EMERGENCY, FIRM
from sim.boxes import overlap
from sim.scene import EGO, VehicleState
from xavi_dialogue.explain.facts.bodies import at_least, distance
from xavi_dialogue.explain.history.motion import Motion
from xavi_dialogue.report.decisions.alternatives import Emergency
from xavi_dialogue.report.figures import rounded
from xavi_dialogue.report.road_users.tracks import Tracks

STEP = 0.1  # [s]
AFTER = 4.0  # [s] after the contact up to which a replay goes
BACK = 7.0  # [s] before the contact from which braking is tried
GOES_ON = 1.0  # [s] for which the speed of somebody who is not seen any more changes as before
RATES = (FIRM, EMERGENCY)  # [m/s2]

Driven = Callable[[float], VehicleState | None]


def clearance(tracks: Tracks, line: Motion, vehicle: int, until: float) -> float | None:
    """Return the least distance [m] of the car on a line from another as it drove; 0: they touch.

    None if the other was not seen in that time.
    """
    shape = tracks.shapes[EGO]

    def ours(time: float) -> VehicleState | None:
        k = line.index(time)
        if k is None:
            return None
        here = replace(shape, heading=line.heading[k], speed=line.speed[k])
        if k + 1 >= len(line.time):
            return replace(here, position=line.position[k]) if line.speed[k] < 0.5 else None
        share = (time - line.time[k]) / (line.time[k + 1] - line.time[k])
        (x, y), there = line.position[k], line.position[k + 1]
        return replace(here, position=(x + share * (there[0] - x), y + share * (there[1] - y)))

    return _least(tracks, ours, vehicle, line.time[0], until)


def carried_on(tracks: Tracks, vehicle: int, time: float) -> VehicleState | None:
    """Return another as it was seen at a time [s], or carried on after it was seen last."""
    state, motion = tracks.state(vehicle, time), tracks.motion(vehicle)
    if state is not None or not motion.time or time < motion.time[-1]:
        return state
    last = tracks.state(vehicle, motion.time[-1])
    if last is None:
        return None
    first = motion.index(motion.time[-1] - GOES_ON) or 0
    span = motion.time[-1] - motion.time[first]
    rate = (last.speed - motion.speed[first]) / span if span > 0.0 else 0.0
    after = time - motion.time[-1]
    changing = min(after, GOES_ON, last.speed / -rate if rate < 0.0 else GOES_ON)
    speed = max(last.speed + rate * changing, 0.0)
    way = (last.speed + speed) / 2.0 * changing + speed * (after - changing)
    x, y = last.position
    there = (x + way * math.cos(last.heading), y + way * math.sin(last.heading))
    return replace(last, position=there, speed=speed)


def _least(tracks: Tracks, ours: Driven, vehicle: int, since: float, until: float) -> float | None:
    """Return the least distance [m] between the car as it is supposed to drive and another."""
    best: float | None = None
    for k in range(round((until - since) / STEP) + 1):
        time = since + k * STEP
        here, there = ours(time), carried_on(tracks, vehicle, time)
        if here is None or there is None:
            continue
        if overlap(here, there):
            return 0.0
        if best is None or at_least(here, there) < best:
            best = min(distance(here, there), math.inf if best is None else best)
    return best


def emergencies(tracks: Tracks, vehicle: int, contact: float) -> tuple[Emergency, ...]:
    """Find the last moments from which braking on the car's own line would have avoided a contact.

    Args:
        tracks: where everybody was.
        vehicle: the other.
        contact: [s]
    """
    times = [t for t in tracks.times(EGO, contact - BACK, contact) if t < contact]
    found = []
    for rate in RATES:
        latest = next((t for t in reversed(times) if _escapes(tracks, vehicle, contact, t, rate)),
                      None)  # fmt: skip
        how = f"braking at {rate:g} m/s2 on the car's own line, the other as recorded"
        found.append(
            Emergency(
                rate=rate,
                latest=latest,
                before=None if latest is None else rounded(contact - latest),
                looked_from=times[0] if times else contact,
                source=tracks.source("position", EGO, vehicle, how=how),
            )
        )
    return tuple(found)


def _escapes(tracks: Tracks, vehicle: int, contact: float, begin: float, rate: float) -> bool:
    """Check whether braking from a time [s] on keeps the car clear of another."""
    motion = tracks.motion(EGO)
    first = motion.index(begin)
    assert first is not None
    speed, arc = motion.speed[first], motion.arc
    shape = tracks.shapes[EGO]

    def ours(time: float) -> VehicleState | None:
        lasts = min(time - begin, speed / rate)
        way = arc[first] + speed * lasts - rate * lasts * lasts / 2.0
        k = next((j for j in range(first, len(arc)) if arc[j] > way), len(arc)) - 1
        (x, y), heading = motion.position[k], motion.heading[k]
        rest = way - arc[k]
        there = (x + rest * math.cos(heading), y + rest * math.sin(heading))
        return replace(shape, position=there, heading=heading)

    least = _least(tracks, ours, vehicle, begin, contact + AFTER)
    return least is not None and least > 0.0
