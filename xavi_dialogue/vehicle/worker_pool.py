"""A pool of worker processes: jobs with deadlines, and a limit on the jobs that wait.

One thread manages the pool, so that submitting a job never blocks. A job is answered at its
deadline at the latest, and is not begun if it cannot be finished by then. A worker that is late may
finish its job within a short grace period, although the result is discarded: it is warm, and a
replacement takes time to start. The next job goes to the late worker or to its replacement,
whichever is ready first; the other one is killed. A worker that dies is replaced, and its job is
tried once more. Workers are started as new programs, never forked, and end when this process ends
in any way (see replan_worker.py).

The limit holds for all clients together. A client that asks on behalf of many people must divide
it among them.
"""

import contextlib
import os
import queue
import subprocess
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import TracebackType
from typing import Self, TypeAlias

import msgspec

from xavi_dialogue.bus.messages import Failure
from xavi_dialogue.domain.answers import Reason
from xavi_dialogue.vehicle.replan_worker import READY, Result

WAITING = 8  # jobs that may wait for a worker
LEAST = 0.02  # [s] a lower bound of the time that a job takes
GRACE = 1.0  # [s] after which a worker that is late is killed; a new one takes as long to start
NICENESS = 10  # added to the niceness of workers, so that the driving has priority

Done: TypeAlias = Callable[[bytes | Failure], None]  # gets the plan trace, or the reason for none


@dataclass(frozen=True, slots=True, eq=False)
class Job:
    """A job for a worker."""

    order: bytes  # one line; see replan_worker.ReplanOrder
    deadline: float  # [s] on the monotonic clock
    done: Done  # called once, from the pool's thread
    tried: bool = False  # whether a worker died on it


@dataclass(frozen=True, slots=True, eq=False)
class _Heard:
    """A line from a worker; None: it has ended."""

    worker: "_Worker"
    line: bytes | None


class _Close:
    """The request to close the pool."""


_Event: TypeAlias = Job | _Heard | _Close


class _Worker:
    """One worker process, and its current job."""

    def __init__(
        self,
        command: Sequence[str],
        environment: Mapping[str, str] | None,
        tell: Callable[[_Event], None],
    ) -> None:
        self.ready = False
        self.job: Job | None = None
        self.ends: float | None = None  # [s] when a worker that is late is killed
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
        threading.Thread(target=self._listen, name="whatif-replies", daemon=True).start()

    @property
    def pid(self) -> int:
        return self._process.pid

    @property
    def late(self) -> bool:
        """Check whether it works on a job that was already answered without it."""
        return self.ends is not None

    @property
    def idle(self) -> bool:
        return self.ready and self.job is None and not self.late

    def begin(self, job: Job) -> None:
        """Send a job on a separate thread, because the worker may not be reading."""
        self.job = job
        threading.Thread(target=self._write, args=(job.order,), daemon=True).start()

    def kill(self) -> None:
        """End the process at once, and release its resources."""
        self._process.kill()
        self._process.wait()
        assert self._process.stdin is not None
        with contextlib.suppress(BrokenPipeError):
            self._process.stdin.close()

    def _write(self, order: bytes) -> None:
        assert self._process.stdin is not None
        with contextlib.suppress(BrokenPipeError, ValueError):  # it has ended
            self._process.stdin.write(order + b"\n")
            self._process.stdin.flush()

    def _listen(self) -> None:
        assert self._process.stdout is not None
        with self._process.stdout as stream:
            for line in stream:
                self._tell(_Heard(self, line))
        self._tell(_Heard(self, None))


