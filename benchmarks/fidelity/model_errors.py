"""The error of the model behind rollouts: a bound on how often they are uninformative.

In a contamination model (Huber, Robust Statistics, 1981, 1.2) the rollouts are uninformative with
some probability. Then the outcome has a distribution of its own, that of the outcomes which were
not foreseen. Errors come in clusters, as whatever misleads the rollouts lasts for much of a ride.
The bound is therefore that of a jackknife over rides.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar
from scipy.stats import t as student

from planner.record.trace import OUTCOMES, Outcome

DOUBT = 0.05  # probability that the error is larger than its bound
PRIOR = 0.5  # prior number of cases of each outcome (Jeffreys 1946)
MOST = 0.9  # largest error
FLOOR = 1e-12


class Known(NamedTuple):
    """The actual outcome of one foil whose outcome was foreseen."""

    ride: str
    outcome: Outcome
    given: float  # probability of that outcome among the rollouts


class ModelError(NamedTuple):
    """The error of rollouts, with its bound."""

    mean: float  # fitted probability that they are uninformative
    bound: float  # upper bound of it with the probability 1 - DOUBT
    unforeseen: dict[Outcome, float]  # probability of each outcome if they are uninformative


def fitted(cases: Sequence[Known]) -> ModelError:
    """Fit how often rollouts are uninformative, and bound it from above.

    The bound adds a quantile of Student's t times the standard error by a jackknife over rides
    (Tukey 1958; Cameron and Miller 2015). It is no lower than the bound for so many rides without
    an error. Without cases no error is assumed.

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
    """Return the probability of each outcome (len(OUTCOMES),) among those not foreseen."""
    counts = PRIOR + np.bincount(kinds, 1.0 - given, len(OUTCOMES))
    return np.asarray(counts / counts.sum(), dtype=np.float64)


def _likeliest(given: NDArray[np.float64], base: NDArray[np.float64]) -> float:
    """Return the error of the greatest likelihood, by the outcomes' two probabilities."""

    def loss(error: float) -> float:
        return -float(np.sum(np.log(np.maximum((1.0 - error) * given + error * base, FLOOR))))

    return float(minimize_scalar(loss, bounds=(0.0, MOST), method="bounded").x)


def _margin(given: NDArray[np.float64], base: NDArray[np.float64], rides: Sequence[str]) -> float:
    """Return how much larger than fitted the error may be, leaving out each ride in turn."""
    names = list(dict.fromkeys(rides))
    if len(names) < 2:
        return MOST
    owners = np.array([names.index(ride) for ride in rides])
    left = np.array([_likeliest(given[owners != k], base[owners != k]) for k in range(len(names))])
    spread = (len(names) - 1) / len(names) * float(np.sum((left - left.mean()) ** 2))
    return float(student.ppf(1.0 - DOUBT, len(names) - 1)) * math.sqrt(spread)
