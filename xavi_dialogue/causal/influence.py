"""Influence: how much the best option depends on what another vehicle does.

Per option o and choice c of vehicle i (its goal and trajectory), the action value Q(o, c) is the
expected reward of o given c. The other vehicles are adjusted for by an additive model fitted to
the rollouts of o, so that a chance coincidence of two vehicles' samples is not attributed to the
wrong one. Then p(o | c) is the softmax of Q(o, c), and the influence is the mutual information of
option and choice, in bits.

How much of it chance alone would produce is found by permutation: what a model of the other
vehicles leaves of the reward is shuffled among the draws, which is to say among the choices of
vehicle i. These were drawn without regard to anybody else. So where the reward does not depend
on them, all assignments are as probable, and the test is exact for any number of draws (Fisher's
randomisation test; Edgington and Onghena 2007). The statistic is the mutual information again,
of the plain means of what is left, each draw counting as one. Options share their shuffles where
they share their samples.

Several vehicles are tested at once, so the probability that any of those without influence is
stated to have one is kept to 5 % by the step-down procedure of Holm (1979). Within a vehicle,
choices are ordered by the measure of XAVI (Gyevnar et al. 2022, Equation 9), smoothed.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property, partial

import numpy as np
from numpy.typing import NDArray

from xavi_dialogue.causal.mixtures import Joint
from xavi_dialogue.causal.model import CausalModel, Choice, Intervention

Array = NDArray[np.float64]

RATIONALITY = 1.0  # [1/s] beta of the softmax; rewards count in seconds
PERMUTATIONS = 499
FALSE_ALARMS = 0.05  # probability that any vehicle without influence is stated to have one
MIN_BITS = 0.01  # a measure below this is none at all
SMOOTHING = 1e-3  # added to every probability of a divergence
RANK = 1e-6  # singular values below this share of the largest count as zero


@dataclass(frozen=True, slots=True)
class ChoiceInfluence:
    """The probabilities of options under one choice of a vehicle."""

    choice: Choice
    probability: float  # of the choice
    options: tuple[float, ...]  # p(o | choice), in the order of the options
    divergence: float  # [bit] of p(o) from p(o | choice), smoothed


@dataclass(frozen=True, slots=True)
class Influence:
    """The influence of one vehicle on the choice among the options."""

    vehicle: int
    bits: float  # mutual information of option and the vehicle's choice
    chance: float  # p-value of so much by chance alone; 1 if there is no influence at all
    options: tuple[float, ...]  # p(o), averaged over the vehicle's choices
    choices: tuple[ChoiceInfluence, ...]  # least divergent first; ties: the likelier first
    adjusted: float = 1.0  # the p-value by Holm, for all vehicles that were tested

    @property
    def significant(self) -> bool:
        """Whether it exceeds what chance would produce."""
        return self.adjusted <= FALSE_ALARMS


def influence(
    model: CausalModel, options: Sequence[Intervention] | None = None
) -> tuple[Influence, ...]:
    """Return the influence of every vehicle on the choice among options, largest first.

    Args:
        model: the network of the decision.
        options: the options to choose from; every first action by default, which gives
            I(Omega_1; G_i, S_i).
    """
    if options is None:
        found = (model.intervene((action,)) for action in model.options())
        options = [intervention for intervention in found if intervention is not None]
    if len(options) < 2:
        return ()
    numbers = cache(partial(_keys, model))
    draws = [_Draws(model, option, numbers) for option in options]
    measured = [_measure(model, vehicle, draws) for vehicle in model.vehicles]
    adjusted = holm([one.chance for one in measured])
    tested = [replace(one, adjusted=p) for one, p in zip(measured, adjusted, strict=True)]
    return tuple(sorted(tested, key=lambda i: (-i.bits, i.vehicle)))


def holm(chances: Sequence[float]) -> tuple[float, ...]:
    """Adjust p-values for their number, in their order: the step-down procedure of Holm (1979).

    The k-th smallest of m is multiplied by m - k + 1; none is smaller than one before it.
    """
    adjusted, largest = [1.0] * len(chances), 0.0
    for rank, k in enumerate(sorted(range(len(chances)), key=lambda k: chances[k])):
        largest = max(largest, min(chances[k] * (len(chances) - rank), 1.0))
        adjusted[k] = largest
    return tuple(adjusted)


@dataclass(frozen=True, slots=True)
class _Fit:
    """The contribution of one vehicle's choices to the reward of one option."""

    mean: float  # expected reward
    slopes: Array  # [choices, K]
    residual: Array  # [K] reward that the others do not explain

    def values(self, residuals: Array, prior: Array) -> Array:
        """Return Q(o, c) for columns of residuals [K, M]: [M, choices]."""
        shifts = self.slopes @ residuals
        return np.asarray(self.mean + shifts.T - (prior @ shifts)[:, None], dtype=np.float64)


