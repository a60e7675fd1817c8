"""Demands: what a sentence wants to be told, by its question words.

They are found in the words alone, whatever the grammar makes of them: "why" demands a reason. A
reading that leaves a demand of its sentence unmet answers something else.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

from xavi_dialogue.domain.meaning import Act
from xavi_dialogue.nlu.intents.signature import signature
from xavi_dialogue.nlu.text.tables import load
from xavi_dialogue.nlu.text.tokens import Token, Typed

FILE: Final = "nlu_demands.toml"
REASON: Final = "reason"
ANY: Final = ".*"


def demanded(words: Iterable[str]) -> tuple[str, ...]:
    """List the kinds of what a sentence demands."""
    said = " ".join(words)
    return tuple(kind for kind in load(FILE) if _makes(kind, said))


def is_met(kind: str, acts: Iterable[Act]) -> bool:
    """Tell whether one of some acts asks for what is demanded."""
    met = tuple(load(FILE)[kind]["met"])
    return any(signature(act).startswith(met) for act in acts)


@dataclass(frozen=True, slots=True)
class Default:
    """What a demand comes to where nothing meets it."""

    plain: str  # a question
    fitted: bool  # chosen by the words of the sentence


def default(kind: str, words: Iterable[str]) -> Default | None:
    """Give the plain question that a sentence with a demand comes to where nothing meets it."""
    said = " ".join(words)
    rows: list[list[str]] = load(FILE)[kind].get("default", [])
    found = ((fits, plain) for fits, plain in rows if re.search(rf"\b(?:{fits})", said))
    return next((Default(plain, fits != ANY) for fits, plain in found), None)


def wants_reason(sentence: Typed) -> bool:
    """Tell whether a sentence does nothing but demand a reason: "explain that, please"."""
    return _is_alone(sentence.tokens)


def startles(sentence: Typed) -> bool:
    """Tell whether a sentence demands the reason of what startled: "what was that?"."""
    return _fits("after", sentence.tokens)


def blames(tokens: Sequence[Token]) -> bool:
    """Tell whether words do no more than name whom something was for: "all for that bus"."""
    return _fits("blames", tokens)


def set_apart(sentence: Typed) -> tuple[Typed, ...]:
    """Cut off what only demands a reason: "why, there is nobody", "you braked, what for?"."""
    tokens = sentence.tokens
    marks = [k for k, token in enumerate(tokens) if k and token.mark]
    apart = [k for k in marks if blames(tokens[k:])] or [
        k for k in marks[-1:] if _is_alone(tokens[k:])
    ]
    if apart and _fits("stated", tokens):
        cut, ends = apart[0], (".", sentence.end)
    elif marks and _is_alone(tokens[: marks[0]]) and _fits("stated", tokens[marks[0] :]):
        cut, ends = marks[0], ("?", "")
    elif _is_alone(tokens[:1]) and _fits("existing", tokens[1:]):
        cut, ends = 1, ("?", "")
    else:
        return (sentence,)
    behind = (Token(tokens[cut].text), *tokens[cut + 1 :])
    return Typed(tokens[:cut], ends[0]), Typed(behind, ends[1])


def _is_alone(tokens: Sequence[Token]) -> bool:
    return _fits("alone", tokens)


def _fits(name: str, tokens: Sequence[Token]) -> bool:
    pattern = _patterns(REASON, name)
    return pattern is not None and bool(pattern.fullmatch(" ".join(t.text for t in tokens)))


def _makes(kind: str, said: str) -> bool:
    words, alone, unless = (_patterns(kind, name) for name in ("words", "alone", "unless"))
    if alone is not None and alone.fullmatch(said):
        return True
    found = words is not None and words.search(said) is not None
    return found and not (unless is not None and unless.search(said))


@cache
def _patterns(kind: str, name: str) -> re.Pattern[str] | None:
    table: dict[str, Any] = load(FILE)[kind]
    expressions = table.get(name, ())
    if not expressions:
        return None
    return re.compile(r"\b(?:" + "|".join(expressions) + r")(?!\w)")
