"""What a decision hangs on.

Whether it stands under a condition, what would have to change for another, what mattered most.
"""

import math
from collections.abc import Mapping

from msgspec.structs import replace

from planner.trace import Action, PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import Actions, CausalModel, Choice, Intervention
from xavi_dialogue.explain import ego, suppositions
from xavi_dialogue.explain.actions import same, to_macros
from xavi_dialogue.explain.causes import contrastive_causes, expected_actions
from xavi_dialogue.explain.conditions import Condition, condition
from xavi_dialogue.explain.contrast import (
    alternatives,
    arrival,
    check_applicable,
    evidence,
    explain_contrast,
    factual,
    outcome,
    to_effects,
)
from xavi_dialogue.explain.course import lines, speed_mark
from xavi_dialogue.explain.deeds import DRIVING, did_not_happen, happened
from xavi_dialogue.explain.details import Pivot
from xavi_dialogue.explain.explanation import Cause, Explanation, NoExplanation
from xavi_dialogue.explain.premise import about_foil, premise
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.ride import Ride, Unanswered, decline, enough, planned, prediction, thin
from xavi_dialogue.explain.slowing import began
from xavi_dialogue.explain.vehicles import check_known, matching

LIKELY = 0.5  # share of the rollouts from which the ego is said to do something
TRIED = 2  # vehicles that are taken away one by one
WORTH = 0.02  # probability from which a vehicle's conduct is worth speaking of


def sensitivity(query: Query, ride: Ride) -> Explanation:
    """Whether a deed stands under a condition; what would change it; or what mattered most.

    Raises:
        Unanswered: the condition is none that the record can be asked about, the deed did not
            happen, or a plan must be made again first.
    """
    if query.condition:
        supposed = condition(query.condition)
        if supposed is None:
            raise decline("out-of-scope", what="unsupported-condition")
        check_known(ride, supposed.vehicle)
        return _under(query, ride, supposed)
    if query.counterfactual:
        return _towards(query, ride)
    return _factor(query, ride)


# Would you still have done it? ---------------------------------------------------------------


def _under(query: Query, ride: Ride, supposed: Condition) -> Explanation:
    """The plan under the condition against the plan as it was, as for a what-if."""
    if query.tense == "past":
        if really := _really(query, ride):
            found = _under(replace(query, factual=really), ride, supposed)
            return replace(found, done=really)
        _check_done(query, ride)
    deed = query.factual or query.counterfactual or ()
    driving = [a for a in deed if a in DRIVING and not (a == "stop" and happened(ride, "stop"))]
    if supposed.actions and driving:
        return _given(query, ride, supposed, deed)
    if supposed.actions:
        asked = Query(
            type="what_if",
            actor=f"vehicle:{supposed.vehicle}",
            counterfactual=supposed.actions,
            negated=supposed.negated,
            tense=query.tense,
        )
        return _judged(ride, suppositions.what_if(asked, ride), supposed.vehicle, deed)
    moment = _moment(query, ride, supposed.vehicle, deed)
    trace, again = suppositions.replanned(ride, supposed.vehicle, moment)
    found = suppositions.compared(ride, supposed.vehicle, trace, again)
    if not driving:
        return _judged(ride, found, supposed.vehicle, deed)
    fact = _share(trace, factual(ride.model(trace), trace), driving[-1])
    share = _share(again, factual(ride.model(again), again), driving[-1])
    if fact is None or share is None:
        raise thin(deed, None)
    changes = share < LIKELY <= fact  # what is no longer planned with it was not for it
    return _with_change(found, supposed.vehicle, changes=changes)


def _check_done(query: Query, ride: Ride) -> None:
    """Decline to say whether we would still have done what we did not do.

    Raises:
        Unanswered: it did not happen.
    """
    deed = query.factual or ()
    undone = [a for a in deed if a not in DRIVING and happened(ride, a) is None]
    waited = any(event.kind == "gave-way" for event in ride.events)
    if undone or ("give-way" in deed and not waited and not _halted(ride)):
        raise did_not_happen(ride, deed)


