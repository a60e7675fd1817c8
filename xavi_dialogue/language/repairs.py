"""Repairs: "why did vehicle 1, sorry, vehicle 2 stop?" asks about vehicle 2.

Who corrects himself marks it, and begins anew with a thing of the same kind: what was said of that
kind before is taken back (the "reparandum" of E. Shriberg, Preliminaries to a theory of speech
disfluencies, 1994). Words are known by the lists, so that nothing is taken back for a thing that
is not one.
"""

from functools import cache

from xavi_dialogue.language.lattice import Cuts, build
from xavi_dialogue.language.normalise import BREAK
from xavi_dialogue.language.wordlists import english

_MAX_PARTS = 4  # phrases that one thing is said in
_VEHICLE = frozenset({"CAR", "KIND", "NUMBER", "COLOUR", "OTHER", "WHICHCAR"})
_BESIDE = frozenset({"NOISE", "THAT", "PLACE", "ONLEFT", "ONRIGHT"})  # belongs to what stands by it
_SIDE = frozenset({"LEFT", "RIGHT"})
_DEED = frozenset({"CHANGE", "LANE", "TURN", "STOP", "SLOW", "SPEED", "GIVEWAY", "OVERTAKE"})
_HEAD = frozenset({"WHY", "IF", "WHAT", "HOW", "WHEN", "WHEREGO", "HAPPEN", "KNOW", "DECIDE"})
_ASIDE = frozenset({"BREAK", "NOISE", "CORRECT", "SMALL"})
_US = frozenset({"EGO"})
_KINDS = (_VEHICLE, _SIDE, _DEED)


def repaired(words: tuple[str, ...]) -> tuple[str, ...]:
    """The words without what was taken back; the same where nothing was.

    Args:
        words: of a text, spelling corrected, clause marks as `BREAK`.
    """
    found = _marker(words)
    if found is None:
        return words
    begin, end = found
    before, after = words[:begin], words[end:]
    heard, new = build(before).main(), build(after).main()
    head = next((edge.token.terminal for _, edge in new if edge.token.terminal != "NOISE"), "")
    if head in _HEAD:
        asked = any(edge.token.terminal in _HEAD for _, edge in heard)
        return after if asked else words
    kind = next((kind for kind in _KINDS if head in kind), None)
    if kind is None:
        return words
    cut = _taken_back(heard, kind) or (_taken_back(heard, _US) if kind is _VEHICLE else None)
    if cut is None:
        return words
    start, stop = cut
    rest = before[stop:] if not _goes_on(new, kind) else ()
    return (*before[:start], *after, *rest)


def _marker(words: tuple[str, ...]) -> tuple[int, int] | None:
    """Where the last words stand by which something is taken back, clause marks included."""
    known = _markers()
    for begin in range(len(words) - 2, 0, -1):
        for size in range(min(_MAX_PARTS, len(words) - begin), 0, -1):
            said, end = words[begin : begin + size], begin + size
            if said not in known or end >= len(words):
                continue
            marked = words[begin - 1] == BREAK, words[end] == BREAK
            if any(marked):
                return begin - marked[0], end + marked[1]
    return None


def _taken_back(heard: Cuts, kind: frozenset[str]) -> tuple[int, int] | None:
    """From where to where the last thing of a kind was named."""
    inside = kind | _BESIDE if kind is _VEHICLE else kind
    last = next(
        (k for k in reversed(range(len(heard))) if heard[k][1].token.terminal in kind), None
    )
    if last is None:
        return None
    first = last
    while first > 0 and heard[first - 1][1].token.terminal in inside:
        first -= 1
    return heard[first][0], heard[last][1].end


def _goes_on(new: Cuts, kind: frozenset[str]) -> bool:
    """Whether the question goes on behind the new thing: "..., sorry, vehicle 2 stop?"."""
    named = kind | _BESIDE if kind is _VEHICLE else kind
    return any(edge.token.terminal not in named | _ASIDE for _, edge in new)


@cache
def _markers() -> frozenset[tuple[str, ...]]:
    return frozenset(tuple(phrase.split()) for phrase in english()["repairs"]["markers"])