class WorkerPool:
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
            environment: of the workers; None: that of this process.
            count: number of workers.
            waiting: number of jobs that may wait for one of them.
        """
        self._command, self._environment = command, environment
        self._count, self._limit = count, waiting
        self._events: queue.SimpleQueue[_Event] = queue.SimpleQueue()
        self._workers: list[_Worker] = []
        self._waiting: deque[Job] = deque()
        self._unstarted = 0  # workers that failed to start since the latest job came
        self._keeper = threading.Thread(target=self._keep, name="whatif", daemon=True)
        self._keeper.start()

    @property
    def pids(self) -> tuple[int, ...]:
        """The ids of the worker processes that run now."""
        return tuple(worker.pid for worker in tuple(self._workers))

    @property
    def idle(self) -> int:
        """The number of workers that are ready for a job."""
        return sum(worker.idle for worker in tuple(self._workers))

    def submit(self, job: Job) -> None:
        """Submit a job; returns at once."""
        self._events.put(job)

    def close(self) -> None:
        """End the workers; open jobs get a failure."""
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
            self._mend()
        for worker in self._workers:
            worker.kill()
        self._fail(self._open(), "planner-unavailable", "the car stops planning")
        self._workers.clear()

    def _patience(self) -> float | None:
        """Return the time [s] to the next deadline or end of a grace period; None: no limit."""
        ends = [job.deadline for job in self._open()]
        ends += [worker.ends for worker in self._workers if worker.ends is not None]
        return max(min(ends) - time.monotonic(), 0.0) if ends else None

    def _open(self) -> list[Job]:
        begun = [worker.job for worker in self._workers if worker.job is not None]
        return begun + list(self._waiting)

    def _take(self, job: Job) -> None:
        if len(self._waiting) >= self._limit:
            self._fail([job], "busy", f"{self._limit} requests are waiting already")
        else:
            self._waiting.append(job)
            self._unstarted = 0

    def _mend(self) -> None:
        """Start the workers that are missing, and replacements of late ones if jobs wait."""
        late = sum(worker.late for worker in self._workers)
        there = len(self._workers) - min(late, len(self._waiting))
        for _ in range(self._count - self._unstarted - there):
            self._workers.append(_Worker(self._command, self._environment, self._events.put))

    def _hear(self, worker: _Worker, line: bytes | None) -> None:
        if worker not in self._workers:
            return  # killed meanwhile
        if line is None:
            self._lose(worker)
        elif not worker.ready:
            worker.ready = line == READY
        elif worker.late:
            worker.ends = None
        elif worker.job is not None:
            job, worker.job = worker.job, None
            job.done(_outcome(line))
        self._thin_out()

    def _lose(self, worker: _Worker) -> None:
        """Handle the end of a worker; one that failed to start is replaced at the next job."""
        self._workers.remove(worker)
        worker.kill()
        if worker.job is not None and not worker.job.tried:
            self._waiting.appendleft(replace(worker.job, tried=True))
        elif worker.job is not None:
            self._fail([worker.job], "planner-failed", "the planner's process has died")
        if not worker.ready:
            self._unstarted += 1
            if not self._workers:
                self._fail(self._waiting, "planner-failed", "the planner's process does not start")
                self._waiting.clear()

    def _thin_out(self) -> None:
        """Kill surplus workers once enough are ready: late ones, or their replacements."""
        up = [worker for worker in self._workers if worker.ready and not worker.late]
        if len(up) >= self._count:
            for worker in self._workers:
                if worker not in up:
                    worker.kill()
            self._workers = up

    def _expire(self) -> None:
        """Answer the jobs that are overdue; kill workers that exceed the grace period."""
        now = time.monotonic()
        late = [job for job in self._open() if job.deadline <= now]
        late += [job for job in self._waiting if now < job.deadline <= now + LEAST]
        for worker in tuple(self._workers):
            if worker.job in late:
                worker.job, worker.ends = None, now + GRACE
            elif worker.ends is not None and worker.ends <= now:
                self._workers.remove(worker)
                worker.kill()
                self._unstarted = 0
        self._waiting = deque(job for job in self._waiting if job not in late)
        self._fail(late, "timed-out", "not planned within the time given")

    def _assign(self) -> None:
        for worker in self._workers:
            if worker.idle and self._waiting:
                worker.begin(self._waiting.popleft())

    @staticmethod
    def _fail(jobs: Sequence[Job], reason: Reason, detail: str) -> None:
        for job in tuple(jobs):
            job.done(Failure(reason=reason, detail=detail))


def _outcome(line: bytes) -> bytes | Failure:
    """Decode a worker's line: a plan trace, or the reason why there is none."""
    try:
        result = msgspec.json.decode(line, type=Result)
        message = bytes(result.message)
        return message if result.planned else msgspec.json.decode(message, type=Failure)
    except msgspec.MsgspecError as error:
        return Failure(reason="planner-failed", detail=f"no result: {error}")
