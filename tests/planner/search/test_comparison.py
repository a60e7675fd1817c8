"""The joint samples in which first actions are compared."""

import itertools
import math
import random
from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
import pytest

from planner.motion.obstacles import Motions, Obstacle
from planner.prediction.goals import Goal
from planner.prediction.recognise import Belief, Trajectory
from planner.record.trace import Sample
from planner.search.comparison import draw, likeliest, standard_error, weighted

Known: TypeAlias = dict[int, tuple[Belief, ...]]

STILL = Obstacle(1, 4.8, 1.8, np.zeros((1, 2)), np.zeros(1), np.zeros(1), frozenset())


def beliefs(*goals: Sequence[float]) -> tuple[Belief, ...]:
    """Goals, each with the joint probabilities of its trajectories."""
    return tuple(
        Belief(
            Goal("continue", "the road", None, 1.0),
            1.0,
            sum(ways),
            tuple(
                Trajectory(p / max(sum(ways), 1e-9), ("continue",), Motions(STILL)) for p in ways
            ),
        )
        for ways in goals
    )


FEW = {1: beliefs([0.6, 0.1], [0.3]), 4: beliefs([0.2], [0.8])}
MANY = {v: beliefs([0.5, 0.2], [0.2, 0.1]) for v in range(1, 7)}
SURE = {1: beliefs([0.995], [0.005])}


def probability(known: Known, samples: Sequence[Sample]) -> float:
    found = math.prod(
        known[s.vehicle][s.goal].probability
        * known[s.vehicle][s.goal].trajectories[s.trajectory].probability
        for s in samples
    )
    return float(found)


@pytest.mark.parametrize("known", [FEW, MANY, SURE, {}])
def test_all_joint_samples_come_once_the_likeliest_first(known: Known) -> None:
    found = list(likeliest(known))
    choices = [
        [(v, g, t) for g, goal in enumerate(own) for t in range(len(goal.trajectories))]
        for v, own in known.items()
    ]
    every = {tuple(Sample(*one) for one in joint) for joint in itertools.product(*choices)}
    assert {samples for samples, _ in found} == every
    assert len(found) == len(every)
    chances = [chance for _, chance in found]
    assert chances == sorted(chances, reverse=True) or np.all(np.diff(chances) < 1e-12)
    assert sum(chances) == pytest.approx(1.0)
    for samples, chance in found:
        assert chance == pytest.approx(probability(known, samples))


def test_what_cannot_be_is_left_out() -> None:
    assert len(list(likeliest({1: beliefs([1.0, 0.0], [0.0])}))) == 1


def test_few_are_enumerated_with_their_probabilities() -> None:
    found = dict(weighted(FEW, [], 24))
    assert len(found) == 6
    for samples, weight in found.items():
        assert weight == pytest.approx(probability(FEW, samples))


def test_what_is_next_to_certain_is_enough() -> None:
    ((samples, weight),) = weighted(SURE, [], 24)
    assert (samples, weight) == ((Sample(1, 0, 0),), 1.0)


def test_nobody_else_is_one_joint_sample() -> None:
    assert weighted({}, [()], 24) == [((), 1.0)]


def test_draws_stand_for_what_is_not_enumerated() -> None:
    known = {v: beliefs([0.8, 0.1], [0.1]) for v in range(1, 7)}
    rngs = {v: random.Random(v) for v in known}
    drawn = [draw(known, rngs) for _ in range(100)]
    found = weighted(known, drawn, 24)
    exact = [s for s, weight in found if weight == pytest.approx(probability(known, s))]
    assert exact == [s for s, _ in itertools.islice(likeliest(known), len(exact))]
    assert 1 <= len(exact) < len(found) <= 12
    assert {samples for samples, _ in found[len(exact) :]} <= set(drawn)
    assert sum(weight for _, weight in found) == pytest.approx(1.0)


def test_without_draws_the_rest_is_left_out() -> None:
    found = weighted(MANY, [], 8)
    assert [samples for samples, _ in found] == [s for s, _ in itertools.islice(likeliest(MANY), 4)]
    assert sum(weight for _, weight in found) == pytest.approx(1.0)


@pytest.mark.parametrize("likely", [0.5, 0.7, 0.85])
def test_the_estimate_is_without_bias(likely: float) -> None:
    """Its mean over many searches is the exact expectation of anything, and near it sooner."""
    known = {v: beliefs([likely, 0.7 * (1.0 - likely)], [0.3 * (1.0 - likely)]) for v in range(6)}
    worth = {
        samples: random.Random(str(samples)).gauss(0.0, 5.0) for samples, _ in likeliest(known)
    }
    exact = sum(chance * worth[samples] for samples, chance in likeliest(known))
    ours, plain = [], []
    for seed in range(400):
        rngs = {v: random.Random(f"{seed}/{v}") for v in known}
        drawn = [draw(known, rngs) for _ in range(100)]
        ours.append(sum(weight * worth[samples] for samples, weight in weighted(known, drawn, 24)))
        plain.append(sum(worth[samples] for samples in drawn[:12]) / 12)
    error = float(np.std(ours)) / math.sqrt(len(ours))
    assert abs(float(np.mean(ours)) - exact) < 4.0 * error
    assert np.std(ours) < 1.02 * np.std(plain)


def test_the_standard_error_is_that_of_a_mean_of_equal_weights() -> None:
    values = [3.0, 5.0, 10.0, 2.0]
    expected = float(np.std(values)) / math.sqrt(len(values))
    assert standard_error([0.25] * 4, values) == pytest.approx(expected)
    assert standard_error([0.5, 0.5], [4.0, 4.0]) == 0.0
