"""Hidden areas as causes: the ego is slower since somebody might come out of them.

The rollouts of a decision show where this is so. Whether it matters is tested by planning the
decision again as if the ego could see past what hides the area. It matters if this saves time.
"""

import math
from typing import Literal

from planner.record.hidden_record import Phantom
from planner.record.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.domain.answers import MotionCause, NeedRollout
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.plans.replanned import replanned, saves_time
from xavi_dialogue.explain.history.ride import ROUNDING, Ride

SLOWED = frozenset[ActionName](("slow-down", "brake", "move"))
HELD = 0.5  # minimum share of the rollouts in which a phantom makes us slower
AHEAD = 0.6  # [rad] maximum angle to our heading at which a phantom comes from ahead
BEFORE = 1.0  # [s] before a slowing in which it may have been decided

Side = Literal["left", "right", "ahead"]


def hidden_causes(ride: Ride, deed: Episode) -> tuple[tuple[MotionCause, ...], PlanTrace] | None:
    """Find what hides the areas for which the ego slowed down.

    Returns:
        The causes, each with the vehicle that hides an area (None: a building), and the decision.
        It is the first that matters by itself, or may; else all that matter together. None if no
        hidden area made the ego slower, or that does not matter.

    Raises:
        Unanswered: the decision must be planned again first.
    """
    end = ride.now if deed.end is None else deed.end
    known = [
        trace
        for trace in ride.traces
        if deed.begin - BEFORE <= trace.sim_time <= end + ROUNDING and holding(trace)
    ]
    if deed.action not in SLOWED or not known:
        return None
    trace = next((t for t in known if t.under_way is None), known[0])
    held = holding(trace)
    hiders = tuple(dict.fromkeys((one.behind, side_of(trace, one)) for one in held))
    for hider, side in hiders:
        needed = matters(ride, trace, opened(trace, hider, side))
        if needed is not False:
            return (MotionCause("hidden", hider, necessary=needed, side=side),), trace
    together = tuple(k for k, one in enumerate(trace.phantoms) if one in held)
    if not matters(ride, trace, together):
        return None
    return tuple(MotionCause("hidden", x, necessary=False, side=side) for x, side in hiders), trace


def holding(trace: PlanTrace) -> tuple[Phantom, ...]:
    """List the phantoms that make us slower at a decision, the nearest first."""
    way = next((step.action for step in trace.plan if step.action != "stop"), None)
    drives = [r for r in trace.rollouts if r.actions and r.actions[0].action == way]
    shares = [0] * len(trace.phantoms)
    for drive in drives:
        for k in {held.phantom for held in drive.held_by_hidden}:
            shares[k] += 1
    pairs = zip(trace.phantoms, shares, strict=True)
    return tuple(one for one, count in pairs if count >= HELD * len(drives) > 0.0)


def side_of(trace: PlanTrace, one: Phantom) -> Side:
    """Return the side of us from which a phantom would come."""
    angle = math.remainder(one.heading + math.pi - trace.scene[EGO].heading, math.tau)
    if abs(angle) < AHEAD:
        return "ahead"
    return "left" if angle > 0.0 else "right"


def opened(trace: PlanTrace, hider: int | None, side: Side | None = None) -> tuple[int, ...]:
    """List the phantoms that we would see if a vehicle, or the buildings (None), hid nobody.

    Only phantoms on the side, if one is given, count. Those that something else hides, too, stay
    out of sight.
    """
    return tuple(
        k
        for k, one in enumerate(trace.phantoms)
        if (one.behind is None if hider is None else one.seen_without((hider,)))
        and side in (None, side_of(trace, one))
    )


def matters(ride: Ride, trace: PlanTrace, seen: tuple[int, ...]) -> bool | None:
    """Check whether a decision would save time if some phantoms were seen not to be there.

    None if that is not known.

    Raises:
        Unanswered: the decision must be planned again first.
    """
    return saves_time(ride, trace, seeing_past(ride, trace, seen)) if seen else False


def seeing_past(ride: Ride, trace: PlanTrace, seen: tuple[int, ...]) -> PlanTrace | None:
    """Find the plan made again from a decision as if some phantoms were not there.

    None if the planner could not make it.

    Args:
        ride: the ride.
        trace: the decision.
        seen: indices of the phantoms that are seen not to be there.

    Raises:
        Unanswered: it must be made first.
    """
    return replanned(ride, trace, NeedRollout(trace_id=trace.trace_id, seen_past=seen))