def _really(query: Query, ride: Ride) -> tuple[QueryAction, ...]:
    """What the ego did where it is said to have stopped, and only slowed down."""
    if query.factual != ("stop",) or _halted(ride):
        return ()
    return ("slow-down",) if ride.motion(EGO).last("slow-down") is not None else ()


def _halted(ride: Ride) -> bool:
    return ride.motion(EGO).last("stop") is not None


def _moment(query: Query, ride: Ride, vehicle: int, deed: tuple[QueryAction, ...]) -> float:
    """The time [s] of the decision for a deed; one that was not done was up for decision too.

    Of a way of driving it is the one under which it began, or, where the vehicle was not known
    then, the first that reckons with it.

    Raises:
        Unanswered: it is a way of driving, and was not.
    """
    driving = tuple(action for action in deed if action in DRIVING)
    if driving:
        start = began(ride, driving, query.tense)
        known = suppositions.known_to(ride, vehicle, math.inf)
        return max(start, known[0].sim_time) if known else start
    try:
        return premise(ride, replace(query, factual=deed or None)).trace.sim_time
    except Unanswered:
        return suppositions.moment_of(ride, query.tense, vehicle)


def _given(
    query: Query, ride: Ride, supposed: Condition, deed: tuple[QueryAction, ...]
) -> Explanation:
    """The plan of the decision behind a way of driving, given what a vehicle does.

    Raises:
        Unanswered: it did not happen, or there is too little evidence.
    """
    trace = premise(ride, replace(query, factual=deed)).trace
    model, vehicle = ride.model(trace), supposed.vehicle
    matched = matching(model, vehicle, supposed.actions)
    if prediction(trace, vehicle) is None:
        raise decline("outside-record", vehicle=vehicle, time=trace.sim_time)
    chosen = frozenset(model.choices(vehicle)) - matched if supposed.negated else matched
    if not chosen:
        raise thin(deed, None)
    given = CausalModel(trace, {vehicle: chosen})
    here, there = factual(model, trace), factual(given, trace)
    share = _share(trace, there, deed[-1])
    if share is None:
        raise thin(deed, there)
    chance = min(sum(model.choices(vehicle)[choice] for choice in chosen), 1.0)
    likeliest = max(chosen, key=lambda choice: (model.choices(vehicle)[choice], choice))
    actions, _ = expected_actions(model, vehicle, likeliest)
    return Explanation(
        factual=here.plan,
        counterfactual=there.plan,
        outcome=outcome(there),
        effects=to_effects(effects(there, here)),
        causes=(Cause(vehicle, actions, chance, None, None, share < LIKELY),),
        evidence=evidence(model, ride, there, here),
        sim_time=trace.sim_time,
        arrival=arrival(trace, here),
    )


def _judged(
    ride: Ride, found: Explanation, vehicle: int, deed: tuple[QueryAction, ...]
) -> Explanation:
    """Whether a deed, as the action decided on, was done or is planned, but would not, or so."""
    if not deed:
        return found
    plan = planned(ride.latest)[:1]
    was = any(happened(ride, a) is not None or any(same(a, step) for step in plan) for a in deed)
    would = any(same(action, step) for action in deed for step in found.counterfactual[:1])
    return _with_change(found, vehicle, changes=was != would)


def _with_change(found: Explanation, vehicle: int, *, changes: bool) -> Explanation:
    causes = tuple(
        replace(c, decision_changes=changes) if c.vehicle == vehicle else c for c in found.causes
    )
    return replace(found, causes=causes)


def _share(trace: PlanTrace, plan: Intervention, action: QueryAction) -> float | None:
    """The weight of the rollouts of a plan in which the ego drives as described."""
    known = lines(trace)
    there = total = 0.0
    for result, weight in zip(plan.results, plan.weights, strict=True):
        line = known.get(result.rollout.index)
        if line is not None:
            total += weight
            there += weight * (speed_mark(line, action) is not None)
    return there / total if total > 0.0 else None


