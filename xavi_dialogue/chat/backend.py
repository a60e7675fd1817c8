"""The processes behind a conversation: started for it, or by others."""

from typing import Protocol

from xavi_dialogue.bus.messages import SceneReport
from xavi_dialogue.chat.client import Client
from xavi_dialogue.process import child_commands
from xavi_dialogue.runtime import system


class Backend(Protocol):
    """Vehicle and service, as a conversation uses them."""

    @property
    def over(self) -> system.Event:
        """An event that is set when the conversation is over."""

    @property
    def paced(self) -> bool:
        """Whether it takes orders about the pace of the ride."""

    def check(self) -> None:
        """Make sure that the conversation can go on.

        Raises:
            ChildFailed: it cannot.
        """

    def recover(self, client: Client) -> bool:
        """Restore a service that answers; return whether there is one.

        Raises:
            ChildFailed: see `check`.
        """

    def order(self, order: child_commands.Order) -> None:
        """Give the car an order.

        Raises:
            CommandError: it accepts no commands.
        """

    def set_off(self) -> None:
        """Let the ride begin or continue, now that the passenger can see it."""

    def drive(
        self, client: Client, order: child_commands.Order, *, halt: bool = False
    ) -> SceneReport:
        """Send a command to the car, and wait until it has been carried out.

        Args:
            client: sees the car's scenes.
            order: to give.
            halt: also wait until the car has halted or the ride is over.

        Raises:
            ChildFailed: a process has ended, or the car is silent.
            CommandError: it accepts no commands.
        """

    def now(self, client: Client) -> float | None:
        """Return the latest time [s] that the passenger has seen; None before the first scene."""

    def trouble(self) -> str:
        """Return a permanent note about the car's process, empty if all is well."""
