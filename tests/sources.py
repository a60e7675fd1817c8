"""The repository's own Python modules, parsed, for the tests that read the code."""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGES = ("benchmarks", "grammars", "planner", "sim", "xavi_dialogue")


@dataclass(frozen=True)
class Module:
    """One module of the product."""

    name: str  # dotted
    path: str  # from the top of the repository
    text: str
    tree: ast.Module

    @cached_property
    def nodes(self) -> tuple[ast.AST, ...]:
        """Every node of the tree; many tests look at them."""
        return tuple(ast.walk(self.tree))


@dataclass(frozen=True)
class Import:
    """One import statement's target, made as precise as the names tell."""

    target: str  # a module of ours, or the dotted name as written
    line: int
    deferred: bool  # inside a function, or for type checkers only


@cache
def modules() -> dict[str, Module]:
    """Every module of ours by dotted name."""
    found = {}
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            relative = path.relative_to(ROOT)
            name = ".".join(relative.with_suffix("").parts).removesuffix(".__init__")
            text = path.read_text(encoding="utf-8")
            found[name] = Module(name, relative.as_posix(), text, ast.parse(text, str(relative)))
    return found


@cache
def imports(module: Module) -> tuple[Import, ...]:
    """Every import of a module, those inside functions included."""
    return tuple(_imports(module.tree, deferred=False))


def _imports(node: ast.AST, *, deferred: bool) -> Iterator[Import]:
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Import):
            for alias in child.names:
                yield Import(alias.name, child.lineno, deferred)
        elif isinstance(child, ast.ImportFrom):
            for alias in child.names:
                whole = f"{child.module}.{alias.name}"
                target = whole if whole in modules() else str(child.module)
                yield Import(target, child.lineno, deferred)
        else:
            if isinstance(child, ast.Call) and "import_module" in ast.dump(child.func):
                yield from _imported_by_name(child)
            later = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef) or (
                isinstance(child, ast.If) and "TYPE_CHECKING" in ast.dump(child.test)
            )
            yield from _imports(child, deferred=deferred or later)


def _imported_by_name(call: ast.Call) -> Iterator[Import]:
    """What `importlib.import_module("name")` imports; a computed name could be anything."""
    match call.args:
        case [ast.Constant(value=str(name)), *_]:
            yield Import(name, call.lineno, deferred=True)
        case _:
            yield Import("?", call.lineno, deferred=True)


def functions(module: Module) -> Iterator[ast.FunctionDef | ast.AsyncFunctionDef]:
    """Every function and method of a module, at any depth."""
    for node in module.nodes:
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            yield node
