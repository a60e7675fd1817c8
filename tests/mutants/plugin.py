"""A pytest plugin: loads all tests once, then tries every fault in a copy of the process."""

import gc
import os
import pickle
import resource
import signal
import sys
import tempfile
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from _pytest.runner import runtestprotocol

from tests.mutants import fresh, rooms, swap
from tests.mutants import reach as reaching
from tests.mutants.edits import planted
from tests.mutants.faults import Fault
from tests.mutants.reach import Reach

FAST = (
    5.0  # [s], with lines recorded, that a test may take; a longer one is not among the fast tests
)
BUDGET = 4.0  # [s] that the tests of one fault may take; the rest is not run
PATIENCE = 8.0  # times the time of the tests: then the fault counts as noticed
GRACE = 60.0  # [s] beside that
LOADING = 60.0  # [s] more, for loading everything anew
LONGEST = 3600.0  # [s] that measuring may take
STARTS = {"subprocess.Popen", "os.fork", "os.forkpty", "os.posix_spawn", "os.exec"}
MEMORY = 4 << 30  # [bytes] that a test may take beyond what the process has


@dataclass(frozen=True)
class Broken:
    """How a copy broke down."""

    how: str


class Trial:
    """What came of one fault."""

    def __init__(self, fault: Fault, by: str, tried: int, seconds: float) -> None:
        self.fault = fault
        self.by = by  # the test that noticed, "time" or "crash"; "" where none did
        self.tried = tried  # tests that were there to notice
        self.seconds = seconds


class Planter:
    """Measures the tests, then plants each fault and runs the tests that reach it."""

    def __init__(self, faults: list[Fault], kept: Path | None = None) -> None:
        self.faults = faults
        self.kept = kept  # file of what the tests reach, written where there is none
        self.trials: list[Trial] = []
        self.reach = Reach()
        self.files = {path: str(rooms.ROOT / path) for _, path in rooms.modules()}
        self.seen = reaching.watch(self.files.values())
        self.items: dict[str, pytest.Item] = {}
        self.sound: dict[str, bool] = {}  # whether a test passes on its own
        self.functions: swap.Functions = {}
        self.caches: list[Any] = []

    def start(self) -> None:
        """Begin to record what is run when modules are loaded."""
        self.seen.start()

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtestloop(self, session: pytest.Session) -> bool:
        self.seen.stop()
        loading = set(reaching.lines_of(self.seen, str(rooms.ROOT)))
        self.items = {item.nodeid: item for item in session.items}
        self.reach = self._reach(loading)
        if self.reach.failed:
            session.testsfailed = len(self.reach.failed)
            return True
        gc.unfreeze()  # what is excluded from collections is not listed, either
        self.functions = swap.living(self.files.values())
        self.caches = swap.caches(self.files.values())
        gc.freeze()
        for number, fault in enumerate(self.faults, 1):
            trial = self._try(fault)
            self.trials.append(trial)
            told = f"noticed by {trial.by}" if trial.by else "NOT NOTICED"
            note(f"{number}/{len(self.faults)} {trial.seconds:5.1f} s  {fault.name}  {told}")
        return True

    def _reach(self, loading: set[reaching.Line]) -> Reach:
        if self.kept is not None and self.kept.is_file():
            found: Reach = pickle.loads(self.kept.read_bytes())
            new = [name for name in self.items if name not in found.seconds]
            if new:
                more = in_copy(lambda: self._measure(new), limit=LONGEST)
                found = reaching.joined(found, more)
        else:
            found = in_copy(lambda: self._measure(list(self.items)), limit=LONGEST)
        found.loading |= loading
        if self.kept is not None and not found.failed:
            self.kept.write_bytes(pickle.dumps(found))
        return found

    def _measure(self, names: list[str]) -> Reach:
        return reaching.measure(
            names,
            lambda k: self._run(names[k], names[k + 1] if k + 1 < len(names) else None) == "",
            reaching.watch(self.files.values()),
            str(rooms.ROOT),
        )

    def _run(self, name: str, after: str | None) -> str:
        """Run one test; its name where it fails."""
        following = self.items[after] if after else None
        reports = runtestprotocol(self.items[name], log=False, nextitem=following)
        return name if any(report.failed for report in reports) else ""

    def _try(self, fault: Fault) -> Trial:
        """Try a fault; a test that fails on its own with nothing planted is no witness."""
        while True:
            trial = self._tried(fault)
            if trial.by not in self.items or self._passes(trial.by):
                return trial
            note(f"{trial.by} fails on its own and is left out")

    def _passes(self, test: str) -> bool:
        """Whether a test passes on its own with nothing planted."""
        if test not in self.sound:
            try:
                self.sound[test] = in_copy(lambda: self._alone(test), GRACE) == ""
            except (TimeoutError, ChildProcessError):
                self.sound[test] = False
        return self.sound[test]

    def _alone(self, test: str) -> str:
        sys.addaudithook(refuse)
        return self._run(test, None)

    def _tried(self, fault: Fault) -> Trial:
        begun = time.perf_counter()
        tests = self.tests_for(fault)
        if not tests:
            return Trial(fault, "", 0, 0.0)
        try:
            if self.reach.loads(fault.path, *fault.statement):
                raise swap.NotSwapped("it is run when the module is loaded")
            by = in_copy(lambda: self._planted(fault, tests), limit=self.limit(tests))
        except swap.NotSwapped:
            by = fresh.attempt(fault, tests, self.limit(tests) + LOADING)
        except TimeoutError:
            by = "time"
        except ChildProcessError:
            by = "crash"
        return Trial(fault, by, len(tests), time.perf_counter() - begun)

    def tests_for(self, fault: Fault) -> list[str]:
        """The tests that run the statement; of one run on loading, those that use its module.

        After them comes the rest of their files: a test may use what an earlier one left in a
        cache, and not run the line itself.
        """
        direct = self.reach.of(fault.path, *fault.statement)
        if not fault.in_function or self.reach.loads(fault.path, *fault.statement):
            direct |= self.reach.of_module(fault.path)
        direct = {test for test in direct & self.items.keys() if self.sound.get(test, True)}
        files = reaching.by_file(direct)
        rest = {
            name
            for name in self.items
            if name.partition("::")[0] in files and self.sound.get(name, True)
        } - direct
        order = [*reaching.in_order(direct, self.reach), *reaching.in_order(rest, self.reach)]
        return reaching.within(order, self.reach, FAST, BUDGET)

    def limit(self, tests: list[str]) -> float:
        """The time [s] after which tests are given up."""
        return PATIENCE * sum(self.reach.seconds[test] for test in tests) + GRACE

    def _planted(self, fault: Fault, tests: list[str]) -> str:
        """Plant a fault in this process and run tests until one fails; its name, or ""."""
        name = self.files[fault.path]
        source = Path(name).read_text(encoding="utf-8")
        tree, _ = planted(source, fault.number)
        swap.swap(compile(source, name, "exec"), compile(tree, name, "exec"), self.functions[name])
        for cache in self.caches:
            cache.cache_clear()
        sys.addaudithook(refuse)
        for test, after in zip(tests, [*tests[1:], None], strict=True):
            if self._run(test, after):
                return test
        return ""


