"""Elsewhere: "in my country who comes from the right goes first, is it the same here?".

What holds elsewhere is not read: it asks who goes first here.
"""

from itertools import pairwise
from typing import Final

from xavi_dialogue.domain.meaning import Ask, Reading, TokenShare, Which
from xavi_dialogue.domain.terms import Everyone, Related, Wanted
from xavi_dialogue.nlu.text.tokens import Typed

COST: Final = 0.3
SHORT: Final = 9  # [tokens] the most in "is it not right before left here?"
ECHO: Final = 8  # [tokens] the most in "is it the same here?"
_PLACES: Final = frozenset(
    ("country", "village", "town", "city", "homeland", "england", "britain", "italy", "germany",
     "france", "spain", "portugal", "poland", "india", "japan", "america", "ireland", "scotland",
     "greece", "turkey", "sweden", "norway", "austria", "switzerland", "belgium", "holland",
     "states", "us", "uk", "place", "parts", "home")
)  # fmt: skip
_RULES: Final = frozenset(
    ("priority", "first", "wait", "waits", "yield", "yields", "way", "precedence", "preference",
     "stop", "stops", "let", "lets")
)  # fmt: skip
_COMPARING: Final = frozenset(
    ("same", "different", "opposite", "other", "too", "also", "no", "not", "yes", "like", "so")
)
_OPENING: Final = frozenset(
    ("excuse", "me", "but", "and", "so", "well", "sorry", "please", "you", "know", "hm", "oh")
)


def elsewhere(typed: Typed) -> Reading | None:
    """Read a sentence of who goes first elsewhere as the question who does here."""
    words = tuple(token.text for token in typed.tokens)
    right_first = len(words) <= SHORT and ("right", "before", "left") in zip(
        words, words[1:], words[2:], strict=False
    )
    if not right_first and (not _leads(words) or _RULES.isdisjoint(words)):
        return None
    asked = Ask(Which(Wanted(), Related("has-priority-over", Wanted(), Everyone())))
    shares = tuple(TokenShare(word, word, "meaning", "elsewhere", 0) for word in words)
    return Reading((asked,), shares, COST)


def echoes(before: Typed, typed: Typed) -> bool:
    """Say whether a sentence only asks whether it is the same here as the one before says."""
    words = {token.text for token in typed.tokens}
    short = len(typed.tokens) <= ECHO and "here" in words and not words.isdisjoint(_COMPARING)
    return short and elsewhere(before) is not None


def _leads(words: tuple[str, ...]) -> bool:
    """Say whether a sentence begins with another place: "in my country", "where I come from"."""
    start = next((k for k, word in enumerate(words) if word not in _OPENING), len(words))
    head = words[start : start + 5]
    if head[:3] in (("where", "i", "come"), ("where", "i", "live"), ("where", "we", "come")):
        return True
    if head[:2] == ("at", "home") or head[:2] == ("back", "home"):
        return True
    owned = {"my", "our", "the"}
    return head[:1] == ("in",) and any(
        second in _PLACES and (first == "in" or first in owned) for first, second in pairwise(head)
    )
