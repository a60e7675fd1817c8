"""Supervision of a chat's vehicle process, which is restarted and drives the same ride again.

Scenario and seed determine a ride, so earlier answers about it stay valid. A thread watches the
process and restarts it. The car then drives to the time that was reached as fast as possible, and
continues at the pace that the passenger last set.
"""

import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from types import TracebackType
from typing import Self

from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.chat.client import Client
from xavi_dialogue.process import child_commands
from xavi_dialogue.process.subprocesses import Child, ChildFailed
from xavi_dialogue.terminal.slash_commands import CommandError

SPARE = 3  # greatest number of restarts
POLL = 0.2  # [s] between checks of the process
PATIENCE = 90.0  # [s] without a scene after which a restarted car is given up
AGAIN = "The car's program ended and is started again; the ride goes on."
NO_MORE = "The ride cannot go on, but you can still ask about it."
STARTING = "the car's program is started again"
STANDING = "the ride cannot go on; ask on"


@dataclass(frozen=True, slots=True)
class _WantedPace:
    """The pace at which the passenger wants the ride to continue."""

    speed: float  # simulated seconds per second; 0 is as fast as possible
    motion: child_commands.Order

    def after(self, order: child_commands.Order) -> "_WantedPace":
        match order:
            case child_commands.Speed(factor):
                return replace(self, speed=factor)
            case _:
                return replace(self, motion=order)


class _Over(Exception):
    """The chat is over."""


class VehicleSupervisor:
    """A vehicle process that is restarted when it ends; its methods are thread-safe."""

    def __init__(
        self, start: Callable[[], Child], speed: float, tell: Callable[[str], None]
    ) -> None:
        """Start the process.

        Args:
            start: starts the process, which waits for orders.
            speed: its initial speed; see `_WantedPace`.
            tell: gets notes for the passenger, on a thread.
        """
        self._start, self._child, self._tell = start, start(), tell
        self._wish = _WantedPace(speed, child_commands.Pause())
        self._lock = threading.Lock()  # protects the attributes below
        self._ready = True  # orders go to the process; otherwise they are remembered
        self._reached: float | None = None  # [s] time that the ride has to reach again
        self._before: str | None = None  # name of the ride that broke off
        self._lost: str | None = None  # why the car has ended for good
        self._over = threading.Event()
        self._keeper: threading.Thread | None = None

    def follow(self, client: Client) -> None:
        """Begin to restart the process when it ends.

        Args:
            client: has seen the car's first scene.
        """
        if self._keeper is None:
            self._keeper = threading.Thread(
                target=self._keep, args=(client,), name="keeper", daemon=True
            )
            self._keeper.start()

    def check(self) -> None:
        """Check that the process runs; call it before `follow`.

        Raises:
            ChildFailed: it has ended.
        """
        if self._keeper is None:
            self._child.check()

    def hope(self) -> None:
        """Check that the process runs or is being restarted.

        Raises:
            CommandError: it has ended for good.
        """
        if self._lost is not None:
            raise CommandError(self._lost)

    def order(self, order: child_commands.Order) -> None:
        """Send a command now, or as soon as a restarted car has reached its former time.

        Raises:
            ChildFailed: it has ended and is not restarted.
            CommandError: it has ended for good.
        """
        self.hope()
        with self._lock:
            self._wish = self._wish.after(order)
            if not self._ready:
                return
            try:
                self._child.order(order)
            except ChildFailed:
                self._ready = False
                if self._keeper is None:
                    raise

    def obeyed(self, scene: SceneReport) -> bool:
        """Check whether a scene shows that all commands were carried out."""
        with self._lock:
            known = self._ready and scene.ride != self._before
            return known and scene.orders >= self._child.ordered

    def now(self, told: float | None) -> float | None:
        """Return the time [s] that a question is about, if scenes were seen up to `told` [s]."""
        with self._lock:
            catching_up = not self._ready and self._lost is None
            if not catching_up or self._reached is None:
                return told
            return max(self._reached, told or 0.0)

    @property
    def catching_up(self) -> bool:
        """Whether the process is being restarted."""
        return not self._ready and self._lost is None

    def trouble(self) -> str:
        """See Backend."""
        if self._lost is not None:
            return STANDING
        return STARTING if self.catching_up else ""

    def _keep(self, client: Client) -> None:
        spare = SPARE
        while True:
            try:
                if not self._ready:
                    self._catch_up(client)
                while not self._over.wait(POLL):
                    self._child.check()
            except _Over:
                return
            except ChildFailed as error:
                if spare == 0:
                    self._give_up(error)
                    return
                spare -= 1
                self._start_again(client)
            else:
                return

    def _start_again(self, client: Client) -> None:
        scene = client.scene
        with self._lock:
            self._ready = False
            if scene is not None:
                self._before = scene.ride
                self._reached = max(scene.sim_time, self._reached or 0.0)
        self._child.stop()
        if not self._over.is_set():
            self._tell(AGAIN)
            child = self._start()
            with self._lock:
                self._child = child

    def _catch_up(self, client: Client) -> None:
        """Drive to the time that the ride had reached, and then at the passenger's pace.

        Raises:
            ChildFailed: the car has ended again, or is silent.
        """
        child = self._child
        child.order(child_commands.Speed(0.0))
        number = child.order(child_commands.Until(self._reached or 0.0))

        def there(scene: SceneReport) -> bool:
            begun = scene.ride != self._before and scene.orders >= number
            return begun and scene.state != "driving"

        if client.wait_for(there, self._still, PATIENCE) is None:
            child.kill()
            raise ChildFailed("the car no longer sends anything")
        with self._lock:
            child.order(child_commands.Speed(self._wish.speed))
            child.order(self._wish.motion)
            self._ready = True

    def _still(self) -> None:
        if self._over.is_set():
            raise _Over
        self._child.check()

    def _give_up(self, error: ChildFailed) -> None:
        text = str(error)
        with self._lock:
            self._lost, self._ready = NO_MORE, False
        self._tell(f"{text[:1].upper()}{text[1:].rstrip('.')}. {NO_MORE}")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._over.set()
        if self._keeper is not None:
            self._keeper.join()
        if self._keeper is None or not self._ready:
            self._child.kill()  # it is starting and cannot read yet
        self._child.stop()
