"""Learn: annotated questions -> the weights of the judge.

Run as `python -m xavi_dialogue.app.learn FILE...`, or by `make judge`; writes
`grammars/judge.json`. With `--hold-out` nothing is written: every file is judged by what the
others teach, and the agreement is printed.

The loss is the cross entropy with an L2 penalty, minimised by L-BFGS (scipy). Same questions, same
weights, up to rounding; weights too small to matter are left out.
"""

import argparse
import hashlib
import json
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize
from scipy.sparse import csr_matrix

from xavi_dialogue.explain.query import Query
from xavi_dialogue.language.features import features
from xavi_dialogue.language.judge import FILE, Weights
from xavi_dialogue.language.kinds import kind_of
from xavi_dialogue.language.lattice import build
from xavi_dialogue.language.normalise import normalise
from xavi_dialogue.language.parse import VEHICLES, Parser
from xavi_dialogue.language.words import hear

SCALE = 20
PENALTY = 0.02
RAREST = 2  # features seen in fewer texts are not learnt
SMALLEST = 0.2  # weights below are left out
ITERATIONS = 150


@dataclass(frozen=True, slots=True)
class Example:
    """A text as the judge sees it, and what it is."""

    features: frozenset[str]
    kind: str


def examples(lines: Iterable[dict[str, Any]]) -> list[Example]:
    """Annotated questions as examples; a line is as in tests/language/questions."""
    parser = Parser()
    found: list[Example] = []
    for line in lines:
        previous = parser.question_before(tuple(line.get("context") or ()))
        heard = hear(normalise(line["text"]), VEHICLES)
        if heard.words:
            seen = features(build(heard.words), heard, follows=previous is not None)
            query = msgspec.convert(line["query"], Query)
            found.append(Example(seen, kind_of(query, previous)))
    return found


def learn(taught: list[Example], digest: str = "") -> Weights:
    """The weights that fit the examples best."""
    counted = Counter(f for one in taught for f in one.features)
    names = sorted(f for f, count in counted.items() if count >= RAREST)
    kinds = tuple(sorted({one.kind for one in taught}))
    table = _table(taught, {name: index for index, name in enumerate(names)})
    wanted = np.zeros((len(taught), len(kinds)))
    wanted[np.arange(len(taught)), [kinds.index(one.kind) for one in taught]] = 1.0
    fitted = _fit(table, wanted)
    return Weights(digest, SCALE, kinds, _sparse(names, fitted))


def _table(taught: list[Example], index: dict[str, int]) -> csr_matrix:
    """Examples by features, each row of length one."""
    rows, columns, values = [], [], []
    for row, one in enumerate(taught):
        known = sorted(index[f] for f in one.features if f in index)
        rows += [row] * len(known)
        columns += known
        values += [1.0 / np.sqrt(max(1, len(known)))] * len(known)
    return csr_matrix((values, (rows, columns)), shape=(len(taught), len(index)))


def _fit(table: csr_matrix, wanted: NDArray[np.float64]) -> NDArray[np.float64]:
    shape = (table.shape[1], wanted.shape[1])

    def loss(flat: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        weights = flat.reshape(shape)
        scores = table @ weights
        scores -= scores.max(axis=1, keepdims=True)
        logs = scores - np.log(np.exp(scores).sum(axis=1, keepdims=True))
        value = -float((wanted * logs).sum()) + PENALTY / 2 * float((flat**2).sum())
        slope = table.T @ (np.exp(logs) - wanted) + PENALTY * weights
        return value, np.asarray(slope).ravel()

    start = np.zeros(shape[0] * shape[1])
    found = minimize(loss, start, jac=True, method="L-BFGS-B", options={"maxiter": ITERATIONS})
    return np.asarray(found.x).reshape(shape)


def _sparse(names: list[str], fitted: NDArray[np.float64]) -> dict[str, dict[int, int]]:
    kept: dict[str, dict[int, int]] = {}
    for name, row in zip(names, fitted, strict=True):
        large = {k: round(w * SCALE) for k, w in enumerate(row.tolist()) if abs(w) >= SMALLEST}
        if large:
            kept[name] = large
    return kept


def read(files: Iterable[Path]) -> list[dict[str, Any]]:
    """The lines of the files."""
    return [json.loads(line) for file in files for line in file.read_text("utf-8").splitlines()]


def digest_of(files: Iterable[Path]) -> str:
    """What the files hold, in short."""
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:16]


def _written(weights: Weights) -> str:
    """As JSON with a line for each feature, so that a change can be read."""
    fields = msgspec.to_builtins(weights)
    said = {f: json.dumps(fields["features"][f], separators=(",", ":")) for f in weights.features}
    lines = [f"{json.dumps(f)}: {line}" for f, line in said.items()]
    head = {name: value for name, value in fields.items() if name != "features"}
    return json.dumps({**head, "features": {}}, indent=0).replace(
        '"features": {}', '"features": {\n' + ",\n".join(lines) + "\n}"
    )


def main() -> None:
    """Learn from the files named on the command line."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("files", nargs="+", type=Path)
    files = sorted(options.parse_args().files)
    weights = learn(examples(read(files)), digest_of(files))
    target = Path(str(resources.files("grammars").joinpath(FILE)))
    target.write_text(_written(weights), encoding="utf-8")


if __name__ == "__main__":
    main()
