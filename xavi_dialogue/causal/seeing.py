"""Seeing: the network conditioned on what is observed, where `intervene` sets the actions.

p(S, Omega, R, O | e) is proportional to p(S) p(Omega | S) p(R, O | Omega, S) over the rows that
agree with the evidence e. Here p(Omega | S) is the search as it went (XAVI, Gyevnar et al. 2022,
Equation 3): of the search's own rollouts of a sample, the share that took these actions; by the
chain rule the shares at the nodes on the way multiply to it. Forced rollouts do not count. As an
action is then evidence on the samples in which the search tried it, p(O | w) and p(O | do(w)) may
differ; explanations rest on the latter.
"""

from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

from planner.record.trace import Action, Outcome
from xavi_dialogue.causal.mixtures import Joint, Mixture, Result
from xavi_dialogue.causal.model import Actions, CausalModel, Choice, plan_of, shared_out

Value = TypeVar("Value", bound=Hashable)


@dataclass(frozen=True)
class Evidence:
    """The observed actions and choices; anything left out is not observed."""

    actions: Mapping[int, Action | None] = field(default_factory=dict)  # by depth; None: none
    choices: Mapping[int, frozenset[Choice]] = field(default_factory=dict)  # by vehicle
    outcome: Outcome | None = None

    def allows(self, result: Result) -> bool:
        """Check whether a result agrees with it."""
        plan = plan_of(result.rollout)
        return (
            self.outcome in (None, result.rollout.outcome)
            and all(_at(plan, depth) == action for depth, action in self.actions.items())
            and all((g, t) in self.choices[v] for v, g, t in result.joint if v in self.choices)
        )


@dataclass(frozen=True)
class Observation(Mixture):
    """p(S, Omega, R, O | evidence)."""

    probability: float  # of the evidence

    def choices(self, vehicle: int) -> dict[Choice, float]:
        """Return p(G_i, S_i | evidence), of the choices that are still possible."""
        return self._marginal(
            lambda result: next((g, t) for v, g, t in result.joint if v == vehicle)
        )

    def goals(self, vehicle: int) -> dict[int, float]:
        """Return p(G_i | evidence), by the index of the goal in its prediction."""
        return self._marginal(lambda result: next(g for v, g, _ in result.joint if v == vehicle))

    def actions(self, depth: int) -> dict[Action | None, float]:
        """Return p(Omega_d | evidence); the key None: no action at that depth."""
        return self._marginal(lambda result: _at(plan_of(result.rollout), depth))

    def plans(self) -> dict[Actions, float]:
        """Return p(Omega | evidence)."""
        return self._marginal(lambda result: plan_of(result.rollout))

    def _marginal(self, of: Callable[[Result], Value]) -> dict[Value, float]:
        found: dict[Value, float] = {}
        for result, weight in zip(self.results, self.weights, strict=True):
            value = of(result)
            found[value] = found.get(value, 0.0) + weight
        return found


class Search:
    """The observational side of the network of one decision; immutable once built."""

    def __init__(self, model: CausalModel) -> None:
        rows = [result for _, result in model.recorded() if result.searched]
        drawn: dict[Joint, int] = {}
        for result in rows:
            drawn[result.joint] = drawn.get(result.joint, 0) + result.searched
        priors = {joint: model.prior(joint) for joint in drawn}
        self.coverage = sum(priors.values())  # prior mass of the samples that the search drew
        shares = shared_out(priors, sum(drawn.values()))
        total = sum(shares.values())
        self._rows = [
            (result, shares[result.joint] / total * result.searched / drawn[result.joint])
            for result in rows
            if total > 0.0
        ]

    def policy(self, joint: Joint) -> dict[Actions, float]:
        """Return p(Omega | S = joint); empty if the search did not draw the sample."""
        found = {plan_of(r.rollout): float(r.searched) for r, _ in self._rows if r.joint == joint}
        return {plan: count / sum(found.values()) for plan, count in found.items()}

    def see(self, evidence: Evidence | None = None) -> Observation | None:
        """Return the network given evidence; None where the evidence has probability 0."""
        known = evidence or Evidence()
        rows = [(result, weight) for result, weight in self._rows if known.allows(result)]
        chance = sum(weight for _, weight in rows)
        if chance <= 0.0:
            return None
        results, weights = zip(*rows, strict=True)
        return Observation(results, tuple(weight / chance for weight in weights), chance)


def _at(plan: Actions, depth: int) -> Action | None:
    return plan[depth - 1] if 1 <= depth <= len(plan) else None
