"""The conversation as shown on a dashboard, with turns from a terminal too.

The service stores the turns; here they are compared with the known ones to find the new ones.
Turns have no ids: their total number shows which of them are new.
"""

from dataclasses import dataclass, field

from xavi_dialogue.bus.messages import HistoryReply, PastTurn
from xavi_dialogue.bus.sanitize import clean
from xavi_dialogue.dashboard.views.evidence import has_evidence, vehicles_of
from xavi_dialogue.dashboard.web.websocket_messages import Turns, TurnShown
from xavi_dialogue.dialogue.reply import Reply
from xavi_dialogue.storage.turn_log import MAX_PAST

GLANCE = 5  # latest turns that are fetched to find new ones
MAX_TURNS = 500  # turns that are kept


@dataclass
class Conversation:
    """The turns so far, numbered from 0."""

    turns: list[PastTurn] = field(default_factory=list)  # the latest
    first: int = 0  # number of the first of these turns
    _total: int = 0  # number of turns that the service had at the last request

    def learn(self, said: HistoryReply, *, whole: bool) -> Turns | None:
        """Add the latest turns.

        Args:
            said: the turns.
            whole: there are no others.

        Returns:
            The new turns; None if they do not continue the known ones, so that all must be
            fetched.
        """
        overlap = self._overlap(said)
        apart = overlap is None or (overlap == 0 and bool(self.turns))
        if apart and not whole:
            return None
        reset = overlap is None and bool(self.turns)
        if reset:  # the session was erased, and perhaps begun again
            self.first += len(self.turns)
            self.turns.clear()
        self._total = said.total
        begin = self.first + len(self.turns)
        fresh = said.turns[overlap or 0 :]
        self.turns += fresh
        excess = max(len(self.turns) - MAX_TURNS, 0)
        del self.turns[:excess]
        self.first += excess
        return Turns(turns=tuple(shown(begin + k, t) for k, t in enumerate(fresh)), reset=reset)

    def all(self) -> Turns:
        """Return all turns that are known."""
        told = tuple(shown(self.first + k, turn) for k, turn in enumerate(self.turns))
        return Turns(turns=told, reset=True)

    @property
    def suggestions(self) -> tuple[str, ...]:
        """Return the suggestions in the latest reply; a refusal contains them itself."""
        last = self.turns[-1].reply if self.turns else None
        return last.suggestions if last is not None and last.kind == "answer" else ()

    def turn(self, n: int) -> PastTurn | None:
        """Return one turn by its number."""
        k = n - self.first
        return self.turns[k] if 0 <= k < len(self.turns) else None

    def find(self, text: str, reply: Reply) -> int | None:
        """Return the number of the latest turn with this question and reply; None without one."""
        for k in range(len(self.turns) - 1, -1, -1):
            turn = self.turns[k]
            if (turn.text, turn.reply.text, turn.reply.sim_time) == (
                text,
                reply.text,
                reply.sim_time,
            ):
                return self.first + k
        return None

    def _overlap(self, said: HistoryReply) -> int | None:
        """Count how many of the first of these turns are the last of the known ones.

        That follows from how many there are in all; beyond what is counted, it is the most that
        it can be. None where they are not the same.
        """
        turns, known = said.turns, self.turns
        if said.total < MAX_PAST:
            counts = [len(turns) - (said.total - self._total)]
        else:
            counts = list(range(min(len(turns), len(known)), 0, -1))
        for count in counts:
            possible = 0 <= count <= min(len(turns), len(known))
            if possible and list(turns[:count]) == known[len(known) - count :]:
                return count
        return None


def shown(n: int, turn: PastTurn) -> TurnShown:
    """Convert a turn for browsers."""
    return TurnShown(
        n=n,
        text=clean(turn.text),
        reply=turn.reply,
        vehicles=vehicles_of(turn.reply),
        evidence=has_evidence(turn.reply),
    )
