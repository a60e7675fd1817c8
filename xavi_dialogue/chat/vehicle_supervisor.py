"""The car of a chat: where its program ends, the same ride is driven again to where it was.

Scenario and seed determine a ride, so what was said of it still holds. A thread watches over the
program, starts it anew, has it drive to the moment that was reached as fast as it can, and then
on as the passenger last wished.
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

SPARE = 3  # times that it is started anew
POLL = 0.2  # [s] between looks at whether it is there
PATIENCE = 90.0  # [s] without a scene, after which a car that is started anew is given up
AGAIN = "The car's program ended and is started again; the ride goes on."
NO_MORE = "The ride cannot go on, but you can still ask about it."
STARTING = "the car's program is started again"
STANDING = "the ride cannot go on; ask on"


@dataclass(frozen=True, slots=True)
class _Wish:
    """How the passenger wants the ride to go on."""

    speed: float  # simulated seconds per second; 0 is as fast as possible
    motion: child_commands.Order

    def after(self, order: child_commands.Order) -> "_Wish":
        match order:
            case child_commands.Speed(factor):
                return replace(self, speed=factor)
            case _:
                return replace(self, motion=order)


class _Over(Exception):
    """The chat is over."""


class SteadyCar:
    """A car that is started anew when its program has ended; its methods may be called anywhere."""

    def __init__(
        self, start: Callable[[], Child], speed: float, tell: Callable[[str], None]
    ) -> None:
        """Start it.

        Args:
            start: starts it; it waits for orders.
            speed: at which it is started.
            tell: gets what the passenger should know, on a thread.
        """
        self._start, self._child, self._tell = start, start(), tell
        self._wish = _Wish(speed, child_commands.Pause())
        self._lock = threading.Lock()  # of all that follows
        self._ready = True  # orders go to the program; else they are remembered
        self._reached: float | None = None  # [s] where the ride has to get to again
        self._before: str | None = None  # name of the ride that broke off
        self._lost: str | None = None  # why there is no car any more
        self._over = threading.Event()
        self._keeper: threading.Thread | None = None

    def follow(self, client: Client) -> None:
        """From now on, start it anew when it has ended.

        Args:
            client: has seen the car's first scene.
        """
        if self._keeper is None:
            self._keeper = threading.Thread(
                target=self._keep, args=(client,), name="keeper", daemon=True
            )
            self._keeper.start()

    def check(self) -> None:
        """Make sure that it is there, as long as nobody sees to it.

        Raises:
            ChildFailed: it has ended.
        """
        if self._keeper is None:
            self._child.check()

    def hope(self) -> None:
        """Make sure that it is there, or will be.

        Raises:
            CommandError: there will be no car any more.
        """
        if self._lost is not None:
            raise CommandError(self._lost)

    def order(self, order: child_commands.Order) -> None:
        """Give an order: now, or as soon as the car is where it was.

        Raises:
            ChildFailed: it has ended, and nobody starts it anew.
            CommandError: there is no car any more.
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
        """Whether all orders have been obeyed in a scene."""
        with self._lock:
            known = self._ready and scene.ride != self._before
            return known and scene.orders >= self._child.ordered

    def now(self, told: float | None) -> float | None:
        """The moment [s] that the passenger has in mind, who has been told up to `told` [s]."""
        with self._lock:
            catching_up = not self._ready and self._lost is None
            if not catching_up or self._reached is None:
                return told
            return max(self._reached, told or 0.0)

    @property
    def catching_up(self) -> bool:
        """Whether it is being started anew."""
        return not self._ready and self._lost is None

    def trouble(self) -> str:
        """See Behind."""
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
        """Have the ride driven to where it was, and then on as the passenger wishes.

        Raises:
            ChildFailed: the car has ended again, or says nothing.
        """
        child = self._child
        child.order(child_commands.Speed(0.0))
        number = child.order(child_commands.Until(self._reached or 0.0))

        def there(scene: SceneReport) -> bool:
            begun = scene.ride != self._before and scene.orders >= number
            return begun and scene.state != "driving"

        if client.wait_for(there, self._still, PATIENCE) is None:
            child.kill()
            raise ChildFailed("the car is not heard of any more")
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
            self._child.kill()  # it is coming up, and hears nothing yet
        self._child.stop()
