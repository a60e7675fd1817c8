"""The panels in the repository are whole, and their scores are those that the docs state."""

import re
from pathlib import Path

import pytest

from sim.setup import scenario
from tests.panels.score import figures, read

HERE = Path(__file__).parent
ROUNDS = sorted(HERE.glob("round-*.jsonl"))
DOCS = HERE.parents[1] / "docs" / "language.md"


@pytest.mark.parametrize("path", ROUNDS, ids=lambda path: path.stem)
def test_time_does_not_go_back_within_a_conversation(path: Path) -> None:
    last: dict[str, float] = {}
    for line in read(path):
        name, at = str(line["conversation"]), float(str(line["at"]))
        assert at >= last.get(name, 0.0), name
        last[name] = at


@pytest.mark.parametrize("path", ROUNDS, ids=lambda path: path.stem)
def test_every_world_can_be_loaded(path: Path) -> None:
    for name in sorted({str(line["scenario"]) for line in read(path)}):
        folder = HERE / "worlds" / name
        assert scenario.load(str(folder) if folder.is_dir() else name).duration > 0.0


@pytest.mark.parametrize("path", ROUNDS[1:], ids=lambda path: path.stem)
def test_the_docs_state_the_score(path: Path) -> None:
    found = figures(read(path))
    number = path.stem.removeprefix("round-")
    row = re.search(rf"^\| {number} \|.*$", DOCS.read_text(), re.MULTILINE)
    assert row is not None, f"docs/language.md has no row for {path.stem}"
    for name in ("exchanges", "satisfying", "another question answered", "false or misleading"):
        assert re.search(rf"\b{found[name]}\b", row[0]), (name, found[name], row[0])
