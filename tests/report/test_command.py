"""`xavi report`, and the page about it."""

import json
import re
import shlex
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

import xavi_dialogue as xavi
from tests.report.records import HERE, UNHEEDED, report
from xavi_dialogue.__main__ import app
from xavi_dialogue.process.program import program_hash

WORLD = HERE / "worlds" / "unheeded"


def run(*arguments: str) -> Result:
    return CliRunner().invoke(app, list(arguments))


def test_a_report_is_written_and_its_file_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    done = run("report", str(UNHEEDED), "--scenario", str(WORLD))
    assert (done.exit_code, done.stdout) == (0, "unheeded-0-11.1s.html\n")
    written = (tmp_path / "unheeded-0-11.1s.html").read_text(encoding="utf-8")
    assert written == report(UNHEEDED).html()


def test_a_report_is_written_over_a_report_and_over_nothing_else(tmp_path: Path) -> None:
    asked = ("report", str(UNHEEDED), "--scenario", str(WORLD), "--out")
    html, notes = tmp_path / "it.html", tmp_path / "notes.html"
    assert run(*asked, str(html)).exit_code == run(*asked, str(html)).exit_code == 0
    assert run(*asked, str(html), "--json").exit_code == run(*asked, str(html)).exit_code == 0
    notes.write_text("keep", encoding="utf-8")
    done = run(*asked, str(notes))
    assert done.exit_code == 2
    assert "is no report; --force overwrites it" in done.stderr
    assert notes.read_text(encoding="utf-8") == "keep"
    assert run(*asked, str(notes), "--force").exit_code == 0


def test_a_report_is_never_written_over_its_ride(tmp_path: Path) -> None:
    ride = tmp_path / UNHEEDED.name
    ride.write_bytes(UNHEEDED.read_bytes())
    asked = ("report", str(ride), "--scenario", str(WORLD), "--out", str(ride))
    for extra in ((), ("--force",)):
        done = run(*asked, *extra)
        assert done.exit_code == 2
        assert "is the ride itself" in done.stderr
    assert ride.read_bytes() == UNHEEDED.read_bytes()


def test_json_goes_to_the_output_or_into_a_file(tmp_path: Path) -> None:
    asked = ("report", str(UNHEEDED), "--scenario", str(WORLD), "--at", "collision", "--json")
    done = run(*asked)
    told = json.loads(done.stdout)
    assert told == json.loads(report(UNHEEDED, "collision").json())
    file = tmp_path / "it.json"
    assert run(*asked, "--out", str(file)).stdout == f"{file}\n"
    assert json.loads(file.read_text(encoding="utf-8")) == told


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("--at", "tea"), "'tea' names no moment; give a time"),
        (("--at", "nan"), "'nan' names no moment; give a time"),
        (("--at", "0:61"), "'0:61' names no moment; give a time"),
        (("--at", "1:05"), "the ride has no moment 65 s; give one from 0 to 11.1"),
        (("--at", "99"), "the ride has no moment 99 s; give one from 0 to 11.1"),
        (("--at", "red light"), "the ride has no red light; give a time"),
    ],
)
def test_a_moment_that_is_not_there_is_an_error(arguments: tuple[str, ...], told: str) -> None:
    done = run("report", str(UNHEEDED), *arguments)
    assert done.exit_code != 0
    assert told in done.stderr
    assert "planning again" not in done.stderr


@pytest.mark.parametrize("at", [True, [6.0], float("nan")])
def test_what_is_no_moment_is_an_error_of_the_library(at: object) -> None:
    with pytest.raises(xavi.XaviError, match="names no moment; give a time"):
        xavi.open(UNHEEDED).report(at)  # type: ignore[arg-type]


@pytest.mark.parametrize("at", [5, "5", "5 s", " 0:05 ", "0:05.0"])
def test_a_moment_may_be_written_in_minutes(at: float | str) -> None:
    found = report(UNHEEDED, at)
    assert (found.kind, found.time) == ("time", 5.0)


def test_a_file_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    with pytest.raises(xavi.XaviError, match=r"cannot write .*gone.*; name another"):
        report(UNHEEDED).save(tmp_path / "gone" / "x.html")


def test_the_program_is_known_by_its_files() -> None:
    assert re.fullmatch("[0-9a-f]{64}", program_hash())
    assert report(UNHEEDED).content.hashes.program == program_hash()


def test_the_commands_of_the_page_work(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    page = (root / "docs" / "report.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```sh\n(.*?)```", page, re.DOTALL)
    lines = [line for block in blocks for line in block.splitlines()]
    commands = [shlex.split(line, comments=True) for line in lines if line.startswith("xavi ")]
    assert len(commands) >= 3
    (tmp_path / "transcripts").symlink_to(root / "transcripts")
    monkeypatch.chdir(tmp_path)
    for command in commands:
        done = run(*command[1:])
        assert done.exit_code == 0, (command, done.output)


@pytest.mark.slow
def test_a_driven_collision_is_reported() -> None:
    ride = xavi.drive(WORLD)
    found = ride.report()
    assert found.kind == "collision"
    assert found.content.hashes.file is None
    assert found.content.moment.vehicle == 1
    own = found.content.motions[0]
    assert own.time[-1] == pytest.approx(found.time)  # by the scenes after the last decision
    assert "no-scenes" not in {one.kind for one in found.content.limits}
