"""Ranges by split-conformal prediction."""

import math
import random

import pytest

from xavi_dialogue.causal.conformal import reach


def alone(errors: list[float]) -> list[list[float]]:
    return [[error] for error in errors]


def test_it_is_the_rank_corrected_for_the_finite_number() -> None:
    # 39 errors: (39 + 1) * 0.9 = 36, the 36th smallest size.
    assert reach(alone([float(k) for k in range(39)])) == 35.0
    assert reach(alone([-float(k) for k in range(100)]), 0.8) == 80.0  # 101 * 0.8 = 80.8


@pytest.mark.parametrize(("n", "enough"), [(8, False), (9, True)])
def test_too_few_rides_give_no_range(n: int, enough: bool) -> None:
    assert (reach([[0.5, 0.7]] * n) is not None) is enough


def test_a_ride_of_many_cases_weighs_no_more_than_one_of_a_single_case() -> None:
    rides = alone([0.1 * k for k in range(39)])
    assert reach([*rides, [100.0] * 1000]) == reach([*rides, [100.0]])
    assert reach([*rides, *alone([100.0] * 5)]) == 100.0


def test_what_never_came_is_beyond_every_range() -> None:
    errors = [0.1 * k for k in range(95)]
    assert reach(alone([*errors, math.inf])) is not None
    assert reach(alone([*errors[:85], *[math.inf] * 11])) is None


def test_the_next_ride_lies_within_as_often_as_is_said() -> None:
    """Errors of one ride share a part; single errors would be taken for more than they tell."""
    draw = random.Random(5)

    def ride() -> list[float]:
        shared = draw.gauss(0.0, 1.0)
        return [shared + 0.1 * draw.random() for _ in range(draw.randint(1, 9))]

    held, tries, n = 0.0, 2000, 40
    for _ in range(tries):
        size = reach([ride() for _ in range(n)])
        assert size is not None
        new = ride()
        held += sum(abs(error) <= size for error in new) / len(new)
    assert 0.89 <= held / tries <= 0.93
