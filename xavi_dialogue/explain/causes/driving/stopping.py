"""Stopping: whether we could stop for what another vehicle suddenly does, by distances alone."""

from dataclasses import dataclass
from typing import Literal

from planner.kernels.limits import EMERGENCY, REACTION
from sim.scene import EGO, VehicleState
from xavi_dialogue.explain.facts.approach import following
from xavi_dialogue.explain.facts.bearings import Offset
from xavi_dialogue.explain.facts.states import States
from xavi_dialogue.explain.history.thresholds import SAME_LANE, STANDING

HALF_LANE = 1.8  # [m] to each side of the middle of our way that we need ourselves
SLOWEST = 3.0  # [m/s] above which a vehicle that moves in ahead of us drives on
SETTING_OFF = 2.6  # [m/s2] acceleration of another vehicle that sets off briskly

Kind = Literal["room", "short", "first", "behind", "beside", "apart", "joins", "standing"]


@dataclass(frozen=True, slots=True)
class Stopping:
    """What a sudden action of another vehicle would lead to for us."""

    kind: Kind
    speed: float  # [m/s] ours
    needed: float | None = None  # [m] in which we come to a standstill
    room: float | None = None  # [m] to it, or to where it gets in our way
    left: float | None = None  # [m] that would be left behind a leader that brakes as hard
    closing: float | None = None  # [m/s] by which one behind us that drives our way is faster


def stopping_distance(speed: float) -> float:
    """Return the distance [m] in which we come to a standstill, the time to react included."""
    return speed * REACTION + speed * speed / (2.0 * EMERGENCY)


def stopping(
    states: States, vehicle: int, time: float, *, in_lane: bool, halts: bool = False
) -> Stopping | None:
    """Estimate whether we could stop in time; None if it is not known where both are.

    Args:
        states: where everybody was.
        vehicle: the one that does something suddenly.
        time: when [s].
        in_lane: whether it does so in its own lane: it stops, brakes, or drives on.
        halts: whether it does not drive on: it stops, or falls over.
    """
    ours, other = states.state(EGO, time), states.state(vehicle, time)
    seen = states.offset(EGO, vehicle, time)
    if ours is None or other is None or seen is None:
        return None
    speed = ours.speed
    if seen.ahead + seen.clear <= 0.0:
        lane = seen.same_way and abs(seen.left) <= SAME_LANE
        closing = other.speed - speed if lane else None
        return Stopping("behind", speed, room=-(seen.ahead + seen.clear), closing=closing)
    if speed < STANDING:
        return Stopping("standing", speed, room=max(seen.ahead - seen.clear, 0.0))
    line = following(states, EGO, vehicle, time)
    if line is not None and line.behind == EGO:
        return _behind(speed, other.speed, line.gap)
    aside = seen.same_way and abs(seen.left) > SAME_LANE
    if in_lane and (aside or seen.opposite):
        return Stopping("apart", speed)
    if abs(seen.ahead) <= seen.clear and seen.same_way:
        return Stopping("beside", speed)
    if seen.same_way and other.speed > SLOWEST and not halts:
        return _joining(seen, speed, other.speed)
    return _across(seen, ours, other)


def _joining(seen: Offset, speed: float, pace: float) -> Stopping:
    """Return the result for a vehicle that moves in ahead of us and drives on."""
    closing = max(speed - pace, 0.0)
    gap = seen.ahead - seen.clear
    kind: Kind = "joins" if stopping_distance(closing) <= gap else "short"
    return Stopping(kind, speed, stopping_distance(speed), gap)


def _behind(speed: float, leader: float, gap: float) -> Stopping:
    """Return the result for braking behind a leader that brakes as hard as anybody can."""
    needed = stopping_distance(speed)
    left = gap + leader * leader / (2.0 * EMERGENCY) - needed
    return Stopping("room" if left > 0.0 else "short", speed, needed, gap, left)


def _across(seen: Offset, ours: VehicleState, other: VehicleState) -> Stopping:
    """Return the result for a vehicle that comes into our way straight from where it is now."""
    across = (ours.length + other.width) / 2.0  # from the side, it takes up its width of our way
    room = max(seen.ahead - across, 0.0)
    needed = stopping_distance(ours.speed)
    if needed <= room:
        return Stopping("room", ours.speed, needed, room)
    aside = max(abs(seen.left) - HALF_LANE - other.length / 2.0, 0.0)
    reach = other.speed * other.speed + 2.0 * SETTING_OFF * aside
    comes = (reach**0.5 - other.speed) / SETTING_OFF
    passed = (seen.ahead + (seen.clear if seen.same_way else across)) / ours.speed
    return Stopping("first" if passed < comes else "short", ours.speed, needed, room)
