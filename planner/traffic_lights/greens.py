"""The remaining time of a green: a prior, given how long it has been seen.

The prior is a lognormal. Its 5 % and 95 % points are SHORT and LONG, about the least and the
greatest greens that the Traffic Signal Timing Manual names as usual (FHWA 2008, FHWA-HOP-08-024,
Chapter 5).

The time that a green has lasted is taken into account. If it was not seen to begin, its first
sight is a random moment within greens, which meets long ones more often (the residual time of a
renewal process; Feller 1971, An Introduction to Probability Theory II, XI.4).
"""

import math
from collections.abc import Callable

SHORT, LONG = 7.0, 60.0  # [s] of green
MEDIAN = math.sqrt(SHORT * LONG)  # [s]
SIGMA = math.log(LONG / SHORT) / (2.0 * 1.645)


def residual(quantile: float, spent: float, *, begun: bool) -> float:
    """Return a quantile of the remaining time [s] of a green.

    Args:
        quantile: in (0, 1).
        spent: [s] for which it has been seen.
        begun: whether it was seen to begin.
    """
    survives: Callable[[float], float] = _survival if begun else _excess
    wanted = (1.0 - quantile) * survives(spent)
    low, high = spent, spent + LONG
    while survives(high) > wanted:
        low, high = high, high + LONG
    for _ in range(30):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if survives(middle) > wanted else (low, middle)
    return high - spent


def _survival(time: float) -> float:
    """Return the probability that a green lasts longer than some time [s]."""
    return 1.0 if time <= 0.0 else _normal((math.log(MEDIAN) - math.log(time)) / SIGMA)


def _excess(time: float) -> float:
    """Return the probability that a green lasts longer than a time [s] from a random moment on."""
    if time <= 0.0:
        return 1.0
    mean = MEDIAN * math.exp(0.5 * SIGMA**2)
    beyond = _normal((math.log(MEDIAN) + SIGMA**2 - math.log(time)) / SIGMA)
    return beyond - time / mean * _survival(time)


def _normal(x: float) -> float:
    return 0.5 * math.erfc(-x / math.sqrt(2.0))
