"""`xavi bench parse`: how often questions are understood, and how long that takes."""

from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random

import msgspec
from msgspec.structs import replace

from benchmarks.figures import (
    Aimed,
    Figure,
    aimed,
    at_least,
    at_most,
    figure,
    figures_table,
    in_columns,
    quantile,
    targets_table,
)
from benchmarks.language.hostile import Family, families, half
from benchmarks.language.latency import hearing_time, record_of
from benchmarks.language.questions import BLIND, LEARN, read_folder
from benchmarks.language.scoring import Agreement, Question, Verdict, agreement, verdict
from xavi_dialogue.cli.parse import query_of
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.nlu.parse import Parser
from xavi_dialogue.process.garbage import settled

AGAIN = 10  # slowest texts of a family that are timed again
TIMES = 3  # number of repeats then; the fastest counts
SEED = 0
SHOWN = 60  # characters of the worst text that are shown
RATIOS = 40  # greatest number of texts of a family for measuring growth
SHORTEST = 0.2  # [ms] least time of a text for measuring growth

EXACT = 95.0  # target: least [%] of blind questions that are exact
CONFIDENT = 1.0  # target: greatest [%] of them that are confidently wrong
MEDIAN, TAIL, WORST = 3.0, 15.0, 50.0  # targets [ms] to read and ground: p50, p99, hostile texts

Grouping = Callable[[Question], str]


class Set(msgspec.Struct, frozen=True):
    """The scores of the parser on the questions of a folder."""

    name: str
    all: Agreement
    types: tuple[Agreement, ...]
    styles: tuple[Agreement, ...]
    turns: tuple[Agreement, ...]  # single, follow-up


class Hardest(msgspec.Struct, frozen=True):
    """A family of hostile texts."""

    family: str
    n: int
    p50: float  # [ms]
    most: float  # [ms]
    growth: float | None  # median ratio of a text's time to its first half's; None: too short
    growth_most: float | None
    worst: str  # the text that took longest


class ParseReport(Aimed, frozen=True):
    """The results of the benchmark."""

    bench: str
    figures: tuple[Figure, ...]  # of latency, reading and grounding together
    sets: tuple[Set, ...]
    unseen: Agreement | None  # on blind questions that are in no other set; None: there are none
    hostile: tuple[Hardest, ...]

    def table(self) -> str:
        """Return the report for people."""
        head = ("", "n", "type", "exact", "primary", "confidently wrong")
        everything = [replace(one.all, group=one.name) for one in self.sets]
        parts = [_agreements(head, [*everything, *([self.unseen] if self.unseen else [])])]
        for one in self.sets:
            parts += [
                f"{one.name}\n" + _agreements((by, *head[1:]), groups)
                for by, groups in (("type", one.types), ("style", one.styles), ("", one.turns))
            ]
        parts += [figures_table(self.figures), _hostile(self.hostile)]
        parts.append(targets_table(self.targets))
        return "\n\n".join(parts)


def measure(
    questions: Path,
    ride: Path,
    note: Callable[[str], None],
    attacks: dict[str, Family] | None = None,
) -> ParseReport:
    """Score annotated questions, and time them and hostile texts.

    Args:
        questions: parent of the folders `learn` and `blind`; the latter may be missing.
        ride: a recorded ride in which texts are grounded when they are timed.
        note: is called with notes on progress.
        attacks: families of hostile texts; default: all of them.

    Raises:
        QuestionFileError: the folder `learn` has no questions, or a line is broken.
        RideFileError: the file is no recorded ride.
    """
    parser, record = Parser(), record_of(ride)
    asked = {LEARN: read_folder(questions / LEARN)}
    if any((questions / BLIND).glob("*.jsonl")):
        asked[BLIND] = read_folder(questions / BLIND)
    else:
        note(f"{questions / BLIND} holds no .jsonl files: no figures of blind questions")
    sets = tuple(scored(parser, name, found) for name, found in asked.items())
    with settled():  # as in a warm service
        figures = tuple(
            figure(f"{name} questions", "ms", [hearing_time(q.text, record) for q in found])
            for name, found in asked.items()
        )
        hostile = []
        for name, family in (families() if attacks is None else attacks).items():
            note(f"hostile texts: {name}")
            hostile.append(hardest(name, family, record))
    return _aimed(ParseReport("parse", figures, sets, _unseen(parser, asked), tuple(hostile)))


