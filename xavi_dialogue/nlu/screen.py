"""Screen: figures that engineers read off a screen.

Examples: "100 percent stop for v1?" and "continue -26.5 against change-left -26.9".

A stated probability becomes the question what it is based on. Two compared values become a claim,
to which "what tips it?" can refer. Every word has to be a figure, a vehicle, an action or one of
the small words between them; else nothing is read here.
"""

from collections.abc import Iterator
from typing import Any, Final

from xavi_dialogue.domain.meaning import Act, Ask, Claim, HowKnow, Reading, TokenShare
from xavi_dialogue.domain.terms import Compares, Event, Happens, Measured, Vehicle
from xavi_dialogue.nlu.text.tokens import Token, Typed

COST: Final = 0.3
LONGEST: Final = 22  # [tokens]
_OPENING: Final = frozenset(("hang", "wait", "on", "then", "ok", "so", "and", "but", "hold"))
_SMALL: Final = frozenset(
    ("a", "an", "and", "at", "the", "for", "to", "of", "on", "with", "has", "have", "had", "is",
     "was", "reads", "read", "here", "now", "still", "just", "but", "so", "only", "it", "its",
     "you", "give", "gives", "put", "chance", "probability", "goal", "percent", "%", "per", "cent",
     "against", "versus", "vs", "over", "value", "scores", "score", "reward", "coming", "turning",
     "going", "turn", "full", "moving", "then", "ok", "wait", "hang", "hold", "as", "way", "branch",
     "hypothesis", "mass", "weight", "standstill", "halt")
)  # fmt: skip
_ENDS: Final = frozenset(("on", "in", "at", "while", "with"))  # begin an aside after a comma
_VEHICLES: Final = frozenset(("v", "vehicle", "veh", "number", "car", "no"))
_PERCENT: Final = frozenset(("percent", "%", "per"))
_AGAINST: Final = frozenset(("against", "versus", "vs", "over", "to", "and", "but"))
_ACTIONS: Final[dict[str, Any]] = {
    "stop": "stop", "stopping": "stop", "stops": "stop", "halt": "stop", "standstill": "stop",
    "straight": "exit-straight", "exit-straight": "exit-straight", "left": "exit-left",
    "exit-left": "exit-left", "right": "exit-right", "exit-right": "exit-right",
    "leave": "leave", "leaving": "leave", "exit": "leave", "exiting": "leave",
    "continue": "continue", "continuing": "continue", "change-left": "change-left",
    "change-right": "change-right", "overtake": "overtake", "overtaking": "overtake",
}  # fmt: skip


def on_screen(typed: Typed) -> Reading | None:
    """Read a sentence that only names figures, a vehicle and actions; None for any other."""
    tokens = tuple(_without_aside(typed.tokens))
    words = tuple(token.text for token in tokens)
    if len(typed.tokens) > LONGEST or not any(map(_is_number, words)):
        return None
    owner = next((k for k in range(len(words) - 1) if _names(words, k)), None)
    rest = words if owner is None else (*words[:owner], *words[owner + 2 :])
    if any(not (w in _SMALL or w in _ACTIONS or _is_number(w)) for w in rest):
        return None
    acts = list(dict.fromkeys(_ACTIONS[word] for word in rest if word in _ACTIONS))
    act = _valued(rest, acts) if owner is None else None
    if owner is not None and len(acts) == 1 and _is_chance(rest):
        event = Event(acts[0], Vehicle(int(words[owner + 1])), tense="present")
        act = Ask(HowKnow(Happens(event)))
    if act is None:
        return None
    every = tuple(token.text for token in typed.tokens)
    return Reading((act,), tuple(TokenShare(w, w, "meaning", "figure", 0) for w in every), COST)


def _without_aside(tokens: tuple[Token, ...]) -> Iterator[Token]:
    """Leave out an opening such as "hang on," and an aside such as "..., on a motorway"."""
    marked = [index for index, token in enumerate(tokens) if token.mark]
    begin = next((m for m in marked if all(t.text in _OPENING for t in tokens[:m])), 0)
    figures = [index for index, token in enumerate(tokens) if _is_number(token.text)]
    last = figures[-1] if figures else 0
    end = next((m for m in marked if m > max(last, begin) and tokens[m].text in _ENDS), len(tokens))
    return iter(tokens[begin:end])


def _names(words: tuple[str, ...], index: int) -> bool:
    return words[index] in _VEHICLES and words[index + 1].isdigit()


def _is_number(word: str) -> bool:
    return word.replace(",", ".").replace(".", "", 1).isdigit()


def _is_chance(words: tuple[str, ...]) -> bool:
    """Check whether one of the numbers is a probability: in percent, or between 0 and 1."""
    for word, behind in zip(words, (*words[1:], ""), strict=True):
        if _is_number(word) and (behind in _PERCENT or float(word.replace(",", ".")) < 1.0):
            return True
    return False


def _valued(words: tuple[str, ...], acts: list[Any]) -> Act | None:
    """Read two actions with their values as a claim that the better one is better."""
    figures = [word for word in words if _is_number(word)]
    if len(acts) != 2 or len(figures) != 2 or _AGAINST.isdisjoint(words):
        return None
    done, other = (Event(action, tense="present") for action in acts)
    if float(figures[0]) > float(figures[1]):  # they are costs, given without their sign
        done, other = other, done
    return Claim(Compares(Measured("value", event=done), "more", Measured("value", event=other)))
