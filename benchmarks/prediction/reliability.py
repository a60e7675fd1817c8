"""Reliability of probabilities: how often predictions of each probability come true.

Bins are the bands of the words for probabilities (grammars/chances.toml). The
expected calibration error (ECE) is the mean distance between a bin's probabilities and its
frequency, weighted by cases (Naeini et al., AAAI 2015).
"""

import math
from collections.abc import Sequence
from itertools import pairwise

import msgspec
import numpy as np
from scipy.optimize import minimize_scalar

from benchmarks.prediction.foretold import Foretold
from benchmarks.prediction.goal_scores import FLOOR, Chances, clustered

EDGES = (0.0, 0.05, 0.15, 0.45, 0.55, 0.65, 0.85, 0.95, 1.0)


class Bin(msgspec.Struct, frozen=True):
    """The cases whose probability lies within two bounds."""

    low: float
    high: float  # exclusive, except in the last bin
    cases: int
    said: float  # mean probability
    true: float  # share that came true


class MapRow(msgspec.Struct, frozen=True):
    """The effect of a power on some networks."""

    networks: str
    power: float  # to which the probabilities of one vehicle are raised; their sum is kept
    moments: int
    ece: tuple[float, float]  # before and after
    log: tuple[float, float]  # log score before and after
    gain: float  # of the log score
    error: float  # standard error of the gain, over networks
    before: tuple[Bin, ...]
    after: tuple[Bin, ...]


POWERS = (0.05, 5.0)  # least and greatest power that are tried


def pairs(moments: Sequence[Foretold], power: float = 1.0) -> list[tuple[float, bool]]:
    """Return each probability of each road, raised to a power, and whether it was taken."""
    return [
        (chance, k == moment.truth)
        for moment in moments
        for k, chance in enumerate(mapped(moment.chances, power))
    ]


def bins(cases: Sequence[tuple[float, bool]]) -> tuple[Bin, ...]:
    """Put probabilities in [0, 1] into bins; empty bins are left out."""
    found = []
    for low, high in pairwise(EDGES):
        inside = [c for c in cases if low <= c[0] < high or (high == EDGES[-1] and c[0] >= high)]
        if inside:
            said = sum(chance for chance, _ in inside) / len(inside)
            true = sum(came for _, came in inside) / len(inside)
            found.append(Bin(low, high, len(inside), said, true))
    return tuple(found)


def ece(found: Sequence[Bin]) -> float:
    """Return the expected calibration error of bins, at least one."""
    cases = sum(one.cases for one in found)
    return sum(one.cases * abs(one.said - one.true) for one in found) / cases


def mapped(chances: Chances, power: float) -> Chances:
    """Raise the probabilities of roads to a power and scale them to the sum that they had.

    This is temperature scaling with the temperature 1 / power (Guo et al., ICML 2017).
    """
    powers = [chance**power if chance > 0.0 else 0.0 for chance in chances]
    total = sum(powers)
    if total == 0.0:
        return chances
    return tuple(sum(chances) * one / total for one in powers)


def fit(moments: Sequence[Foretold]) -> float:
    """Return the power with the best log score in some moments, at least one."""

    def loss(logarithm: float) -> float:
        return float(np.mean(logs_of(moments, math.exp(logarithm))))

    low, high = (math.log(power) for power in POWERS)
    found = minimize_scalar(loss, bounds=(low, high), method="bounded")
    return round(math.exp(float(found.x)), 3)


def logs_of(moments: Sequence[Foretold], power: float) -> list[float]:
    """Return the log score of each moment with its probabilities raised to a power."""
    return [-math.log(max(mapped(m.chances, power)[m.truth], FLOOR)) for m in moments]


def map_row(networks: str, power: float, moments: Sequence[Foretold]) -> MapRow:
    """Return the effect of a power on some moments, at least one."""
    plain, better = logs_of(moments, 1.0), logs_of(moments, power)
    before, after = bins(pairs(moments)), bins(pairs(moments, power))
    gains = [a - b for a, b in zip(plain, better, strict=True)]
    gain, error = clustered(gains, [moment.network for moment in moments])
    count = len(moments)
    return MapRow(
        networks=networks,
        power=power,
        moments=count,
        ece=(ece(before), ece(after)),
        log=(sum(plain) / count, sum(better) / count),
        gain=gain,
        error=error,
        before=before,
        after=after,
    )
