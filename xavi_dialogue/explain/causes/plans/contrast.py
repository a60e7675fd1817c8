"""Contrast: what the ego did or plans, compared with what it might have done instead."""

from collections.abc import Mapping, Sequence

from msgspec.structs import replace

from planner.record.trace import Action, PlanTrace
from xavi_dialogue.causal.effects import ComponentEffect, effects
from xavi_dialogue.causal.model import Actions, CausalModel, Intervention
from xavi_dialogue.domain.answers import (
    Aim,
    Cause,
    Contrast,
    Effect,
    Evidence,
    NotApplicable,
    TooLittle,
)
from xavi_dialogue.domain.facts import Episode
from xavi_dialogue.domain.terms import Ego
from xavi_dialogue.explain.causes.plans.chances import chances
from xavi_dialogue.explain.causes.plans.lateness import exceeds, in_time
from xavi_dialogue.explain.causes.plans.ranges import likely
from xavi_dialogue.explain.causes.plans.routes import route_after, shared
from xavi_dialogue.explain.causes.plans.terms import RISK, differences, told
from xavi_dialogue.explain.causes.vehicles.actions import CHANGES, EXITS, same
from xavi_dialogue.explain.causes.vehicles.involved import contrastive_causes, holding_up
from xavi_dialogue.explain.causes.vehicles.necessity import Proven, proven
from xavi_dialogue.explain.history.ride import Ride, Unanswered, enough, planned, thin
from xavi_dialogue.explain.history.thresholds import STANDING

#: The change of lanes that undoes one.
OPPOSITE: Mapping[Action, Action] = {"change-left": "change-right", "change-right": "change-left"}


def contrast(ride: Ride, trace: PlanTrace, foil: Actions | None, node: Actions = ()) -> Contrast:
    """Compare the plan of a decision with a foil.

    Args:
        ride: the record.
        trace: the decision.
        foil: the macro actions asked about; None for the best alternative.
        node: the actions of the plan that foil and fact have in common.

    Raises:
        Unanswered: the foil is the plan, does not apply, lacks evidence or makes no difference.
    """
    if foil is None:
        return against_best(ride, trace, node)
    plan = planned(trace)
    if plan[: len(node) + len(foil)] == (*node, *foil):
        raise SameAsPlan(ride, trace, (*node, *foil))
    check_applicable(ride.model(trace), foil, node)
    model, there = ride.evidence(trace, (*node, *foil))
    here = decided(ride, model)
    return compare(ride, model, here, there, (*node, *foil))


class SameAsPlan(Unanswered):
    """The foil is what was decided; `contrast` has the decision against its best alternative."""

    def __init__(self, ride: Ride, trace: PlanTrace, foil: Actions) -> None:
        super().__init__(TooLittle("no-influence", asked=foil, chosen=planned(trace)))
        self.trace, self.foil = trace, foil
        done = [d for d in ride.deeds if d.action == foil[-1] and d.time >= trace.sim_time - 1.0]
        self.deed = Episode(Ego(), done[0].action, done[0].time, done[0].ended) if done else None


def check_applicable(model: CausalModel, foil: Actions, node: Actions = ()) -> None:
    """Refuse a foil that cannot be done, with the planner's reason.

    Raises:
        Unanswered: it does not apply at the node, or further on.
    """
    trace = model.trace
    reasons = {(n.node, n.action): n.reason for n in trace.not_applicable}
    for depth, action in enumerate(foil):
        here = (*node, *foil[:depth])
        if action in model.options(here):
            continue
        reason = reasons.get((here, action))
        if reason is None and not here and trace.under_way is not None:
            reason = "another manoeuvre is under way"
        if reason is not None:
            raise Unanswered(NotApplicable((action,), reason, trace.sim_time))
        return


def factual(model: CausalModel, trace: PlanTrace) -> Intervention:
    """Find the plan of a decision, with as many of its actions as there is evidence for.

    Raises:
        Unanswered: there is not even enough for its first action.
    """
    plan = planned(trace)
    for length in range(len(plan), 0, -1):
        found = model.intervene(plan[:length])
        if found is not None and enough(found):
            return found
    raise thin(plan[:1], model.intervene(plan[:1]))


def decided(ride: Ride, model: CausalModel) -> Intervention:
    """Find the plan of a decision by its own rollouts, or by further ones if these are too few.

    So statements about the plan are the same whatever it is compared with.

    Raises:
        Unanswered: there is not enough evidence for it in either.
    """
    original = ride.original(model.trace)
    try:
        return factual(ride.model(original), original)
    except Unanswered:
        return factual(model, model.trace)


def alternatives(
    model: CausalModel, fact: Action, node: Actions = ()
) -> list[tuple[Actions, Intervention]]:
    """List the other actions at a node that there is evidence for, best first."""
    found = []
    for action in model.options(node):
        if not same(action, fact):
            there = model.intervene((*node, action))
            if there is not None and enough(there):
                found.append(((*node, action), there))
    return sorted(found, key=lambda pair: -pair[1].value)


def compare(
    ride: Ride, model: CausalModel, here: Intervention, there: Intervention, foil: Actions
) -> Contrast:
    """Compare one plan with another, with the vehicles that cause the difference.

    Raises:
        Unanswered: rollouts are needed.
    """
    found = effects(there, here)
    causes = [_as_seen(ride, model, c) for c in contrastive_causes(model, there, here, found)]
    tried = proven(ride, model, causes, here, there)
    return sides(ride, model, here, there, foil, tried)


