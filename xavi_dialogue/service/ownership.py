"""Whose a session is: it belongs to whoever begins it, and shows the same token from then on.

Of a token only a digest is kept, in memory and on disk.
"""

import hashlib
import hmac
from collections.abc import Callable, Set
from dataclasses import dataclass, field

from xavi_dialogue.storage.database import StoreError

UNKNOWN = "unknown"  # in place of a digest: no token has it
MAX_OWNERS = 200_000  # that are known; more than there are sessions in memory, see reception.py


@dataclass
class Owners:
    """The owners of sessions: what is on disk counts; where that cannot be read, what is known."""

    recall: Callable[[str], str | None]  # the digest that is kept on disk; may raise StoreError
    changed: Callable[[str], object]  # is told whose owner turned out to be somebody else
    known: dict[str, str | None] = field(default_factory=dict)  # digest by session; None: open

    def admits(self, session: str, token: str | None, *, begun: bool) -> bool:
        """Whether a token may ask for this session; an open session is open to all.

        Args:
            session: its name.
            token: of whoever asks.
            begun: something of it is in memory, or at stake on disk: then, as long as its owner
                cannot be read, nobody may.
        """
        owner = self.of(session)
        if owner is None:
            return True
        if owner == UNKNOWN:
            return not begun
        return token is not None and hmac.compare_digest(owner, digest(token))

    def claim(self, session: str, token: str | None, held: Callable[[], Set[str]]) -> None:
        """Let a session that is begun belong to whoever has this token.

        Args:
            session: its name.
            token: of who begins it; None leaves it open.
            held: the sessions of which anything is remembered; the owners of others may go.
        """
        owner = self.of(session)
        if owner not in (None, UNKNOWN) or (owner is None and token is None):
            return
        if len(self.known) >= MAX_OWNERS:
            remembered = held()
            self.known = {name: one for name, one in self.known.items() if name in remembered}
        self.known[session] = None if token is None else digest(token)

    def release(self, session: str) -> None:
        """A session that is forgotten belongs to nobody."""
        self.known.pop(session, None)

    def of(self, session: str) -> str | None:
        """The digest of a session's owner; None: it is open; UNKNOWN: that cannot be read now."""
        try:
            kept = self.recall(session)
        except StoreError:
            return self.known.get(session, UNKNOWN)
        if kept is None:
            return self.known.get(session)
        if self.known.get(session, kept) != kept:  # begun anew while the disk could not be read
            self.changed(session)
        if len(self.known) < MAX_OWNERS or session in self.known:
            self.known[session] = kept
        return kept


def digest(token: str) -> str:
    """What is kept of a token: 32 bytes in hexadecimal."""
    return hashlib.sha256(token.encode()).hexdigest()
