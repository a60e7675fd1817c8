"""Scenario folders to break."""

import shutil
from pathlib import Path

from sim.setup.scenario import load


def copy_of(name: str, target: Path) -> Path:
    """A copy of a shipped scenario in a folder of its own."""
    folder = target / name
    shutil.copytree(load(name).folder, folder)
    return folder


def edit(file: Path, old: str, new: str) -> None:
    """Replace a text that occurs exactly once."""
    text = file.read_text(encoding="utf-8")
    assert text.count(old) == 1, f"{old!r} occurs {text.count(old)} times in {file}"
    file.write_text(text.replace(old, new), encoding="utf-8")
