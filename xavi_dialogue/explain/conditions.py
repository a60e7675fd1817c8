"""Conditions: the mere condition in "would you still have stopped if vehicle 1 had turned left?".

A query carries it as the words that were said, tidied by the parser: numbers as digits, no
contractions.
"""

import re
from dataclasses import dataclass

from xavi_dialogue.explain.query import QueryAction

_VEHICLE = re.compile(r"\b(?:vehicle|car|truck|bus) (\d+)\b")
_GONE = re.compile(
    r"^without\b|\b(?:no|not)\b.*\b(?:there|here|around|present|existed?)\b|\bgone\b"
)
_ABSENT = re.compile(r"\bthere (?:was|were|is|had been) no\b|^if no\b")
_NOT = re.compile(r"\b(?:not|never)\b")
#: Words for what vehicles do, the more telling ones first.
_WORDS: tuple[tuple[str, QueryAction], ...] = (
    (r"(?:chang|mov)\w* (?:\w+ ){0,3}left", "change-left"),
    (r"(?:chang|mov)\w* (?:\w+ ){0,3}right|cut\w* in", "change-right"),
    (r"(?:turn\w*|went|gone?|exit\w*) (?:\w+ ){0,2}left", "exit-left"),
    (r"(?:turn\w*|went|gone?|exit\w*) (?:\w+ ){0,2}right", "exit-right"),
    (r"straight|kept going|continu\w*|gone on|went on|stay\w*", "continue"),
    (r"slow\w*|brak\w*", "slow-down"),
    (r"speed\w*|sped|accelerat\w*|faster", "speed-up"),
    (r"yield\w*|g[ai]ven? way", "give-way"),
    (r"stop\w*|wait\w*|halt\w*|stood", "stop"),
)
_DEEDS = tuple((re.compile(rf"\b(?:{words})\b"), action) for words, action in _WORDS)


@dataclass(frozen=True, slots=True)
class Condition:
    """What is supposed of another vehicle: that it were not there, or did or did not do things."""

    vehicle: int
    actions: tuple[QueryAction, ...]  # () where it is not there
    negated: bool


def condition(words: str) -> Condition | None:
    """What a condition supposes; None where it names no vehicle, or nothing that vehicles do."""
    text = " ".join(words.lower().split())
    named = _VEHICLE.search(text)
    if named is None:
        return None
    vehicle = int(named[1])
    action = next((action for words, action in _DEEDS if words.search(text)), None)
    if action is None:
        gone = _GONE.search(text) or _ABSENT.search(text)
        return Condition(vehicle, (), True) if gone else None
    return Condition(vehicle, (action,), _NOT.search(text) is not None)
