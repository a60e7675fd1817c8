import math

import pytest

from planner.search.tree import EXPLORATION, Edge, Tree


def test_untried_actions_come_first_in_their_order() -> None:
    tree = Tree()
    chosen = []
    for _ in range(3):
        chosen.append(tree.select((), ["continue", "stop", "change-left"]))
        tree.back_up((chosen[-1],), -10.0)
    assert chosen == ["continue", "stop", "change-left"]


def test_ucb1_weighs_value_against_visits() -> None:
    # Rewards lie in [-30, -10]. UCB1 is (value - low) / span + sqrt(2) sqrt(ln(total) / visits).
    tree = Tree({(): {"continue": Edge(8, -12.0), "stop": Edge(2, -20.0)}}, -30.0, -10.0)
    bounds = {
        "continue": 0.9 + math.sqrt(2.0 * math.log(10.0) / 8.0),  # 1.659
        "stop": 0.5 + math.sqrt(2.0 * math.log(10.0) / 2.0),  # 2.017
    }
    assert bounds["continue"] == pytest.approx(1.6587, abs=1e-4)
    assert bounds["stop"] == pytest.approx(2.0174, abs=1e-4)
    assert math.sqrt(2.0) == EXPLORATION
    assert tree.select((), ["continue", "stop"]) == "stop"
    tree.edges[()]["stop"].visits = 4  # total 12: 1.688 against 0.5 + 1.115 = 1.615
    assert tree.select((), ["continue", "stop"]) == "continue"


def test_only_the_offered_actions_are_chosen() -> None:
    tree = Tree({(): {"continue": Edge(50, -12.0), "stop": Edge(1, -20.0)}}, -30.0, -10.0)
    assert tree.select((), ["continue"]) == "continue"


def test_values_are_backed_up_by_q_learning() -> None:
    tree = Tree()
    tree.back_up(("continue", "stop"), -20.0)
    tree.back_up(("continue", "exit-right"), -10.0)
    # The last action learns its reward, the first one the value of the best that follows.
    assert tree.edges[("continue",)]["stop"] == Edge(1, -20.0)
    assert tree.edges[("continue",)]["exit-right"] == Edge(1, -10.0)
    assert tree.edges[()]["continue"] == Edge(2, -15.0)  # mean of -20 and -10
    tree.back_up(("continue", "stop"), -40.0)
    assert tree.edges[("continue",)]["stop"] == Edge(2, -30.0)  # mean of -20 and -40
    # Best of -30 and -10 is -10: (-20 - 10 - 10) / 3.
    assert tree.edges[()]["continue"].value == pytest.approx(-40.0 / 3.0)
    assert (tree.low, tree.high) == (-40.0, -10.0)


def test_a_copy_is_independent() -> None:
    tree = Tree()
    tree.back_up(("continue",), -20.0)
    copy = tree.copy()
    assert copy == tree
    copy.back_up(("continue",), -40.0)
    copy.back_up(("stop",), -1.0)
    assert tree.edges == {(): {"continue": Edge(1, -20.0)}}
    assert (tree.low, tree.high) == (-20.0, -20.0)


def test_the_best_plan_follows_the_highest_values() -> None:
    tree = Tree()
    for _ in range(3):
        tree.back_up(("continue",), -20.0)
        tree.back_up(("change-left", "continue"), -12.0)
        tree.back_up(("change-left", "exit-left"), -100.0)
    assert [action for action, _ in tree.best(1)] == ["change-left", "continue"]


def test_rarely_tried_actions_do_not_lead_the_plan() -> None:
    tree = Tree({(): {"continue": Edge(30, -15.0), "stop": Edge(1, -5.0)}})
    assert [action for action, _ in tree.best(5)] == ["continue"]
    assert [action for action, _ in tree.best(1)] == ["stop"]
    assert [action for action, _ in tree.best(100)] == ["stop"]  # nobody was tried enough


def test_an_empty_tree_has_no_plan() -> None:
    assert Tree().best(1) == []
