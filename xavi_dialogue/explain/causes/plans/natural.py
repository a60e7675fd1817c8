"""Natural foils: the alternative that comes to mind first.

For a turn, an exit or going straight on, that is another direction. For a lane change it is staying
in the lane, and for a stop it is going on as planned. Stopping is a foil only if nothing else was
possible.
"""

from msgspec.structs import replace

from planner.record.trace import Action, PlanTrace
from xavi_dialogue.causal.model import Actions, CausalModel, Intervention
from xavi_dialogue.domain.answers import Contrast, NeedRollout
from xavi_dialogue.explain.causes.plans.contrast import (
    against_best,
    alone,
    alternatives,
    compare,
    contrast,
    factual,
)
from xavi_dialogue.explain.causes.plans.routes import route_after
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES, EXITS
from xavi_dialogue.explain.history.ride import Ride, Unanswered, chose, planned

DIRECTIONS: tuple[Action, ...] = (*EXITS, "continue-next-exit")
STAYING: Actions = ("continue",)
APPROACH = 10.0  # [s] before a decision in which its junction may have been the next one already


def natural(ride: Ride, trace: PlanTrace, node: Actions = ()) -> Contrast:
    """Compare the plan of a decision with its natural foil.

    Raises:
        Unanswered: there is too little evidence, or rollouts are needed.
    """
    plan = planned(trace)
    fact = plan[len(node)] if len(plan) > len(node) else None
    if fact in CHANGES:
        return _staying(ride, trace, node)
    if fact == "stop":
        return _going_on(ride, trace, node)
    if fact in DIRECTIONS:
        return other_way(ride, trace, node) or against_best(ride, trace, node)
    return against_best(ride, trace, node)


def other_way(ride: Ride, trace: PlanTrace, node: Actions = ()) -> Contrast | None:
    """Compare the way that a plan takes with the best other one; None if nothing is known.

    If no other way leads to the destination, the way itself is the reason. So it is if the map has
    it on the route, and no other is known to lead there. If another leads there, or did until
    somebody got in its way, the reason is what speaks against that one, since the route of a trace
    follows the plan.

    Raises:
        Unanswered: there is too little evidence of the plan, or rollouts are needed.
    """
    model, plan = ride.model(trace), planned(trace)
    here = factual(model, trace)
    fact = plan[len(node)]
    others = [
        pair
        for pair in alternatives(model, fact, node)
        if pair[0][-1] in DIRECTIONS or (fact in DIRECTIONS and pair[0][-1] == "continue")
    ]
    by_map = on_route(trace, fact, node)
    arriving = [pair for pair in others if _leads_there(ride, trace, *pair)]
    astray = [pair for pair in others if pair[1].likeliest == "dead"]
    if astray and not arriving:
        return replace(_compared(ride, model, here, astray[0]), way=True)
    if by_map and not arriving:
        return replace(alone(ride, model, here), way=True)
    if not others:
        return None
    return _compared(ride, model, here, (arriving or others)[0])


def _leads_there(ride: Ride, trace: PlanTrace, foil: Actions, there: Intervention) -> bool:
    """Check whether a way leads to the destination, or did before somebody got in its way."""
    if there.likeliest != "collision" or len(foil) > 1:
        return there.likeliest == "done"
    for before in reversed(ride.traces):
        if before.sim_time >= trace.sim_time:
            continue
        done = before.under_way is not None and before.under_way.action in EXITS
        if done or trace.sim_time - before.sim_time > APPROACH:
            break
        earlier = ride.model(before).intervene(foil)
        if before.under_way is None and earlier is not None and earlier.likeliest == "done":
            return True
    return False


def _compared(
    ride: Ride, model: CausalModel, here: Intervention, other: tuple[Actions, Intervention]
) -> Contrast:
    foil, there = other
    return compare(ride, model, here, there, foil)


def on_way(trace: PlanTrace, found: Contrast, node: Actions = ()) -> Contrast:
    """Mark a comparison of two ways if the one taken is on the route of the map."""
    at = len(node)
    fact, foil = found.fact[at : at + 1], found.foil[at : at + 1]
    both = bool(fact and foil) and fact != foil and {*fact, *foil} <= {*DIRECTIONS, "continue"}
    lost = found.outcome is not None and found.outcome.name != "done"
    if both and lost and on_route(trace, fact[0], node):
        return replace(found, way=True)
    return found


def _going_on(ride: Ride, trace: PlanTrace, node: Actions) -> Contrast:
    """Compare a stop with doing at once what comes after it, else with the best alternative.

    Raises:
        Unanswered: there is too little evidence, or rollouts are needed.
    """
    after = planned(trace)[len(node) + 1 :]
    try:
        return contrast(ride, trace, after[:1], node) if after else against_best(ride, trace, node)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return against_best(ride, trace, node)


def stopping(ride: Ride, decided: PlanTrace, *, going_on: bool) -> Contrast:
    """Compare a stop with driving on: as of now if the stop goes on, else as of the decision.

    Raises:
        Unanswered: there is too little evidence, or rollouts are needed.
    """
    latest = ride.latest
    if going_on and latest.sim_time > decided.sim_time and chose(latest, "stop"):
        found = natural(ride, latest)
        if found.verdict == "better":
            return found
    return natural(ride, decided)


def _staying(ride: Ride, trace: PlanTrace, node: Actions) -> Contrast:
    """Compare a change of lanes with staying in the lane; else with the best alternative."""
    try:
        return contrast(ride, trace, STAYING, node)
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        return against_best(ride, trace, node)


def on_route(trace: PlanTrace, action: Action, node: Actions = ()) -> bool:
    """Check whether the route has an action at the next junction after the actions of a node."""
    route, passed = route_after(trace, node)
    if not route:
        return False
    if route[0].kind == "roundabout":
        last = route[0].exit == passed + 1
        return action in ("exit-right", "exit-left") if last else action == "continue-next-exit"
    return route[0].turn == action
