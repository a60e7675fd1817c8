"""What a conversation rests on: processes of its own, or such as others have started."""

import threading
from typing import Protocol

from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.chat.client import Client
from xavi_dialogue.process import child_commands


class Behind(Protocol):
    """Car and service, as far as a conversation can see to them."""

    @property
    def over(self) -> threading.Event:
        """Set when the conversation is over: nobody waits any more."""

    def check(self) -> None:
        """Make sure that the conversation can go on.

        Raises:
            ChildFailed: it cannot.
        """

    def recover(self, client: Client) -> bool:
        """See to it that there is a service that answers; whether there is.

        Raises:
            ChildFailed: see `check`.
        """

    def order(self, order: child_commands.Order) -> None:
        """Give the car an order.

        Raises:
            CommandError: it takes none.
        """

    def set_off(self) -> None:
        """Let the ride begin, or go on, now that there is somebody to be told of it."""

    def drive(
        self, client: Client, order: child_commands.Order, *, halt: bool = False
    ) -> SceneReport:
        """Give the car an order, and wait until it has obeyed it.

        Args:
            client: sees the car's scenes.
            order: to give.
            halt: wait until the car has halted or the ride is over, too.

        Raises:
            ChildFailed: a process has ended, or the car is not heard of any more.
            CommandError: it takes no orders.
        """

    def now(self, client: Client) -> float | None:
        """The moment [s] up to which the passenger has been told of the ride; None before it."""

    def trouble(self) -> str:
        """What the passenger should know of the car's program at all times, if anything."""