class _Draws:
    """The rollouts of one option as data: a row for each of its K distinct samples.

    Draws of one sample have equal rows, so that fitting the distinct ones by their weight is
    fitting all N draws; only the permutations are of draws.
    """

    def __init__(
        self, model: CausalModel, option: Intervention, keys: Callable[[Joint, int], Array]
    ) -> None:
        joints = [result.joint for result in option.results]
        draws = np.array([result.draws for result in option.results])
        self.rewards: Array = np.array([result.rollout.reward for result in option.results])
        self.root: Array = np.sqrt(np.array(option.weights))  # [K] root of the weights
        self.columns = {
            vehicle: _one_hot(joints, vehicle, tuple(model.choices(vehicle)))
            for vehicle in model.vehicles
        }
        self._keys, self._joints = keys, joints
        self._designs: dict[int, Array] = {}  # of the others, by vehicle
        self._counts: NDArray[np.int64] = draws  # [K]
        self._draws: Array = draws[:, None]  # [K, 1]
        self._firsts: NDArray[np.int64] = np.cumsum(draws) - draws  # [K] first draw of each

    @cached_property
    def _sources(self) -> NDArray[np.int64]:
        """The sample [N, PERMUTATIONS] that each draw's reward is taken from in each shuffle."""
        draws = self._counts
        pairs = zip(self._joints, draws, strict=True)
        shuffled = np.argsort(np.vstack([self._keys(j, int(n)) for j, n in pairs]), axis=0)
        return np.asarray(np.repeat(np.arange(len(draws)), draws)[shuffled], dtype=np.int64)

    def fit(self, vehicle: int) -> _Fit:
        """Return the additive model, with what one vehicle's choices add to the others'."""
        mean, wanted = float(np.sum(self.root**2 * self.rewards)), self.columns[vehicle]
        if wanted.shape[1] == 1 or not np.ptp(self.rewards):  # one choice, or all rewards equal
            return _Fit(mean, np.zeros(wanted.T.shape), np.zeros(len(wanted)))
        design, root = self._others(vehicle), self.root[:, None]
        targets = np.hstack([wanted, self.rewards[:, None]])
        fitted = np.linalg.pinv(root * design, rcond=RANK) @ (root * targets)
        rest = targets - design @ fitted
        rest[np.abs(rest) < 1e-9] = 0.0
        residual = rest[:, -1]
        if not np.any(residual):
            return _Fit(mean, np.zeros(wanted.T.shape), residual)
        slopes = np.linalg.pinv(root * rest[:, :-1], rcond=RANK) * self.root
        return _Fit(mean, slopes, residual)

    def _others(self, vehicle: int) -> Array:
        """Return the choices of the other vehicles [K, M], and a constant."""
        if vehicle not in self._designs:
            others = [columns for name, columns in self.columns.items() if name != vehicle]
            varied = [columns for columns in others if columns.shape[1] > 1]
            design = np.concatenate([np.ones((len(self.rewards), 1)), *varied], axis=1)
            self._designs[vehicle] = design
        return self._designs[vehicle]

    def plain(self, vehicle: int) -> _Fit:
        """Fit the others' choices alone, and take means of the rest; each draw counts as one."""
        design, root, own = self._others(vehicle), np.sqrt(self._draws), self.columns[vehicle]
        fitted = np.linalg.pinv(root * design, rcond=RANK) @ (root[:, 0] * self.rewards)
        rest = self.rewards - design @ fitted
        rest[np.abs(rest) < 1e-9] = 0.0
        counts = own * self._draws  # [K, choices]
        means = counts / np.maximum(np.sum(counts, axis=0), 1.0)
        return _Fit(float(np.sum(self.root**2 * self.rewards)), means.T, rest)

    def permuted(self, residual: Array) -> Array:
        """Return residuals [K] shuffled among the draws, averaged over each sample [K, P]."""
        if not np.any(residual):
            return np.zeros((len(residual), PERMUTATIONS))
        drawn: Array = residual[self._sources]
        if len(drawn) == len(residual):  # each sample once
            return drawn
        found: Array = np.add.reduceat(drawn, self._firsts, axis=0)
        return found / self._draws


