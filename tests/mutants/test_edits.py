"""Which faults are found in a text, and that planting one changes what it does, there alone."""

import ast

import pytest

from tests.mutants.edits import edits, planted


def found(source: str) -> list[tuple[str, str, str]]:
    return [(edit.kind, edit.before, edit.after) for edit in edits(ast.parse(source))]


@pytest.mark.parametrize(
    ("source", "changes"),
    [
        ("a < b", [("comparison", "a <= b"), ("comparison", "a >= b")]),
        ("a == b", [("comparison", "a != b")]),
        ("a not in b", [("comparison", "a in b")]),
        ("a - b", [("arithmetic", "a + b")]),
        ("a / b", [("arithmetic", "a * b")]),
        ("a or b", [("logic", "a and b")]),
        ("not a", [("logic", "a")]),
        ("-a", [("logic", "a")]),
        ("3", [("constant", "4"), ("constant", "2")]),
        ("2.5", [("constant", "5.0")]),
        ("0.0", [("constant", "1.0")]),
        ("True", [("constant", "False")]),
        ("min(a, b)", [("extreme", "max(a, b)")]),
        ("all(a)", [("extreme", "any(a)")]),
    ],
)
def test_an_expression_is_changed(source: str, changes: list[tuple[str, str]]) -> None:
    assert found(f"x = {source}") == [(kind, source, after) for kind, after in changes]


@pytest.mark.parametrize(
    ("source", "change"),
    [
        ("def f(x):\n    return x", ("return", "return x", "return None")),
        ("def f(x):\n    x.clear()", ("dropped", "x.clear()", "pass")),
        ("def f(x):\n    x += y", ("dropped", "x += y", "pass")),
        ("for x in y:\n    continue", ("dropped", "continue", "pass")),
        ("if x:\n    y = z", ("condition", "x", "not x")),
        ("x = [y for y in z if y]", ("condition", "y", "not y")),
        ("x = y if z else w", ("condition", "z", "not z")),
    ],
)
def test_a_statement_is_changed(source: str, change: tuple[str, str, str]) -> None:
    assert found(source) == [change]


def test_arguments_of_one_type_are_swapped() -> None:
    source = "def f(a: int, b: int, c: str):\n    pass\nx = f(y, z, w)"
    assert ("swapped", "f(y, z, w)", "f(z, y, w)") in found(source)
    assert ("swapped", "f(y, z, w)", "f(y, w, z)") not in found(source)


@pytest.mark.parametrize(
    "source",
    [
        '"""A text: 1 < 2."""',
        "x: Literal[1, 2]",
        "X: TypeAlias = Y | Z",
        "def f(a: 'int' = b) -> 'x < y':\n    pass",
        "@cache(3)\ndef f():\n    pass",
        "def f():\n    raise ValueError(1 + 2)",
        "def __repr__(self):\n    return self.x",
        "x = f'{a + b}'",
        "x = zip(y, z, strict=True)",
        "x = isinstance(y, Z | W)",
        "x = 1e-9",
        "x = (*y,) + z",
        "class A(B, frozen=True):\n    pass",
        "def f():\n    return None",
    ],
)
def test_what_alters_no_answer_is_left_alone(source: str) -> None:
    assert found(source) == []


def test_one_fault_is_planted() -> None:
    source = "def f(x):\n    return x + 1\n\ndef g(x):\n    return x + 1\n"
    every = edits(ast.parse(source))
    for number, edit in enumerate(every):
        tree, same = planted(source, number)
        assert (same.kind, same.line, same.after) == (edit.kind, edit.line, edit.after)
        text = ast.unparse(tree).splitlines()
        whole = source.splitlines()
        assert [k for k, (a, b) in enumerate(zip(text, whole, strict=True), 1) if a != b] == [
            edit.line
        ]


def test_a_fault_tells_where_it_is() -> None:
    method = "    def f(self):\n        if (\n            a\n        ):\n            pass\n"
    source = "class A:\n    x = 1\n" + method
    constant, *_, condition = edits(ast.parse(source))
    assert (constant.place.owner, constant.place.in_function) == ("A", False)
    assert (condition.place.owner, condition.place.in_function) == ("A.f", True)
    assert condition.line == 5
    assert condition.place.statement == (4, 6)
