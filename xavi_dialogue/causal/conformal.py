"""Ranges that hold: split-conformal prediction (Vovk, Gammerman and Shafer 2005; Lei et al. 2018).

Forecasts are compared with what happened, in cases like those to come. Quantiles of the errors,
corrected for their finite number, bound the error of the next case. Cases of one ride are alike, so
rides must be exchangeable: each has the same weight, however many cases it has (hierarchical
conformal prediction, Lee, Barber and Willett 2023).
"""

import math
from collections.abc import Sequence

COVERAGE = 0.9


def reach(rides: Sequence[Sequence[float]], coverage: float = COVERAGE) -> float | None:
    """Return a bound on the size of an error in the next ride that holds with this probability.

    Each of n errors in k rides weighs 1 / ((k + 1) n), and what is left, 1 / (k + 1), lies beyond
    all of them; the quantile of their sizes at `coverage` is taken.

    Args:
        rides: the errors of each, at least one: happened minus foreseen, infinite if the foreseen
            event never happened.
        coverage: between 0 and 1.

    Returns:
        The bound; None if the rides are too few, or the errors too often infinite.
    """
    weighed = sorted(
        (abs(error), 1.0 / ((len(rides) + 1) * len(ride))) for ride in rides for error in ride
    )
    reached = 0.0
    for size, weight in weighed:
        reached += weight
        if reached >= coverage - 1e-9:
            return size if math.isfinite(size) else None
    return None