def in_copy(work: Callable[[], Any], limit: float) -> Any:
    """Do something in a copy of this process, and hand back what it returns or raises.

    Raises:
        TimeoutError: if it takes longer than `limit` [s].
        ChildProcessError: if the copy breaks down.
    """
    with tempfile.TemporaryFile() as answer:
        copy = os.fork()
        if copy == 0:
            _answer(work, answer, limit)
        _, status = os.waitpid(copy, 0)
        if os.WIFSIGNALED(status) and os.WTERMSIG(status) == signal.SIGALRM:
            raise TimeoutError
        if status != 0:
            raise ChildProcessError
        answer.seek(0)
        found = pickle.load(answer)
    if isinstance(found, Broken):
        raise ChildProcessError(found.how)
    if isinstance(found, Exception):
        raise found
    return found


def _answer(work: Callable[[], Any], answer: Any, limit: float) -> None:
    """Work in the copy, silently, and end it."""
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.setitimer(signal.ITIMER_REAL, limit)
    nothing = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nothing, stream)
    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + MEMORY, used + MEMORY))
    status = 1
    try:
        try:
            found = work()
        except swap.NotSwapped as error:
            found = error
        except Exception:
            found = Broken(traceback.format_exc())
        pickle.dump(found, answer)
        answer.flush()
        status = 0
    finally:
        os._exit(status)


def refuse(event: str, _: tuple[object, ...]) -> None:
    """Let no test start a process: that would load the code without the fault.

    Raises:
        RuntimeError: where one would be started.
    """
    if event in STARTS:
        raise RuntimeError(f"a fault is planted: {event}")


def note(text: str) -> None:
    """Say how far it has come, past what pytest captures."""
    print(text, file=sys.__stderr__, flush=True)
