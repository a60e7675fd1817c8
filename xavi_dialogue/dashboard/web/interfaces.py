"""Interfaces between the web server and the rest of the dashboard.

The server knows browsers, messages and limits, but no cars. A `DashboardSource` knows the ride and
the conversation, but no sockets. All its methods are called on the event loop of the server,
one at a time, and must return at once: slow work is done elsewhere and reported later.

Threads of a bus never call methods of the server or a session directly, except for
`Browsers.soon`, which passes a call to the loop.
"""

from collections.abc import Callable
from typing import Any, Protocol

from xavi_dialogue.dashboard.web.client_session import ClientSession
from xavi_dialogue.dashboard.web.websocket_messages import Ask, Cancel, Outgoing, Suggest


class DashboardSource(Protocol):
    """The contents of the dashboard.

    Exceptions from these methods are logged and reported to the browser as an internal error
    without details; the server goes on.
    """

    def greet(self, viewer: ClientSession) -> tuple[Outgoing, ...]:
        """Return all messages for a new browser, in order, the welcome first.

        A scene among it is shown as any other. Of a status the server fills in `dropped` and
        `browsers` itself, here and in `tell`. Between this call and the first message that is told
        to all afterwards nothing is lost.
        """

    def ask(self, viewer: ClientSession, message: Ask) -> None:
        """Handle a question. Send the result with `viewer.tell`, and to all, later.

        After `left` a viewer may still get messages; they are dropped.
        """

    def cancel(self, viewer: ClientSession, message: Cancel) -> None:
        """Cancel a question; it may be unknown, or another browser's."""

    def suggest(self, viewer: ClientSession, message: Suggest) -> None:
        """Send suggestions for a time: `viewer.tell(Suggestions(...))`."""

    def left(self, viewer: ClientSession) -> None:
        """Handle that a browser has disconnected; called once for each that was greeted."""

    def roads(self, name: str) -> bytes | None:
        """Return `documents.Roads` as JSON, by its hash; None: not known."""

    def past(self) -> bytes:
        """Return `http_documents.Past` as JSON; without scenes before the first ride."""

    def decision(self, name: str) -> bytes | None:
        """Return `documents.DecisionShown` as JSON, by its trace id; None: not known."""

    async def evidence(self, number: int) -> bytes | None:
        """Return `http_documents.EvidenceShown` of a turn as JSON; None: there is none.

        It may take up to `routes.EVIDENCE_WAIT` seconds, without blocking the loop; it is
        cancelled after that, and when the server ends.
        """


class Browsers(Protocol):
    """All connected browsers; `server.Server` implements it."""

    @property
    def browsers(self) -> int:
        """The number of connected browsers."""

    def tell(self, message: Outgoing) -> None:
        """Send a message to all of them, encoded once. On the event loop only."""

    def soon(self, function: Callable[..., None], *arguments: Any) -> None:
        """Schedule a call on the event loop; thread-safe, at any time.

        Calls keep their order. Calls from before the server runs are made when it begins; calls
        after its end are dropped. Exceptions are logged.
        """
