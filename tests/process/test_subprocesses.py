"""Child processes: how they end, and that they leave nothing behind."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.drills.processes import state_of
from xavi_dialogue.process import scratch, subprocesses
from xavi_dialogue.process.subprocesses import Child

pytestmark = pytest.mark.slow

PATIENCE = 20.0  # [s] before a test gives up
OBEYS = "cat > /dev/null"  # ends when its input does
DEAF = "trap '' TERM; while :; do sleep 0.1; done"


@pytest.fixture
def begin(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Callable[[str], Child]:
    """Starts a child that writes a temporary file, and then does as a line of shell says."""
    folder = tmp_path / "tmp"
    folder.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(folder))

    def begun(line: str) -> Child:
        program = tmp_path / "program"
        program.write_text(f'#!/bin/sh\ntouch "$TMPDIR/left"\n{line}\n')
        program.chmod(0o700)
        monkeypatch.setattr(sys, "executable", str(program))
        child = Child("the car", ["drive"])
        assert until(lambda: [*folder.glob("*/left")])
        return child

    return begun


def until(condition: Callable[[], object]) -> bool:
    give_up = time.monotonic() + PATIENCE
    while time.monotonic() < give_up:
        if condition():
            return True
        time.sleep(0.01)
    return False


def left(tmp_path: Path) -> list[Path]:
    return list((tmp_path / "tmp").iterdir())


def test_a_child_that_is_killed_leaves_no_temporary_files(
    begin: Callable[[str], Child], tmp_path: Path
) -> None:
    child = begin(OBEYS)
    assert len(left(tmp_path)) == 1
    child.kill()
    child.stop()
    assert left(tmp_path) == []
    child.stop()  # again, which does nothing


def test_nor_does_one_that_does_not_end_by_itself(
    begin: Callable[[str], Child], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(subprocesses, "ORDERLY", 0.1)
    monkeypatch.setattr(subprocesses, "FORCED", 0.1)
    child = begin(DEAF)
    child.stop()
    assert child._process.returncode == -signal.SIGKILL
    assert left(tmp_path) == []


def test_nor_one_that_cannot_be_started(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "tmp").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "tmp"))
    monkeypatch.setattr(sys, "executable", str(tmp_path / "nothing"))
    with pytest.raises(FileNotFoundError):
        Child("the car", ["drive"])
    assert left(tmp_path) == []


def test_a_child_that_was_stopped_by_a_signal_ends_in_order(
    begin: Callable[[str], Child], tmp_path: Path
) -> None:
    child = begin(OBEYS)
    os.kill(child.pid, signal.SIGSTOP)
    assert until(lambda: state_of(child.pid) == "T")
    child.stop()
    assert child._process.returncode == 0
    assert left(tmp_path) == []


def test_a_child_whose_parent_was_killed_deletes_its_folder_itself(tmp_path: Path) -> None:
    folder = tmp_path / "xavi-child"
    folder.mkdir()
    listens = (
        "import io, queue; from xavi_dialogue.process import child_commands as c;"
        "c.listen(io.StringIO(), queue.SimpleQueue())"
    )
    for extra, there in (({}, True), ({scratch.PLACE: str(folder)}, False)):
        subprocess.run([sys.executable, "-c", listens], env={**os.environ, **extra}, check=True)
        assert folder.exists() == there
