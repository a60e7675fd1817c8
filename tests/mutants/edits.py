"""One-line faults: every small change of a module that alters what it does, found in its syntax.

What cannot alter an answer is left out: type hints, decorators, docstrings, texts of errors and
of formatted strings, tolerances below 1e-4, `strict=` of zip, and how an object is printed.
"""

import ast
from collections.abc import Iterator
from copy import deepcopy
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias


@dataclass(frozen=True)
class Place:
    """Where the walk through a tree has come to."""

    owner: str = ""  # qualified name of the function or class, "" at module level
    in_function: bool = False
    statement: tuple[int, int] = (1, 1)  # first and last line of the statement, without its body


@dataclass(frozen=True)
class Edit:
    """A node of a tree, and what to put in its place."""

    kind: str
    place: Place
    line: int
    before: str
    after: str
    parent: ast.AST
    field: str
    index: int | None  # in the field, where that is a list
    node: ast.AST

    def carry_out(self) -> None:
        """Change the tree that the edit was found in."""
        if self.index is None:
            setattr(self.parent, self.field, self.node)
        else:
            getattr(self.parent, self.field)[self.index] = self.node


Change: TypeAlias = tuple[str, ast.AST]
Signatures: TypeAlias = dict[str, list[str]]  # of functions: the types of their parameters

COMPARED: dict[type[ast.cmpop], tuple[type[ast.cmpop], ...]] = {
    ast.Lt: (ast.LtE, ast.GtE),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.LtE),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
}
RECKONED: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Mult,
    ast.Mod: ast.Mult,
    ast.BitOr: ast.BitAnd,
    ast.BitAnd: ast.BitOr,
}
EXTREMES = {"min": "max", "max": "min", "any": "all", "all": "any"}
TOLERANCE = 1e-4  # below it, a number stands for 0
UNSEEN = {"__repr__", "__str__"}
SEQUENCES = (ast.Tuple, ast.List, ast.JoinedStr, ast.Dict, ast.Set, ast.ListComp)
#: What the walk never enters, by field.
LEFT_OUT = {"annotation", "returns", "decorator_list", "bases", "op", "ops", "ctx"}


def edits(tree: ast.Module) -> list[Edit]:
    """Find every edit of a tree, in the order of its text."""
    return list(_walk(tree, Place(), _signatures(tree)))


def planted(source: str, number: int) -> tuple[ast.Module, Edit]:
    """Plant the edit of this number, as `edits` counts them, in a module of this source."""
    tree = ast.parse(source)
    edit = edits(tree)[number]
    edit.carry_out()
    return ast.fix_missing_locations(tree), edit


def _signatures(tree: ast.Module) -> Signatures:
    return {
        node.name: [ast.unparse(a.annotation) if a.annotation else "" for a in node.args.args]
        for node in tree.body
        if isinstance(node, ast.FunctionDef)
    }


def _walk(parent: ast.AST, place: Place, signatures: Signatures) -> Iterator[Edit]:
    for field, value in ast.iter_fields(parent):
        if field in LEFT_OUT or (field == "keywords" and isinstance(parent, ast.ClassDef)):
            continue
        several = isinstance(value, list)
        for index, child in enumerate(value if several else [value]):
            if not isinstance(child, ast.AST) or _is_left_out(child):
                continue
            there = _place_of(child, place)
            for kind, node in _changes(child, parent, signatures):
                before, after = _text(child), _text(node)
                ast.copy_location(node, child)
                at = index if several else None
                line = child.lineno  # type: ignore[attr-defined]
                yield Edit(kind, there, line, before, after, parent, field, at, node)
            yield from _walk(child, there, signatures)


def _text(node: ast.AST) -> str:
    return ast.unparse(node)


