"""Forward simulation: one vehicle drives an action plan among vehicles whose motion is known.

The hot kernel of recognition, search and driving. Time runs in steps of DT; all motions of
one simulation share their time base. Car-following is Krauss' safe speed (Krauss 1998,
Eq. 4.18), which never collides with a leader that brakes no harder than assumed.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from planner.actions import COMFORT, STANDING_TIME, ActionPlan, GiveWay
from planner.obstacles import Obstacle, Occupancy, occupancy
from planner.trace import SAMPLE_PERIOD, HoldUp
from planner.trajectory import Path

DT = SAMPLE_PERIOD  # [s] step of the simulation

ACCELERATION = 2.0  # [m/s2] most when speeding up
FOLLOWING = 3.0  # [m/s2] braking assumed of leaders and applied behind them
EMERGENCY = 7.0  # [m/s2] the hardest braking
JERK_UP, JERK_DOWN = 3.0, 12.0  # [m/s3] change of acceleration upwards and downwards
REACTION = 0.9  # [s] of Krauss' model
RELAXATION = 0.5  # [s] in which a wanted speed is approached
MIN_GAP = 2.0  # [m] to a standing leader
GAP_HORIZON = 40  # steps of DT that a gap at a waiting line must stay clear
INTRUSION = 1.0  # [m] by which one may stand in a stretch that is shared: boxes are generous
HINDERED = 0.5  # [m/s] below the free speed from which a vehicle counts as held up


@dataclass(frozen=True, slots=True)
class Hindrance:
    """What kept the vehicle below its free speed in one step."""

    step: int  # of DT, in the common time base
    vehicle: int
    how: HoldUp
    speed: float  # [m/s] of the hindering vehicle


@dataclass(frozen=True, slots=True)
class Motion:
    """One vehicle's motion at one instant along its path."""

    arc: float  # [m]
    speed: float  # [m/s]
    acceleration: float  # [m/s2]


@dataclass(frozen=True, slots=True, eq=False)
class Drive:
    """What came of driving an action plan."""

    first: int  # step of the first sample
    motions: tuple[Motion, ...]  # [N >= 1] at steps first, first + 1, ...
    finished: bool  # the action's end was reached (else the horizon came first)
    goal_time: float | None  # [s] since the time base, where the goal was passed
    hindrances: tuple[Hindrance, ...]


class Lane:
    """A path prepared for driving: the speed from which every bend ahead can be braked for."""

    def __init__(self, path: Path) -> None:
        caps = path.cap.tolist()
        arcs = path.arc.tolist()
        for k in range(len(caps) - 2, -1, -1):
            reachable = math.sqrt(caps[k + 1] ** 2 + 2.0 * COMFORT * (arcs[k + 1] - arcs[k]))
            caps[k] = min(caps[k], reachable)
        even = np.arange(0.0, arcs[-1] + 1.0)
        self.speeds: list[float] = np.interp(even, arcs, caps).tolist()

    def speed(self, arc: float) -> float:
        """The highest speed [m/s] at an arc [m]."""
        k = int(arc)
        return self.speeds[k] if k < len(self.speeds) else self.speeds[-1]


def drive(
    plan: ActionPlan,
    start: Motion,
    first: int,
    obstacles: Sequence[Obstacle],
    size: tuple[float, float],
    horizon: int,
) -> Drive:
    """Drive an action plan until it ends.

    Args:
        plan: what to drive; its path is the vehicle's own.
        start: where on the path the vehicle is, and how fast.
        first: step at which it is there.
        obstacles: the other vehicles, in the common time base.
        size: length and width [m] of the vehicle.
        horizon: the last step.
    """
    lane = Lane(plan.path)
    others = tuple(
        occupancy(plan.path, obstacle, size, first, horizon + GAP_HORIZON) for obstacle in obstacles
    )
    others = tuple(o for o in others if not o.follows(start.arc - size[0] / 2.0, first))
    motion, motions, hindrances = start, [start], []
    standing, goal_time, finished = 0, None, False
    for step in range(first, horizon):
        acceleration, hindrance = accelerate(plan, lane, motion, step, others, size[0])
        if hindrance is not None:
            hindrances.append(hindrance)
        before, motion = motion, advance(motion, acceleration, DT)
        motions.append(motion)
        if plan.goal is not None and motion.arc >= plan.goal:
            share = (plan.goal - before.arc) / max(motion.arc - before.arc, 1e-9)
            goal_time, finished = (step + min(max(share, 0.0), 1.0)) * DT, True
            break
        standing = standing + 1 if motion.speed < 0.1 else 0
        if standing * DT >= STANDING_TIME if plan.stops else motion.arc >= plan.end:
            finished = True
            break
    return Drive(first, tuple(motions), finished, goal_time, tuple(hindrances))


