"""Planning again from a recorded decision with something changed.

The ego may be told what to do first, a vehicle taken away, and another supposed to have a goal
or to do certain things. Everything that is needed stands in the trace, so a replayed ride can be
asked as well as a live one. The same request gives the same trace.

    WhatIfError        the question cannot be planned from this trace
    ├── NotInView      the vehicle is not in the trace's scene
    └── Inapplicable   what is supposed of it cannot be
"""

from collections.abc import Mapping, Sequence

import msgspec

from planner.decide import Frame, Moment, predict, prepare, record, rollouts, root_at
from planner.recognise import Belief
from planner.resume import resume
from planner.routes import Refusal
from planner.search import Root
from planner.suppose import suppose
from planner.trace import PlanTrace, WhatIf, fitted
from planner.trajectory import Roads
from sim.network import Network
from sim.scene import EGO

__all__ = ["Inapplicable", "NotInView", "WhatIf", "WhatIfError", "replan"]


class WhatIfError(Exception):
    """The question cannot be planned from this trace."""


class NotInView(WhatIfError):
    """The vehicle is not in the trace's scene."""


class Inapplicable(WhatIfError):
    """What is supposed of a vehicle cannot be."""


def replan(trace: PlanTrace, network: Network, request: WhatIf) -> PlanTrace:
    """Plan again from the scene of a trace; `what_if` of the result says what was changed.

    With forced actions alone, the result is the trace with more rollouts, marked as forced; where
    an action does not apply, it has none more and says why. With a vehicle removed or its conduct
    supposed, it is the decision that would then have been taken, with the budget of the trace's
    settings, before any forced actions are added. A manoeuvre that was under way is finished
    first, forced or not; see planner.resume for how exactly.

    Raises:
        WhatIfError: the request contradicts itself, the trace is of another network or of a
            what-if itself, or the ego's place is not clear from it.
        NotInView: a vehicle is not in the trace.
        Inapplicable: a vehicle cannot have that goal or do those things.
    """
    _check(trace, network, request)
    frame, moment = _restore(trace, Roads(network), request.removed)
    beliefs = _beliefs(frame, moment, request)
    changed = request.removed is not None or request.vehicle is not None
    if changed:
        search = prepare(frame, moment, beliefs)
        search.run()
        trace = record(frame, moment, beliefs, search)
    trace = msgspec.structs.replace(trace, what_if=request)
    if not changed or request.actions:
        trace = _with_more(trace, frame, moment, beliefs, request)
    return fitted(trace)


def _with_more(
    trace: PlanTrace,
    frame: Frame,
    moment: Moment,
    beliefs: Mapping[int, Sequence[Belief]],
    request: WhatIf,
) -> PlanTrace:
    """The trace with rollouts that begin with the forced actions."""
    search = prepare(frame, moment, beliefs, salt="/" + ",".join(request.actions))
    search.force(request.actions, request.rollouts)
    known = {(entry.node, entry.action) for entry in trace.not_applicable}
    fresh = (e for e in search.not_applicable() if (e.node, e.action) not in known)
    more = rollouts(search.rollouts, moment.time, offset=len(trace.rollouts))
    return msgspec.structs.replace(
        trace,
        rollouts=trace.rollouts + more,
        not_applicable=trace.not_applicable + tuple(fresh),
    )


def _check(trace: PlanTrace, network: Network, request: WhatIf) -> None:
    """Whether the request makes sense, and is about this trace."""
    if network.hash != trace.network:
        raise WhatIfError(f"the trace is of network {trace.network}, not of {network.hash}")
    if trace.what_if is not None:
        raise WhatIfError("the trace is of a what-if itself; ask about the decision behind it")
    depth = trace.settings.depth
    if max(len(request.actions), len(request.vehicle_actions)) > depth:
        raise WhatIfError(f"at most {depth} actions in a row are planned")
    supposed = request.goal is not None or bool(request.vehicle_actions)
    if supposed and request.vehicle is None:
        raise WhatIfError("a goal or actions are supposed, but of no vehicle")
    if request.vehicle is not None and not supposed:
        raise WhatIfError(f"nothing is supposed of vehicle {request.vehicle}")
    if request.removed == EGO:
        raise WhatIfError("the ego cannot be removed; name another vehicle")
    if request.vehicle == EGO:
        raise WhatIfError("the ego's goal stands; force its actions instead")
    if request.removed is not None and request.removed == request.vehicle:
        raise WhatIfError(f"vehicle {request.removed} cannot be removed and do something")
    for vehicle in (request.removed, request.vehicle):
        if vehicle is not None and vehicle not in trace.scene:
            raise NotInView(f"vehicle {vehicle} was not in view at {trace.sim_time} s")


def _restore(trace: PlanTrace, roads: Roads, gone: int | None) -> tuple[Frame, Moment]:
    """The frame and moment of a recorded decision, without the removed vehicle."""
    here = root_at(roads, trace.scene[EGO], trace.sim_time)
    if here is None:
        raise WhatIfError(f"the ego was on no lane at {trace.sim_time} s")
    rest = resume(roads, trace)
    if isinstance(rest, Refusal):
        action = "" if trace.under_way is None else trace.under_way.action
        raise WhatIfError(f"{action} was under way at {trace.sim_time} s; {rest.reason}")
    frame = Frame(roads, trace.goal, trace.settings, trace.seed, trace.vehicle)
    moment = Moment(
        trace.decision,
        trace.sim_time,
        {vehicle: state for vehicle, state in trace.scene.items() if vehicle != gone},
        {vehicle: track for vehicle, track in trace.history.items() if vehicle != gone},
        Root(here, rest),
        {vehicle: since for vehicle, since in trace.unseen.items() if vehicle != gone},
    )
    return frame, moment


def _beliefs(frame: Frame, moment: Moment, request: WhatIf) -> dict[int, Sequence[Belief]]:
    """What the others may be up to, with what is supposed of one of them."""
    beliefs: dict[int, Sequence[Belief]] = dict(predict(frame, moment))
    vehicle = request.vehicle
    if vehicle is None:
        return beliefs
    known = beliefs.get(vehicle, ())
    supposed = suppose(frame, moment, known, vehicle, request.goal, request.vehicle_actions)
    if isinstance(supposed, Refusal):
        raise Inapplicable(f"vehicle {vehicle}: {supposed.reason}")
    return {**beliefs, vehicle: (supposed,)}
