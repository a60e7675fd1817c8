"""Exchanging the code of loaded functions, and refusing where only loading anew would do."""

import ast
from typing import Any

import pytest

from tests.mutants.edits import edits, planted
from tests.mutants.swap import NotSwapped, caches, living, swap

SOURCE = """
import functools
LIMIT = 3
TABLE = [k + 1 for k in range(3)]
class A:
    size: int = 4
    def grown(self, by):
        return self.size + by
@functools.cache
def doubled(x):
    return 2 * x
def inside(x):
    def inner(y):
        return x < y
    return inner
pair = (lambda x: x - 1, lambda x: x - 2)
"""


class Loaded:
    """A module of SOURCE, as if it had been read from a file of its own."""

    def __init__(self, file: str) -> None:
        self.file = file
        self.names: dict[str, Any] = {"__name__": "made_up_module"}
        exec(compile(SOURCE, file, "exec"), self.names)

    def plant(self, before: str, after: str) -> None:
        found = [(edit.before, edit.after) for edit in edits(ast.parse(SOURCE))]
        tree, _ = planted(SOURCE, found.index((before, after)))
        old, new = (compile(code, self.file, "exec") for code in (SOURCE, tree))
        swap(old, new, living([self.file])[self.file])


@pytest.fixture
def module(request: pytest.FixtureRequest) -> Loaded:
    return Loaded(f"{request.node.name}.py")


def test_a_method_and_what_holds_on_to_it_change(module: Loaded) -> None:
    one = module.names["A"]()
    grown = one.grown
    module.plant("self.size + by", "self.size - by")
    assert grown(1) == one.grown(1) == 3


def test_a_function_behind_a_cache_changes_once_that_is_cleared(module: Loaded) -> None:
    doubled = module.names["doubled"]
    assert doubled(5) == 10
    module.plant("2 * x", "2 / x")
    for cache in caches([module.file]):
        cache.cache_clear()
    assert doubled(5) == 0.4


def test_a_function_within_a_function_changes(module: Loaded) -> None:
    made = module.names["inside"](1)
    module.plant("x < y", "x >= y")
    assert not module.names["inside"](1)(2)
    assert not made(2)


def test_variables_that_are_bound_otherwise_are_refused(module: Loaded) -> None:
    made = module.names["inside"](1)
    with pytest.raises(NotSwapped):
        module.plant("return x < y", "return None")
    assert made(2)


@pytest.mark.parametrize(
    ("before", "after"),
    [("3", "4"), ("4", "5"), ("k + 1", "k - 1"), ("x - 1", "x + 1")],
)
def test_what_is_run_on_loading_is_refused(module: Loaded, before: str, after: str) -> None:
    with pytest.raises(NotSwapped):
        module.plant(before, after)
