"""An event loop of asyncio in a task of the simulated world, on its clock."""

import asyncio
import selectors
from asyncio import events
from collections.abc import Callable, Coroutine
from contextlib import suppress
from typing import Any

from tests.simulated.scheduler import Crashed, Scheduler, Waiter


class _Selector(selectors.BaseSelector):
    """Waits for nothing but time, and for calls from other tasks."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler = scheduler
        self._waiters: list[Waiter] = []
        self._called = False

    def select(self, timeout: float | None = None) -> list[Any]:
        if not self._called and (timeout is None or timeout > 0.0):
            # Other loops run in this thread meanwhile.
            loop = events._get_running_loop()
            events._set_running_loop(None)
            try:
                self._scheduler.step()
                self._scheduler.wait(self._waiters, timeout)
            finally:
                events._set_running_loop(loop)
        self._called = False
        return []

    def call(self) -> None:
        self._called = True
        for waiter in self._waiters:
            waiter.wake()

    def register(self, *_: Any) -> Any:
        raise NotImplementedError("there are no sockets")

    unregister = register

    def get_map(self) -> Any:
        return {}

    def close(self) -> None:
        pass


class VirtualLoop(asyncio.SelectorEventLoop):
    """A loop without sockets; what it runs on other threads runs as tasks."""

    def __init__(self, scheduler: Scheduler) -> None:
        self._scheduler, self._calls = scheduler, _Selector(scheduler)
        self.tasks: list[asyncio.Task[Any]] = []  # that are not done, and some that are
        super().__init__(self._calls)

    def time(self) -> float:
        return self._scheduler.monotonic()

    def create_task(self, coro: Any, **named: Any) -> Any:
        task = super().create_task(coro, **named)
        self.tasks = [one for one in self.tasks if not one.done()] + [task]
        return task

    def run_in_executor(  # type: ignore[override]
        self, executor: None, func: Callable[..., Any], *arguments: Any
    ) -> "asyncio.Future[Any]":
        future = self.create_future()

        def settle(act: Callable[[Any], None], found: Any) -> None:
            if not future.done():
                act(found)

        def run() -> None:
            try:
                found = func(*arguments)
            except Exception as error:
                self.call_soon_threadsafe(settle, future.set_exception, error)
            else:
                self.call_soon_threadsafe(settle, future.set_result, found)

        self._scheduler.start("executor", run)
        return future

    def call_soon_threadsafe(self, callback: Any, *args: Any, context: Any = None) -> Any:
        if self._scheduler.process is not None and not self._scheduler.process.alive:
            return None
        handle = self.call_soon(callback, *args, context=context)
        self._calls.call()
        return handle

    def _make_self_pipe(self) -> None:
        pass

    def _close_self_pipe(self) -> None:
        pass

    def _process_events(self, event_list: list[Any]) -> None:
        pass


def run(scheduler: Scheduler, main: Coroutine[Any, Any, None]) -> None:
    """Run a coroutine to its end on a loop of its own, in the present task."""
    loop = VirtualLoop(scheduler)
    before = events._get_running_loop()
    events._set_running_loop(None)
    try:
        loop.run_until_complete(main)
    except Crashed:
        _abandon(loop)
        main.close()
        raise
    finally:
        events._set_running_loop(before)
        loop.close()


def _abandon(loop: VirtualLoop) -> None:
    """End the coroutines of a dead process, of which nothing runs any more.

    Otherwise they end when they are collected, which is any time later, and complain.
    """
    loop.call_exception_handler = lambda _: None  # type: ignore[method-assign]
    events._set_running_loop(loop)
    for task in loop.tasks:
        coroutine = task.get_coro()
        if coroutine is not None:
            with suppress(Crashed, RuntimeError):  # it awaits something on its way out
                coroutine.close()
