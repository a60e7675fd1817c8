"""The interface of a chat for the terminal."""

from collections.abc import Awaitable
from typing import Protocol


class ChatInterface(Protocol):
    """A chat as the terminal uses it."""

    def status(self) -> str:
        """Return one line: time, speed, plan."""

    def vehicles(self) -> str:
        """Describe the vehicles in view."""

    def plan(self) -> str:
        """Describe the plan."""

    def words(self) -> tuple[str, ...]:
        """Return the words that Tab can complete."""

    def ask(self, text: str, request: str) -> Awaitable[str]:
        """Return the answer to a question."""

    def why(self) -> Awaitable[str]:
        """Return the question why about the latest answer or action."""

    def history(self) -> Awaitable[str]:
        """Return the turns of this session as text."""

    def save(self, file: str) -> Awaitable[str]:
        """Write the session to a file, a new one if it has no name; return a note about it.

        Raises:
            CommandError: the session is empty, or the file exists or cannot be written.
        """

    def forget(self) -> Awaitable[str]:
        """Erase the session; return a note about it."""

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
        """Raise an error if the ride has ended for the chat."""

    def new_request(self) -> str: ...
