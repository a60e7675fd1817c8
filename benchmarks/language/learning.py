"""Learning: the weights of the intent classifier from annotated texts."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Final, TypeAlias

import msgspec
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.sparse import csr_matrix

from xavi_dialogue.nlu.intents.classifier import UNIT, Head, Model
from xavi_dialogue.nlu.intents.features import features, shape
from xavi_dialogue.nlu.intents.signature import asking_acts, signature
from xavi_dialogue.nlu.parse import Parser

RIDGE: Final = 0.03  # weight of the squared weights
STEPS: Final = 60  # of L-BFGS
TIMES: Final = 2  # least number of texts with a feature
LEAST: Final = 0.5  # weights below this are left out
COARSE: Final = ("word:", "asked:", "begin:", "asked pair:", "act:")  # features for tense, action
NONE: Final = "none"

Array: TypeAlias = NDArray[np.float64]


class Asked(msgspec.Struct, frozen=True):
    """One thing that a text asks."""

    i: str  # the intent
    t: str = "now"  # its tense
    a: str = NONE  # its action
    x: str = ""  # the words for the other vehicle


class Example(msgspec.Struct, frozen=True):
    """An annotated text."""

    text: str
    asks: tuple[Asked, ...]

    @property
    def intents(self) -> tuple[str, ...]:
        """The intents, in the order of the text."""
        return tuple(ask.i for ask in self.asks)


Rows: TypeAlias = Sequence[frozenset[str]]


def read(folder: Path) -> dict[str, tuple[Example, ...]]:
    """Read the sets of annotated texts, by the names of their files."""
    return {
        path.stem: tuple(
            msgspec.json.decode(line, type=Example)
            for line in path.read_text(encoding="utf-8").splitlines()
        )
        for path in sorted(folder.glob("*.jsonl"))
    }


def write(model: Model, path: Path) -> None:
    """Write the weights."""
    path.write_bytes(msgspec.json.encode(model, order="sorted") + b"\n")


def learnt(examples: Sequence[Example]) -> Model:
    """Learn the weights."""
    parser = Parser()
    readings = [parser.read(example.text)[0] for example in examples]
    rows = [features(e.text, reading) for e, reading in zip(examples, readings, strict=True)]
    coarse = [frozenset(f for f in row if f.startswith(COARSE)) for row in rows]
    return Model(
        intent=_head(rows, [e.intents for e in examples], TIMES),
        tense=_head(coarse, [tuple(ask.t for ask in e.asks) for e in examples], TIMES + 1),
        action=_head(coarse, [tuple(ask.a for ask in e.asks) for e in examples], TIMES + 1),
    )


def grammar_alone(examples: Sequence[Example]) -> Head:
    """Learn the intent that an act of the grammar stands for, from texts that ask one thing."""
    parser = Parser()
    rows: list[frozenset[str]] = []
    named: list[tuple[str, ...]] = []
    for example in examples:
        found = asking_acts(parser.read(example.text)[0].acts)
        if len(found) == len(example.asks) == 1:
            rows.append(frozenset(shape(signature(found[0]))))
            named.append(example.intents)
    return _head(rows, named, 1)


def _head(rows: Rows, classes: Sequence[Sequence[str]], times: int) -> Head:
    """Fit one model; a text of several classes counts in part for each."""
    counts = Counter(name for row in rows for name in sorted(row))
    index = {n: k for k, n in enumerate(sorted(n for n, c in counts.items() if c >= times))}
    labels = sorted({label for row in classes for label in row})
    place = {label: k for k, label in enumerate(labels)}
    wanted = np.zeros((len(rows), len(labels)))
    for at, row in enumerate(classes):
        for label in row:
            wanted[at, place[label]] += 1.0 / len(row)
    weights, bias = _fitted(_matrix(rows, index), wanted)
    kept = np.where(np.abs(weights) < LEAST, 0.0, np.round(weights / UNIT)).astype(int)
    found = {}
    for name, k in index.items():
        pairs = [(int(j), int(kept[k, j])) for j in np.nonzero(kept[k])[0]]
        if pairs:
            found[name] = tuple(number for pair in pairs for number in pair)
    return Head(tuple(labels), tuple(int(b) for b in np.round(bias / UNIT)), found)


def _matrix(rows: Iterable[frozenset[str]], index: dict[str, int]) -> csr_matrix:
    """Return the features of texts [N, D]; each row has length 1."""
    at, columns, values = [], [], []
    size = 0
    for size, row in enumerate(rows, start=1):
        known = sorted(index[name] for name in row if name in index)
        at += [size - 1] * len(known)
        columns += known
        values += [1.0 / math.sqrt(len(known))] * len(known) if known else []
    return csr_matrix((values, (at, columns)), shape=(size, len(index)))


def _fitted(found: csr_matrix, wanted: Array) -> tuple[Array, Array]:
    """Fit weights [D, K] and biases [K] by the regularised likelihood of classes [N, K]."""
    d, k = found.shape[1], wanted.shape[1]

    def loss(values: Array) -> tuple[float, Array]:
        weights, bias = values[: d * k].reshape(d, k), values[d * k :]
        scores = found @ weights + bias
        scores -= scores.max(axis=1, keepdims=True)
        shares = np.exp(scores)
        shares /= shares.sum(axis=1, keepdims=True)
        missed = -float(np.sum(wanted * np.log(shares + 1e-12)))
        slope = shares - wanted
        down = np.asarray(found.T @ slope) + RIDGE * weights
        total = missed + 0.5 * RIDGE * float(np.sum(weights**2))
        return total, np.concatenate((down.ravel(), slope.sum(axis=0)))

    start = np.zeros(d * k + k)
    best = minimize(loss, start, jac=True, method="L-BFGS-B", options={"maxiter": STEPS}).x
    return best[: d * k].reshape(d, k), best[d * k :]
