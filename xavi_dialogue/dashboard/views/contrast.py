"""Fact and foil of an explanation, found again in the traces that it names.

An explanation holds figures, and not the rollouts behind them. These are looked up once more in
the ways in which explanations find them, and taken only where they give its very figures: what
browsers show beside an answer never contradicts it.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from planner.record.trace import PlanTrace
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import Actions, CausalModel, Choice, Intervention
from xavi_dialogue.dashboard.typed_answer import TypedAnswer
from xavi_dialogue.dashboard.views.decision import chosen_plan
from xavi_dialogue.dialogue.explanation import Contrastive
from xavi_dialogue.domain.answers import SupposedOfOther
from xavi_dialogue.explain.causes.plans.chances import chances
from xavi_dialogue.explain.causes.vehicles.conduct import conduct_names, matching

SAME = 1e-6  # greatest difference of figures that were computed in the same way


@dataclass(frozen=True, slots=True)
class ContrastSide:
    """The plan and results behind one side of an explanation."""

    trace: PlanTrace  # source of the results
    plan: Intervention


def sides(
    told: TypedAnswer, traces: Sequence[PlanTrace]
) -> tuple[ContrastSide | None, ContrastSide | None]:
    """Find the fact and the foil of an explanation.

    Args:
        told: what is explained.
        traces: those that it names, as far as they are at hand, in that order.

    Returns:
        Both, None where there is none or it cannot be found again.
    """
    models, said = [CausalModel(trace) for trace in traces], told.said
    if not said.counterfactual:
        return (next(_alone(said, models), None) if told.ours else None), None
    for here, there in _pairs(told, models):
        if _agrees(said, here.plan, there.plan):
            return here, there
    facts = (_found(model, said.factual) for model in models if _decided(model.trace))
    return next((found for found in facts if found is not None), None), None


def _decided(trace: PlanTrace) -> bool:
    """Check whether a trace is of the decision itself: nothing was supposed about others."""
    again = trace.what_if
    return again is None or not (again.gone or again.vehicle is not None)


def _alone(said: Contrastive, models: Sequence[CausalModel]) -> Iterator[ContrastSide]:
    """Yield the plan, where there is nothing beside it; of its outcome as it was stated."""
    outcome = said.outcome
    for model in models:
        if not _decided(model.trace):
            continue
        plan = chosen_plan(model)
        found = _found(model, said.factual)
        if found is None and plan is not None:
            found = ContrastSide(model.trace, plan)
        if found is None:
            continue
        if outcome is None or _same(outcome.probability, chances(found.plan).of(outcome.name)):
            yield found


def _pairs(
    told: TypedAnswer, models: Sequence[CausalModel]
) -> Iterator[tuple[ContrastSide, ContrastSide]]:
    """Yield pairs that may be fact and foil."""
    fact, foil = told.said.factual, told.said.counterfactual
    for model in models:
        here = _found(model, fact) if _decided(model.trace) else None
        if here is None:
            continue
        if not isinstance(told.answer, SupposedOfOther):
            there = model.intervene(foil)
            if there is not None:
                yield here, ContrastSide(model.trace, there)
            continue
        for other in models:
            if other is not model and (planned := _found(other, foil)) is not None:
                yield here, planned
        for vehicle, supposed in _supposed(told.answer, model):
            given = _under(CausalModel(model.trace, {vehicle: supposed}), foil)
            if given is not None:
                yield here, ContrastSide(model.trace, given)


def _found(model: CausalModel, plan: Actions) -> ContrastSide | None:
    found = _under(model, plan)
    return None if found is None else ContrastSide(model.trace, found)


def _under(model: CausalModel, plan: Actions) -> Intervention | None:
    """Return the results of exactly this plan.

    It was found under the first actions of the plan of the decision, or of this one.
    """
    decided = tuple(planned.action for planned in model.trace.plan)
    for actions in (plan, decided):
        for length in range(len(actions), 0, -1):
            found = model.intervene(actions[:length])
            if found is not None and found.plan == plan:
                return found
    return None


def _supposed(
    answer: SupposedOfOther, model: CausalModel
) -> Iterator[tuple[int, frozenset[Choice]]]:
    """Yield what is supposed about another vehicle, as choices that a decision considered."""
    vehicle = answer.vehicle
    if answer.supposed is None or vehicle not in model.vehicles:
        return
    every = frozenset(model.choices(vehicle))
    matched = matching(model, vehicle, conduct_names(answer.supposed))
    chosen = every - matched if answer.negated else matched
    if chosen:
        yield vehicle, chosen


def _agrees(said: Contrastive, here: Intervention, there: Intervention) -> bool:
    """Check whether two sides give the figures of an explanation."""
    outcome = said.outcome
    if outcome is not None and not _same(outcome.probability, chances(there).of(outcome.name)):
        return False
    known = {effect.component: effect for effect in effects(there, here)}
    untold = known.keys() - {effect.component for effect in said.effects}
    return untold <= {"time"} and all(  # a side that is too late has no time
        effect.component in known
        and _same(effect.delta, known[effect.component].delta)
        and _same(effect.low, known[effect.component].low)
        and _same(effect.high, known[effect.component].high)
        for effect in said.effects
    )


def _same(one: float, other: float) -> bool:
    return math.isclose(one, other, rel_tol=SAME, abs_tol=SAME)
