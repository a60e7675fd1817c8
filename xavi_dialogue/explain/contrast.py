"""Contrast: what the ego did or plans against what it might have done instead."""

from collections.abc import Sequence

from planner.trace import Action, PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.effects import SCALES, ComponentEffect, effects
from xavi_dialogue.causal.model import Actions, CausalModel, Intervention
from xavi_dialogue.explain.actions import same
from xavi_dialogue.explain.causes import contrastive_causes, holding_up
from xavi_dialogue.explain.explanation import Effect, Evidence, Explanation, OutcomeEstimate
from xavi_dialogue.explain.necessity import proven
from xavi_dialogue.explain.ride import Ride, decline, enough, planned, thin

LANE_CHANGES: tuple[Action, ...] = ("change-left", "change-right")
NO_EFFECT = 0.05  # of a component's scale: below this nothing tells fact and foil apart
NO_DIFFERENCE = 0.01  # of probability: nor does this


def contrast(ride: Ride, trace: PlanTrace, foil: Actions | None, node: Actions = ()) -> Explanation:
    """Explain the plan of a decision against a foil.

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
        raise decline(
            "did-not-happen", vehicle=EGO, asked=foil, did=True, happened=foil, time=trace.sim_time
        )
    check_applicable(ride.model(trace), foil, node)
    model, there = ride.evidence(trace, (*node, *foil))
    here = factual(model, trace)
    return explain_contrast(ride, model, here, there, (*node, *foil))


def check_applicable(model: CausalModel, foil: Actions, node: Actions = ()) -> None:
    """Decline a foil that cannot be done, with the planner's reason.

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
            asked, time = (action,), trace.sim_time
            raise decline("not-applicable", asked=asked, reason=reason, time=time, vehicle=EGO)
        return


def factual(model: CausalModel, trace: PlanTrace) -> Intervention:
    """The plan of a decision; of its later actions, as many as there is evidence for.

    Raises:
        Unanswered: there is not even enough for its first action.
    """
    plan = planned(trace)
    for length in range(len(plan), 0, -1):
        found = model.intervene(plan[:length])
        if found is not None and enough(found):
            return found
    raise thin(plan[:1], model.intervene(plan[:1]))


def alternatives(
    model: CausalModel, fact: Action, node: Actions = ()
) -> list[tuple[Actions, Intervention]]:
    """The other actions at a node that there is evidence for, best first."""
    found = []
    for action in model.options(node):
        if not same(action, fact):
            there = model.intervene((*node, action))
            if there is not None and enough(there):
                found.append(((*node, action), there))
    return sorted(found, key=lambda pair: -pair[1].value)


def explain_contrast(
    ride: Ride, model: CausalModel, here: Intervention, there: Intervention, foil: Actions
) -> Explanation:
    """The explanation of one plan against another.

    Raises:
        Unanswered: nothing tells them apart.
    """
    found = effects(there, here)
    causes = contrastive_causes(model, there, here, found)
    if not causes and _alike(here, there, found):
        time = next((e.delta for e in found if e.component == "time"), None)
        chosen = here.plan[: len(foil)]
        raise decline("effect-too-small", asked=foil, chosen=chosen, delta=time)
    causes = proven(ride, model, causes, here, there)
    return Explanation(
        factual=here.plan,
        counterfactual=foil,
        outcome=outcome(there),
        effects=to_effects(found),
        causes=causes,
        evidence=evidence(model, ride, here, there),
        sim_time=model.trace.sim_time,
        arrival=arrival(model.trace, here),
    )


def outcome(intervention: Intervention) -> OutcomeEstimate:
    """The likeliest outcome of an intervention."""
    name = intervention.likeliest
    struck = intervention.collisions() if name == "collision" else {}
    vehicle = max(struck, key=lambda v: struck[v], default=None)
    return OutcomeEstimate(name, min(intervention.outcomes[name], 1.0), vehicle)


def arrival(trace: PlanTrace, plan: Intervention) -> float | None:
    """Expected time [s] to the goal; None where a plan only goes to a place on the way there."""
    return None if trace.waypoint is not None else plan.expectation("time")


def evidence(model: CausalModel, ride: Ride, *sides: Intervention) -> Evidence:
    """What an explanation of one decision rests on."""
    joints = {result.joint for side in sides for result in side.results}
    draws = {result.rollout.index: result.draws for side in sides for result in side.results}
    trace = model.trace
    original = any(trace is one for one in ride.traces)
    return Evidence(
        method="tree" if original else "rollouts",
        rollouts=sum(draws.values()),
        distinct_samples=len(joints),
        traces=(trace.trace_id,),
    )


def to_effects(found: Sequence[ComponentEffect]) -> tuple[Effect, ...]:
    """Effects as the contract has them."""
    return tuple(
        Effect(e.component, e.unit, e.delta, e.low, e.high, e.n, e.n_distinct) for e in found
    )


def against_best(ride: Ride, trace: PlanTrace, node: Actions = ()) -> Explanation:
    """Explain the plan of a decision against the best alternative, or by itself without any.

    Raises:
        Unanswered: there is too little evidence, or the two make no difference.
    """
    model, plan = ride.model(trace), planned(trace)
    here = factual(model, trace)
    others = alternatives(model, plan[len(node)], node) if len(plan) > len(node) else []
    others = [pair for pair in others if not _coming(plan, pair[0])]
    if others:
        foil, there = next((pair for pair in others if _natural(plan, pair[0])), others[0])
        return explain_contrast(ride, model, here, there, foil)
    return Explanation(
        factual=here.plan,
        counterfactual=(),
        outcome=outcome(here),
        effects=(),
        causes=proven(ride, model, holding_up(model, here), here),
        evidence=evidence(model, ride, here),
        sim_time=trace.sim_time,
        arrival=arrival(trace, here),
    )


def _coming(plan: Actions, foil: Actions) -> bool:
    """Whether a foil is what the plan has next: driving on up to it is no choice against it."""
    at = len(foil) - 1
    later = next((action for action in plan[at:] if action != "continue"), None)
    return plan[at] == "continue" and later is not None and same(foil[-1], later)


def _natural(plan: Actions, foil: Actions) -> bool:
    """Whether a foil is what one thinks of first: who changes lanes might have stayed in his."""
    return plan[len(foil) - 1] in LANE_CHANGES and foil[-1] == "continue"


def _alike(here: Intervention, there: Intervention, found: Sequence[ComponentEffect]) -> bool:
    same_ends = all(
        abs(here.outcomes[name] - there.outcomes[name]) < NO_DIFFERENCE for name in here.outcomes
    )
    spread = any(max(abs(e.low), abs(e.high)) >= NO_EFFECT * SCALES[e.component] for e in found)
    return same_ends and not spread
