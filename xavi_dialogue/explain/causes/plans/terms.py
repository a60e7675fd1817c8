"""Terms: what counts for or against a plan in the planner's reward, in seconds, term by term.

A contrast states components in natural units. Which of them decided the choice is shown by the
planner's own reward, split up as the trace records it. The terms of a difference sum to the
difference of the expected rewards.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from planner.record.trace import COMPONENTS, Costs, Outcome
from xavi_dialogue.causal.mixtures import Mixture, Result
from xavi_dialogue.causal.model import CausalModel, Intervention, plan_of
from xavi_dialogue.domain.answers import Share, Term, Weighing
from xavi_dialogue.explain.causes.plans.chances import chances

PAIRED = 0.5  # share of the weight of either side that must have been tried with both
SPEAKS = 0.25  # [s] minimum by which a plan must be better to be called better
REVERSAL = 2.0  # minimum standard errors by which the foil must be better to be called so
ROUNDING = 0.05  # [s] greatest error of terms that are computed from components
TINY = 1e-9  # greatest error of sums of floats
RISK = 0.01  # probability of a collision from which it is always stated
STEERING = frozenset[Term](("angular-acceleration", "curvature"))
RIDE = STEERING | {"jerk"}
SMALL = STEERING | {"effort"}  # stated only if they decide the choice
#: Outcomes whose cost does not depend on what was driven before, and their terms.
FATAL: Mapping[Outcome, Term] = {"collision": "collision", "dead": "dead"}


@dataclass(frozen=True)
class Difference:
    """How much [s] more the foil costs than the fact."""

    terms: dict[Term, float]  # [s] largest first; those that are not 0
    error: float  # [s] standard error of their sum
    chances: dict[Term, tuple[float, float]] = field(default_factory=dict)  # of foil and of fact

    @cached_property
    def value(self) -> float:
        """The difference [s] by which the expected reward of the fact is higher."""
        return sum(self.terms.values())

    @property
    def verdict(self) -> Weighing:
        """Whether the fact is better or worse, or the two are as good within the error.

        The decision itself is evidence, since the planner compared both in the same situations. So
        it takes a greater difference to call what was decided worse than to call it better.
        """
        least = max(self.error * (REVERSAL if self.value < 0.0 else 1.0), SPEAKS)
        if abs(self.value) < least:
            return "close"
        return "better" if self.value > 0.0 else "worse"

    @property
    def risks(self) -> tuple[float, float]:
        """The probability of a collision under foil and fact."""
        return self.chances.get("collision", (0.0, 0.0))

    def share(self, term: Term) -> Share:
        """Return one term, with the probabilities under foil and fact if it is an outcome's."""
        there, here = self.chances.get(term, (None, None))
        return Share(term, self.terms.get(term, 0.0), there, here)

    @property
    def shares(self) -> tuple[Share, ...]:
        """All terms, largest first."""
        return tuple(self.share(term) for term in self.terms)


def differences(model: CausalModel, foil: Intervention, fact: Intervention) -> Difference:
    """Compute how much more [s] the foil costs than the fact, term by term, with the error.

    If the situations that were tried with both make up PAIRED of either side, they alone count,
    each by its prior. The planner compares in this way, too, and what only one side met by chance
    shows nothing about the choice. Otherwise the two sides vary independently. They also do if a
    fatal outcome occurred in a situation that was tried with one side only, since it weighs too
    much to be left out, or if the pairs contradict the stated chances of such an outcome.

    The standard error is that of the weighted mean (Hajek 1971): of the differences by situation,
    if there are any, for the share of the prior mass that was not tried.
    """
    costs = model.trace.reckoned
    found = _paired(model, foil, fact)
    if found is None or _contradicted(found[0], foil, fact):
        error = math.hypot(_own_error(costs, foil), _own_error(costs, fact))
        found = _independent(costs, foil, fact), error
    terms, error = found
    ranked = sorted(terms, key=lambda term: -terms[term])
    known = {t: terms[t] for t in ranked if terms[t] != 0.0}
    return Difference(known, error, _chances(foil, fact))


