"""Terms: what the planner's reward holds for or against a plan, in seconds, term by term.

A contrast tells components in natural units. Which of them the choice turned on is told by the
planner's own reckoning: its reward, taken apart. The terms of a plan sum to minus its value.
"""

from collections.abc import Iterable, Mapping

from planner.reward import EFFORT, PENALTY, WEIGHTS
from planner.trace import COMPONENTS
from xavi_dialogue.causal.model import CausalModel, Intervention, Joint, Result, plan_of
from xavi_dialogue.domain.answers import Term

PAIRED = 0.5  # share of the weight of either side that must have been tried with both
SPEAKS = 0.25  # [s] from which a term is a reason


def differences(model: CausalModel, foil: Intervention, fact: Intervention) -> dict[Term, float]:
    """Tell how much [s] more the foil costs than the fact, term by term.

    Where the situations that were tried with both make up PAIRED of either side, they alone
    count, each by its prior: so the planner compares, and what one side met by chance alone
    tells nothing of the choice.
    """
    common = {r.joint for r in foil.results} & {r.joint for r in fact.results}
    mass = min(sum(_weights(side, common)) for side in (foil, fact))
    if mass >= PAIRED:
        prior = {joint: model.prior(joint) for joint in common}
        there, here = (_mean((r, prior.get(r.joint, 0.0)) for r in s.results) for s in (foil, fact))
    else:
        there, here = costs(foil), costs(fact)
    return {term: there.get(term, 0.0) - here.get(term, 0.0) for term in (there | here)}


def costs(plan: Intervention) -> dict[Term, float]:
    """Take the expected cost [s] of a plan apart into the terms of the reward."""
    return _mean(zip(plan.results, plan.weights, strict=True))


def _mean(pairs: Iterable[tuple[Result, float]]) -> dict[Term, float]:
    found: dict[Term, float] = {}
    total = 0.0
    for result, weight in pairs:
        total += weight
        for term, cost in _parts(result).items():
            found[term] = found.get(term, 0.0) + weight * cost
    return {term: cost / total for term, cost in found.items()} if total > 0.0 else {}


def _weights(plan: Intervention, among: set[Joint]) -> list[float]:
    pairs = zip(plan.results, plan.weights, strict=True)
    return [weight for result, weight in pairs if result.joint in among]


def effort(plan: Intervention) -> float:
    """Tell the effort [s] that a plan's actions cost as such, in the mean."""
    return costs(plan).get("effort", 0.0)


def decisive(difference: Mapping[Term, float]) -> Term | None:
    """Find the term that speaks most for the fact; None where none is worth speaking of.

    Where all that can be told of what would come of either does not, it is effort if anything.
    """
    if is_close(difference):
        return "effort" if difference.get("effort", 0.0) >= SPEAKS else None
    ranked = sorted(difference, key=lambda term: -difference[term])
    return ranked[0] if ranked and difference[ranked[0]] >= SPEAKS else None


def is_close(difference: Mapping[Term, float]) -> bool:
    """Tell whether, all but the effort of actions counted, nothing speaks for the fact."""
    return sum(cost for term, cost in difference.items() if term != "effort") < SPEAKS


def _parts(result: Result) -> dict[Term, float]:
    rollout = result.rollout
    if rollout.outcome in ("collision", "dead"):
        outcome: Term = "collision" if rollout.outcome == "collision" else "dead"
        return {outcome: PENALTY[rollout.outcome]}
    trouble = sum(EFFORT.get(action, 0.0) for action in plan_of(rollout))
    time = rollout.components.get("time")
    if rollout.outcome == "termination" or time is None:
        return {"late": -rollout.reward - trouble, "effort": trouble}
    found: dict[Term, float] = {"time": time, "effort": trouble}
    for name in COMPONENTS:
        value = rollout.components.get(name)
        if name != "time" and value is not None:
            found[name] = WEIGHTS[name] * value * time
    return found