def _place_of(node: ast.AST, place: Place) -> Place:
    """Where one is inside a node."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        owner = f"{place.owner}.{node.name}" if place.owner else node.name
        inside = place.in_function or isinstance(node, ast.FunctionDef)
        return Place(owner, inside, (node.lineno, node.lineno))
    if isinstance(node, ast.stmt):
        return Place(place.owner, place.in_function, _head(node))
    if isinstance(node, ast.match_case):
        first, last = node.pattern.lineno, node.body[0].lineno - 1
        return Place(place.owner, place.in_function, (first, max(first, last)))
    return place


def _head(node: ast.stmt) -> tuple[int, int]:
    """The lines of a statement without those of its body."""
    match node:
        case ast.If(body=[inner, *_]) | ast.For(body=[inner, *_]) | ast.While(body=[inner, *_]):
            return node.lineno, max(node.lineno, inner.lineno - 1)
        case ast.With(body=[inner, *_]) | ast.Try(body=[inner, *_]):
            return node.lineno, max(node.lineno, inner.lineno - 1)
        case ast.Match(cases=[inner, *_]):
            return node.lineno, max(node.lineno, inner.pattern.lineno - 1)
    return node.lineno, node.end_lineno or node.lineno


def _is_left_out(node: ast.AST) -> bool:
    """Whether nothing within a node can alter an answer."""
    match node:
        case ast.FunctionDef(name=name):
            return name in UNSEEN
        case ast.Raise() | ast.Assert() | ast.Import() | ast.ImportFrom() | ast.JoinedStr():
            return True
        case ast.If(test=ast.Name(id="TYPE_CHECKING")):
            return True
        case ast.AnnAssign(annotation=ast.Name(id="TypeAlias")):
            return True
        case ast.Expr(value=ast.Constant()) | ast.keyword(arg="strict"):
            return True
        case ast.Call(func=ast.Name(id="cast" | "TypeVar" | "field" | "isinstance")):
            return True
        case ast.Subscript(value=ast.Name(id="Literal")):
            return True
    return False


def _changes(node: ast.AST, parent: ast.AST, signatures: Signatures) -> Iterator[Change]:
    match node:
        case ast.Compare():
            yield from _compared(node)
        case ast.BinOp():
            yield from _reckoned(node)
        case ast.BoolOp(op=op):
            other = ast.Or() if isinstance(op, ast.And) else ast.And()
            yield "logic", ast.BoolOp(other, node.values)
        case ast.UnaryOp(op=ast.Not() | ast.USub()):
            yield "logic", deepcopy(node.operand)
        case ast.Constant():
            yield from _constants(node)
        case ast.Return(value=value) if value and ast.unparse(value) != "None":
            yield "return", ast.Return(ast.Constant(None))
        case ast.Expr() | ast.AugAssign() | ast.Continue():
            yield "dropped", ast.Pass()
        case ast.Call():
            yield from _called(node, signatures)
    if _is_condition(node, parent) and not isinstance(node, ast.Compare):
        yield "condition", ast.UnaryOp(ast.Not(), deepcopy(node))  # type: ignore[arg-type]


def _is_condition(node: ast.AST, parent: ast.AST) -> bool:
    match parent:
        case ast.If(test=test) | ast.IfExp(test=test):
            found = node is test
        case ast.comprehension(ifs=tests):
            found = node in tests
        case ast.match_case(guard=guard):
            found = node is guard
        case ast.Return(value=ast.BoolOp() as value):
            found = node is value
        case _:
            found = False
    return found and not isinstance(node, ast.UnaryOp)


def _compared(node: ast.Compare) -> Iterator[Change]:
    for index, op in enumerate(node.ops):
        for other in COMPARED[type(op)]:
            changed = deepcopy(node)
            changed.ops[index] = other()
            yield "comparison", changed


def _reckoned(node: ast.BinOp) -> Iterator[Change]:
    sides = (node.left, node.right)
    if type(node.op) in RECKONED and not any(
        isinstance(side, SEQUENCES)
        or (isinstance(side, ast.Constant) and isinstance(side.value, str))
        for side in sides
    ):
        yield "arithmetic", ast.BinOp(node.left, RECKONED[type(node.op)](), node.right)


def _constants(node: ast.Constant) -> Iterator[Change]:
    match node.value:
        case bool(value):
            yield "constant", ast.Constant(not value)
        case int(value):
            yield "constant", ast.Constant(value + 1)
            yield "constant", ast.Constant(value - 1)
        case float(value) if value == 0.0:
            yield "constant", ast.Constant(1.0)
        case float(value) if value >= TOLERANCE:
            yield "constant", ast.Constant(2.0 * value)


def _called(node: ast.Call, signatures: Signatures) -> Iterator[Change]:
    if not isinstance(node.func, ast.Name):
        return
    if node.func.id in EXTREMES:
        changed = deepcopy(node)
        changed.func = ast.Name(EXTREMES[node.func.id], ast.Load())
        yield "extreme", changed
    types = signatures.get(node.func.id, [])
    for one, other in pairwise(range(min(len(node.args), len(types)))):
        plain = all(isinstance(node.args[k], ast.Name | ast.Attribute) for k in (one, other))
        if plain and types[one] == types[other]:
            changed = deepcopy(node)
            changed.args[one], changed.args[other] = node.args[other], node.args[one]
            yield "swapped", changed
