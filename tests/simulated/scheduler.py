"""Tasks of several processes in one thread, on a virtual clock; a seed chooses who runs next.

A task is a greenlet: it runs until it waits, sleeps or ends. Whatever is due at the same time runs
in an order that the seed decides. Processes can be crashed at any of their steps (see `step`),
stalled, and started again.
"""

import heapq
import queue
import random
import traceback
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from typing import Any

from greenlet import getcurrent, greenlet

from xavi_dialogue.runtime.system import System

BEGIN = 1_800_000_000.0  # [s] wall time at which every run begins
JITTER = 0.0005  # [s] until a woken task runs, at most
TICK = 1e-6  # [s] least time that waiting takes: who waits for less would never see time pass
MAX_STEPS = 400_000  # events of a run, beyond which it has got out of hand


class Crashed(BaseException):
    """The process that does this is dead."""


class OutOfHand(AssertionError):
    """The world does not come to rest."""


@dataclass(eq=False)
class Process:
    """One process of a machine, from its start to its end."""

    name: str
    machine: str
    boot: float  # [s] offset of its monotonic clock
    alive: bool = True
    steps: int = 0  # steps so far at which it can crash
    crash_at: int | None = None  # step at which it crashes
    stalled: float = 0.0  # [s] until when it does not run
    tasks: list["Task"] = field(default_factory=list)
    ends: list[Callable[[], None]] = field(default_factory=list)  # called when it has ended
    failure: str | None = None  # of an exception that nobody caught


@dataclass(eq=False)
class Task:
    """A thread of a process."""

    name: str
    process: Process
    scheduler: "Scheduler"
    greenlet: greenlet = field(init=False)
    done: bool = False
    joined: list["Waiter"] = field(default_factory=list)

    def join(self, timeout: float | None = None) -> None:
        """Wait for its end."""
        if not self.done:
            self.scheduler.wait(self.joined, timeout)


@dataclass(eq=False)
class Waiter:
    """A task that waits for something, once."""

    task: Task
    scheduler: "Scheduler"
    woken: bool = False

    def wake(self, found: bool = True) -> None:
        """Let the task go on."""
        if not self.woken:
            self.woken = True
            delay = self.scheduler.dice.random() * JITTER if found else 0.0
            self.scheduler.after(delay, lambda: self.scheduler.resume(self.task, found))


