"""Audits that are run: whole, broken off, with workers killed, in processes or on a cluster."""

import multiprocessing
import os
import shutil
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from distributed import LocalCluster

from xavi_dialogue.audit import audit, report
from xavi_dialogue.audit.audit import Audit, Progress, Runner
from xavi_dialogue.audit.errors import AuditError
from xavi_dialogue.audit.program import TOP, files, program
from xavi_dialogue.audit.questions import Question
from xavi_dialogue.audit.running import cluster, local
from xavi_dialogue.audit.sources import Source, driven, recorded
from xavi_dialogue.audit.store import COSTS, Store
from xavi_dialogue.audit.values import Failed
from xavi_dialogue.audit.work import Task, work

pytestmark = pytest.mark.slow

QUESTIONS = (Question("Why did you brake?", "braking"), Question("How fast were you?", 2.0))


def sources() -> tuple[Source, ...]:
    return driven(["s2"], range(4), 4.0)


class Watched:
    """Progress that kills a worker after the first ride."""

    def __init__(self, kill: bool = False) -> None:
        self.known = 0
        self.steps = 0
        self.lost = 0
        self.kill = kill

    @property
    def progress(self) -> Progress:
        return Progress(self._begin, self._step, self._lost)

    def _begin(self, count: int, known: int) -> None:
        assert count
        self.known = known

    def _step(self) -> None:
        self.steps += 1
        if self.kill and self.steps == 1:
            killed = multiprocessing.active_children()[0]
            assert killed.pid is not None
            os.kill(killed.pid, signal.SIGKILL)

    def _lost(self) -> None:
        self.lost += 1


def carried_out(folder: Path, rides: Sequence[Source], watched: Watched, runner: Runner) -> Audit:
    store = Store(folder)
    found = audit.run(rides, QUESTIONS, store, runner, watched.progress)
    report.write(found, store, 10, None)
    return found


def in_processes(folder: Path, rides: Sequence[Source], watched: Watched) -> Audit:
    """An audit by two processes."""
    return carried_out(folder, rides, watched, lambda tasks, lost: local.run(tasks, 2, lost))


def here(folder: Path, rides: Sequence[Source], watched: Watched) -> Audit:
    """An audit by this process, which gives the same results sooner, as it needs no start."""
    return carried_out(folder, rides, watched, lambda tasks, _: ((t, work(t)) for t in tasks))


def content(folder: Path) -> dict[str, bytes]:
    """Return all results; what was measured is none."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file() and path.name != COSTS
    }


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of an audit that nothing interrupted."""
    folder = tmp_path_factory.mktemp("whole")
    found = here(folder, sources(), Watched())
    assert found.failed == ()
    assert len(found.rides) == 4
    return folder


def test_a_killed_process_changes_nothing(whole: Path, tmp_path: Path) -> None:
    watched = Watched(kill=True)
    in_processes(tmp_path, sources(), watched)
    assert watched.lost >= 1
    assert content(tmp_path) == content(whole)


def test_an_audit_goes_on_where_it_broke_off(whole: Path, tmp_path: Path) -> None:
    here(tmp_path, sources()[:2], Watched())
    ride = next((tmp_path / "rides").iterdir())
    ride.write_bytes(ride.read_bytes()[:-20])  # as after a full disk
    watched = Watched()
    here(tmp_path, sources(), watched)
    assert (watched.known, watched.steps) == (1, 3)
    assert content(tmp_path) == content(whole)
    again = Watched()
    here(tmp_path, sources(), again)
    assert (again.known, again.steps) == (4, 0)
    assert content(tmp_path) == content(whole)


@pytest.fixture(scope="module")
def dask() -> Iterator[LocalCluster]:
    with LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1"
    ) as found:
        yield found


def test_a_killed_worker_of_a_cluster_changes_nothing(
    whole: Path, tmp_path: Path, dask: LocalCluster
) -> None:
    watched, killed = Watched(), []

    def kill_one() -> None:
        watched.steps += 1
        if watched.steps == 1:
            nanny = next(iter(dask.workers.values()))
            killed.append(nanny.pid)
            os.kill(nanny.pid, signal.SIGKILL)

    store = Store(tmp_path)
    progress = Progress(watched.progress.begin, kill_one, watched.progress.lost)
    address = dask.scheduler_address
    found = audit.run(
        sources(), QUESTIONS, store, lambda tasks, lost: cluster.run(tasks, address, lost), progress
    )
    report.write(found, store, 10, None)
    assert killed
    assert content(tmp_path) == content(whole)


