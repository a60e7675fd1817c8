"""Influence: how much the best option depends on what another vehicle does.

Per option o and choice c of vehicle i (its goal and trajectory), the action value Q(o, c) is the
expected reward of o given c. The other vehicles are adjusted for by an additive model fitted to
the rollouts of o, so that a chance coincidence of two vehicles' samples is not laid at the wrong
door. Then p(o | c) is the softmax of Q(o, c), and the influence is the mutual information of
option and choice, in bits. How much of it chance alone would produce is found by permuting the
residuals of a model without vehicle i among the rollouts (Freedman and Lane 1983).

A vehicle whose measure does not exceed the 95 % point of that null has no influence. Within a
vehicle, choices are ordered by the measure of XAVI (Gyevnar et al. 2022, Equation 9), smoothed.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from xavi_dialogue.causal.model import CausalModel, Choice, Intervention, Joint

Array = NDArray[np.float64]

RATIONALITY = 1.0  # [1/s] beta of the softmax; rewards count in seconds
PERMUTATIONS = 199
NULL_POINT = 0.95
MIN_BITS = 0.01  # a measure below this is none at all
SMOOTHING = 1e-3  # added to every probability of a divergence
RANK = 1e-6  # singular values below this share of the largest count as zero


@dataclass(frozen=True, slots=True)
class ChoiceInfluence:
    """What one choice of a vehicle makes of the options."""

    choice: Choice
    probability: float  # of the choice
    options: tuple[float, ...]  # p(o | choice), in the order of the options
    divergence: float  # [bit] of p(o) from p(o | choice), smoothed


@dataclass(frozen=True, slots=True)
class Influence:
    """How one vehicle bears on the choice among the options."""

    vehicle: int
    bits: float  # mutual information of option and the vehicle's choice
    null: float | None  # its 95 % point by chance alone; None where it is none at all anyway
    options: tuple[float, ...]  # p(o), averaged over the vehicle's choices
    choices: tuple[ChoiceInfluence, ...]  # least divergent first; ties: the likelier first

    @property
    def significant(self) -> bool:
        """Whether it exceeds what chance would produce."""
        return self.null is not None and self.bits > self.null + 1e-9


def influence(
    model: CausalModel, options: Sequence[Intervention] | None = None
) -> tuple[Influence, ...]:
    """The influence of every vehicle on the choice among options, largest first.

    Args:
        model: the network of the decision.
        options: what there is to choose from; every first action by default, which gives
            I(Omega_1; G_i, S_i).
    """
    if options is None:
        found = (model.intervene((action,)) for action in model.options())
        options = [intervention for intervention in found if intervention is not None]
    if len(options) < 2:
        return ()
    draws = [_Draws(model, option, k) for k, option in enumerate(options)]
    measured = [_measure(model, vehicle, draws) for vehicle in model.vehicles]
    return tuple(sorted(measured, key=lambda i: (-i.bits, i.vehicle)))


class _Draws:
    """The rollouts of one option as data: a row for each of its K distinct samples.

    Draws of one sample have equal rows, so that fitting the distinct ones by their weight is
    fitting all N draws; only the permutations are of draws.
    """

    def __init__(self, model: CausalModel, option: Intervention, number: int) -> None:
        joints = [result.joint for result in option.results]
        draws = np.array([result.draws for result in option.results])
        self.rewards: Array = np.array([result.rollout.reward for result in option.results])
        self.root: Array = np.sqrt(np.array(option.weights))  # [K] root of the weights
        self.columns = {
            vehicle: _one_hot(joints, vehicle, tuple(model.choices(vehicle)))
            for vehicle in model.vehicles
        }
        rng = np.random.default_rng((model.trace.seed, model.trace.decision, number))
        shuffled = np.argsort(rng.random((int(np.sum(draws)), PERMUTATIONS)), axis=0)
        self._draws: Array = draws[:, None]  # [K, 1]
        self._firsts: NDArray[np.int64] = np.cumsum(draws) - draws  # [K] first draw of each
        self._sources = np.repeat(np.arange(len(draws)), draws)[shuffled]  # [N, PERMUTATIONS]

    def fit(self, vehicle: int) -> "_Fit":
        """The additive model, with what one vehicle's choices add to the others'."""
        mean, wanted = float(np.sum(self.root**2 * self.rewards)), self.columns[vehicle]
        if wanted.shape[1] == 1:  # it has no choice
            return _Fit(mean, np.zeros(wanted.T.shape), np.zeros(len(wanted)))
        ones = np.ones((len(self.rewards), 1))
        others = [columns for name, columns in self.columns.items() if name != vehicle]
        design = np.hstack([ones, *(columns for columns in others if columns.shape[1] > 1)])
        root = self.root[:, None]
        targets = np.hstack([wanted, self.rewards[:, None]])
        fitted = np.linalg.pinv(root * design, rcond=RANK) @ (root * targets)
        rest = targets - design @ fitted
        rest[np.abs(rest) < 1e-9] = 0.0
        residual = rest[:, -1]
        if not np.any(residual):
            return _Fit(mean, np.zeros(wanted.T.shape), residual)
        slopes = np.linalg.pinv(root * rest[:, :-1], rcond=RANK) * self.root
        return _Fit(mean, slopes, residual)

    def permuted(self, residual: Array) -> Array:
        """Residuals [K] shuffled among the draws, in the mean of each sample [K, P]."""
        found: Array = np.add.reduceat(residual[self._sources], self._firsts, axis=0)
        return found / self._draws


@dataclass(frozen=True, slots=True)
class _Fit:
    """What the choices of one vehicle add to the reward of one option."""

    mean: float  # expected reward
    slopes: Array  # [choices, K]
    residual: Array  # [K] what the others leave of the reward

    def values(self, residuals: Array, prior: Array) -> Array:
        """Q(o, c) for columns of residuals [K, M]: [M, choices]."""
        shifts = self.slopes @ residuals
        return np.asarray(self.mean + shifts.T - (prior @ shifts)[:, None], dtype=np.float64)


def _measure(model: CausalModel, vehicle: int, draws: Sequence[_Draws]) -> Influence:
    choices = model.choices(vehicle)
    prior = np.array(list(choices.values()))
    fits = [option.fit(vehicle) for option in draws]
    observed = [fit.values(fit.residual[:, None], prior) for fit in fits]
    found, chances, pooled = _information(np.stack(observed, axis=1), prior)
    null = None
    if found[0] >= MIN_BITS:
        shuffled = [
            fit.values(option.permuted(fit.residual), prior)
            for option, fit in zip(draws, fits, strict=True)
        ]
        bits, _, _ = _information(np.stack(shuffled, axis=1), prior)
        null = float(np.sort(bits)[int(NULL_POINT * PERMUTATIONS)])
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
        null,
        tuple(pooled[0].tolist()),
        tuple(details),
    )


def _information(values: Array, prior: Array) -> tuple[Array, Array, Array]:
    """The mutual information of option and choice in bits [M], p(o | c) and p(o).

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