def _aimed(report: ParseReport) -> ParseReport:
    """Return the report with its targets."""
    last, timed = report.sets[-1].all, report.figures[-1]
    worst = max((one.most for one in report.hostile), default=None)
    return aimed(
        report,
        at_least(f"{report.sets[-1].name}, exact", "%", last.exact, EXACT),
        at_most(f"{report.sets[-1].name}, confidently wrong", "%", last.false_confident, CONFIDENT),
        at_most(f"{timed.name}, p50", "ms", timed.p50, MEDIAN),
        at_most(f"{timed.name}, p99", "ms", timed.p99, TAIL),
        at_most("hostile texts, worst", "ms", worst, WORST),
    )


def scored(parser: Parser, name: str, questions: Sequence[Question]) -> Set:
    """Return the scores of a parser on questions, at least one."""
    verdicts = [(question, _verdict(parser, question)) for question in questions]
    return Set(
        name,
        agreement("all", [one for _, one in verdicts]),
        _grouped(verdicts, lambda question: question.query.type),
        _grouped(verdicts, lambda question: question.style),
        _grouped(verdicts, lambda question: "follow-up" if question.context else "single"),
    )


def _verdict(parser: Parser, question: Question) -> Verdict:
    return verdict(question, query_of(parser, question.text, question.context))


def _unseen(parser: Parser, asked: dict[str, tuple[Question, ...]]) -> Agreement | None:
    """Return the scores on blind questions that are not among the others too."""
    learnt = {question.text.casefold() for question in asked[LEARN]}
    rest = [question for question in asked.get(BLIND, ()) if question.text.casefold() not in learnt]
    verdicts = [_verdict(parser, question) for question in rest]
    return agreement(f"{BLIND}, not in {LEARN}", verdicts) if verdicts else None


def _grouped(
    verdicts: Sequence[tuple[Question, Verdict]], group: Grouping
) -> tuple[Agreement, ...]:
    """Return the agreement by group, the largest group first."""
    groups: dict[str, list[Verdict]] = {}
    for question, found in verdicts:
        groups.setdefault(group(question), []).append(found)
    ordered = sorted(groups.items(), key=lambda item: (-len(item[1]), item[0]))
    return tuple(agreement(name, found) for name, found in ordered)


def hardest(name: str, family: Family, record: Record) -> Hardest:
    """Return the times of a family's texts, and their growth from the first half of each.

    All are timed once. The slowest are timed again, as the machine may have been slow for a moment.
    """
    texts = family(Random(SEED))
    once = [hearing_time(text, record) for text in texts]
    order = sorted(range(len(texts)), key=lambda k: (-once[k], k))[:AGAIN]
    anew = {k: hearing_time(texts[k], record, times=TIMES) for k in order}
    times = [min(taken, anew.get(k, taken)) for k, taken in enumerate(once)]
    worst = max(order, key=lambda k: anew[k])
    ratios = _growth(texts, record)
    return Hardest(
        name,
        len(texts),
        round(quantile(times, 50), 3),
        round(max(times), 3),
        round(quantile(ratios, 50), 2) if ratios else None,
        round(max(ratios), 2) if ratios else None,
        texts[worst],
    )


def _growth(texts: Sequence[str], record: Record) -> list[float]:
    """Return ratios of the times of texts to those of their first halves, if long enough."""
    chosen = texts[:: -(-len(texts) // RATIOS)]
    times = [
        (hearing_time(t, record, times=TIMES), hearing_time(half(t), record, times=TIMES))
        for t in chosen
    ]
    return [long / short for long, short in times if short >= SHORTEST]


def _agreements(head: Sequence[str], groups: Sequence[Agreement]) -> str:
    rows: list[Sequence[str]] = [head]
    for one in groups:
        shares = (one.type, one.exact, one.exact_primary, one.false_confident)
        rows.append((one.group, str(one.n), *(f"{share:.1f}" for share in shares)))
    return in_columns(rows)


def _hostile(families: Sequence[Hardest]) -> str:
    rows: list[Sequence[str]] = [
        ("hostile texts", "n", "p50 ms", "most ms", "growth", "most growth")
    ]
    for one in families:
        ratios = ("-" if r is None else f"{r:.2f}" for r in (one.growth, one.growth_most))
        rows.append((one.family, str(one.n), f"{one.p50:.2f}", f"{one.most:.2f}", *ratios))
    worst = [f"{one.family}: {one.worst[:SHOWN]!a}" for one in families]
    return "\n".join((in_columns(rows), "", "worst texts, from their beginning", *worst))
