"""The identity of the program: a hash of the files that it consists of."""

import hashlib
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable

PACKAGES = ("grammars", "planner", "sim", "xavi_dialogue")
KINDS = (".py", ".toml", ".lark", ".rules", ".json", ".txt")


@cache
def program_hash() -> str:
    """Return the SHA-256 of the program's files, in hexadecimal.

    Each file counts with its path and content; nothing else does, such as compiled kernels.
    """
    total = hashlib.sha256()
    for package in PACKAGES:
        for path, file in sorted(_below(files(package), package), key=lambda one: one[0]):
            content = hashlib.sha256(file.read_bytes()).hexdigest()
            total.update(f"{path} {content}\n".encode())
    return total.hexdigest()


def _below(folder: Traversable, path: str) -> list[tuple[str, Traversable]]:
    found: list[tuple[str, Traversable]] = []
    for one in folder.iterdir():
        here = f"{path}/{one.name}"
        if one.is_dir() and one.name != "__pycache__":
            found += _below(one, here)
        elif one.name.endswith(KINDS):
            found.append((here, one))
    return found
