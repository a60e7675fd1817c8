"""Features: what the judge sees of a text.

Two views of the same text: the words as they were typed (spelling corrected), and the terminals
of its likeliest cut, where every action is ACT and every direction SIDE. Of each view single
elements, pairs and triples in a row are taken, and pairs with a gap of one.
"""

from xavi_dialogue.language.lattice import Lattice
from xavi_dialogue.language.normalise import is_clock
from xavi_dialogue.language.words import Heard, is_number

_EDGE = "#"  # the beginning and the end
_ACTIONS = frozenset(
    {"CHANGE", "TURN", "STOP", "SLOW", "SPEED", "GIVEWAY", "OVERTAKE", "NEXTEXIT", "STRAIGHT",
     "STAY", "CONTINUE", "GO", "MOVE", "TAKE", "EXITWAY", "LET"}
)  # fmt: skip
_SIDES = frozenset({"LEFT", "RIGHT", "ONLEFT", "ONRIGHT"})
_DROPPED = frozenset({"NOISE"})
_SHOWN = frozenset({"PLAIN", "TOPIC", "THAT", "IT", "BETTER"})  # terminals seen with their words
_LEADING = frozenset({",", "BREAK", "AND", "CONJ", "SMALL", "THINK"})
_ASKING = frozenset(
    {"WHY", "IF", "WHEN", "HOW", "HAPPEN", "WHEREGO", "SURE", "CHANCE", "BETTER", "KNOW", "AVOID",
     "STILL", "INSTEAD", "THAN", "NOT", "BECAUSE", "WHAT", "HOWLONG", "FACTOR", "REQUIRE", "MORE",
     "LESS"}
)  # fmt: skip
_STEM = 4  # letters
_LONGEST = 6  # lengths beyond this many threes of words are alike


def features(lattice: Lattice, heard: Heard, *, follows: bool) -> frozenset[str]:
    """The features of a text.

    Args:
        lattice: the text, cut into phrases.
        heard: its words.
        follows: whether a question was asked before it.
    """
    terminals = [_EDGE]
    for _, edge in lattice.main():
        shown = _shown(edge.token.terminal, edge.token.text)
        if shown is not None and not (shown == terminals[-1] and shown in ("ACT", "SIDE")):
            terminals.append(shown)
    terminals.append(_EDGE)
    typed = [_EDGE, *("0" if is_number(w) or is_clock(w) else w for w in heard.words), _EDGE]
    length = min(len(heard.words) // 3, _LONGEST)
    found = {f"length {length}", f"follows {int(follows)}", f"tagged {int(heard.tagged)}"}
    found |= _frame([s for s in terminals if s.partition("=")[0] not in _LEADING])
    found |= {f"stem {word[:_STEM]}" for word in heard.words if len(word) > _STEM}
    return frozenset(found | _in_rows("t", terminals) | _in_rows("w", typed))


def _frame(seen: list[str]) -> set[str]:
    """How the text begins and ends, and its words of questions in any order."""
    first, last = seen[1:3], seen[-2:-1]
    asks = " ".join(sorted(_ASKING & set(seen)))
    return {f"begins {first[:1]}", f"begins {first}", f"ends {first[:1]} {last}", f"asks {asks}"}


def _shown(terminal: str, text: str) -> str | None:
    if terminal in _DROPPED:
        return None
    if terminal in _ACTIONS:
        return "ACT"
    if terminal in _SIDES:
        return "SIDE"
    return f"{terminal}={text}" if terminal in _SHOWN else terminal


def _in_rows(view: str, seen: list[str]) -> set[str]:
    found: set[str] = set()
    for start, one in enumerate(seen):
        found.add(f"{view} {one}")
        found.add(f"{view} {' '.join(seen[start : start + 2])}")
        found.add(f"{view} {' '.join(seen[start : start + 3])}")
        if start + 2 < len(seen):
            found.add(f"{view} {one} .. {seen[start + 2]}")
    return found
