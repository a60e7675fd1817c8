"""`xavi bench intents`: the intents of texts by the classifier, by the grammar and by rivals.

They learn from some sets of annotated texts and are tested on another, which other people wrote
about other rides. The grammar alone is measured by the most frequent intent of its reading.
"""

from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

import msgspec

from benchmarks.figures import Aimed, in_columns
from benchmarks.language.learning import Example, grammar_alone, learnt, read, write
from xavi_dialogue.nlu.intents.classifier import Head
from xavi_dialogue.nlu.intents.features import features
from xavi_dialogue.nlu.parse import Parser

HELD_OUT = "fresh"  # the set for the test
SURE = 0.6  # least probability that counts as sure
FIRST = 3


class Rate(msgspec.Struct, frozen=True):
    """The accuracy of one way to determine the intent."""

    name: str
    right: float
    among_three: float | None = None
    sure: float | None = None  # share of texts in which it is sure ...
    right_when_sure: float | None = None  # ... and the share of these that are right


class IntentsReport(Aimed, frozen=True):
    """The results of the benchmark."""

    bench: str
    learnt_from: int
    asked: int
    rates: tuple[Rate, ...]
    confused: tuple[tuple[str, str, int], ...]  # true intent, the one found, how often

    def table(self) -> str:
        """Return the report for people."""
        rows = [
            (r.name, _percent(r.right), _percent(r.among_three), _percent(r.sure),
             _percent(r.right_when_sure))
            for r in self.rates
        ]  # fmt: skip
        head = ("told by", "right", "among three", "sure", "right when sure")
        told = in_columns([head, *rows])
        mixed = "\n".join(f"  {a} told as {b}: {n}" for a, b, n in self.confused)
        return (
            f"{self.asked} texts, learnt from {self.learnt_from} others\n{told}\nmixed up:\n{mixed}"
        )


def measure(folder: Path, keep: Path | None, note: Callable[[str], None]) -> IntentsReport:
    """Learn from all sets except one, and test on that one.

    Args:
        folder: the sets of annotated texts.
        keep: a file for the weights learnt from all sets; None: they are not kept.
        note: is called with notes on progress.
    """
    sets = read(folder)
    fresh = sets.pop(HELD_OUT)
    known = [example for name in sorted(sets) for example in sets[name]]
    note(f"learning from {len(known)} texts")
    model = learnt(known)
    report = IntentsReport(
        bench="intents",
        learnt_from=len(known),
        asked=len(fresh),
        rates=(
            _classified("classifier", model.intent, fresh),
            _classified("grammar alone", grammar_alone(known), fresh, grammar=True),
            _nearest(known, fresh),
            _commonest(known, fresh),
        ),
        confused=_confused(model.intent, fresh),
    )
    if keep is not None:
        note("learning from all texts")
        write(learnt([*known, *fresh]), keep)
    return report


def _classified(name: str, head: Head, asked: Sequence[Example], grammar: bool = False) -> Rate:
    right = among = sure = both = 0
    for example in asked:
        found = _features(example, grammar)
        shares = head.probabilities(found)
        ranked = sorted(shares, key=lambda intent: (-shares[intent], intent))
        right += ranked[0] in example.intents
        among += bool(set(ranked[:FIRST]) & set(example.intents))
        if shares[ranked[0]] >= SURE:
            sure += 1
            both += ranked[0] in example.intents
    n = len(asked)
    return Rate(name, right / n, among / n, sure / n, both / sure if sure else None)


def _features(example: Example, grammar: bool) -> frozenset[str]:
    found = features(example.text, Parser().read(example.text)[0])
    return frozenset(f for f in found if f.startswith(("act:", "all:"))) if grammar else found


def _nearest(known: Sequence[Example], asked: Sequence[Example]) -> Rate:
    """Score the intent of the text with most words in common (Jaccard)."""
    bags = [(frozenset(example.text.lower().split()), example) for example in known]
    right = 0
    for example in asked:
        words = frozenset(example.text.lower().split())
        _, best = max(bags, key=lambda bag: len(words & bag[0]) / len(words | bag[0]))
        right += bool(set(best.intents) & set(example.intents))
    return Rate("nearest text", right / len(asked))


def _commonest(known: Sequence[Example], asked: Sequence[Example]) -> Rate:
    common = Counter(intent for example in known for intent in example.intents).most_common(1)
    name = common[0][0]
    return Rate(f"always {name}", sum(name in e.intents for e in asked) / len(asked))


def _confused(head: Head, asked: Sequence[Example]) -> tuple[tuple[str, str, int], ...]:
    found: Counter[tuple[str, str]] = Counter()
    for example in asked:
        shares = head.probabilities(_features(example, grammar=False))
        told = min(shares, key=lambda intent: (-shares[intent], intent))
        if told not in example.intents:
            found[example.intents[0], told] += 1
    return tuple((a, b, n) for (a, b), n in found.most_common(8))


def _percent(share: float | None) -> str:
    return "" if share is None else f"{100.0 * share:.0f} %"
