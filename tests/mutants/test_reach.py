"""Which tests are run on a fault, and in which order."""

from tests.mutants.reach import Reach, in_order, within

SECONDS = {"a.py::slow": 4.0, "a.py::quick": 0.5, "b.py::one": 1.0, "b.py::other": 0.1}
REACH = Reach(
    seconds=SECONDS,
    tests={
        ("m.py", 3): ["a.py::quick"],
        ("m.py", 4): ["a.py::slow", "b.py::one"],
        ("n.py", 4): ["b.py::other"],
    },
    loading={("m.py", 1)},
)


def test_tests_are_those_that_run_any_line_of_the_statement() -> None:
    assert REACH.of("m.py", 2, 3) == {"a.py::quick"}
    assert REACH.of("m.py", 3, 4) == {"a.py::quick", "a.py::slow", "b.py::one"}
    assert REACH.of("m.py", 5, 9) == set()
    assert REACH.of_module("m.py") == {"a.py::quick", "a.py::slow", "b.py::one"}


def test_what_is_run_on_loading_is_told() -> None:
    assert REACH.loads("m.py", 1, 2)
    assert not REACH.loads("m.py", 2, 3)
    assert not REACH.loads("n.py", 1, 1)


def test_quick_files_come_first_and_in_them_quick_tests() -> None:
    assert in_order(set(SECONDS), REACH) == [
        "b.py::other",
        "b.py::one",
        "a.py::quick",
        "a.py::slow",
    ]


def test_slow_tests_and_those_beyond_the_budget_are_not_run() -> None:
    order = in_order(set(SECONDS), REACH)
    assert within(order, REACH, fast=3.0, budget=20.0) == order[:3]
    assert within(order, REACH, fast=5.0, budget=1.2) == ["b.py::other", "b.py::one"]