def advance(motion: Motion, acceleration: float, dt: float) -> Motion:
    """Move on by `dt` [s] at constant acceleration [m/s2]; a vehicle never rolls back."""
    speed = max(motion.speed + acceleration * dt, 0.0)
    return Motion(motion.arc + 0.5 * (motion.speed + speed) * dt, speed, acceleration)


def accelerate(
    plan: ActionPlan,
    lane: Lane,
    motion: Motion,
    step: int,
    others: Sequence[Occupancy],
    length: float,
    dt: float = DT,
    crossing: Sequence[Occupancy] | None = None,
) -> tuple[float, Hindrance | None]:
    """What to do in the coming step, and who is in the way.

    Args:
        plan: what is being driven.
        lane: its path, prepared.
        motion: where on the path the vehicle is.
        step: now, in the common time base.
        others: the vehicles to keep behind of.
        length: [m] of the vehicle.
        dt: [s] length of the coming step.
        crossing: motions to give way to, where they are not those of `others`.

    Returns:
        Acceleration [m/s2], and the hindrance where there is one.
    """
    first = others if crossing is None else crossing
    free = 0.0 if plan.stops else lane.speed(motion.arc + motion.speed * RELAXATION)
    wanted, hardest, hindrance = free, COMFORT if plan.stops else FOLLOWING, None
    for other in others:
        gap = other.gap(motion.arc, step, length)
        if gap is None:
            continue
        speed = safe_speed(gap - MIN_GAP, other.speed_along(step), FOLLOWING)
        if speed < wanted:
            wanted, hindrance = speed, (other, other.manner(step))
            hardest = EMERGENCY if gap < MIN_GAP or speed < motion.speed - 3.0 else FOLLOWING
    for line in plan.give_ways:
        gap = line.stop - motion.arc
        braking = motion.speed**2 / (2.0 * COMFORT) + motion.speed * REACTION + 3.0
        if gap <= braking and motion.arc < line.clear:
            blocker = _blocker(lane, motion, step, line, first, length)
            speed = safe_speed(gap, 0.0, COMFORT)
            if blocker is not None and speed < wanted:
                wanted, hindrance = speed, (blocker, "right-of-way")
    acceleration = _towards(motion.speed, motion.acceleration, wanted, hardest, dt)
    if hindrance is None or wanted > free - HINDERED:
        return acceleration, None
    other, how = hindrance
    return acceleration, Hindrance(step, other.vehicle, how, other.speed(step))


def _towards(speed: float, acceleration: float, wanted: float, hardest: float, dt: float) -> float:
    """The acceleration [m/s2] that leads to a wanted speed [m/s], within all limits."""
    wished = min(max((wanted - speed) / RELAXATION, -hardest), ACCELERATION)
    if wished < acceleration:
        return max(wished, acceleration - JERK_DOWN * dt)
    return min(wished, max(acceleration + JERK_UP * dt, min(0.0, acceleration + JERK_DOWN * dt)))


def safe_speed(gap: float, leader: float, braking: float) -> float:
    """Krauss' safe speed [m/s] at a gap [m] behind a leader of a speed [m/s]."""
    reach = braking * REACTION
    return max(0.0, -reach + math.sqrt(reach**2 + leader**2 + 2.0 * braking * max(gap, 0.0)))


def _blocker(
    lane: Lane,
    motion: Motion,
    step: int,
    line: GiveWay,
    others: Sequence[Occupancy],
    length: float,
) -> Occupancy | None:
    """Who must be waited for: going on freely would get in the way of its right to go first.

    Beyond the line, that is asked only as long as one can stop before getting in the way.
    """
    first = [
        other
        for other in others
        if other.goes_first(line.yields_to)
        and other.last >= step
        and not other.leads(motion.arc, step)
    ]
    if not first:
        return None
    arc, speed, acceleration = motion.arc, motion.speed, motion.acceleration
    passed = max(other.top for other in first) + length + 1.0
    last = max(other.last for other in first)
    for ahead in range(step + 1, min(step + GAP_HORIZON, last + 1)):
        wanted = lane.speed(arc + speed * RELAXATION)
        acceleration = _towards(speed, acceleration, wanted, FOLLOWING, DT)
        before, speed = speed, max(speed + acceleration * DT, 0.0)
        arc += 0.5 * (before + speed) * DT
        if arc > passed:
            return None
        for other in first:
            begin = other.meets(arc - length - 1.0, arc + 1.0, ahead)
            if begin is not None:
                stopping = motion.speed**2 / (2.0 * FOLLOWING)
                late = motion.arc > line.stop and begin - motion.arc < stopping - INTRUSION
                return None if late else other
    return None
