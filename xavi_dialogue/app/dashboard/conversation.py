"""The conversation as a dashboard knows it: whoever asked, here or at a terminal.

The service keeps what is said; here it is compared with what is known, so that what is new can
be told. A turn has no name of its own: where the latest turns overlap with those that are known,
the rest is new.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

from xavi_dialogue.app.dashboard.evidence import has_evidence, vehicles_of
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.transports.messages import PastTurn
from xavi_dialogue.transports.text import clean
from xavi_dialogue.transports.web.wire import Turns, TurnShown

GLANCE = 5  # turns that are looked at for new ones
MAX_TURNS = 500  # that are known of


@dataclass
class Conversation:
    """The turns so far, numbered from 0."""

    turns: list[PastTurn] = field(default_factory=list)  # the latest
    first: int = 0  # number of the first of them

    def learn(self, latest: Sequence[PastTurn], *, all_of_it: bool) -> Turns | None:
        """Take in the latest turns.

        Args:
            latest: oldest first.
            all_of_it: there are no others, or none that can be had.

        Returns:
            What is new of it; None where these do not join on to what is known, so that all
            has to be looked at.
        """
        overlap = self._overlap(latest)
        apart = overlap == 0 and bool(self.turns)
        if apart and not all_of_it:
            return None
        if apart:  # it was forgotten, and perhaps begun anew
            self.first += len(self.turns)
            self.turns.clear()
        begin = self.first + len(self.turns)
        fresh = list(latest[overlap:])
        self.turns += fresh
        excess = max(len(self.turns) - MAX_TURNS, 0)
        del self.turns[:excess]
        self.first += excess
        told = tuple(shown(begin + k, turn) for k, turn in enumerate(fresh))
        return Turns(turns=told, reset=apart)

    def all(self) -> Turns:
        """All that are known."""
        told = tuple(shown(self.first + k, turn) for k, turn in enumerate(self.turns))
        return Turns(turns=told, reset=True)

    def turn(self, n: int) -> PastTurn | None:
        """One of them."""
        k = n - self.first
        return self.turns[k] if 0 <= k < len(self.turns) else None

    def find(self, text: str, reply: Reply) -> int | None:
        """The number of the latest turn with this question and reply; None: there is none."""
        for k in range(len(self.turns) - 1, -1, -1):
            turn = self.turns[k]
            if (turn.text, turn.reply.text, turn.reply.sim_time) == (
                text,
                reply.text,
                reply.sim_time,
            ):
                return self.first + k
        return None

    def _overlap(self, latest: Sequence[PastTurn]) -> int:
        """How many of the first of these are the last of those that are known."""
        for count in range(min(len(latest), len(self.turns)), 0, -1):
            if list(latest[:count]) == self.turns[-count:]:
                return count
        return 0


def shown(n: int, turn: PastTurn) -> TurnShown:
    """A turn as browsers get it."""
    return TurnShown(
        n=n,
        text=clean(turn.text),
        reply=turn.reply,
        vehicles=vehicles_of(turn.reply),
        evidence=has_evidence(turn.reply),
    )
