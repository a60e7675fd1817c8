"""Judge: how likely a text is of each kind, whatever the grammar makes of it.

A multinomial logistic model (maximum entropy; Berger, Della Pietra and Della Pietra, 1996) over
the features of a text. Its weights stand in `grammars/judge.json`, learnt from annotated
questions by `make judge`; here they are only added up.

Errors::

    JudgeFileError   the weights cannot be read
"""

import math
from dataclasses import dataclass
from functools import cache
from importlib import resources

import msgspec

FILE = "judge.json"


class JudgeFileError(ValueError):
    """The file of weights is damaged."""


class Weights(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """All of judge.json."""

    learnt_from: str  # digest of the questions
    scale: int  # a weight of one is written as this number
    kinds: tuple[str, ...]
    features: dict[str, dict[int, int]]  # feature -> index of kind -> weight


@dataclass(frozen=True, slots=True, eq=False)
class Judge:
    """What the weights say."""

    weights: Weights

    def log_probabilities(self, features: frozenset[str]) -> dict[str, float]:
        """The natural logarithm of the probability of every kind.

        A text's weights are divided by the square root of the number of its features that are
        known, so that long texts are not judged more surely for their length.
        """
        kinds = self.weights.kinds
        known = sorted(f for f in features if f in self.weights.features)
        totals = [0] * len(kinds)
        for feature in known:
            for index, weight in self.weights.features[feature].items():
                totals[index] += weight
        shrunk = self.weights.scale * math.sqrt(max(1, len(known)))
        scores = [total / shrunk for total in totals]
        top = max(scores)
        norm = top + math.log(sum(math.exp(score - top) for score in scores))
        return {kind: score - norm for kind, score in zip(kinds, scores, strict=True)}

    def telling(self, features: frozenset[str], kind: str, most: int = 5) -> tuple[str, ...]:
        """The features that speak most for a kind, strongest first."""
        index = self.weights.kinds.index(kind)
        table = self.weights.features
        found = [(-table[f].get(index, 0), f) for f in features if f in table]
        return tuple(feature for weight, feature in sorted(found)[:most] if weight < 0)


@cache
def judge() -> Judge:
    """The judge that ships with the grammar.

    Raises:
        JudgeFileError: its file is damaged.
    """
    text = resources.files("grammars").joinpath(FILE).read_bytes()
    try:
        return Judge(msgspec.json.decode(text, type=Weights))
    except msgspec.MsgspecError as error:
        raise JudgeFileError(f"grammars/{FILE}: {error}; `make judge` writes it anew") from error
