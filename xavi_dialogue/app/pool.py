"""A pool of workers, each a process of its own: jobs with deadlines, and a cap on those waiting.

One thread keeps the pool; who submits a job never waits. A job is answered at its deadline at
the latest. A worker that is late then is killed and replaced, so that it holds nobody else up;
so is one that dies. Workers are started as new programs, never forked, and end with this
process, however it ends (see worker.py).
"""

import contextlib
import os
import queue
import subprocess
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from types import TracebackType
from typing import Self, TypeAlias

import msgspec

from xavi_dialogue.app.worker import READY, Result
from xavi_dialogue.explain.explanation import Reason
from xavi_dialogue.transports.messages import Failure

WAITING = 8  # jobs that may wait for a worker
NICENESS = 10  # by which workers stand back behind the driving

Done: TypeAlias = Callable[[bytes | Failure], None]  # gets the plan trace, or why there is none


@dataclass(frozen=True, slots=True, eq=False)
class Job:
    """One thing to be done."""

    order: bytes  # one line; see worker.Order
    deadline: float  # [s] on the monotonic clock
    done: Done  # called once, from the pool's thread


@dataclass(frozen=True, slots=True, eq=False)
class _Heard:
    """What a worker said; None: it is gone."""

    worker: "_Worker"
    line: bytes | None


class _Close:
    """The pool is no longer needed."""


_Event: TypeAlias = Job | _Heard | _Close


class _Worker:
    """One process, and the job that it is at."""

    def __init__(
        self,
        command: Sequence[str],
        environment: Mapping[str, str] | None,
        tell: Callable[[_Event], None],
    ) -> None:
        self.ready = False
        self.job: Job | None = None
        self._tell = tell
        self._process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment,
            start_new_session=True,  # the terminal's signals are for the car
        )
        niceness = min(os.getpriority(os.PRIO_PROCESS, 0) + NICENESS, 19)
        with contextlib.suppress(ProcessLookupError):
            os.setpriority(os.PRIO_PROCESS, self._process.pid, niceness)
        threading.Thread(target=self._listen, name="whatif-ear", daemon=True).start()

    @property
    def pid(self) -> int:
        return self._process.pid

    def begin(self, job: Job) -> None:
        """Hand a job over; on a thread of its own, for the worker may not be listening."""
        self.job = job
        threading.Thread(target=self._write, args=(job.order,), daemon=True).start()

    def kill(self) -> None:
        """End the process at once, and leave nothing of it."""
        self._process.kill()
        self._process.wait()
        assert self._process.stdin is not None
        with contextlib.suppress(BrokenPipeError):
            self._process.stdin.close()

    def _write(self, order: bytes) -> None:
        assert self._process.stdin is not None
        with contextlib.suppress(BrokenPipeError, ValueError):  # it is gone, as will be heard
            self._process.stdin.write(order + b"\n")
            self._process.stdin.flush()

    def _listen(self) -> None:
        assert self._process.stdout is not None
        with self._process.stdout as stream:
            for line in stream:
                self._tell(_Heard(self, line))
        self._tell(_Heard(self, None))


class Pool:
    """Workers that are started by the same command."""

    def __init__(
        self,
        command: Sequence[str],
        *,
        environment: Mapping[str, str] | None = None,
        count: int = 1,
        waiting: int = WAITING,
    ) -> None:
        """Start the workers.

        Args:
            command: the program of a worker and its arguments.
            environment: of the workers; None: ours.
            count: how many there are.
            waiting: how many jobs may wait for one of them.
        """
        self._command, self._environment = command, environment
        self._count, self._limit = count, waiting
        self._events: queue.SimpleQueue[_Event] = queue.SimpleQueue()
        self._workers: list[_Worker] = []
        self._waiting: deque[Job] = deque()
        self._keeper = threading.Thread(target=self._keep, name="whatif", daemon=True)
        self._keeper.start()

    @property
    def pids(self) -> tuple[int, ...]:
        """The processes that are there now."""
        return tuple(worker.pid for worker in tuple(self._workers))

    def submit(self, job: Job) -> None:
        """Have a job done; returns at once."""
        self._events.put(job)

    def close(self) -> None:
        """End the workers; jobs that are open are answered."""
        self._events.put(_Close())
        self._keeper.join()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def _keep(self) -> None:
        self._mend()
        while True:
            try:
                event = self._events.get(timeout=self._patience())
            except queue.Empty:
                event = None
            match event:
                case Job():
                    self._take(event)
                case _Heard(worker, line):
                    self._hear(worker, line)
                case _Close():
                    break
            self._expire()
            self._assign()
        for worker in self._workers:
            worker.kill()
        self._fail(self._open(), "planner-unavailable", "the car stops planning")
        self._workers.clear()

    def _patience(self) -> float | None:
        """Time [s] to the next deadline."""
        deadlines = [job.deadline for job in self._open()]
        return max(min(deadlines) - time.monotonic(), 0.0) if deadlines else None

    def _open(self) -> list[Job]:
        begun = [worker.job for worker in self._workers if worker.job is not None]
        return begun + list(self._waiting)

    def _take(self, job: Job) -> None:
        if len(self._waiting) >= self._limit:
            self._fail([job], "busy", f"{self._limit} requests are waiting already")
            return
        self._waiting.append(job)
        self._mend()

    def _mend(self) -> None:
        """Start the workers that are missing."""
        while len(self._workers) < self._count:
            self._workers.append(_Worker(self._command, self._environment, self._events.put))

    def _hear(self, worker: _Worker, line: bytes | None) -> None:
        if worker not in self._workers:
            return  # killed meanwhile
        if line is None:
            self._lose(worker)
        elif not worker.ready:
            worker.ready = line == READY
        elif worker.job is not None:
            job, worker.job = worker.job, None
            job.done(_outcome(line))

    def _lose(self, worker: _Worker) -> None:
        """A worker has died; one that did not even start is not tried again before the next job."""
        self._workers.remove(worker)
        worker.kill()
        if worker.job is not None:
            self._fail([worker.job], "planner-failed", "the planner's process has died")
        if worker.ready:
            self._mend()
        elif not self._workers:
            self._fail(self._waiting, "planner-failed", "the planner's process does not start")
            self._waiting.clear()

    def _expire(self) -> None:
        """Answer the jobs whose time is up; who is still at one is replaced."""
        now = time.monotonic()
        late = [job for job in self._open() if job.deadline <= now]
        for worker in tuple(self._workers):
            if worker.job in late:
                self._workers.remove(worker)
                worker.kill()
                self._mend()
        self._waiting = deque(job for job in self._waiting if job not in late)
        self._fail(late, "timed-out", "not planned within the time given")

    def _assign(self) -> None:
        for worker in self._workers:
            if worker.ready and worker.job is None and self._waiting:
                worker.begin(self._waiting.popleft())

    @staticmethod
    def _fail(jobs: Sequence[Job], reason: Reason, detail: str) -> None:
        for job in tuple(jobs):
            job.done(Failure(reason=reason, detail=detail))


def _outcome(line: bytes) -> bytes | Failure:
    """The plan trace in a worker's line, or why there is none."""
    try:
        result = msgspec.json.decode(line, type=Result)
        message = bytes(result.message)
        return message if result.planned else msgspec.json.decode(message, type=Failure)
    except msgspec.MsgspecError as error:
        return Failure(reason="planner-failed", detail=f"no result: {error}")
