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
from collections.abc import Hashable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias, TypeVar

from planner.record.trace import Action, PlanTrace, Rollout
from xavi_dialogue.causal.mixtures import Joint, Mixture, Result
from xavi_dialogue.errors import XaviError

#: One vehicle's goal and trajectory, as indices into its prediction.
Choice: TypeAlias = tuple[int, int]
#: A sequence of macro actions: from the root of the search on.
Actions: TypeAlias = tuple[Action, ...]
Name = TypeVar("Name", bound=Hashable)

#: A continuation must be known for this share of the best-known one's prior mass.
SUPPORT = 0.5
CONFIDENCE = 0.05  # share of records that may exceed the bound on an error


class CausalError(XaviError):
    """A causal query that cannot be carried out."""


class InconsistentTrace(CausalError):
    """A rollout refers to what its trace does not predict."""


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
        """Build the network of a decision.

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
        self._shared: dict[Actions, dict[int, float]] = {}

    @property
    def vehicles(self) -> tuple[int, ...]:
        """The predicted vehicles, in increasing order."""
        return tuple(sorted(self._choices))

    def choices(self, vehicle: int) -> Mapping[Choice, float]:
        """Return p(G_i) p(S_i | G_i) for each goal and trajectory of a vehicle, as given."""
        return self._choices[vehicle]

    def prior(self, joint: Joint) -> float:
        """Return p(S), the product over vehicles, lights and phantoms of what was drawn."""
        index = self._index
        return index.priors[index.numbers[joint]]

    def options(self, node: Actions = ()) -> Actions:
        """Return the actions recorded at a node of the search, in order of first record."""
        if not node and not self.given:  # the most frequent query
            return tuple({r.actions[0].action: None for r in self.trace.rollouts if r.actions})
        reached = self._index.reached if self.given else self._plans
        depth = len(node)
        return tuple({p[depth]: None for p in reached if len(p) > depth and p[:depth] == node})

    @cached_property
    def _plans(self) -> dict[Actions, int]:
        """The distinct action sequences, in order of first record."""
        found: dict[Actions, int] = {}
        for rollout in self.trace.rollouts:
            found.setdefault(plan_of(rollout), len(found))
        return found

    def recorded(self) -> Iterator[tuple[Actions, Result]]:
        """Yield every distinct (actions, sample) with its result."""
        for plan, ended in self._index.ended.items():
            for result in ended.values():
                yield plan, result

    def intervene(self, do: Mapping[int, Action] | Actions) -> Intervention | None:
        """Return p(R, O | do(w)); the best continuation fills depths that w leaves open.

        The best continuation is the one by which the decision compared first actions. If there is
        none, it is the one of highest expected reward among the continuations that are known for
        at least SUPPORT of the prior mass of the best-known one.

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
        found = [one for one in found if one.plan in self._compared] or found
        most = max((intervention.coverage for intervention in found), default=0.0)
        known = [i for i in found if i.coverage >= SUPPORT * most]
        return max(known, key=lambda i: (i.value, i.coverage), default=None)

    @cached_property
    def _compared(self) -> frozenset[Actions]:
        """The action sequences by which the decision compared its first actions."""
        return frozenset(plan_of(r) for r in self.trace.rollouts if r.weight is not None)

    @cached_property
    def _index(self) -> "_Index":
        index, given = _Index({}, [], {(): {}}, {}), self.given
        joints, drawn = self._drawn()
        nodes: dict[Actions, list[dict[int, int]]] = {}
        for (plan, number), rollouts in drawn.items():
            joint, count = joints[number], len(rollouts)
            if given and any((g, way) not in given[v] for v, g, way in joint if v in given):
                continue
            if joint not in index.numbers:
                index.numbers[joint] = len(index.priors)
                index.priors.append(self._probability(joint, rollouts[0].index))
            known = index.numbers[joint]
            if plan not in nodes:
                parts = (plan[:depth] for depth in range(len(plan) + 1))
                nodes[plan] = [index.reached.setdefault(part, {}) for part in parts]
            for reached in nodes[plan]:
                reached[known] = reached.get(known, 0) + count
            searched = sum([not rollout.forced for rollout in rollouts])
            found = Result(joint, rollouts[0], count, searched)
            index.ended.setdefault(plan, {})[known] = found
        return index

    def _drawn(self) -> tuple[list[Joint], dict[tuple[Actions, int], list[Rollout]]]:
        """Return the samples, and the rollouts by (actions, number of a sample), in order."""
        numbers: dict[Joint, int] = {}
        found: dict[tuple[Actions, int], list[Rollout]] = {}
        for rollout in self.trace.rollouts:
            number = numbers.setdefault(self._joint(rollout), len(numbers))
            found.setdefault((plan_of(rollout), number), []).append(rollout)
        return list(numbers), found

    def _probability(self, joint: Joint, index: int) -> float:
        product = 1.0
        for vehicle, goal, way in joint:
            if vehicle < 0:
                product *= self._of_no_vehicle(-1 - vehicle, goal)
                continue
            try:
                product *= self._choices[vehicle][goal, way]
            except KeyError:
                raise InconsistentTrace(
                    f"rollout {index} samples goal {goal}, trajectory {way} of vehicle {vehicle}, "
                    "which the trace does not predict: check the indices of its samples"
                ) from None
        return product

    def _of_no_vehicle(self, number: int, drawn: int) -> float:
        """Return the probability of what was drawn for a light or for a phantom."""
        lights = self.trace.lights
        if number < len(lights):
            return lights[number].courses[drawn].probability
        coming = self.trace.phantoms[number - len(lights)].probability
        return coming if drawn else 1.0 - coming

    def _joint(self, rollout: Rollout) -> Joint:
        """Return the joint sample of a rollout: of other road users, lights and phantoms."""
        drawn = [(s.vehicle, s.goal, s.trajectory) for s in rollout.samples]
        drawn += [(self._lights[s.controller], s.course, 0) for s in rollout.lights]
        hidden = -1 - len(self.trace.lights)
        drawn += [(hidden - s.phantom, int(s.comes), 0) for s in rollout.phantoms]
        return tuple(sorted(drawn))

    def _known(self, plan: Actions) -> Intervention | None:
        if plan not in self._followed:
            self._followed[plan] = self._follow(plan)
        return self._followed[plan]

    def _follow(self, plan: Actions) -> Intervention | None:
        """Return the results under a complete plan; None if the record stops in its middle."""
        index = self._index
        if index.reached[plan].keys() - index.ended[plan].keys():
            return None
        results: list[Result] = []
        weights: list[float] = []
        for depth in range(len(plan) + 1):
            shares = self._shares(plan[:depth])
            for number, result in index.ended.get(plan[:depth], {}).items():
                results.append(result)
                weights.append(shares[number])
        total = sum(weights)
        if total <= 0.0:
            return None
        coverage = sum(index.priors[index.numbers[result.joint]] for result in results)
        return Intervention(tuple(results), tuple([w / total for w in weights]), plan, coverage)

    def _shares(self, node: Actions) -> dict[int, float]:
        """Return the weights of samples that reach a node: shares of the mass that goes on."""
        if node not in self._shared:
            index, mass = self._index, 1.0
            if node:
                ended = index.ended.get(node[:-1], {})
                before = self._shares(node[:-1])
                mass = sum([share for number, share in before.items() if number not in ended])
            reached = index.reached[node]
            priors = {number: index.priors[number] for number in reached}
            self._shared[node] = shared_out(priors, sum(reached.values()), mass)
        return self._shared[node]


