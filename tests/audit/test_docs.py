"""The command lines of docs/audit.md are understood."""

import re
import shlex
from pathlib import Path

import pytest
import typer.main

from xavi_dialogue.__main__ import app
from xavi_dialogue.audit import values
from xavi_dialogue.audit.questions import MOMENTS
from xavi_dialogue.audit.results import tables
from xavi_dialogue.audit.results.page import NOTES


def page(root: Path) -> str:
    return (root / "docs" / "audit.md").read_text(encoding="utf-8")


def test_command_lines_are_understood(root: Path) -> None:
    lines = re.findall(r"^xavi audit (.*)$", page(root), flags=re.MULTILINE)
    assert len(lines) >= 4
    command = typer.main.get_command(app).commands["audit"]  # type: ignore[attr-defined]
    for line in lines:
        context = command.make_context("audit", shlex.split(line))
        assert context.params["scenario"] or context.params["recordings"], line


def test_moments_and_files_are_described(root: Path) -> None:
    text = page(root)
    for moment in MOMENTS:
        assert f"`@ {moment}`" in text
    for name in (tables.RIDES, tables.ANSWERS, tables.DECISIONS, tables.MISTAKES):
        assert f"`{name}`" in text
    for name in (tables.FINDINGS, tables.CHANGES):
        assert f"`{name}`" in text
    assert values.Cost.__struct_fields__


def test_the_page_and_the_document_define_closest_calls_alike(root: Path) -> None:
    defined = "along the way if one follows the other, else straight on, unless one of them is"
    assert defined in page(root)
    assert defined in NOTES["close-call"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "there is nothing to audit; give --scenario s1, or a folder of recordings"),
        (["rides", "--scenario", "s1"], "give one or the other"),
        (["rides", "--seeds", "1"], "give one or the other"),
        (["--scenario", "s1", "--jobs", "2", "--dask", "tcp://x:1"], "--jobs is for local"),
        (["--scenario", "s1", "--seeds", "x"], "seeds are 'x'; give numbers"),
        (["--scenario", "nowhere"], "there is no scenario 'nowhere'"),
        (["nothing"], "nothing is no folder"),
        (["--scenario", "s1", "--question", "Why? @ x"], "'x' is no moment"),
        (["--scenario", "s1", "--against", "nothing"], "nothing is no folder"),
        (["--scenario", "s1", "--against", ".", "--out", "."], "is the folder of results itself"),
    ],
)
def test_what_is_wrong_with_options_is_said(
    arguments: list[str], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.argv", ["xavi", "audit", *arguments])
    with pytest.raises(SystemExit) as ended:
        app()
    assert ended.value.code == 2
    assert message in " ".join(capsys.readouterr().err.split())
