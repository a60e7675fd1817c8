"""The error of the model behind rollouts, and its bound, on cases made up for it."""

import pytest

from benchmarks.fidelity.model_errors import MOST, Known, fitted
from xavi_dialogue.explain.causes.plans.ranges import Ranges, Source


def rides(wrong: list[int], each: int = 10) -> list[Known]:
    """Rides of so many foils each, of which so many end in a collision that was not foreseen."""
    return [
        Known(f"ride-{k}", "collision" if n < bad else "done", 0.0 if n < bad else 1.0)
        for k, bad in enumerate(wrong)
        for n in range(each)
    ]


def test_the_error_is_the_share_of_outcomes_that_were_not_foreseen() -> None:
    """Nearly: of ten that were certain one came otherwise, and what came so was a collision."""
    found = fitted(rides([1] * 40))
    assert found.mean == pytest.approx(0.1, abs=0.01)
    assert sum(found.unforeseen.values()) == pytest.approx(1.0, abs=1e-3)
    assert found.unforeseen["collision"] > 0.9
    done = (1.0 - found.mean) + found.mean * found.unforeseen["done"]
    assert done == pytest.approx(0.9, abs=2e-3)


def test_errors_that_come_in_clusters_widen_the_bound() -> None:
    """As many errors are less sure a mean where four rides hold them all."""
    spread, heaped = fitted(rides([1] * 40)), fitted(rides([10] * 4 + [0] * 36))
    assert spread.mean == pytest.approx(heaped.mean, abs=1e-3)
    assert spread.mean <= spread.bound < spread.mean + 0.01  # each ride alike: nearly no margin
    # With the error 1 in 4 of 40 rides, its standard error is sqrt(0.1 * 0.9 / 39) = 0.048, and
    # 5 % of Student's t with 39 degrees of freedom lie beyond 1.685.
    assert heaped.bound - heaped.mean == pytest.approx(1.685 * 0.048, abs=0.01)


def test_no_bound_is_lower_than_rides_without_errors_prove() -> None:
    found = fitted(rides([0] * 30))
    assert found.mean == pytest.approx(0.0, abs=1e-3)
    assert found.bound == pytest.approx(1.0 - 0.05 ** (1.0 / 30.0), abs=1e-4)


def test_one_ride_proves_next_to_nothing_and_none_nothing() -> None:
    assert fitted(rides([1])).bound == MOST
    assert fitted([]) == (0.0, 0.0, {})


def test_outcomes_are_told_with_what_comes_where_rollouts_fail() -> None:
    source = Source("", {}, 0, 0, 0)
    known = Ranges(0.9, 1.0, (), source, 0.1, {"done": 0.2, "termination": 0.7, "collision": 0.1})
    told = {name: known.trusted(name, p) for name, p in (("done", 1.0), ("collision", 0.0))}
    assert told == {"done": pytest.approx(0.92), "collision": pytest.approx(0.01)}
    alike = Ranges(0.9, 1.0, (), source, 0.1)
    assert alike.trusted("done", 1.0) == pytest.approx(0.925)