@dataclass(frozen=True, slots=True)
class _Index:
    """The rollouts by the actions that they pass through; samples by their number."""

    numbers: dict[Joint, int]
    priors: list[float]  # of each sample
    reached: dict[Actions, dict[int, int]]  # node -> sample -> draws
    ended: dict[Actions, dict[int, Result]]


def shared_out(priors: dict[Name, float], draws: int, mass: float = 1.0) -> dict[Name, float]:
    """Return the weights of drawn samples, which stand for a population of some prior mass.

    Args:
        priors: of the samples drawn.
        draws: number of draws, repeats included.
        mass: of the population.
    """
    missing = max(mass - sum(priors.values()), 0.0)
    if missing <= 1e-9:
        return priors
    odds = [_undrawn(prior / mass, draws) for prior in priors.values()]
    total = sum(odds)
    if total <= 0.0:
        return priors
    shares = zip(priors.items(), odds, strict=True)
    return {name: prior + missing * odd / total for (name, prior), odd in shares}


def _undrawn(prior: float, draws: int) -> float:
    """Return the prior mass of undrawn samples that one drawn sample of a prior represents."""
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
    """Return the macro actions of a rollout."""
    return tuple([timed.action for timed in rollout.actions])


def _agrees(plan: Actions, do: Mapping[int, Action]) -> bool:
    return all(do.get(depth, action) == action for depth, action in enumerate(plan, start=1))
