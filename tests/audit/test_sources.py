"""The rides of an audit: seeds, scenarios, recordings."""

import shutil
from pathlib import Path

import pytest

from xavi_dialogue.audit.errors import AuditError
from xavi_dialogue.audit.sources import check_content, driven, read_seeds, recorded

RIDE = "transcripts/rides/s1-0.ride.jsonl.gz"


def test_seeds_are_numbers_and_ranges() -> None:
    assert read_seeds("0-3") == (0, 1, 2, 3)
    assert read_seeds("7, 1-2,2") == (7, 1, 2)


@pytest.mark.parametrize("text", ["", "a", "3-1", "1-", "-1", "0-99999999999", "0-9999999"])
def test_what_is_wrong_with_seeds_is_said(text: str) -> None:
    with pytest.raises(AuditError, match="give"):
        read_seeds(text)


def test_every_scenario_is_driven_with_every_seed() -> None:
    found = driven(["s1", "s2", "s1"], (0, 4), 5.0)
    assert [one.ride for one in found] == ["s1-0", "s1-4", "s2-0", "s2-4"]
    assert len({one.key for one in found}) == 4
    assert found[0].content == found[1].content != found[2].content
    assert found[0].key != driven(["s1"], (0,), 6.0)[0].key


def test_a_scenario_that_does_not_exist_is_named() -> None:
    with pytest.raises(AuditError, match="there is no scenario 'nowhere'"):
        driven(["nowhere"], (0,), None)


def test_recordings_are_found_below_a_folder(root: Path, tmp_path: Path) -> None:
    (tmp_path / "deep").mkdir()
    shutil.copy(root / RIDE, tmp_path / "deep" / "a.ride.jsonl.gz")
    (tmp_path / "notes.txt").write_text("nothing", encoding="utf-8")
    (found,) = recorded(tmp_path)
    assert found.ride == "deep/a.ride.jsonl.gz"
    check_content(found)


def test_what_is_wrong_with_a_folder_is_said(root: Path, tmp_path: Path) -> None:
    with pytest.raises(AuditError, match="is no folder; give one with recordings"):
        recorded(tmp_path / "nothing")
    with pytest.raises(AuditError, match="holds no recording: no file ends in"):
        recorded(tmp_path)


def test_a_recording_that_has_changed_is_noticed(root: Path, tmp_path: Path) -> None:
    shutil.copy(root / RIDE, tmp_path)
    (found,) = recorded(tmp_path)
    (tmp_path / Path(RIDE).name).write_bytes(b"changed")
    with pytest.raises(AuditError, match="is not the same here"):
        check_content(found)
    (tmp_path / Path(RIDE).name).unlink()
    with pytest.raises(AuditError, match="cannot read"):
        check_content(found)


def test_a_scenario_folder_that_has_changed_is_another_one(root: Path, tmp_path: Path) -> None:
    folder = tmp_path / "own"
    shutil.copytree(root / "sim" / "scenarios" / "s1", folder)
    before = driven([str(folder)], (0,), None)
    toml = folder / "scenario.toml"
    toml.write_text(toml.read_text(encoding="utf-8") + "\n# a comment\n", encoding="utf-8")
    assert driven([str(folder)], (0,), None)[0].content != before[0].content
