"""Unread: stretches of a text of which nothing can be made."""

from typing import Final

from xavi_dialogue.domain.meaning import Reading, Unread
from xavi_dialogue.nlu.compose.acts import NOTHING
from xavi_dialogue.nlu.shares import unknown_shares
from xavi_dialogue.nlu.text.tokens import Typed

WORD: Final = 0.15  # cost of each word more than SHORT in a unit of which nothing is made
SHORT: Final = 5
OPENERS: Final = frozenset(
    ["so", "but", "why", "what", "how", "can", "could", "would", "tell", "explain", "when"]
)


def unread_cost(count: int) -> float:
    """Say what so many words cost of which nothing is made."""
    return NOTHING + WORD * max(0, count - SHORT)


def unreadable(typed: Typed) -> Reading:
    """Give the reading of a stretch of which nothing can be made."""
    words = tuple(token.text for token in typed.tokens)
    asks = typed.end == "?" or words[0] in OPENERS
    return Reading((), unknown_shares(words), NOTHING, (Unread(words, asks),))
