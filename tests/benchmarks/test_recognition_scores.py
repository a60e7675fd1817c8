"""Scores of probabilities and of lines, reliability, and the constants that are varied."""

import math
from random import Random

import numpy as np
import pytest

from benchmarks.prediction.constants import CONSTANTS, Varied, changed, times, varied_rows
from benchmarks.prediction.displacement import error, held
from benchmarks.prediction.foretold import Foretold, spread
from benchmarks.prediction.goal_scores import FLOOR, clustered, commonest, rates, score, uniform
from benchmarks.prediction.reliability import bins, ece, fit, map_row, mapped, pairs
from planner.prediction import likelihood
from planner.prediction.goals import Goal
from planner.prediction.recognise import Belief
from planner.record.trace import EgoGoal


def moment(chances: tuple[float, ...], truth: int, network: str = "a/0") -> Foretold:
    kinds = ("exit-left", "exit-right", "continue")[: len(chances)]
    return Foretold(network, "a", 1, "two roads", 1.0, 3.0, chances, kinds, truth)


def exit_to(edge: str | None) -> Goal:
    return Goal("exit-left", "", None if edge is None else EgoGoal(edge, 1.0, None), 0.3)


def test_a_score_is_that_of_the_formulas() -> None:
    found = score((0.7, 0.2), 1)
    assert found.log == pytest.approx(-math.log(0.2))
    assert found.brier == pytest.approx(0.7**2 + 0.8**2)
    assert found.top == 0.0
    assert score((0.5, 0.5), 1).top == 0.5
    assert score((1.0, 0.0), 1).log == pytest.approx(-math.log(FLOOR))


def test_a_road_that_was_dropped_counts_with_no_probability() -> None:
    beliefs = (Belief(exit_to("b"), 1.0, 0.9, ()), Belief(exit_to(None), 1.0, 0.1, ()))
    chances, kinds, truth = spread(beliefs, (exit_to("a"), exit_to("b"), exit_to(None)), "a")
    assert (chances, truth, len(kinds)) == ((0.0, 0.9), 0, 2)


def test_rivals_know_the_roads_and_how_often_each_kind_is_taken() -> None:
    moments = [moment((0.5, 0.5), 0), moment((0.5, 0.5), 0), moment((0.5, 0.5), 1)]
    assert uniform(moments[0]) == (0.5, 0.5)
    assert commonest(moments[0], rates(moments)) == pytest.approx((2 / 3, 1 / 3))
    assert commonest(moments[0], {}) == (0.5, 0.5)


def test_values_of_one_network_count_together() -> None:
    mean, apart = clustered([1.0, 1.0, 0.0, 0.0], ["a", "b", "c", "d"])
    assert mean == 0.5
    assert apart == pytest.approx(math.sqrt(1.0 * 4 / 3) / 4)
    _, together = clustered([1.0, 1.0, 0.0, 0.0], ["a", "a", "b", "b"])
    assert together > apart


def test_bins_hold_what_lies_within_their_bounds() -> None:
    found = bins([(0.05, False), (0.1, True), (0.95, True), (1.0, False)])
    assert [(one.low, one.cases) for one in found] == [(0.05, 2), (0.95, 2)]
    assert found[0].said == pytest.approx(0.075)
    assert found[0].true == 0.5
    assert ece(found) == pytest.approx((2 * 0.425 + 2 * 0.475) / 4)


def test_a_map_keeps_order_sum_and_what_is_impossible() -> None:
    found = mapped((0.6, 0.3, 0.0), 0.5)
    assert sum(found) == pytest.approx(0.9)
    assert found[0] / found[1] == pytest.approx(math.sqrt(2.0))
    assert found[2] == 0.0
    assert mapped((0.6, 0.3), 1.0) == pytest.approx((0.6, 0.3))
    assert mapped((0.0, 0.0), 0.5) == (0.0, 0.0)


def test_the_power_by_which_one_was_too_sure_is_found_again() -> None:
    draw = Random(4)
    moments = []
    for k in range(4000):
        true = draw.uniform(0.05, 0.95)
        sure = mapped((true, 1.0 - true), 2.0)
        moments.append(moment(sure, 0 if draw.random() < true else 1, f"n/{k % 20}"))
    assert fit(moments) == pytest.approx(0.5, abs=0.06)
    row = map_row("n", fit(moments), moments)
    assert row.log[1] < row.log[0]
    assert row.gain == pytest.approx(row.log[0] - row.log[1])
    assert row.gain > 2.0 * row.error
    assert row.ece[1] < 0.5 * row.ece[0]
    assert len(pairs(moments)) == 8000


def test_of_several_lines_the_best_counts() -> None:
    truth = np.array([[1.0, 0.0], [2.0, 0.0]])
    aside = truth + np.array([0.0, 3.0])
    ahead = truth + np.array([[1.0, 0.0], [2.0, 0.0]])
    alone = error("m", 0.4, [aside], truth)
    assert (alone.average, alone.final) == (3.0, 3.0)
    best = error("m", 0.4, [aside, ahead], truth)
    assert (best.average, best.final, best.lines) == (1.5, 2.0, 2)


def test_who_left_the_network_stays_where_it_was_last() -> None:
    line = np.array([[1.0, 2.0], [3.0, 4.0], [np.nan, np.nan]])
    assert held(line).tolist() == [[1.0, 2.0], [3.0, 4.0], [3.0, 4.0]]


@pytest.mark.parametrize("constant", CONSTANTS)
def test_a_constant_is_changed_for_a_while_wherever_it_is_read(constant: str) -> None:
    with changed(constant, 2.0) as different:
        assert different
    with changed(constant, 1.0) as different:
        assert not different


def test_a_changed_constant_is_what_recognition_reads() -> None:
    before = likelihood.UNEXPLAINED
    with changed("UNEXPLAINED", 2.0):
        assert pytest.approx(2.0 * before) == likelihood.UNEXPLAINED
    assert before == likelihood.UNEXPLAINED


def test_counts_stay_counts() -> None:
    assert times(3, 0.5) == 2
    assert times(1, 0.5) == 1
    assert times((4.0, 3), 2.0) == (8.0, 6)


def test_changes_are_those_of_the_means_over_all_rides() -> None:
    varied = [
        Varied("rationality", 1.0, 2, 2.0, 1.0),
        Varied("rationality", 1.0, 2, 4.0, 2.0),
        Varied("SLOW", 0.5, 2, 2.0, 2.0),
        Varied("SLOW", 0.5, 2, 2.0, 2.0),
    ]
    rows = {row.constant: row for row in varied_rows(varied)}
    assert rows["SLOW"].log["0.5"] == pytest.approx(-0.5)
    assert rows["SLOW"].top["0.5"] == pytest.approx(0.25)
    assert rows["SLOW"].log["2"] is None
    assert rows["SLOW"].moments == 4
    assert varied_rows([]) == ()
