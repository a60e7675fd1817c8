"""The error of the model behind rollouts: how often they tell nothing of the outcome, at most.

With a probability the rollouts tell nothing, and the outcome comes from a distribution of its
own, that of the outcomes which were not foreseen: a contamination model (Huber, Robust
Statistics, 1981, 1.2). Errors come in clusters, as what misleads the rollouts lasts for much of a
ride: the bound is that of a jackknife over rides.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from scipy.stats import t as student

from planner.record.trace import OUTCOMES, Outcome

DOUBT = 0.05  # chance that the error is larger than its bound
PRIOR = 0.5  # cases of each outcome that are reckoned with from the start (Jeffreys 1946)
MOST = 0.9  # largest error
FLOOR = 1e-12


class Known(NamedTuple):
    """What came of one foil whose outcome was foreseen."""

    ride: str
    outcome: Outcome
    given: float  # probability of that outcome among the rollouts


class ModelError(NamedTuple):
    """How far rollouts are to be trusted."""

    mean: float  # probability that they tell nothing of the outcome, as fitted
    bound: float  # that it does not exceed, with the probability 1 - DOUBT
    unforeseen: dict[Outcome, float]  # how probable each outcome is where they tell nothing


def fitted(cases: Sequence[Known]) -> ModelError:
    """Fit how often rollouts tell nothing of the outcome, and bound it from above.

    The bound adds a quantile of Student's t of standard errors by a jackknife over rides (Tukey
    1958; Cameron and Miller 2015), and is no lower than what not one error in as many rides
    proves. Without cases nothing is known to be wrong.

    Args:
        cases: foils of which outcomes were foreseen.
    """
    if not cases:
        return ModelError(0.0, 0.0, {})
    given = np.array([case.given for case in cases])
    kinds = np.array([OUTCOMES.index(case.outcome) for case in cases])
    shares = _shares(np.minimum(given, 1.0), kinds)
    base = shares[kinds]
    mean = _likeliest(given, base)
    rides = [case.ride for case in cases]
    bound = max(mean + _margin(given, base, rides), 1.0 - DOUBT ** (1.0 / len(set(rides))))
    unforeseen = {name: round(float(p), 4) for name, p in zip(OUTCOMES, shares, strict=True)}
    return ModelError(round(mean, 4), round(min(bound, MOST), 4), unforeseen)


def _shares(given: NDArray[np.float64], kinds: NDArray[np.int_]) -> NDArray[np.float64]:
    """Return how probable each outcome (len(OUTCOMES),) is among those that were not foreseen."""
    counts = PRIOR + np.bincount(kinds, 1.0 - given, len(OUTCOMES))
    return np.asarray(counts / counts.sum(), dtype=np.float64)


def _likeliest(given: NDArray[np.float64], base: NDArray[np.float64]) -> float:
    """The error under which what happened is likeliest, by its probabilities with and without."""

    def loss(error: float) -> float:
        return -float(np.sum(np.log(np.maximum((1.0 - error) * given + error * base, FLOOR))))

    return float(minimize_scalar(loss, bounds=(0.0, MOST), method="bounded").x)


def _margin(given: NDArray[np.float64], base: NDArray[np.float64], rides: Sequence[str]) -> float:
    """By how much the error may be larger than fitted, by leaving out each ride in turn."""
    names = list(dict.fromkeys(rides))
    if len(names) < 2:
        return MOST
    owners = np.array([names.index(ride) for ride in rides])
    left = np.array([_likeliest(given[owners != k], base[owners != k]) for k in range(len(names))])
    spread = (len(names) - 1) / len(names) * float(np.sum((left - left.mean()) ** 2))
    return float(student.ppf(1.0 - DOUBT, len(names) - 1)) * math.sqrt(spread)
