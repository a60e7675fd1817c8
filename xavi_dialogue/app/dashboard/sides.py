"""What an explanation set against one another, found again in the traces that it names.

An explanation holds figures, and not the rollouts behind them. These are looked up once more in
the ways in which explanations find them, and taken only where they give its very figures: what
browsers show beside an answer never contradicts it.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from planner.trace import PlanTrace
from sim.scene import EGO
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import Actions, CausalModel, Choice, Intervention
from xavi_dialogue.explain.conditions import condition
from xavi_dialogue.explain.explanation import Explanation
from xavi_dialogue.explain.query import Query, QueryAction
from xavi_dialogue.explain.vehicles import matching, number_of

SAME = 1e-6  # difference of figures that were computed alike


@dataclass(frozen=True, slots=True)
class Found:
    """What is behind one side of an explanation."""

    trace: PlanTrace  # that the results come from
    plan: Intervention


def sides(
    query: Query | None, explanation: Explanation, traces: Sequence[PlanTrace]
) -> tuple[Found | None, Found | None]:
    """What was done or planned, and what that is set against.

    Args:
        query: that is answered; None: not known.
        explanation: of it.
        traces: those that it names, as far as they are at hand, in that order.

    Returns:
        Both, None where there is none or it cannot be found again.
    """
    models = [CausalModel(trace) for trace in traces]
    if not explanation.counterfactual:
        if _about_another(explanation):
            return None, None
        return next(_alone(explanation, models), None), None
    for here, there in _pairs(query, explanation, models):
        if _agrees(explanation, here.plan, there.plan):
            return here, there
    facts = (_found(model, explanation.factual) for model in models if _decided(model.trace))
    return next((found for found in facts if found is not None), None), None


def _about_another(explanation: Explanation) -> bool:
    """Whether what is told was done, or is expected, by another vehicle than ours."""
    parts = (explanation.activity, explanation.destination)
    return any(part is not None and part.vehicle != EGO for part in parts)


def _decided(trace: PlanTrace) -> bool:
    """Whether a trace tells of what was decided: others were not supposed to be otherwise."""
    again = trace.what_if
    return again is None or (again.removed is None and again.vehicle is None)


def _alone(explanation: Explanation, models: Sequence[CausalModel]) -> Iterator[Found]:
    """The plan, where there is nothing beside it; of its outcome as it was told."""
    outcome = explanation.outcome
    for model in models:
        found = _found(model, explanation.factual) if _decided(model.trace) else None
        if found is None:
            continue
        if outcome is None or _same(outcome.probability, found.plan.outcomes[outcome.name]):
            yield found


def _pairs(
    query: Query | None, explanation: Explanation, models: Sequence[CausalModel]
) -> Iterator[tuple[Found, Found]]:
    """What may have been set against one another."""
    fact, foil = explanation.factual, explanation.counterfactual
    for model in models:
        here = _found(model, fact) if _decided(model.trace) else None
        if here is None:
            continue
        there = model.intervene(foil)
        if there is not None:
            yield here, Found(model.trace, there)
        for other in models:
            if other is not model and (planned := _found(other, foil)) is not None:
                yield here, planned
        for vehicle, supposed in _supposed(query, model):
            given = _under(CausalModel(model.trace, {vehicle: supposed}), foil)
            if given is not None:
                yield here, Found(model.trace, given)


def _found(model: CausalModel, plan: Actions) -> Found | None:
    found = _under(model, plan)
    return None if found is None else Found(model.trace, found)


def _under(model: CausalModel, plan: Actions) -> Intervention | None:
    """What comes of exactly a plan.

    It was found under the first actions of the plan of the decision, or of this one.
    """
    decided = tuple(planned.action for planned in model.trace.plan)
    for actions in (plan, decided):
        for length in range(len(actions), 0, -1):
            found = model.intervene(actions[:length])
            if found is not None and found.plan == plan:
                return found
    return None


def _supposed(query: Query | None, model: CausalModel) -> Iterator[tuple[int, frozenset[Choice]]]:
    """What a question supposes of another vehicle, as choices that a decision reckoned with."""
    for vehicle, asked, negated in _conduct(query):
        if vehicle in model.vehicles:
            matched = matching(model, vehicle, asked)
            chosen = frozenset(model.choices(vehicle)) - matched if negated else matched
            if chosen:
                yield vehicle, chosen


def _conduct(query: Query | None) -> Iterator[tuple[int, tuple[QueryAction, ...], bool]]:
    """Vehicle, what it is supposed to do, and whether rather not to do."""
    if query is None:
        return
    vehicle = number_of(query.actor)
    if vehicle and query.counterfactual:
        yield vehicle, query.counterfactual, query.negated
    said = condition(query.condition) if query.condition else None
    if said is not None and said.actions:
        yield said.vehicle, said.actions, said.negated


def _agrees(explanation: Explanation, here: Intervention, there: Intervention) -> bool:
    """Whether two sides give the figures of an explanation."""
    outcome = explanation.outcome
    if outcome is not None and not _same(outcome.probability, there.outcomes[outcome.name]):
        return False
    known = {effect.component: effect for effect in effects(there, here)}
    return len(known) == len(explanation.effects) and all(
        effect.component in known
        and _same(effect.delta, known[effect.component].delta)
        and _same(effect.low, known[effect.component].low)
        and _same(effect.high, known[effect.component].high)
        for effect in explanation.effects
    )


def _same(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=SAME, abs_tol=SAME)
