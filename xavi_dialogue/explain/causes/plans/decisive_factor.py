"""Decisive factors: what would have made another option of a decision the best."""

from collections.abc import Mapping

from planner.record.trace import Action
from xavi_dialogue.causal.model import Actions, CausalModel, Choice
from xavi_dialogue.domain.answers import Cause, Contrast, DecisiveFactor, NeedRollout
from xavi_dialogue.explain.causes.plans.contrast import (
    alternatives,
    check_applicable,
    compare,
    factual,
    sides,
)
from xavi_dialogue.explain.causes.plans.premise import Premise
from xavi_dialogue.explain.causes.vehicles.actions import same
from xavi_dialogue.explain.causes.vehicles.involved import contrastive_causes
from xavi_dialogue.explain.history.ride import Ride, Unanswered, enough, planned, prediction

TRIED = 2  # maximum number of vehicles that are removed one by one
WORTH = 0.02  # minimum probability of a vehicle's conduct that is mentioned


def towards(ride: Ride, found: Premise, foil: Actions) -> DecisiveFactor:
    """Find what would have made the foil the best option: a vehicle's conduct, or its absence.

    Raises:
        Unanswered: the foil does not apply or lacks evidence; or rollouts are needed.
    """
    trace, node = found.trace, found.node
    model = ride.model(trace)
    check_applicable(model, foil, node)
    seen, there = ride.evidence(trace, (*node, *foil))
    here = factual(seen, trace)
    try:
        explained = compare(ride, seen, here, there, (*node, *foil))
    except Unanswered as unanswered:
        if isinstance(unanswered.result, NeedRollout):
            raise
        explained = sides(ride, seen, here, there, (*node, *foil))
    if there.likeliest == "dead":
        return DecisiveFactor("none", explained)
    factor = _conduct(model, (*node, *foil), node, explained)
    if factor is not None:
        return factor
    causes = explained.causes or contrastive_causes(seen, there, here, ())
    return _removal(ride, found, (*node, *foil), causes, explained)


def otherwise(ride: Ride, found: Premise) -> DecisiveFactor:
    """Find what would have made any other option the best.

    That is the conduct or the absence of one vehicle. If no option has such a factor, the result
    is that of the best alternative.

    Raises:
        Unanswered: there is too little evidence, or rollouts are needed.
    """
    plan, node = planned(found.trace), found.node
    if len(plan) <= len(node):
        return DecisiveFactor("none", None)
    rivals = alternatives(ride.model(found.trace), plan[len(node)], node)
    tried = [towards(ride, found, foil[len(node) :]) for foil, _ in rivals]
    turning = (factor for factor in tried if factor.kind != "none")
    return next(turning, tried[0] if tried else DecisiveFactor("none", None))


def _conduct(
    model: CausalModel, foil: Actions, node: Actions, contrast: Contrast
) -> DecisiveFactor | None:
    """Return the likeliest conduct of one vehicle under which the foil is the best option."""
    blamed = {cause.vehicle for cause in contrast.causes}
    factors = [
        DecisiveFactor("conduct", contrast, vehicle, actions, chance)
        for vehicle in model.vehicles
        if not blamed or vehicle in blamed  # only these are known to matter
        for actions, (choices, chance) in _conducts(model, vehicle).items()
        if chance >= WORTH and _wins(model, vehicle, choices, foil, node)
    ]
    return max(factors, key=lambda p: p.probability or 0.0, default=None)


def _conducts(
    model: CausalModel, vehicle: int
) -> Mapping[Actions, tuple[frozenset[Choice], float]]:
    """Return what a vehicle may do: the choices with the same actions, and their probability."""
    known = prediction(model.trace, vehicle)
    found: dict[Actions, tuple[frozenset[Choice], float]] = {}
    if known is None:
        return found
    for (g, t), chance in model.choices(vehicle).items():
        actions = known.goals[g].trajectories[t].actions
        choices, sum_before = found.get(actions, (frozenset(), 0.0))
        found[actions] = (choices | {(g, t)}, min(sum_before + chance, 1.0))
    return found


def _wins(
    model: CausalModel, vehicle: int, choices: frozenset[Choice], foil: Actions, node: Actions
) -> bool:
    """Check whether the foil is the best option given what a vehicle does.

    There must be evidence for what was chosen as well.
    """
    given = CausalModel(model.trace, {vehicle: choices})
    mine = given.intervene(foil)
    if mine is None or not enough(mine):
        return False
    step = foil[len(node)]
    rivals = alternatives(given, step, node)
    tried = {actions[len(node)] for actions, _ in rivals}
    plan = planned(model.trace)
    chosen: Action | None = plan[len(node)] if len(plan) > len(node) else None
    compared = chosen is not None and (chosen in tried or same(chosen, step))
    return compared and all(mine.value > rival.value for _, rival in rivals)


def _removal(
    ride: Ride, found: Premise, foil: Actions, causes: tuple[Cause, ...], contrast: Contrast
) -> DecisiveFactor:
    """Return the first cause as a factor without which the plan begins with the foil."""
    for cause in causes[:TRIED]:
        again = ride.without(found.trace, cause.vehicle)
        if again is not None and planned(again)[: len(foil)] == foil:
            return DecisiveFactor("removal", contrast, cause.vehicle)
    return DecisiveFactor("none", contrast)


def weight(cause: Cause) -> tuple[int, float]:
    """Return a key that sorts causes: collisions, then hold-ups by expected delay, then others."""
    mechanism = cause.mechanism
    if mechanism is None:
        return 2, -(cause.influence or 0.0)
    if mechanism.how == "collision":
        return 0, -mechanism.share
    return 1, -(mechanism.delay or 0.0) * mechanism.share
