"""Scores of goal probabilities: log score, Brier score and top-1, for us and simple rivals."""

import math
from collections.abc import Callable, Mapping, Sequence

import msgspec

from benchmarks.prediction.foretold import Foretold
from planner.record.trace import Action

FLOOR = 0.01  # least probability for the log score, as recognition drops lower ones
OURS, UNIFORM, COMMONEST = "ours", "uniform", "commonest"
Chances = tuple[float, ...]


class Score(msgspec.Struct, frozen=True):
    """The mean scores of some probabilities."""

    log: float  # negative natural logarithm of the probability of the truth
    brier: float  # squared error, summed over the roads: 0 to 2
    top: float  # share in which the truth is the likeliest; ties share it


class GoalRow(msgspec.Struct, frozen=True):
    """The mean scores of some moments."""

    group: str
    moments: int
    approaches: int
    scores: dict[str, Score]  # by method
    ahead: float  # log score of the better rival minus ours
    error: float  # standard error of that, over networks


def score(chances: Chances, truth: int) -> Score:
    """Score the probabilities of one moment.

    Args:
        chances: probability of each road, with a sum up to 1.
        truth: index of the road that was taken.
    """
    best = max(chances) - 1e-9
    likeliest = [k for k, chance in enumerate(chances) if chance >= best]
    return Score(
        log=-math.log(max(chances[truth], FLOOR)),
        brier=sum((chance - (k == truth)) ** 2 for k, chance in enumerate(chances)),
        top=(truth in likeliest) / len(likeliest),
    )


def rates(moments: Sequence[Foretold]) -> dict[Action, float]:
    """Return how often a road of each kind is taken when there is one."""
    offered: dict[Action, int] = {}
    taken: dict[Action, int] = {}
    for moment in moments:
        for k, kind in enumerate(moment.kinds):
            offered[kind] = offered.get(kind, 0) + 1
            taken[kind] = taken.get(kind, 0) + (k == moment.truth)
    return {kind: taken[kind] / offered[kind] for kind in offered}


def uniform(moment: Foretold) -> Chances:
    """Return the same probability for each road, and none for stopping, which nobody does here."""
    return (1.0 / len(moment.chances),) * len(moment.chances)


def commonest(moment: Foretold, often: Mapping[Action, float]) -> Chances:
    """Return probabilities in proportion to how often roads of that kind are taken."""
    weights = [often.get(kind, 0.0) for kind in moment.kinds]
    total = sum(weights)
    return tuple(weight / total for weight in weights) if total else uniform(moment)


def goal_rows(
    moments: Sequence[Foretold], groups: Sequence[tuple[str, Callable[[Foretold], bool]]]
) -> tuple[GoalRow, ...]:
    """Return the rows of groups of moments; those without any are left out.

    The commonest kinds are counted in these very moments, which favours that rival.
    """
    often = rates(moments)
    found = []
    for name, belongs in groups:
        chosen = [moment for moment in moments if belongs(moment)]
        if chosen:
            found.append(_row(name, chosen, often))
    return tuple(found)


def _row(name: str, moments: Sequence[Foretold], often: Mapping[Action, float]) -> GoalRow:
    single = {
        OURS: [score(m.chances, m.truth) for m in moments],
        UNIFORM: [score(uniform(m), m.truth) for m in moments],
        COMMONEST: [score(commonest(m, often), m.truth) for m in moments],
    }
    scores = {method: average(found) for method, found in single.items()}
    rival = min((UNIFORM, COMMONEST), key=lambda method: scores[method].log)
    gains = [b.log - a.log for a, b in zip(single[OURS], single[rival], strict=True)]
    ahead, error = clustered(gains, [m.network for m in moments])
    approaches = len({(m.network, m.vehicle, m.kinds) for m in moments})
    return GoalRow(name, len(moments), approaches, scores, ahead, error)


def average(scores: Sequence[Score]) -> Score:
    """Return the mean of some scores, at least one."""
    count = len(scores)
    return Score(
        sum(s.log for s in scores) / count,
        sum(s.brier for s in scores) / count,
        sum(s.top for s in scores) / count,
    )


def clustered(values: Sequence[float], clusters: Sequence[str]) -> tuple[float, float]:
    """Return the mean of values and its standard error, given clusters of dependent values.

    The error is that of a ratio of cluster totals (Cochran, Sampling Techniques, 1977, 6.3).
    """
    mean = sum(values) / len(values)
    sums: dict[str, float] = {}
    for value, cluster in zip(values, clusters, strict=True):
        sums[cluster] = sums.get(cluster, 0.0) + value - mean
    count = len(sums)
    spread = sum(total**2 for total in sums.values()) * count / max(count - 1, 1)
    return mean, math.sqrt(spread) / len(values)
