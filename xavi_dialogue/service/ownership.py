"""Ownership of sessions: a session belongs to the client that begins it, by its token.

Only a digest of a token is kept, in memory and on disk.
"""

import hashlib
import hmac
from collections.abc import Callable, Set
from dataclasses import dataclass, field

from xavi_dialogue.storage.store_errors import StoreError

UNKNOWN = "unknown"  # stands for an owner that cannot be read; no token has this digest
MAX_OWNERS = 200_000  # exceeds the number of sessions in memory, see request_handler.py


@dataclass
class SessionOwners:
    """The owners of sessions; the known owner counts only if there is no stored one to read."""

    recall: Callable[[str], str | None]  # returns the stored digest; may raise StoreError
    changed: Callable[[str], object]  # called with a session whose stored owner is another
    known: dict[str, str | None] = field(default_factory=dict)  # digest by session; None: open

    def admits(self, session: str, token: str | None, *, begun: bool) -> bool:
        """Check whether a token may use this session; an open session may be used by all.

        Args:
            session: its name.
            token: of the client.
            begun: whether it is in memory, or is to be erased. Then nobody may use it as long as
                its owner cannot be read.
        """
        owner = self.of(session)
        if owner is None:
            return True
        if owner == UNKNOWN:
            return not begun
        return token is not None and hmac.compare_digest(owner, digest(token))

    def claim(self, session: str, token: str | None, held: Callable[[], Set[str]]) -> None:
        """Assign a session that begins to the client with this token.

        Args:
            session: its name.
            token: of the client; None leaves the session open.
            held: returns the sessions in memory; owners of other sessions may be dropped.
        """
        owner = self.of(session)
        if owner not in (None, UNKNOWN) or (owner is None and token is None):
            return
        if len(self.known) >= MAX_OWNERS:
            remembered = held()
            self.known = {name: one for name, one in self.known.items() if name in remembered}
        self.known[session] = None if token is None else digest(token)

    def release(self, session: str) -> None:
        """Remove the owner of a session that was erased."""
        self.known.pop(session, None)

    def of(self, session: str) -> str | None:
        """Return the digest of a session's owner; None: open; UNKNOWN: it cannot be read now."""
        try:
            kept = self.recall(session)
        except StoreError:
            return self.known.get(session, UNKNOWN)
        if kept is None:
            return self.known.get(session)
        if self.known.get(session, kept) != kept:  # begun again while the disk could not be read
            self.changed(session)
        if len(self.known) < MAX_OWNERS or session in self.known:
            self.known[session] = kept
        return kept


def digest(token: str) -> str:
    """Return the stored form of a token: 32 bytes in hexadecimal."""
    return hashlib.sha256(token.encode()).hexdigest()
