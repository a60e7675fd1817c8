"""Which joint samples are weighed, worked out for one vehicle with a few goals."""

from collections.abc import Sequence

import pytest

from planner.record.trace import Sample
from planner.search.comparison import Samples, weighted
from tests.planner.search.test_comparison import Known, beliefs


def goals(*chances: float) -> Known:
    """One vehicle with a way to each goal."""
    return {1: beliefs(*([chance] for chance in chances))}


def one(goal: int) -> Samples:
    return (Sample(1, goal, 0),)


FIVE = goals(0.4, 0.3, 0.1, 0.1, 0.1)


@pytest.mark.parametrize(
    ("known", "drawn", "most", "found"),
    [
        # Enough is 99 %: the first two make 99.1 %.
        (goals(0.98, 0.011, 0.009), [0], 5, {0: 0.98 / 0.991, 1: 0.011 / 0.991}),
        (goals(0.5, 0.3, 0.2), [], 3, {0: 0.5, 1: 0.3, 2: 0.2}),
        # Half of 4 are weighed: (1 - 0)^2 / 2 = 0.5 without any, 0.6^2 / 1 = 0.36 with one.
        (FIVE, [0, 2, 0, 1], 4, {0: 0.4, 2: 0.6}),
        (FIVE, [0, 0], 4, {0: 1.0}),  # no draw stands for the rest
        (FIVE, [], 4, {0: 0.4 / 0.7, 1: 0.3 / 0.7}),
        # 1/3, 0.36/2 and 0.09/1: two of three; draws of the same sample add up.
        (goals(0.4, 0.3, *[0.05] * 6), [3, 4], 6, {0: 0.4, 1: 0.3, 3: 0.3}),
        # Of equal ones none is enumerated: 1/4, 0.81/3, ...; four draws instead.
        (goals(*[0.1] * 10), [3, 4, 3, 9, 5], 8, {3: 0.5, 4: 0.25, 9: 0.25}),
        (goals(0.6, 0.4), [1, 0], 1, {1: 1.0}),  # at least one
        (goals(0.6, 0.4), [], 1, {0: 1.0}),
    ],
)
def test_what_is_weighed(
    known: Known, drawn: Sequence[int], most: int, found: dict[int, float]
) -> None:
    weights = weighted(known, [one(goal) for goal in drawn], most)
    assert {samples[0].goal: weight for samples, weight in weights} == pytest.approx(found)
    assert len(weights) == len(found)
