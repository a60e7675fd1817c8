"""What the web server asks of the rest of the program, and what it offers to it.

The server knows browsers, messages and limits, and nothing of cars. A `Board` knows the ride and
the conversation, and nothing of sockets. All methods of a board are called on the server's event
loop, one at a time, and must return at once: what takes longer is done elsewhere and told later.

Threads of a bus never call the server's `tell` or a viewer's: they hand over to the loop with
`Audience.soon`, which is the one method that any thread may call.
"""

from collections.abc import Callable
from typing import Any, Protocol

from xavi_dialogue.dashboard.web.client_session import Viewer
from xavi_dialogue.dashboard.web.websocket_messages import Ask, Cancel, Outgoing, Suggest


class Board(Protocol):
    """What there is to see and to ask.

    An exception out of any of these is logged, and told to the browser as a fault of ours without
    its words; the server goes on.
    """

    def greet(self, viewer: Viewer) -> tuple[Outgoing, ...]:
        """All that a new browser is to be told, in order, the welcome first.

        A scene among it is shown as any other. Of a status the server fills in `dropped` and
        `browsers` itself, here and in `tell`. Between this call and the first message that is told
        to all afterwards nothing is lost.
        """

    def ask(self, viewer: Viewer, message: Ask) -> None:
        """A question came. What comes of it is told with `viewer.tell`, and to all, later.

        After `left` a viewer may still be told something; that goes nowhere.
        """

    def cancel(self, viewer: Viewer, message: Cancel) -> None:
        """An answer is no longer wanted; the request may be unknown, or another browser's."""

    def suggest(self, viewer: Viewer, message: Suggest) -> None:
        """What could be asked at a moment is wanted: `viewer.tell(Suggestions(...))`."""

    def left(self, viewer: Viewer) -> None:
        """A browser is gone; called exactly once for each that was greeted."""

    def roads(self, name: str) -> bytes | None:
        """`documents.Roads` as JSON, by its hash; None: not known."""

    def past(self) -> bytes:
        """`documents.Past` as JSON; without scenes where there is no ride yet."""

    def decision(self, name: str) -> bytes | None:
        """`documents.DecisionShown` as JSON, by its trace id; None: not known."""

    async def evidence(self, number: int) -> bytes | None:
        """`documents.EvidenceShown` as JSON, of a turn; None: there is none.

        It may take its time, up to `site.EVIDENCE_WAIT` seconds, without holding up the loop; it is
        cancelled after that, and when the server ends.
        """


class Audience(Protocol):
    """All browsers that are there: what `server.Server` is to a board."""

    @property
    def browsers(self) -> int:
        """How many."""

    def tell(self, message: Outgoing) -> None:
        """Tell all of them; made JSON once. On the event loop only."""

    def soon(self, function: Callable[..., None], *arguments: Any) -> None:
        """Have something called on the event loop; any thread may say so, at any time.

        In the order in which it was said. What is said before the server runs is done when it
        begins; what is said after its end is not done. An exception of it is logged.
        """