# What would have to change? ------------------------------------------------------------------


def _towards(query: Query, ride: Ride) -> Explanation:
    """What would have made the foil the best option: a vehicle's conduct, or its absence."""
    found = about_foil(ride, query)
    trace, node = found.trace, found.node
    model, plan = ride.model(trace), planned(trace)
    foil = to_macros(model, query.counterfactual or (), node)
    if plan[: len(node) + len(foil)] == (*node, *foil):
        raise decline("did-not-happen", vehicle=EGO, asked=foil, did=True)
    check_applicable(model, foil, node)
    seen, there = ride.evidence(trace, (*node, *foil))
    here = factual(seen, trace)
    explained = explain_contrast(ride, seen, here, there, (*node, *foil))
    if there.likeliest == "dead":
        return replace(explained, pivot=Pivot("none"))
    pivot = _conduct(model, (*node, *foil), node)
    if pivot is None:
        causes = explained.causes or contrastive_causes(seen, there, here, ())
        pivot = _removal(ride, trace, (*node, *foil), causes)
    return replace(explained, pivot=pivot)


def _conduct(model: CausalModel, foil: Actions, node: Actions) -> Pivot | None:
    """The likeliest conduct of one vehicle under which the foil is the best option."""
    pivots = [
        Pivot("conduct", vehicle, actions, chance)
        for vehicle in model.vehicles
        for actions, (choices, chance) in _conducts(model, vehicle).items()
        if chance >= WORTH and _wins(model, vehicle, choices, foil, node)
    ]
    return max(pivots, key=lambda p: p.probability or 0.0, default=None)


def _conducts(
    model: CausalModel, vehicle: int
) -> Mapping[Actions, tuple[frozenset[Choice], float]]:
    """What a vehicle may do: the choices with the same actions, and their probability."""
    known = prediction(model.trace, vehicle)
    assert known is not None
    found: dict[Actions, tuple[frozenset[Choice], float]] = {}
    for (g, t), chance in model.choices(vehicle).items():
        actions = known.goals[g].trajectories[t].actions
        choices, sum_before = found.get(actions, (frozenset(), 0.0))
        found[actions] = (choices | {(g, t)}, min(sum_before + chance, 1.0))
    return found


def _wins(
    model: CausalModel, vehicle: int, choices: frozenset[Choice], foil: Actions, node: Actions
) -> bool:
    """Whether the foil is the best option given what a vehicle does, with evidence for all."""
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


def _removal(ride: Ride, trace: PlanTrace, foil: Actions, causes: tuple[Cause, ...]) -> Pivot:
    """The first of the causes without which the plan begins with the foil.

    Raises:
        Unanswered: it must be planned again without one of them.
    """
    for cause in causes[:TRIED]:
        _, again = suppositions.replanned(ride, cause.vehicle, trace.sim_time)
        if planned(again)[: len(foil)] == foil:
            return Pivot("removal", cause.vehicle)
    return Pivot("none")


# What mattered most? -------------------------------------------------------------------------


def _factor(query: Query, ride: Ride) -> Explanation:
    """The first cause of the deed; where no vehicle is, the difference to the alternative.

    Raises:
        Unanswered: as for why; a choice that made no difference had no factor.
    """
    try:
        found = ego.why(replace(query, type="why"), ride)
    except Unanswered as unanswered:
        refused = unanswered.result
        if isinstance(refused, NoExplanation) and refused.reason == "effect-too-small":
            raise decline("no-influence") from None
        raise
    ranked = sorted(found.causes, key=_weight)
    first = ranked[0].vehicle if ranked else None
    return replace(found, causes=tuple(ranked), pivot=Pivot("factor", first))


def _weight(cause: Cause) -> tuple[int, float]:
    """Collisions first, then hold-ups by the delay expected of them, then influence."""
    mechanism = cause.mechanism
    if mechanism is None:
        return 2, -(cause.influence or 0.0)
    if mechanism.how == "collision":
        return 0, -mechanism.share
    return 1, -(mechanism.delay or 0.0) * mechanism.share