class Scheduler(System):
    """The clock, and all tasks."""

    def __init__(self, seed: int) -> None:
        self.now = 0.0
        self.dice = random.Random(f"schedule {seed}")
        self.process: Process | None = None  # that runs now
        self.task: Task | None = None  # None: a callback of a bus
        self.skew: dict[str, float] = {}  # [s] of wall clocks, by machine
        self.failures: list[str] = []  # exceptions that ended a process or a callback
        self.events = 0
        self._heap: list[tuple[float, float, int, Process | None, Callable[[], None]]] = []
        self._hub = getcurrent()  # the parent of all tasks

    # The door; see System.

    def monotonic(self) -> float:
        return self.now + (0.0 if self.process is None else self.process.boot)

    def wall(self) -> float:
        machine = "" if self.process is None else self.process.machine
        return BEGIN + self.now + self.skew.get(machine, 0.0)

    def sleep(self, delay: float) -> None:
        self.step()
        self.wait([], delay)

    def queue(self) -> "Queue":
        return Queue(self)

    def condition(self) -> "Condition":
        return Condition(self)

    def event(self) -> "Event":
        return Event(self)

    def start(self, name: str, run: Callable[[], None]) -> Task:
        self.step()
        assert self.process is not None
        return self.spawn(self.process, name, run)

    def token(self, size: int) -> str:
        return self.dice.randbytes(size).hex()

    # Time and tasks.

    def step(self) -> None:
        """Count a step of the present process, which may crash here."""
        process = self.process
        if process is None:
            return
        if not process.alive:
            raise Crashed
        process.steps += 1
        if process.crash_at is not None and process.steps >= process.crash_at:
            process.crash_at = None
            process.alive = False
            raise Crashed

    def after(self, delay: float, run: Callable[[], None], process: Process | None = None) -> None:
        """Run a callback after a delay, as a process, if that is still alive then."""
        at = self.now + max(delay, 0.0)
        self.events += 1
        heapq.heappush(self._heap, (at, self.dice.random(), self.events, process, run))

    def spawn(self, process: Process, name: str, run: Callable[[], None]) -> Task:
        """Start a task."""
        task = Task(name, process, self)
        task.greenlet = greenlet(lambda _: self._main(task, run), self._hub)
        process.tasks.append(task)
        self.after(self.dice.random() * JITTER, lambda: self.resume(task, True))
        return task

    def wait(self, waiters: list[Waiter], timeout: float | None) -> bool:
        """Let others run until woken, or until a time [s] has passed; return whether woken."""
        task = self.task
        if task is None:
            raise AssertionError("a callback of the bus waits")
        waiter = Waiter(task, self)
        waiters.append(waiter)
        if timeout is not None:
            self.after(max(timeout, TICK), lambda: waiter.wake(False))
        found = self._hub.switch()
        if waiter in waiters:
            waiters.remove(waiter)
        return bool(found)

    def resume(self, task: Task, found: bool) -> None:
        """Let a task run until it waits."""
        if task.done or not task.process.alive:
            return
        if task.process.stalled > self.now:
            self.after(task.process.stalled - self.now, lambda: self.resume(task, found))
            return
        self.task, self.process = task, task.process
        try:
            task.greenlet.switch(found)
        finally:
            self.task = self.process = None
        if not task.process.alive:
            self.bury(task.process)

    def run(self, until: Callable[[], bool], limit: float) -> bool:
        """Run what is due until something holds; return False if it does not by a time [s]."""
        while not until():
            if not self._heap or self._heap[0][0] > limit:
                return False
            self.now, _, _, process, run = heapq.heappop(self._heap)
            if self.events > MAX_STEPS:
                raise OutOfHand(f"more than {MAX_STEPS} events by {self.now:.1f} s")
            self._call(process, run)
        return True

    def _call(self, process: Process | None, run: Callable[[], None]) -> None:
        if process is None:
            run()
            return
        if not process.alive:
            return
        if process.stalled > self.now:
            self.after(process.stalled - self.now, run, process)
            return
        self.process = process
        try:
            run()
        except Crashed:
            pass
        except Exception:
            self.failures.append(f"{process.name}, on a thread of the bus:\n{_trace()}")
        finally:
            self.process = None
        if not process.alive:
            self.bury(process)

    def kill(self, process: Process) -> None:
        """End a process at once, from outside of it."""
        process.alive = False
        self.bury(process)

    def bury(self, process: Process) -> None:
        """End all tasks of a process that is dead, and release what it held."""
        tasks, process.tasks = process.tasks, []
        for task in tasks:
            if not task.done and task.greenlet:
                self.task, self.process = task, process
                with suppress(Crashed):
                    task.greenlet.throw(Crashed)
            task.done = True
        self.task = self.process = None
        ends, process.ends = process.ends, []
        for end in ends:
            end()

    def _main(self, task: Task, run: Callable[[], None]) -> None:
        try:
            run()
        except Crashed:
            pass
        except Exception:
            self.failures.append(f"{task.process.name}, {task.name}:\n{_trace()}")
        task.done = True
        for waiter in task.joined:
            waiter.wake()
        if task in task.process.tasks:
            task.process.tasks.remove(task)

    @contextmanager
    def acting(self, process: Process) -> Iterator[None]:
        """Do something as a process within."""
        before, self.process = self.process, process
        try:
            yield
        finally:
            self.process = before


def _trace() -> str:
    return traceback.format_exc(limit=-12)


class Queue:
    """See runtime.system.Queue."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler, self._items = scheduler, deque[Any]()
        self._waiters: list[Waiter] = []

    def put(self, item: object) -> None:
        self._scheduler.step()
        self._items.append(item)
        if self._waiters:
            self._waiters[0].wake()

    def get(self, block: bool = True, timeout: float | None = None) -> Any:
        self._scheduler.step()
        if timeout is not None and timeout > 0.0:
            timeout = max(timeout, TICK)
        give_up = None if timeout is None else self._scheduler.now + timeout
        while not self._items:
            left = None if give_up is None else give_up - self._scheduler.now
            if not block or (left is not None and left <= 1e-9):
                raise queue.Empty
            self._scheduler.wait(self._waiters, left)
        return self._items.popleft()

    def get_nowait(self) -> Any:
        return self.get(False)

    def qsize(self) -> int:
        return len(self._items)

    def empty(self) -> bool:
        return not self._items


class Condition:
    """See runtime.system.Condition; a task that holds it is not interrupted by others."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self._waiters: list[Waiter] = []

    def __enter__(self) -> bool:
        return True

    def __exit__(self, *error: object) -> None:
        pass

    def wait(self, timeout: float | None = None) -> bool:
        self._scheduler.step()
        return self._scheduler.wait(self._waiters, timeout)

    def wait_for(self, predicate: Callable[[], object], timeout: float | None = None) -> object:
        give_up = None if timeout is None else self._scheduler.now + timeout
        while not (found := predicate()):
            left = None if give_up is None else give_up - self._scheduler.now
            if left is not None and left <= 1e-9:
                break
            self.wait(left)
        return found

    def notify(self) -> None:
        self.notify_all()

    def notify_all(self) -> None:
        for waiter in self._waiters:
            waiter.wake()


class Event:
    """See runtime.system.Event."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler, self._set = scheduler, False
        self._waiters: list[Waiter] = []

    def is_set(self) -> bool:
        return self._set

    def set(self) -> None:
        self._set = True
        for waiter in self._waiters:
            waiter.wake()

    def wait(self, timeout: float | None = None) -> bool:
        self._scheduler.step()
        if not self._set:
            self._scheduler.wait(self._waiters, timeout)
        return self._set