def _paired(
    model: CausalModel, foil: Intervention, fact: Intervention
) -> tuple[dict[Term, float], float] | None:
    """Return how much more [s] the foil costs if both were tried, and the standard error [s].

    None if that is too small a part of either side, or leaves a fatal outcome out.
    """
    costs = model.trace.reckoned
    there, here = ({r.joint: r for r in side.results} for side in (foil, fact))
    common = [joint for joint in there if joint in here]
    priors = [model.prior(joint) for joint in common]
    total = sum(priors)
    if min(_mass(side, set(common)) for side in (foil, fact)) < PAIRED or total <= 0.0:
        return None
    if any(r.rollout.outcome in FATAL and r.joint not in here for r in foil.results) or any(
        r.rollout.outcome in FATAL and r.joint not in there for r in fact.results
    ):
        return None
    weights = [prior / total for prior in priors]
    pairs = [_split(_Case.of(costs, there[j]), _Case.of(costs, here[j])) for j in common]
    terms = _sum(zip(weights, pairs, strict=True))
    return terms, _error(weights, [sum(pair.values()) for pair in pairs], total)


def _contradicted(terms: Mapping[Term, float], foil: Mixture, fact: Mixture) -> bool:
    """Check whether a fatal outcome counts against the side that is less likely to have it."""
    return any(
        terms.get(term, 0.0) * (foil.outcomes[outcome] - fact.outcomes[outcome]) < -TINY
        for outcome, term in FATAL.items()
    )


def told(difference: Difference) -> tuple[Share, ...]:
    """Choose the terms that are stated, the decisive one first, so that they bear out the verdict.

    Of the terms against it, the largest is stated if it is large enough and more than effort or
    steering, and a collision always. Of the terms for it, as many are stated as outweigh these, and
    time besides comfort if both count. If it is close, the largest on either side is stated. The
    terms of steering go together.
    """
    sign = -1.0 if difference.verdict == "worse" else 1.0
    groups = _grouped(difference.terms)
    weights = {g: sign * sum(difference.terms[term] for term in g) for g in groups}
    ranked = sorted(groups, key=lambda g: -weights[g])
    pros = [g for g in ranked if weights[g] > 0.0]
    cons = [g for g in reversed(ranked) if weights[g] < 0.0]
    against = [g for g in cons[:1] if weights[g] <= -SPEAKS and not set(g) <= SMALL]
    risk = [("collision",)] if max(difference.risks) >= RISK else []
    against += [g for g in cons if g in risk and g not in against]
    if difference.verdict == "close":
        found = [g for g in pros[:1] if weights[g] >= SPEAKS]
    else:
        found = pros[:1]
        if found and set(found[0]) <= RIDE:
            found += [g for g in pros[1:] if g == ("time",) and weights[g] >= SPEAKS]
        pros = [*found, *(g for g in pros if g not in found)]
        while len(found) < len(pros) and sum(weights[g] for g in (*found, *against)) <= 0.0:
            found.append(pros[len(found)])
    found += [g for g in pros if g in risk and g not in found]
    return tuple(difference.share(term) for group in (*found, *against) for term in group)


def _grouped(terms: Mapping[Term, float]) -> list[tuple[Term, ...]]:
    """Return the terms in groups that are stated together: those of steering, the larger first."""
    steering = sorted((t for t in terms if t in STEERING), key=lambda t: -abs(terms[t]))
    single: list[tuple[Term, ...]] = [(t,) for t in terms if t not in STEERING]
    return [*single, tuple(steering)] if steering else single


def costs_of(model: CausalModel, plan: Intervention) -> dict[Term, float]:
    """Split the expected cost [s] of a plan into the terms of the reward."""
    costs = model.trace.reckoned
    cases = (_Case.of(costs, result).parts for result in plan.results)
    return _sum(zip(plan.weights, cases, strict=True))


@dataclass(frozen=True, slots=True)
class _Case:
    """The cost of one rollout, or the mean cost of several with the same outcome."""

    outcome: Outcome
    parts: dict[Term, float]  # [s]

    @staticmethod
    def of(costs: Costs, result: Result) -> "_Case":
        return _Case(result.rollout.outcome, _parts(costs, result))

    @property
    def total(self) -> float:
        return sum(self.parts.values())