def test_a_cluster_that_does_not_answer_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster, "PATIENCE", 0.2)
    task = Task("key", program(), sources()[0], QUESTIONS)
    for address in ("tcp://127.0.0.1:9", "nonsense"):
        with pytest.raises(AuditError, match="no Dask scheduler answers at"):
            list(cluster.run([task], address, lambda: None))


def test_recordings_are_asked_alike(root: Path, tmp_path: Path) -> None:
    rides = tmp_path / "rides"
    rides.mkdir()
    shutil.copy(root / "transcripts" / "rides" / "s1-0.ride.jsonl.gz", rides / "good.ride.jsonl.gz")
    (rides / "bad.ride.jsonl.gz").write_bytes(b"no ride")
    found = here(tmp_path / "out", recorded(rides), Watched())
    (good,) = found.rides
    assert good.facts.scenario == "s1"
    assert good.facts.distance is not None
    assert [answer.kind for answer in good.answers][1:] == ["answer"]
    assert list((tmp_path / "out" / "rides").iterdir()) == []  # they lie elsewhere
    ((bad, why),) = found.failed
    assert bad.ride == "bad.ride.jsonl.gz"
    assert "not a recorded ride" in why or "not a plan trace" in why


def test_a_worker_with_another_program_refuses() -> None:
    result = work(Task("key", "another", sources()[0], QUESTIONS))
    assert isinstance(result, Failed)
    assert "runs another version of this program" in result.why


def test_all_that_computes_results_belongs_to_the_program() -> None:
    ours = {"grammars", "planner", "sim", "xavi_dialogue"}
    known = {str(path) for path in files()}
    code = (
        "import sys, xavi_dialogue.audit.work\n"
        "print(*(m.__file__ for n, m in sys.modules.items()"
        f" if n.split('.')[0] in {ours!r} and getattr(m, '__file__', None)), sep='\\n')"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=TOP, capture_output=True, text=True, check=True
    )
    loaded = set(done.stdout.splitlines())
    assert len(loaded) > 100
    assert loaded <= known


def test_a_fault_of_ours_costs_one_ride(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object) -> None:
        raise KeyError("\x1b[31mego")

    monkeypatch.setattr("xavi_dialogue.audit.work.look_through", fail)
    result = work(Task("key", program(), sources()[0], QUESTIONS))
    assert isinstance(result, Failed)
    assert result.why.startswith("a fault of this program at test_audit_processes.py, line ")
    assert "\x1b" not in result.why


def test_a_recording_that_cannot_be_read_fails_alone(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rides = tmp_path / "rides"
    rides.mkdir()
    shutil.copy(root / "transcripts" / "rides" / "s1-0.ride.jsonl.gz", rides / "a.ride.jsonl.gz")
    shutil.copy(root / "transcripts" / "rides" / "s1-0.ride.jsonl.gz", rides / "b.ride.jsonl.gz")
    read_bytes = Path.read_bytes

    def refuse(path: Path) -> bytes:
        if path.name.startswith("b."):
            raise PermissionError(13, "Permission denied")
        return read_bytes(path)

    monkeypatch.setattr(Path, "read_bytes", refuse)
    one, two = recorded(rides)
    assert one.content
    assert not two.content
    result = work(Task("key", program(), two, QUESTIONS))
    assert result == Failed(f"cannot read {two.place}: Permission denied")


def test_a_page_names_recordings_as_seen_from_its_folder(root: Path, tmp_path: Path) -> None:
    rides = tmp_path / "rides"
    rides.mkdir()
    shutil.copy(root / "transcripts" / "rides" / "s1-0.ride.jsonl.gz", rides / "a.ride.jsonl.gz")
    found = here(tmp_path / "out", recorded(rides), Watched())
    assert not found.failed
    page = (tmp_path / "out" / "audit.html").read_text(encoding="utf-8")
    assert "xavi explain ../rides/a.ride.jsonl.gz" in page
    assert str(tmp_path) not in page


def test_a_stored_ride_that_was_spoilt_is_driven_again(whole: Path, tmp_path: Path) -> None:
    folder = tmp_path / "spoilt"
    shutil.copytree(whole, folder)
    ride = sorted((folder / "rides").iterdir())[0]
    data = bytearray(ride.read_bytes())
    data[len(data) // 2] ^= 0xFF
    ride.write_bytes(data)
    answers = sorted((folder / "answers").iterdir())[0]
    answers.write_bytes(answers.read_bytes()[:-9])
    here(folder, sources(), Watched())
    assert content(folder) == content(whole)
