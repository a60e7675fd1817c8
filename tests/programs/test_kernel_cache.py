"""Where compiled kernels are kept, and that one decision compiles all of them."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from xavi_dialogue.process import kernel_cache


@pytest.fixture
def nowhere(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """No place for compiled kernels but temporary ones."""
    file = tmp_path / "file"
    file.touch()
    lent = tmp_path / "lent"
    lent.mkdir()
    monkeypatch.setattr(kernel_cache, "BESIDE", file / "__pycache__")
    monkeypatch.setattr("tempfile.tempdir", str(lent))
    monkeypatch.setenv("XDG_CACHE_HOME", str(file))
    monkeypatch.setenv(kernel_cache.PLACE, "")
    monkeypatch.delenv(kernel_cache.PLACE)
    return lent


def test_where_nothing_can_be_written_a_place_is_lent(nowhere: Path) -> None:
    kernel_cache.find_place()
    [place] = nowhere.iterdir()
    assert os.environ[kernel_cache.PLACE] == str(place)
    kernel_cache.find_place()
    assert list(nowhere.iterdir()) == [place]


def test_a_place_beside_the_source_is_enough(
    nowhere: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(kernel_cache, "BESIDE", tmp_path / "planner" / "__pycache__")
    kernel_cache.find_place()
    assert kernel_cache.PLACE not in os.environ
    assert list(nowhere.iterdir()) == []


def test_a_place_in_the_users_cache_is_enough(
    nowhere: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    kernel_cache.find_place()
    assert kernel_cache.PLACE not in os.environ


def test_without_any_place_what_needs_none_goes_on(
    nowhere: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(nowhere / "gone"))
    kernel_cache.find_place()
    assert kernel_cache.PLACE not in os.environ


@pytest.mark.slow
def test_warming_compiles_all_that_a_ride_needs(root: Path, tmp_path: Path) -> None:
    # What is compiled is the same however well; so it takes less time.
    environment = {**os.environ, kernel_cache.PLACE: str(tmp_path), "NUMBA_OPT": "1"}

    def compiled(*arguments: str) -> set[str]:
        command = [sys.executable, "-m", *arguments]
        subprocess.run(command, cwd=root, env=environment, check=True, capture_output=True)
        return {path.name for path in tmp_path.rglob("*.nb?")}

    warm = compiled("xavi_dialogue.vehicle.compile_kernels")
    assert warm
    ride = ("xavi_dialogue", "drive", "--scenario", "town", "--duration", "3")
    assert compiled(*ride) == warm
    assert not kernel_cache.missing(tmp_path)


def test_a_file_without_kernels_is_never_missing(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "types.py").write_text("Arc = float\n", encoding="utf-8")
    (tmp_path / "sums.py").write_text("_jit = njit(cache=True)\n", encoding="utf-8")
    monkeypatch.setattr(kernel_cache, "SOURCES", tmp_path)
    assert kernel_cache.missing(tmp_path) == ("sums.py",)
    (tmp_path / "sums.add-3.py311.nbi").touch()
    assert kernel_cache.missing(tmp_path) == ()