def _as_seen(ride: Ride, model: CausalModel, cause: Cause) -> Cause:
    """Correct a cause that is in our way and has stood ever since it was seen: it stands there.

    What was believed about where it would go is no reason then.
    """
    seen = ride.motion(cause.vehicle).until(model.trace.sim_time).speed
    how = cause.mechanism
    if not seen or max(seen) >= STANDING or how is None or how.how not in ("leader", "blocked"):
        return cause
    stands = replace(how, speed_from=0.0, speed_to=0.0, present=True)
    return replace(cause, actions=(), probability=1.0, mechanism=stands)


def sides(
    ride: Ride,
    model: CausalModel,
    here: Intervention,
    there: Intervention,
    foil: Actions,
    tried: Proven | None = None,
) -> Contrast:
    """Return the contrast of fact and foil, with the causes that were tried."""
    difference = differences(model, there, here)
    other, own = chances(there), chances(here)
    risky = other.collision >= RISK
    close = difference.verdict == "close"
    known = () if tried is None else tried.causes
    causes = tuple(c for c in known if c.mechanism is not None) if close else known
    found = effects(there, here)
    return Contrast(
        fact=here.plan,
        foil=foil,
        outcome=other.likeliest,
        effects=to_effects(in_time(found, there, here)),
        causes=causes,
        evidence=evidence(ride, model, here, there),
        decided=model.trace.sim_time,
        fact_outcome=own.likeliest,
        collision=other.collision if risky else 0.0,
        fact_collision=own.collision,
        collided_with=other.struck if risky else None,
        continued=there.plan[len(foil) :],
        aim=aim(model.trace, here),
        cleared=() if tried is None else tried.cleared,
        causation=None if tried is None else tried.causation,
        verdict=difference.verdict,
        terms=difference.shares,
        told=told(difference),
        error=difference.error,
        likely=likely(model, here, there, found),
        route=missed(model.trace, there, here),
        horizon=model.trace.settings.horizon,
        exceeds=exceeds(model.trace.settings.horizon, there, here),
    )


def missed(trace: PlanTrace, there: Intervention, here: Intervention) -> Action | None:
    """Find what comes next on our way, if the foil takes another way or keeps to a wrong lane.

    None if the foil probably arrives or collides, or stops, and so loses time above all.
    """
    if there.likeliest in ("done", "collision"):
        return None
    back = OPPOSITE.get(there.plan[0])
    if back is not None and back in here.plan and here.likeliest == "done":
        return back
    node = shared(there.plan, here.plan)
    route, _ = route_after(trace, node)
    if not route or "stop" in there.plan or route[0].kind != "junction":
        return None
    turn = route[0].turn
    taken = next((action for action in there.plan[len(node) :] if action in EXITS), None)
    if taken is not None:
        return turn if taken != turn and here.likeliest == "done" else None
    moves = set(there.plan) & set(CHANGES)
    return turn if moves and turn != "exit-straight" else None


def aim(trace: PlanTrace, here: Intervention) -> Aim:
    """Return where the plans of a decision lead to, and the expected time of the chosen one."""
    goal = trace.waypoint or trace.goal
    return Aim(goal.edge, goal.position, trace.waypoint is None, here.expectation("time"))


def alone(
    ride: Ride, model: CausalModel, here: Intervention, tried: Proven | None = None
) -> Contrast:
    """Return what was decided as a contrast without a foil."""
    return Contrast(
        fact=here.plan,
        foil=(),
        outcome=None,
        effects=(),
        causes=() if tried is None else tried.causes,
        evidence=evidence(ride, model, here),
        decided=model.trace.sim_time,
        fact_outcome=chances(here).likeliest,
        fact_collision=chances(here).collision,
        aim=aim(model.trace, here),
        cleared=() if tried is None else tried.cleared,
        causation=None if tried is None else tried.causation,
    )


def evidence(ride: Ride, model: CausalModel, *plans: Intervention) -> Evidence:
    """Return what an explanation of one decision rests on; each simulation counts once."""
    joints = {result.joint for plan in plans for result in plan.results}
    simulations = {result.rollout.index for plan in plans for result in plan.results}
    trace = model.trace
    original = any(trace is one for one in ride.traces)
    return Evidence(
        method="tree" if original else "rollouts",
        rollouts=len(simulations),
        distinct_samples=len(joints),
        traces=(trace.trace_id,),
    )


def to_effects(found: Sequence[ComponentEffect]) -> tuple[Effect, ...]:
    """Convert effects to the values that answers hold."""
    return tuple(
        Effect(e.component, e.unit, e.delta, e.low, e.high, e.n, e.n_distinct) for e in found
    )


def against_best(ride: Ride, trace: PlanTrace, node: Actions = ()) -> Contrast:
    """Compare the plan of a decision with the best alternative, if there is any.

    Raises:
        Unanswered: there is too little evidence, or the two make no difference.
    """
    model, plan = ride.model(trace), planned(trace)
    here = factual(model, trace)
    others = alternatives(model, plan[len(node)], node) if len(plan) > len(node) else []
    others = [pair for pair in others if not _coming(plan, pair[0])]
    if others:
        foil, there = next((pair for pair in others if _natural(plan, pair[0])), others[0])
        return compare(ride, model, here, there, foil)
    return alone(ride, model, here, proven(ride, model, holding_up(model, here), here))


def _coming(plan: Actions, foil: Actions) -> bool:
    """Check whether a plan has a foil next: driving on until then is no choice against it."""
    at = len(foil) - 1
    later = next((action for action in plan[at:] if action != "continue"), None)
    return plan[at] == "continue" and later is not None and same(foil[-1], later)


def _natural(plan: Actions, foil: Actions) -> bool:
    """Check whether a foil comes to mind first: staying in the lane, instead of leaving it."""
    return plan[len(foil) - 1] in CHANGES and foil[-1] == "continue"
