"""Whose a session is: it belongs to whoever begins it, and shows the same token from then on.

Of a token only a digest is kept, in memory and on disk.
"""

import hashlib
import hmac
from collections.abc import Callable, Set
from dataclasses import dataclass, field

MAX_OWNERS = 200_000  # that are known; more than there are sessions in memory, see reception.py


@dataclass
class Owners:
    """The owners of sessions, as far as they are known."""

    recall: Callable[[str], str | None]  # the digest that is kept on disk with a session
    known: dict[str, str] = field(default_factory=dict)  # digest by session

    def admits(self, session: str, token: str | None) -> bool:
        """Whether a token may ask for this session; an open session is open to all."""
        owner = self.of(session)
        given = None if token is None else digest(token)
        return owner is None or (given is not None and hmac.compare_digest(owner, given))

    def claim(self, session: str, token: str | None, held: Callable[[], Set[str]]) -> None:
        """Let an open session belong to whoever has this token.

        Args:
            session: that is begun.
            token: of who begins it; None leaves it open.
            held: the sessions of which anything is remembered; the owners of others may go.
        """
        if token is None or self.of(session) is not None:
            return
        if len(self.known) >= MAX_OWNERS:
            remembered = held()
            self.known = {name: one for name, one in self.known.items() if name in remembered}
        self.known[session] = digest(token)

    def release(self, session: str) -> None:
        """A session that is forgotten belongs to nobody."""
        self.known.pop(session, None)

    def of(self, session: str) -> str | None:
        """The digest of a session's owner; None: it is open."""
        return self.recall(session) or self.known.get(session)


def digest(token: str) -> str:
    """What is kept of a token: 32 bytes in hexadecimal."""
    return hashlib.sha256(token.encode()).hexdigest()
