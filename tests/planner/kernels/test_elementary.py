"""Elementary functions are those of the C library, and the planner uses no others."""

import ast
import math

import numpy as np
import pytest

from planner.kernels.elementary import arctan2, power
from tests.sources import Module, modules

#: Functions of numpy that differ by a last digit between processors with and without AVX-512.
DIFFERING = frozenset(
    ("exp", "exp2", "expm1", "log", "log2", "log10", "log1p", "cbrt", "tan", "arcsin", "arccos",
     "arctan", "arctan2", "sinh", "cosh", "tanh", "arcsinh", "arccosh", "arctanh", "power",
     "float_power"),
)  # fmt: skip


def test_angles_are_those_of_the_c_library() -> None:
    y, x = np.random.default_rng(0).uniform(-7.0, 7.0, (2, 5000))
    assert arctan2(y, x).tolist() == [math.atan2(a, b) for a, b in zip(y, x, strict=True)]
    square = arctan2(y.reshape(50, 100), x.reshape(50, 100))
    assert square.shape == (50, 100)
    assert square.ravel().tolist() == arctan2(y, x).tolist()


@pytest.mark.parametrize("exponent", [1.5, -0.5, 3.0])
def test_powers_are_those_of_the_c_library(exponent: float) -> None:
    base = np.random.default_rng(1).uniform(0.1, 40.0, 5000)
    assert power(base, exponent).tolist() == [math.pow(b, exponent) for b in base]


PLANNING = [
    module
    for name, module in modules().items()
    if name.split(".")[0] in ("planner", "sim") and not name.startswith("planner.kernels")
]


@pytest.mark.parametrize("module", PLANNING, ids=lambda module: module.path)
def test_plans_hang_on_no_function_that_differs_between_processors(module: Module) -> None:
    used = {
        node.attr
        for node in module.nodes
        if isinstance(node, ast.Attribute)
        and isinstance(node.value, ast.Name)
        and node.value.id == "np"
    }
    assert not used & DIFFERING, f"{module.path}: use planner.kernels.elementary"
