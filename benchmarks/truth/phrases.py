"""Phrases of answers that stand for macro actions, times and probabilities."""

import re
from functools import cache
from importlib.resources import files
from typing import Any

import msgspec

from planner.record.trace import Action, Outcome

ACTS: tuple[tuple[str, frozenset[Action]], ...] = (
    (r"turn(?:ed|ing|s)? right", frozenset({"exit-right"})),
    (r"turn(?:ed|ing|s)? left", frozenset({"exit-left"})),
    (r"(?:go|going|goes|gone|went) straight on", frozenset({"exit-straight", "continue"})),
    (
        r"(?:leave|leaving|left) (?:the roundabout|there)",
        frozenset({"exit-right", "exit-straight"}),
    ),
    (r"continu\w+ to the next exit", frozenset({"continue-next-exit"})),
    (r"stay\w* in the roundabout", frozenset({"continue-next-exit"})),
    (r"stop(?:ped|ping|s)?\b", frozenset({"stop"})),
    (r"(?:mov|chang)\w+ to the left", frozenset({"change-left"})),
    (r"(?:mov|chang)\w+ to the right", frozenset({"change-right"})),
    (r"(?:stay\w*|remain\w*) in (?:my|the|our) lane", frozenset({"continue"})),
    (r"(?:driv\w+|drove|go\w*) on\b", frozenset({"continue"})),
)
BACK: dict[Action, Action] = {"change-left": "change-right", "change-right": "change-left"}
SIZE = (
    r"(?P<size>less than half a second|half a second|some time|"
    r"\d+(?:\.\d+)? (?:seconds?|minutes?))"
    r"(?: on average)?(?: over the next (?P<stretch>\d+(?:\.\d+)?) (?:seconds|minutes))?"
)
ADVERBS = {
    "almost certainly": (0.95, 1.0), "very likely": (0.85, 0.95), "probably": (0.65, 0.85),
    "perhaps": (0.45, 0.65), "possibly": (0.15, 0.45), "": (0.99, 1.0),
}  # fmt: skip
ADVERB = rf"(?:(?P<adverb>{'|'.join(one for one in ADVERBS if one)}) )?"
SLACK = 0.02  # tolerance beyond rounding: of times [s], and of percentages and probabilities
COUNTS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten",
          "eleven", "twelve")  # fmt: skip


def acts(text: str) -> list[frozenset[Action]]:
    """Return the sets of macro actions that a phrase may mean, in order.

    Moving back undoes a lane change.
    """
    text = re.sub(r"\b(\w+ (?:left|right)) after (going straight on)", r"\2 and \1", text)
    found = [(m.start(), kinds) for p, kinds in ACTS for m in re.finditer(p, text, re.IGNORECASE)]
    found.sort(key=lambda one: one[0])
    for match in re.finditer(r"(?:(?:mov|chang)\w+|and) back\b", text, re.IGNORECASE):
        before = [kinds for at, kinds in found if at < match.start() and kinds & BACK.keys()]
        undone = BACK[min(before[-1])] if before else "change-right"
        found.append((match.start(), frozenset({undone})))
    return [kinds for _, kinds in sorted(found, key=lambda one: one[0])]


def count(word: str) -> int:
    """Return the value of a number that is spelt out or in digits; "a" is one."""
    return 1 if word in ("a", "an") else COUNTS.index(word) if word in COUNTS else int(word)


def is_time(told: str, value: float) -> bool:
    """Check whether a stated time is a value [s] rounded, such as 3, 2.5 or half a second."""
    if told == "some time":
        return True
    if told.startswith("less"):
        return abs(value) < 0.25 + SLACK
    if told.startswith("half"):
        return abs(abs(value) - 0.5) <= 0.25 + SLACK
    number, unit = float(told.split(" ")[0]), told.split(" ")[1]
    if unit.startswith("minute"):
        return abs(abs(value) / 60.0 - number) <= 0.5 + SLACK
    return abs(abs(value) - number) <= (0.5 if number >= 3.0 else 0.25) + SLACK


def is_chance(match: re.Match[str], value: float, group: str = "chance") -> bool:
    """Check whether a stated percentage, such as "under 1 %", is that of a probability."""
    told = match[group].removesuffix(" %")
    if told.startswith("under "):
        return 100.0 * value < float(told.removeprefix("under ")) + 0.5
    if told.startswith("over "):
        return 100.0 * value > float(told.removeprefix("over ")) - 0.5
    return abs(100.0 * value - float(told)) <= 0.5 + SLACK


def is_likely(adverb: str | None, value: float) -> bool:
    """Check whether an adverb fits a probability; None means next to certain."""
    low, high = ADVERBS[adverb or ""]
    return low - SLACK <= value <= high + SLACK


def trusted(value: float, outcome: Outcome = "collision") -> float:
    """Return the probability of an outcome that an answer may state, given that among rollouts.

    The rollouts' model is wrong for a share of foils, for which measurement gave a bound. In these
    cases each outcome has its measured frequency, or if that is not recorded, all outcomes are
    equally frequent. Both are recorded with the ranges that answers give. Where roads lead is
    certain, so that outcome is stated as the rollouts have it.
    """
    known = _ranges()
    error, shares = float(known["model_error"]), known.get("unforeseen") or {}
    return value + error * (float(shares.get(outcome, 0.0) if shares else 0.25) - value)


@cache
def _ranges() -> dict[str, Any]:
    text = (files("xavi_dialogue.explain.causes") / "ranges.json").read_bytes()
    found: dict[str, Any] = msgspec.json.decode(text)
    return found
