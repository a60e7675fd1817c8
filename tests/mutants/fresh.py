"""Trying a fault in a process of its own, for what is run when modules are loaded."""

import importlib.machinery
import json
import subprocess
import sys
from pathlib import Path
from types import CodeType
from typing import Any

import pytest

from tests.mutants import rooms
from tests.mutants.edits import planted
from tests.mutants.faults import Fault


class Changed(importlib.machinery.SourceFileLoader):
    """Loads a module with a fault in it."""

    def __init__(self, name: str, path: str, number: int) -> None:
        super().__init__(name, path)
        self.number = number

    def get_code(self, fullname: str) -> CodeType:
        tree, _ = planted(Path(self.path).read_text(encoding="utf-8"), self.number)
        return compile(tree, self.path, "exec")


class Finder:
    """Finds the module that is to have a fault, and leaves all others alone."""

    def __init__(self, path: str, number: int) -> None:
        self.name = path.removesuffix(".py").replace("/", ".").removesuffix(".__init__")
        self.path = str(rooms.ROOT / path)
        self.number = number

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> Any:
        if name != self.name:
            return None
        loader = Changed(name, self.path, self.number)
        return importlib.machinery.ModuleSpec(name, loader, origin=self.path)


def attempt(fault: Fault, tests: list[str], limit: float) -> str:
    """Run tests on a fault until one fails; its name, "time", "crash", or "" where none does."""
    asked = json.dumps({"path": fault.path, "number": fault.number, "tests": tests})
    try:
        ended = subprocess.run(
            [sys.executable, "-m", "tests.mutants.fresh"],
            input=asked, capture_output=True, text=True, timeout=limit, cwd=rooms.ROOT,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return "time"
    first = next((x for x in ended.stdout.splitlines() if x.startswith(("FAILED ", "ERROR "))), "")
    if first:
        return first.split(" - ")[0].split(" ", 1)[1]
    return "" if ended.returncode == 0 else "crash"


def main() -> int:
    """Plant the fault that standard input names, and run the tests that it names."""
    asked = json.load(sys.stdin)
    sys.meta_path.insert(0, Finder(asked["path"], asked["number"]))
    options = ["-x", "-q", "--no-header", "-p", "no:cacheprovider", "-m", "not slow"]
    return int(pytest.main([*options, *asked["tests"]]))


if __name__ == "__main__":
    sys.exit(main())
