"""The examples of docs/library.md give what stands there."""

import doctest
import re
from pathlib import Path

import pytest

import xavi_dialogue as xavi

BLOCK = re.compile(r"^```python\n(.*?)^```", re.DOTALL | re.MULTILINE)
DRIVES = "xavi.drive("


def examples(root: Path) -> list[str]:
    page = (root / "docs" / "library.md").read_text(encoding="utf-8")
    return BLOCK.findall(page)


def failures(blocks: list[str], root: Path, patch: pytest.MonkeyPatch) -> str:
    """Run blocks one after the other, as in one notebook."""
    patch.chdir(root)
    text = "\n".join(blocks)
    flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    test = doctest.DocTestParser().get_doctest(
        text, {"xavi": xavi}, "docs/library.md", "docs/library.md", 0
    )
    assert len(test.examples) > 1
    told: list[str] = []
    doctest.DocTestRunner(optionflags=flags).run(test, out=told.append)
    return "".join(told)


def test_examples_on_recorded_rides(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    blocks = [one for one in examples(root) if DRIVES not in one]
    assert len(blocks) >= 4
    assert failures(blocks, root, monkeypatch) == ""


@pytest.mark.slow
def test_examples_that_drive(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    blocks = [one for one in examples(root) if DRIVES in one]
    assert failures(blocks, root, monkeypatch) == ""


def test_every_public_name_is_described(root: Path) -> None:
    page = (root / "docs" / "library.md").read_text(encoding="utf-8")
    for name in xavi.__all__:
        assert re.search(rf"`(?:xavi\.)?{name}\b", page), name
