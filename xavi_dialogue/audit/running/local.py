"""Local processes that work on rides.

A process that dies takes nothing with it: its ride is begun anew by another one. A ride on which
processes died twice is tried once more by itself, and given up if that process dies, too.
"""

import multiprocessing
import os
import signal
import threading
from collections import Counter, deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from types import TracebackType
from typing import Final, Self, TypeAlias

from xavi_dialogue.audit.values import Done, Failed
from xavi_dialogue.audit.work import Task, work

DEATHS: Final = 2  # processes that may die on a ride before it is tried by itself
GONE: Final = "two processes that worked on it died, and one by itself; is there enough memory?"

Result: TypeAlias = tuple[Task, Done | Failed]


def run(tasks: Sequence[Task], jobs: int, lost: Callable[[], None]) -> Iterator[Result]:
    """Yield the result of each task as it comes.

    Args:
        tasks: what is to be done.
        jobs: number of processes.
        lost: called when a process has died.
    """
    waiting, alone, deaths = deque(tasks), deque[Task](), Counter[str]()
    while waiting or alone:
        queue, width = (waiting, jobs) if waiting else (alone, 1)
        with _Pool(min(width, len(queue))) as pool:
            yield from pool.results(queue)
        if pool.broken:
            lost()
        for task in pool.unfinished:
            deaths[task.key] += 1
            if deaths[task.key] > DEATHS:
                yield task, Failed(GONE)
            else:
                (alone if deaths[task.key] == DEATHS else waiting).appendleft(task)


class _Pool:
    """Processes, until one of them dies."""

    def __init__(self, width: int) -> None:
        self.broken = False
        self._width = width
        self._running: dict[Future[Done | Failed], Task] = {}
        context = multiprocessing.get_context("spawn")
        self._pool = ProcessPoolExecutor(width, mp_context=context, initializer=_begin)

    @property
    def unfinished(self) -> tuple[Task, ...]:
        """The tasks that were begun and have no result."""
        return tuple(self._running.values())

    def results(self, queue: deque[Task]) -> Iterator[Result]:
        """Yield results until the queue is empty or a process dies."""
        while queue or self._running:
            try:
                while queue and len(self._running) < self._width:
                    self._running[self._pool.submit(work, queue[0])] = queue[0]
                    queue.popleft()
                ready, _ = wait(self._running, return_when=FIRST_COMPLETED)
                found = [(future, future.result()) for future in ready if not _died(future)]
            except BrokenProcessPool:  # at a submission
                found, ready = [], set(self._running)
            for future, result in found:
                yield self._running.pop(future), result
            if len(found) < len(ready):
                self.broken = True
                return

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if kind is not None or self.broken:
            for child in multiprocessing.active_children():
                child.kill()
        self._pool.shutdown(wait=True, cancel_futures=True)


def _died(future: Future[Done | Failed]) -> bool:
    return isinstance(future.exception(), BrokenProcessPool)


def _begin() -> None:
    """End this process when its parent ends, however that does, and not by Ctrl-C before."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    assert parent is not None

    def watch() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=watch, name="parent", daemon=True).start()
