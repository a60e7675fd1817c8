"""The Bayesian network of one decision: p(G) p(S|G) p(Omega|S) p(R,O|Omega,S).

After the network of XAVI (Gyevnar et al. 2022, Equations 1-6), with two arrows mended: the other
vehicles' trajectories S reach the rewards R and the outcome O, and components and outcome of a
rollout are one joint value, so that outcomes exclude one another. A rollout is a function of its
actions and samples; a distinct (actions, S) is kept once, with the number of times it was drawn.

Nothing is tabulated: the rollouts are indexed by the action sequences that they pass through,
and every query walks that index.

Errors:

    CausalError
    └── InconsistentTrace   a rollout refers to what its trace does not predict
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

from planner.trace import OUTCOMES, Action, Component, Outcome, PlanTrace, Rollout

#: One vehicle's goal and trajectory, as indices into its prediction.
Choice: TypeAlias = tuple[int, int]
#: The joint sample S: a choice for every predicted vehicle, as (vehicle, goal, trajectory), and
#: for every traffic light that was drawn, as (-1 - index in the trace, course, 0).
Joint: TypeAlias = tuple[tuple[int, int, int], ...]
#: A sequence of macro actions: from the root of the search on.
Actions: TypeAlias = tuple[Action, ...]

#: A continuation must be known for this share of the best-known one's prior mass.
SUPPORT = 0.5
CONFIDENCE = 0.05  # share of records that may exceed the bound on an error


class CausalError(Exception):
    """A causal query that cannot be carried out."""


class InconsistentTrace(CausalError):
    """A rollout refers to what its trace does not predict."""


@dataclass(frozen=True, slots=True)
class Result:
    """What came of one action sequence under one joint sample."""

    joint: Joint
    rollout: Rollout  # the first one recorded
    draws: int  # how often it was recorded
    searched: int  # of these, those that the search drew by itself: not forced


@dataclass(frozen=True)
class Mixture:
    """p(R, O): results with their weights."""

    results: tuple[Result, ...]  # each (actions, sample) once, in order of first record
    weights: tuple[float, ...]  # of the results; they sum to 1

    @property
    def draws(self) -> int:
        """Recorded rollouts behind it, repeats included."""
        return sum(result.draws for result in self.results)

    @cached_property
    def outcomes(self) -> dict[Outcome, float]:
        """p(O): exclusive, sums to 1."""
        found = dict.fromkeys(OUTCOMES, 0.0)
        for result, weight in zip(self.results, self.weights, strict=True):
            found[result.rollout.outcome] += weight
        return found

    @cached_property
    def value(self) -> float:
        """Expected reward."""
        pairs = zip(self.results, self.weights, strict=True)
        return sum(weight * result.rollout.reward for result, weight in pairs)

    @property
    def likeliest(self) -> Outcome:
        """The likeliest outcome; ties go to the earlier one in the order of OUTCOMES."""
        return max(OUTCOMES, key=lambda outcome: self.outcomes[outcome])

    def present(self, component: Component) -> list[tuple[Joint, float, float]]:
        """(sample, weight, value) of the results in which a component is present."""
        return [
            (result.joint, weight, value)
            for result, weight in zip(self.results, self.weights, strict=True)
            if (value := result.rollout.components.get(component)) is not None
        ]

    def presence(self, component: Component) -> float:
        """p(R_c is present)."""
        return sum(weight for _, weight, _ in self.present(component))

    def expectation(self, component: Component) -> float | None:
        """E[R_c] over the results in which c is present; None where it never is."""
        present = self.present(component)
        mass = sum(weight for _, weight, _ in present)
        return sum(weight * value for _, weight, value in present) / mass if mass > 0.0 else None

    def collisions(self) -> dict[int, float]:
        """Probability of a collision with each vehicle, by vehicle."""
        found: dict[int, float] = {}
        for result, weight in zip(self.results, self.weights, strict=True):
            vehicle = result.rollout.collided_with
            if result.rollout.outcome == "collision" and vehicle is not None:
                found[vehicle] = found.get(vehicle, 0.0) + weight
        return dict(sorted(found.items()))


@dataclass(frozen=True)
class Intervention(Mixture):
    """p(R, O | do(plan)): the results under a plan, one for each distinct sample.

    A sample weighs its prior. The prior mass of samples that were not drawn is shared out among
    those that were, in proportion to how easily samples like them go undrawn (Horvitz and
    Thompson 1952): with the prior alone, an average over few draws from many samples would lean
    towards the likely ones. At every depth of the plan the mass that goes on is shared out so.
    """

    plan: Actions
    coverage: float  # prior mass of the samples behind it

    @property
    def effective(self) -> float:
        """The number of equally weighty samples that would vary as much: 1 / sum of w squared."""
        return 1.0 / sum(weight * weight for weight in self.weights)

    @property
    def error(self) -> float:
        """Bound on the error of any probability in it that 95 % of records keep to.

        What is covered is known exactly, so the rest is all that can be wrong. The other bound
        is that of Hoeffding and Serfling (1974) for samples drawn without repeats.
        """
        rest = max(1.0 - self.coverage, 0.0)
        return min(rest, math.sqrt(rest * math.log(2.0 / CONFIDENCE) / (2.0 * self.effective)))


class CausalModel:
    """Answers causal queries about one decision; immutable, and indexed when first asked."""

    def __init__(self, trace: PlanTrace, given: Mapping[int, frozenset[Choice]] | None = None):
        """The network of a decision.

        Queries raise InconsistentTrace where a rollout samples what is not predicted.

        Args:
            trace: the record of the decision.
            given: evidence on other vehicles: the choices to which each is confined. The prior
                is renormalised over them.
        """
        self.trace = trace
        self.given = dict(given or {})
        self._choices = _choices(trace, self.given)
        self._lights = {one.controller: -1 - k for k, one in enumerate(trace.lights)}
        self._followed: dict[Actions, Intervention | None] = {}

    @property
    def vehicles(self) -> tuple[int, ...]:
        """The predicted vehicles, in increasing order."""
        return tuple(sorted(self._choices))

    def choices(self, vehicle: int) -> Mapping[Choice, float]:
        """p(G_i) p(S_i | G_i) for each goal and trajectory of a vehicle, as given."""
        return self._choices[vehicle]

    def prior(self, joint: Joint) -> float:
        """p(S), the product over vehicles of goal times trajectory probability."""
        return self._index.priors[joint]

    def options(self, node: Actions = ()) -> Actions:
        """The actions recorded at a node of the search, in order of first record."""
        reached = self._index.reached if self.given else map(plan_of, self.trace.rollouts)
        depth = len(node)
        return tuple({p[depth]: None for p in reached if len(p) > depth and p[:depth] == node})

    def recorded(self) -> Iterator[tuple[Actions, Result]]:
        """Every distinct (actions, sample) with what came of it."""
        for plan, ended in self._index.ended.items():
            for result in ended.values():
                yield plan, result

    def intervene(self, do: Mapping[int, Action] | Actions) -> Intervention | None:
        """p(R, O | do(w)), with the depths that w leaves open filled by the best continuation.

        The best is that of the highest expected reward among the continuations that are known
        for at least SUPPORT of the prior mass of the best-known one.

        Args:
            do: depth -> action, the first action having depth 1; or the leading actions.

        Returns:
            None where no rollout does so.
        """
        wanted = do if isinstance(do, Mapping) else dict(enumerate(do, start=1))
        found = [
            intervention
            for plan in self._index.ended
            if _agrees(plan, wanted) and (intervention := self._known(plan)) is not None
        ]
        most = max((intervention.coverage for intervention in found), default=0.0)
        known = [i for i in found if i.coverage >= SUPPORT * most]
        return max(known, key=lambda i: (i.value, i.coverage), default=None)

    @cached_property
    def _index(self) -> "_Index":
        drawn: dict[tuple[Actions, Joint], list[Rollout]] = {}
        for rollout in self.trace.rollouts:
            drawn.setdefault((plan_of(rollout), self._joint(rollout)), []).append(rollout)
        index = _Index({}, {(): {}}, {})
        for (plan, joint), rollouts in drawn.items():
            if any((goal, way) not in self.given[v] for v, goal, way in joint if v in self.given):
                continue
            if joint not in index.priors:
                index.priors[joint] = self._probability(joint, rollouts[0].index)
            for depth in range(len(plan) + 1):
                reached = index.reached.setdefault(plan[:depth], {})
                reached[joint] = reached.get(joint, 0) + len(rollouts)
            searched = sum(not rollout.forced for rollout in rollouts)
            found = Result(joint, rollouts[0], len(rollouts), searched)
            index.ended.setdefault(plan, {})[joint] = found
        return index

    def _probability(self, joint: Joint, index: int) -> float:
        product = 1.0
        for vehicle, goal, way in joint:
            if vehicle < 0:
                product *= self.trace.lights[-1 - vehicle].courses[goal].probability
                continue
            try:
                product *= self._choices[vehicle][goal, way]
            except KeyError:
                raise InconsistentTrace(
                    f"rollout {index} samples goal {goal}, trajectory {way} of vehicle {vehicle}, "
                    "which the trace does not predict: check the indices of its samples"
                ) from None
        return product

    def _joint(self, rollout: Rollout) -> Joint:
        """The joint sample of a rollout: of others and of lights."""
        drawn = [(s.vehicle, s.goal, s.trajectory) for s in rollout.samples]
        drawn += [(self._lights[s.controller], s.course, 0) for s in rollout.lights]
        return tuple(sorted(drawn))

    def _known(self, plan: Actions) -> Intervention | None:
        if plan not in self._followed:
            self._followed[plan] = self._follow(plan)
        return self._followed[plan]

    def _follow(self, plan: Actions) -> Intervention | None:
        """The results under a complete plan; None where the record stops in the middle of it."""
        index = self._index
        if index.reached[plan].keys() - index.ended[plan].keys():
            return None
        mass = 1.0
        results: list[Result] = []
        weights: list[float] = []
        for depth in range(len(plan) + 1):
            ended, reached = index.ended.get(plan[:depth], {}), index.reached[plan[:depth]]
            priors = {joint: index.priors[joint] for joint in reached}
            shares = shared_out(priors, sum(reached.values()), mass)
            for joint, result in ended.items():
                results.append(result)
                weights.append(shares[joint])
            mass = sum(share for joint, share in shares.items() if joint not in ended)
        total = sum(weights)
        if total <= 0.0:
            return None
        coverage = sum(index.priors[result.joint] for result in results)
        return Intervention(tuple(results), tuple(w / total for w in weights), plan, coverage)


@dataclass(frozen=True, slots=True)
class _Index:
    """The rollouts by the actions that they pass through."""

    priors: dict[Joint, float]
    reached: dict[Actions, dict[Joint, int]]  # node -> sample -> draws
    ended: dict[Actions, dict[Joint, Result]]


def shared_out(priors: dict[Joint, float], draws: int, mass: float = 1.0) -> dict[Joint, float]:
    """The weights of drawn samples, which stand for a population of some prior mass.

    Args:
        priors: of the samples drawn.
        draws: how many there were, repeats included.
        mass: of the population.
    """
    missing = max(mass - sum(priors.values()), 0.0)
    if missing <= 1e-9:
        return priors
    odds = {joint: _undrawn(prior / mass, draws) for joint, prior in priors.items()}
    total = sum(odds.values())
    if total <= 0.0:
        return priors
    return {joint: prior + missing * odds[joint] / total for joint, prior in priors.items()}


def _undrawn(prior: float, draws: int) -> float:
    """Prior mass of undrawn samples for which one drawn sample of a given prior stands."""
    missed = (1.0 - min(prior, 1.0)) ** draws
    return prior * missed / (1.0 - missed) if missed < 1.0 else 0.0


def _choices(
    trace: PlanTrace, given: Mapping[int, frozenset[Choice]]
) -> dict[int, dict[Choice, float]]:
    found: dict[int, dict[Choice, float]] = {}
    for prediction in trace.predictions:
        allowed = given.get(prediction.vehicle)
        weights = {
            (g, t): goal.probability * way.probability
            for g, goal in enumerate(prediction.goals)
            for t, way in enumerate(goal.trajectories)
            if allowed is None or (g, t) in allowed
        }
        total = sum(weights.values()) if allowed is not None else 1.0
        found[prediction.vehicle] = {c: w / total if total > 0 else 0.0 for c, w in weights.items()}
    return found


def plan_of(rollout: Rollout) -> Actions:
    """The macro actions of a rollout."""
    return tuple([timed.action for timed in rollout.actions])


def _agrees(plan: Actions, do: Mapping[int, Action]) -> bool:
    return all(do.get(depth, action) == action for depth, action in enumerate(plan, start=1))
