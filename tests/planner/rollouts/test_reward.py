"""What a drive costs, worked out by hand."""

import math

import numpy as np
import pytest

from planner.record.trace import Action, Component, Outcome, RewardTerm
from planner.rollouts.reward import EFFORT, PENALTY, WEIGHTS, absent, components, reward, terms

DRIVEN: dict[Component, float] = {
    "time": 10.0,
    "jerk": 0.5,
    "angular-acceleration": 0.1,
    "curvature": 0.01,
}
#: The same in seconds: 0.05 x 0.5 x 10, 4 x 0.1 x 10, and 20 x 0.01 x 10.
SPENT: dict[RewardTerm, float] = {
    "time": 10.0,
    "jerk": 0.25,
    "angular-acceleration": 4.0,
    "curvature": 2.0,
}


def test_components_are_means_per_second() -> None:
    found = components(
        3.0, np.array([10.0, 5.0, 20.0]), np.array([0.0, 1.0, -1.0]), np.array([0.0, 0.1, -0.2])
    )
    # Accelerations change by 1 and 2, turning (0, 0.5, -4) by 0.5 and 4.5, in 0.2 s each.
    assert found == pytest.approx(
        {"time": 3.0, "jerk": 7.5, "angular-acceleration": 12.5, "curvature": 0.1}
    )


@pytest.mark.parametrize("samples", [0, 1])
def test_a_moment_has_no_changes(samples: int) -> None:
    one = np.full(samples, 4.0)
    nothing = {"jerk": 0.0, "angular-acceleration": 0.0, "curvature": 0.0}
    assert components(0.5, one, one, one) == {"time": 0.5, **nothing}


def test_two_samples_have_one_change() -> None:
    found = components(0.2, np.array([4.0, 4.0]), np.array([0.0, 0.3]), np.array([0.1, 0.1]))
    assert found == pytest.approx(
        {"time": 0.2, "jerk": 1.5, "angular-acceleration": 0.0, "curvature": 0.1}
    )


def test_who_does_not_arrive_has_no_components() -> None:
    assert absent() == dict.fromkeys(DRIVEN)


@pytest.mark.parametrize(
    ("outcome", "left", "effort", "found"),
    [
        ("done", 7.0, 0.0, SPENT),
        ("done", 7.0, 3.0, {**SPENT, "effort": 3.0}),
        ("termination", 7.0, 1.0, {**SPENT, "effort": 1.0, "late": 10.0, "left": 7.0}),
        ("termination", 0.0, 0.0, {**SPENT, "late": 10.0}),
        ("collision", 7.0, 3.0, {"collision": 200.0}),
        ("dead", 7.0, 3.0, {"dead": 150.0}),
        ("dead", 70.0, 3.0, {"dead": 170.0}),
        ("dead", math.inf, 3.0, {"dead": 150.0}),
    ],
)
def test_terms_are_seconds(
    outcome: Outcome, left: float, effort: float, found: dict[RewardTerm, float]
) -> None:
    assert terms(outcome, DRIVEN, left, effort) == pytest.approx(found)
    assert reward(terms(outcome, DRIVEN, left, effort)) == pytest.approx(-sum(found.values()))


def test_driving_straight_on_steadily_costs_its_time_alone() -> None:
    plain: dict[Component, float] = {
        "time": 5.0, "jerk": 0.0, "angular-acceleration": 0.0, "curvature": 0.0
    }  # fmt: skip
    assert terms("done", plain, 0.0, 0.0) == {"time": 5.0}


def test_what_things_cost_is_documented_in_the_trace() -> None:
    assert WEIGHTS == {"time": 1.0, "jerk": 0.05, "angular-acceleration": 4.0, "curvature": 20.0}
    assert PENALTY == {"collision": 200.0, "dead": 150.0, "termination": 10.0}
    effort: dict[Action, float] = {"stop": 2.0, "change-left": 1.0, "change-right": 1.0}
    assert effort == EFFORT
