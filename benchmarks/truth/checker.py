"""Checks of an answer sentence by sentence, with a list of what no pattern covers."""

import re
from dataclasses import dataclass

from benchmarks.truth.context import RULES, Fault, Said, Told
from benchmarks.truth.decision import Decision
from benchmarks.truth.mentions import mentions
from benchmarks.truth.phrases import COUNTS
from benchmarks.truth.ridden import Ridden
from benchmarks.truth.statements import (
    blames,
    chances,
    conduct,
    consequences,
    deeds,
    hazards,
    motion,
    outcomes,
    own,
    without,
)

__all__ = [
    "blames", "chances", "checked", "conduct", "consequences", "deeds", "hazards", "motion",
    "outcomes", "own", "without",
]  # fmt: skip
SENTENCE = re.compile(r"(?<=[.!?;]) ")
PLACES_ONLY = motion.place_of
FIGURE = re.compile(rf"(?<![V\w])(?:\d+(?:[.:]\d+)?|half a|{'|'.join(COUNTS[2:])})\b")


CLAUSE = re.compile(r", (?:because|but|though|and|as) |: | because ")


@dataclass(frozen=True)
class Sentence:
    """A sentence, with the clauses and figures in it that no pattern covers."""

    text: str
    met: bool  # whether a pattern covers some of it
    unread: tuple[str, ...] = ()

    @property
    def understood(self) -> bool:
        """Check whether every clause and figure in it was checked against the record."""
        return self.met and not self.unread


def checked(
    ride: Ridden, now: float, question: str, answer: str, decision: Decision | None = None
) -> tuple[list[Fault], list[Sentence], list[Told]]:
    """Check an answer.

    Args:
        ride: the whole ride as seen and decided.
        now: [s] time at which the question was asked.
        question: the words of the question.
        answer: the words of the answer.
        decision: the decision that the answer is about; None: consequences are not checked.

    Returns:
        The wrong statements, the sentences, and the statements about foils.
    """
    text, found = mentions(answer, ride, now)
    faults: dict[tuple[str, str], Fault] = {}
    told: list[Told] = []
    sentences: list[Sentence] = []
    before = ""
    for sentence in SENTENCE.split(text):
        said = Said(ride, now, question, sentence, tuple(found), before, decision)
        spans: list[tuple[int, int]] = []
        for pattern, check in RULES:
            for match in pattern.finditer(sentence):
                spans += [match.span()] if check is not PLACES_ONLY else []
                for one in check(said, match):
                    if isinstance(one, Told):
                        told.append(one)
                    else:
                        faults[one.kind, one.detail] = one
        sentences.append(Sentence(sentence, bool(spans), _unread(sentence, spans)))
        before += sentence + " "
    return list(faults.values()), sentences, told


def _unread(sentence: str, spans: list[tuple[int, int]]) -> tuple[str, ...]:
    """Return the clauses of a sentence that no pattern matches, and the figures outside of all."""
    cuts = [(m.start(), m.end()) for m in CLAUSE.finditer(sentence)]
    edges = [0, *(edge for cut in cuts for edge in cut), len(sentence)]
    clauses = zip(edges[::2], edges[1::2], strict=True)
    found = [sentence[a:b] for a, b in clauses if not any(s < b and e > a for s, e in spans)]
    found += [
        m[0] for m in FIGURE.finditer(sentence) if not any(s <= m.start() < e for s, e in spans)
    ]
    return tuple(found)
