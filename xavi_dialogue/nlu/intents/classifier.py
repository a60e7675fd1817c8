"""Classifier: how likely each intent is, by a log-linear model over features.

Multinomial logistic regression (Cox 1958), one model each for the intent, its tense and its
action, learnt by `xavi bench intents --learn` from the annotated questions in tests/nlu/intents.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Final

import msgspec

UNIT: Final = 0.1  # of a recorded weight
CLEAR: Final = 0.4  # probability from which on an action counts
NONE: Final = "none"


class Head(msgspec.Struct, frozen=True):
    """One model: its classes, their biases, and the weights of each feature in UNITs.

    `weights` has for each feature the pairs of the index of a class and its weight, one by one.
    """

    classes: tuple[str, ...]
    bias: tuple[int, ...]
    weights: dict[str, tuple[int, ...]]

    def probabilities(self, found: Iterable[str]) -> dict[str, float]:
        """Give the probability of each class; features that are not known do not count."""
        known = [row for name in sorted(found) if (row := self.weights.get(name)) is not None]
        scale = UNIT / math.sqrt(max(1, len(known)))
        scores = [value * UNIT for value in self.bias]
        for row in known:
            for index, weight in zip(row[::2], row[1::2], strict=True):
                scores[index] += scale * weight
        top = max(scores)
        odds = [math.exp(score - top) for score in scores]
        total = sum(odds)
        return {name: value / total for name, value in zip(self.classes, odds, strict=True)}


class Model(msgspec.Struct, frozen=True):
    """The models of what a text asks, of its tense, and of the action asked about."""

    intent: Head
    tense: Head
    action: Head


@dataclass(frozen=True, slots=True)
class Intent:
    """What a text may ask."""

    name: str
    tense: str  # past, now, next, if
    action: str  # "none" where it has none
    probability: float


@cache
def model() -> Model:
    """Read the weights."""
    data = (files("grammars") / "intents.json").read_bytes()
    return msgspec.json.decode(data, type=Model)


def judge(found: Iterable[str]) -> tuple[Intent, ...]:
    """Judge what a text with these features asks: all intents, likeliest first."""
    features = tuple(found)
    heads = model()
    tense = _best(heads.tense.probabilities(features))
    actions = heads.action.probabilities(features)
    action = _best(actions)
    action = action if actions[action] >= CLEAR else NONE
    shares = heads.intent.probabilities(features)
    ranked = sorted(shares.items(), key=lambda pair: (-pair[1], pair[0]))
    return tuple(Intent(name, tense, action, share) for name, share in ranked)


def _best(shares: dict[str, float]) -> str:
    return min(shares, key=lambda name: (-shares[name], name))
