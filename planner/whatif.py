"""Planning again from a recorded decision: forced actions, or a vehicle removed.

Everything that is needed stands in the trace, so a replayed ride can be asked as well as a
live one. The same request gives the same trace.
"""

from dataclasses import dataclass

import msgspec

from planner.decide import Frame, Moment, decide, predict, prepare, rollouts, root_at
from planner.search import Root
from planner.trace import Action, PlanTrace, fitted
from planner.trajectory import Roads
from sim.network import Network
from sim.scene import EGO


class WhatIfError(Exception):
    """The question cannot be planned from this trace."""


@dataclass(frozen=True, slots=True)
class WhatIf:
    """What to plan again."""

    actions: tuple[Action, ...] = ()  # that the ego takes first
    removed: int | None = None  # a vehicle that is not there
    rollouts: int = 40  # drawn with the forced actions


def replan(trace: PlanTrace, network: Network, request: WhatIf) -> PlanTrace:
    """Plan again from the scene of a trace.

    With forced actions, the result is the trace with more rollouts, marked as forced; where an
    action does not apply, it has none more and says why. With a vehicle removed, it is the
    decision that would have been taken without it, before any forced actions are added.

    Raises:
        WhatIfError: the trace is of another network, the vehicle is the ego or not in it, or the
            ego was in the middle of a manoeuvre.
    """
    frame, moment = _restore(trace, network, request)
    if request.removed is not None:
        trace = decide(frame, moment).trace
        if not request.actions:
            return trace
    beliefs = predict(frame, moment)
    search = prepare(frame, moment, beliefs, salt="/" + ",".join(request.actions))
    search.force(request.actions, request.rollouts)
    known = {(entry.node, entry.action) for entry in trace.not_applicable}
    fresh = (e for e in search.not_applicable() if (e.node, e.action) not in known)
    more = rollouts(search.rollouts, moment.time, offset=len(trace.rollouts))
    larger = msgspec.structs.replace(
        trace,
        rollouts=trace.rollouts + more,
        not_applicable=trace.not_applicable + tuple(fresh),
    )
    return fitted(larger)


def _restore(trace: PlanTrace, network: Network, request: WhatIf) -> tuple[Frame, Moment]:
    """The frame and moment of a recorded decision, without the removed vehicle."""
    if network.hash != trace.network:
        raise WhatIfError(f"the trace is of network {trace.network}, not of {network.hash}")
    if trace.under_way is not None:
        raise WhatIfError(f"{trace.under_way.action} was under way at {trace.sim_time} s")
    if request.removed == EGO:
        raise WhatIfError("the ego cannot be removed; name another vehicle")
    if request.removed is not None and request.removed not in trace.scene:
        raise WhatIfError(f"vehicle {request.removed} was not in view at {trace.sim_time} s")
    roads = Roads(network)
    here = root_at(roads, trace.scene[EGO], trace.sim_time)
    if here is None:
        raise WhatIfError(f"the ego was on no lane at {trace.sim_time} s")
    frame = Frame(roads, trace.goal, trace.settings, trace.seed, trace.vehicle)
    gone = request.removed
    moment = Moment(
        trace.decision,
        trace.sim_time,
        {vehicle: state for vehicle, state in trace.scene.items() if vehicle != gone},
        {vehicle: track for vehicle, track in trace.history.items() if vehicle != gone},
        Root(here),
    )
    return frame, moment