def _measure(model: CausalModel, vehicle: int, draws: Sequence[_Draws]) -> Influence:
    choices = model.choices(vehicle)
    prior = np.array(list(choices.values()))
    fits = [option.fit(vehicle) for option in draws]
    observed = [fit.values(fit.residual[:, None], prior) for fit in fits]
    found, chances, pooled = _information(np.stack(observed, axis=1), prior)
    chance = 1.0
    if found[0] >= MIN_BITS:
        chance = _chance(vehicle, draws, prior)
    details = [
        ChoiceInfluence(
            choice,
            float(prior[k]),
            tuple(chances[0, :, k].tolist()),
            divergence(pooled[0], chances[0, :, k]),
        )
        for k, choice in enumerate(choices)
    ]
    details.sort(key=lambda d: (round(d.divergence, 6), -d.probability, d.choice))
    return Influence(
        vehicle,
        max(float(found[0]), 0.0),
        chance,
        tuple(pooled[0].tolist()),
        tuple(details),
    )


def _chance(vehicle: int, draws: Sequence[_Draws], prior: Array) -> float:
    """Return the probability of at least so much information if choices were shuffled."""
    plain = [option.plain(vehicle) for option in draws]
    pairs = list(zip(draws, plain, strict=True))
    shuffled = [fit.values(option.permuted(fit.residual), prior) for option, fit in pairs]
    seen = [fit.values(fit.residual[:, None], prior) for fit in plain]
    null, _, _ = _information(np.stack(shuffled, axis=1), prior)
    here, _, _ = _information(np.stack(seen, axis=1), prior)
    return float(1 + np.count_nonzero(null >= here[0] - 1e-9)) / (PERMUTATIONS + 1)


def _keys(model: CausalModel, joint: Joint, draws: int) -> Array:
    """Return random numbers [draws, PERMUTATIONS] that depend on the sample, not on the option."""
    flat = [number % 2**32 for choice in joint for number in choice]
    return np.random.default_rng((model.trace.seed, model.trace.decision, *flat)).random(
        (draws, PERMUTATIONS)
    )


def _information(values: Array, prior: Array) -> tuple[Array, Array, Array]:
    """Return the mutual information of option and choice in bits [M], p(o | c) and p(o).

    Args:
        values: Q(o, c), [M, options, choices].
        prior: p(c), [choices].
    """
    weights = np.exp(RATIONALITY * (values - np.max(values, axis=1, keepdims=True)))
    chances = weights / np.sum(weights, axis=1, keepdims=True)
    pooled = chances @ prior
    ratio = np.log2(np.maximum(chances, 1e-300) / np.maximum(pooled[:, :, None], 1e-300))
    return np.sum(chances * ratio, axis=1) @ prior, chances, pooled


def divergence(p: Array, q: Array) -> float:
    """Kullback-Leibler divergence D[p || q] in bits, of distributions smoothed by SMOOTHING."""
    a, b = p + SMOOTHING, q + SMOOTHING
    a, b = a / np.sum(a), b / np.sum(b)
    return float(np.sum(a * np.log2(a / b)))


def _one_hot(joints: Sequence[Joint], vehicle: int, choices: Sequence[Choice]) -> Array:
    column = {choice: k for k, choice in enumerate(choices)}
    found = np.zeros((len(joints), len(choices)))
    for row, joint in enumerate(joints):
        for name, goal, way in joint:
            if name == vehicle:
                found[row, column[goal, way]] = 1.0
    return found