def _split(there: _Case, here: _Case) -> dict[Term, float]:
    """Return how much more [s] one case costs than another, by term.

    If one of them is fatal, the whole difference counts for that outcome. If only one runs out of
    time, all but the effort counts as late. Two that run out of time differ by their terms, in
    which "late" stands for the way that is left.
    """
    fatal = [FATAL.get(case.outcome) for case in (there, here)]
    if fatal[0] is not None or fatal[1] is not None:
        if fatal[0] == fatal[1]:
            return {}
        if fatal[0] is not None and fatal[1] is not None:
            return {fatal[0]: there.total, fatal[1]: -here.total}
        return {fatal[0] or fatal[1] or "dead": there.total - here.total}
    terms = dict.fromkeys((*there.parts, *here.parts))  # in order: sums stay the same
    found = {t: there.parts.get(t, 0.0) - here.parts.get(t, 0.0) for t in terms}
    if (there.outcome == "termination") != (here.outcome == "termination"):
        effort = found.pop("effort", 0.0)
        return {"effort": effort, "late": sum(found.values())}
    return found


def _independent(costs: Costs, foil: Intervention, fact: Intervention) -> dict[Term, float]:
    """Return how much more [s] the foil costs if the two sides vary independently."""
    there, here = _by_outcome(costs, foil), _by_outcome(costs, fact)
    return _sum((w * v, _split(one, other)) for w, one in there for v, other in here)


def _by_outcome(costs: Costs, plan: Intervention) -> list[tuple[float, _Case]]:
    found: dict[Outcome, list[tuple[float, dict[Term, float]]]] = {}
    for result, weight in zip(plan.results, plan.weights, strict=True):
        case = _Case.of(costs, result)
        found.setdefault(case.outcome, []).append((weight, case.parts))
    masses = {outcome: sum(w for w, _ in cases) for outcome, cases in found.items()}
    return [
        (mass, _Case(outcome, {t: c / mass for t, c in _sum(found[outcome]).items()}))
        for outcome, mass in masses.items()
        if mass > 0.0
    ]


def _error(weights: list[float], values: list[float], covered: float) -> float:
    """Return the standard error of a weighted mean that covers a share of the mass.

    It is 0 for a single value.
    """
    count = len(values)
    if count < 2:
        return 0.0
    mean = sum(w * value for w, value in zip(weights, values, strict=True))
    squares = sum(w * w * (v - mean) ** 2 for w, v in zip(weights, values, strict=True))
    return math.sqrt(max(1.0 - covered, 0.0) * squares * count / (count - 1))


def _own_error(costs: Costs, plan: Intervention) -> float:
    values = [_Case.of(costs, result).total for result in plan.results]
    return _error(list(plan.weights), values, plan.coverage)


def _chances(foil: Mixture, fact: Mixture) -> dict[Term, tuple[float, float]]:
    """Return the probabilities of the outcomes other than arriving, under foil and fact."""
    there, here = chances(foil), chances(fact)
    names: dict[Outcome, Term] = {**FATAL, "termination": "late"}
    return {term: (there.of(outcome), here.of(outcome)) for outcome, term in names.items()}


def _sum(pairs: Iterable[tuple[float, dict[Term, float]]]) -> dict[Term, float]:
    found: dict[Term, float] = {}
    for weight, parts in pairs:
        for term, cost in parts.items():
            found[term] = found.get(term, 0.0) + weight * cost
    return found


def _mass(plan: Intervention, among: set[object]) -> float:
    pairs = zip(plan.results, plan.weights, strict=True)
    return sum(weight for result, weight in pairs if result.joint in among)


def _parts(costs: Costs, result: Result) -> dict[Term, float]:
    """Return the cost [s] of a rollout by term: as recorded, else by the costs of its trace.

    If these do not explain the reward of the rollout, all of it counts as time.
    """
    rollout = result.rollout
    if rollout.terms:
        found: dict[Term, float] = {}
        for name, cost in rollout.terms.items():
            term: Term = "late" if name == "left" else name
            found[term] = found.get(term, 0.0) + cost
        return found
    fatal = FATAL.get(rollout.outcome)
    if fatal is not None:
        return {fatal: -rollout.reward}
    trouble = sum(costs.effort.get(action, 0.0) for action in plan_of(rollout))
    time = rollout.components.get("time")
    if rollout.outcome == "termination" or time is None:
        return {"late": -rollout.reward - trouble, "effort": trouble}
    found = {"time": costs.weights["time"] * time, "effort": trouble}
    for name in COMPONENTS:
        value = rollout.components.get(name)
        if name != "time" and value is not None:
            found[name] = costs.weights[name] * value * time
    known = abs(sum(found.values()) + rollout.reward) <= ROUNDING
    return found if known else {"time": -rollout.reward}
