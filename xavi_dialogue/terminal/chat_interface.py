"""What a chat at a terminal talks to."""

from collections.abc import Awaitable
from typing import Protocol


class Cabin(Protocol):
    """What the terminal talks to."""

    def status(self) -> str:
        """One line: time, speed, plan."""

    def vehicles(self) -> str:
        """The vehicles in view, in words."""

    def plan(self) -> str:
        """The plan in words."""

    def words(self) -> tuple[str, ...]:
        """What can be completed to."""

    def ask(self, text: str, request: str) -> Awaitable[str]:
        """The answer to a question."""

    def why(self) -> Awaitable[str]:
        """The question why, as it has to be asked now."""

    def history(self) -> Awaitable[str]:
        """What was said in this session."""

    def save(self, file: str) -> Awaitable[str]:
        """Write what was said into a file, a new one if it has no name; say which.

        Raises:
            CommandError: nothing was said, there is such a file, or it cannot be written.
        """

    def forget(self) -> Awaitable[str]:
        """Erase what was said; say how much it was."""

    def cancel(self, request: str) -> None: ...

    def pause(self) -> None: ...

    def resume(self) -> None: ...

    def speed(self, factor: float) -> None: ...

    def seek(self, time: float) -> None:
        """Go to a moment [s].

        Raises:
            CommandError: the ride is not a recorded one.
        """

    def check(self) -> None:
        """Raise where the ride cannot be talked about any more."""

    def new_request(self) -> str: ...
