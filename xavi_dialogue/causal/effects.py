"""Effects: how the reward components would differ under a foil.

Equation 8 of XAVI (Gyevnar et al. 2022) with the sign of its example: counterfactual minus
factual, so that "lower" means lower under the foil.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from planner.record.trace import COMPONENTS, UNITS, Component
from planner.rollouts.reward import WEIGHTS
from xavi_dialogue.causal.mixtures import Joint
from xavi_dialogue.causal.model import Intervention

DRIVE = 10.0  # [s] a drive as long as rollouts typically are
#: What the planner holds worth a second of time on such a drive, in the unit of each component:
#: its reward counts w seconds per unit and second. Effects are ordered by their size relative to
#: it, which is the order of their share in the reward.
SCALES: dict[Component, float] = {
    name: 1.0 / WEIGHTS[name] if name == "time" else 1.0 / (WEIGHTS[name] * DRIVE)
    for name in COMPONENTS
}
LOW, HIGH = 0.05, 0.95  # the range covers the middle 90 % of the weight
PAIRED = 0.5  # share of either side's weight that must be matched for differences by sample


@dataclass(frozen=True, slots=True)
class ComponentEffect:
    """E[R_c | do(foil)] - E[R_c | do(fact)], over the rollouts in which c is present."""

    component: Component
    unit: str
    delta: float
    low: float
    high: float
    n: int  # simulations behind it, both sides, each counted once
    n_distinct: int  # distinct samples behind it, both sides

    @property
    def size(self) -> float:
        """The difference relative to the component's scale."""
        return abs(self.delta) / SCALES[self.component]


def effects(foil: Intervention, fact: Intervention) -> tuple[ComponentEffect, ...]:
    """Return the effects of doing the foil instead of the fact, largest first relative to SCALES.

    A component that is absent from all results of one side has no effect: how often it is
    present is the outcome's business. The range is that of the difference sample by sample where
    at least PAIRED of the weight of either side has a partner in the other; else the two sides
    vary independently. It is widened to hold the mean, which may lie outside in skewed cases.
    """
    found = [effect for name in COMPONENTS if (effect := _effect(name, foil, fact)) is not None]
    return tuple(sorted(found, key=lambda effect: -effect.size))


def quantile(values: NDArray[np.float64], weights: NDArray[np.float64], share: float) -> float:
    """Return the smallest value up to which lies at least `share` of the weight."""
    order = np.argsort(values, kind="stable")
    reached = np.cumsum(weights[order]) / np.sum(weights)
    return float(values[order][min(int(np.searchsorted(reached, share - 1e-9)), len(values) - 1)])


def _effect(name: Component, foil: Intervention, fact: Intervention) -> ComponentEffect | None:
    there, here = foil.present(name), fact.present(name)
    if not there or not here:
        return None
    expected, actual = foil.expectation(name), fact.expectation(name)
    if expected is None or actual is None:
        return None
    delta = expected - actual
    values, weights = _differences(there, here)
    involved = {joint for joint, _, _ in there} | {joint for joint, _, _ in here}
    return ComponentEffect(
        component=name,
        unit=UNITS[name],
        delta=delta,
        low=min(quantile(values, weights, LOW), delta),
        high=max(quantile(values, weights, HIGH), delta),
        n=len(there) + len(here),
        n_distinct=len(involved),
    )


def _differences(
    there: list[tuple[Joint, float, float]], here: list[tuple[Joint, float, float]]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return differences foil minus fact [K] and their weights [K]."""
    known = {joint: (weight, value) for joint, weight, value in here}
    pairs = [
        (value - known[joint][1], weight, known[joint][0])
        for joint, weight, value in there
        if joint in known
    ]
    matched = min(
        sum(pair[1] for pair in pairs) / sum(weight for _, weight, _ in there),
        sum(pair[2] for pair in pairs) / sum(weight for _, weight, _ in here),
    )
    if matched >= PAIRED:
        table = np.array(pairs)
        return table[:, 0], table[:, 1]
    foil, fact = np.array([row[1:] for row in there]), np.array([row[1:] for row in here])
    values = np.subtract.outer(foil[:, 1], fact[:, 1]).ravel()
    return values, np.multiply.outer(foil[:, 0], fact[:, 0]).ravel()
