"""What cannot be seen, as a cause: the ego is slower since somebody might come out of there.

That it is so is told by the drives imagined at a decision. Whether it matters is tried by planning
that decision again as if one could see past what hides it: it does where this saves time.
"""

import math
from typing import Literal

from planner.hidden_areas import Phantom
from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.domain.answers import MotionCause, NeedRollout
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.vocabulary import ActionName
from xavi_dialogue.explain.causes.replanned import replanned, saves_time
from xavi_dialogue.explain.history.ride import ROUNDING, Ride

SLOWED = frozenset[ActionName](("slow-down", "brake", "move"))
HELD = 0.5  # share of the drives in which it makes us slower
AHEAD = 0.6  # [rad] from our heading within which somebody comes from ahead
BEFORE = 1.0  # [s] before a slowing at which it may have been decided

Side = Literal["left", "right", "ahead"]


def hidden_cause(ride: Ride, deed: Episode) -> tuple[MotionCause, PlanTrace] | None:
    """Tell what hides from where somebody might come, for whom the ego slowed down.

    Returns:
        The cause, with who hides it (None: a building), and the decision; None where nothing
        hidden made it slower, or that does not matter.

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
    needed = matters(ride, trace)
    if needed is False:
        return None
    one = holding(trace)[0]
    cause = MotionCause("hidden", one.behind, necessary=needed, side=side_of(trace, one))
    return cause, trace


def holding(trace: PlanTrace) -> tuple[Phantom, ...]:
    """List who is imagined and makes us slower at a decision, the nearest first."""
    way = next((step.action for step in trace.plan if step.action != "stop"), None)
    drives = [r for r in trace.rollouts if r.actions and r.actions[0].action == way]
    shares = [0] * len(trace.phantoms)
    for drive in drives:
        for k in {held.phantom for held in drive.held_by_hidden}:
            shares[k] += 1
    pairs = zip(trace.phantoms, shares, strict=True)
    return tuple(one for one, count in pairs if count >= HELD * len(drives) > 0.0)


def side_of(trace: PlanTrace, one: Phantom) -> Side:
    """Tell from which side of us somebody who is imagined would come."""
    angle = math.remainder(one.heading + math.pi - trace.scene[EGO].heading, math.tau)
    if abs(angle) < AHEAD:
        return "ahead"
    return "left" if angle > 0.0 else "right"


def matters(ride: Ride, trace: PlanTrace) -> bool | None:
    """Tell whether a decision would save time could one see past; None where it is not known.

    Raises:
        Unanswered: the decision must be planned again first.
    """
    return saves_time(ride, trace, seeing_past(ride, trace))


def seeing_past(ride: Ride, trace: PlanTrace) -> PlanTrace | None:
    """Find the plan made again from a decision as if nothing hid who might come.

    None where the planner could not make it.

    Raises:
        Unanswered: it must be made first.
    """
    everybody = tuple(range(len(trace.phantoms)))
    need = NeedRollout(trace_id=trace.trace_id, seen_past=everybody)
    return replanned(ride, trace, need)
