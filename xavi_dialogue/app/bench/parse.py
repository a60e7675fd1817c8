"""`xavi bench parse`: how often questions are understood, and how long parsing takes."""

from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random

import msgspec
from msgspec.structs import replace

from xavi_dialogue.app.bench.figures import Figure, figure, figures_table, in_columns, quantile
from xavi_dialogue.app.bench.hostile import Family, families, half
from xavi_dialogue.app.bench.latency import parse_time
from xavi_dialogue.app.bench.questions import BLIND, LEARN, read_folder
from xavi_dialogue.app.bench.scoring import Agreement, Question, Verdict, agreement, verdict
from xavi_dialogue.language.parse import Parser, as_query

AGAIN = 20  # slowest texts of a family that are timed anew
TIMES = 5  # how often, then; the fastest counts
SEED = 0
SHOWN = 60  # characters of the worst text
RATIOS = 200  # texts of a family of which growth is taken, at most
SHORTEST = 0.2  # [ms] texts that take less say nothing of growth

Grouping = Callable[[Question], str]


class Set(msgspec.Struct, frozen=True):
    """How the parser fares on the questions of a folder."""

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
    growth: float | None  # time of a text over that of its first half, median; None: too short
    growth_most: float | None
    worst: str  # the text that took longest


class ParseReport(msgspec.Struct, frozen=True):
    """What a benchmark of parsing found."""

    bench: str
    figures: tuple[Figure, ...]  # of latency
    sets: tuple[Set, ...]
    unseen: Agreement | None  # of blind questions whose text is not learnt from too; None: no such
    hostile: tuple[Hardest, ...]

    def table(self) -> str:
        """The report for people."""
        head = ("", "n", "type", "exact", "primary", "confidently wrong")
        everything = [replace(one.all, group=one.name) for one in self.sets]
        parts = [_agreements(head, [*everything, *([self.unseen] if self.unseen else [])])]
        for one in self.sets:
            parts += [
                f"{one.name}\n" + _agreements((by, *head[1:]), groups)
                for by, groups in (("type", one.types), ("style", one.styles), ("", one.turns))
            ]
        parts += [figures_table(self.figures), _hostile(self.hostile)]
        return "\n\n".join(parts)


def measure(
    questions: Path,
    note: Callable[[str], None],
    attacks: dict[str, Family] | None = None,
) -> ParseReport:
    """Score annotated questions, and time them and hostile texts.

    Args:
        questions: where the folders `learn` and `blind` are; there may be no blind ones.
        note: is told how far it is.
        attacks: families of hostile texts; default: all of them.

    Raises:
        QuestionFileError: none are learnt from, or a line is broken.
    """
    parser = Parser()
    asked = {LEARN: read_folder(questions / LEARN)}
    if any((questions / BLIND).glob("*.jsonl")):
        asked[BLIND] = read_folder(questions / BLIND)
    else:
        note(f"{questions / BLIND} holds no .jsonl files: no figures of blind questions")
    sets = tuple(scored(parser, name, found) for name, found in asked.items())
    figures = tuple(
        figure(f"{name} questions", "ms", [_time(parser, question) for question in found])
        for name, found in asked.items()
    )
    hostile = []
    for name, family in (families() if attacks is None else attacks).items():
        note(f"hostile texts: {name}")
        hostile.append(hardest(name, family))
    return ParseReport("parse", figures, sets, _unseen(parser, asked), tuple(hostile))


def scored(parser: Parser, name: str, questions: Sequence[Question]) -> Set:
    """How a parser fares on questions, at least one."""
    verdicts = [(question, _verdict(parser, question)) for question in questions]
    return Set(
        name,
        agreement("all", [one for _, one in verdicts]),
        _grouped(verdicts, lambda question: question.query.type),
        _grouped(verdicts, lambda question: question.style),
        _grouped(verdicts, lambda question: "follow-up" if question.context else "single"),
    )


def _verdict(parser: Parser, question: Question) -> Verdict:
    return verdict(question, as_query(parser.parse(question.text, context=question.context)))


def _unseen(parser: Parser, asked: dict[str, tuple[Question, ...]]) -> Agreement | None:
    """How it fares on blind questions that nobody whose questions are learnt from has asked."""
    learnt = {question.text.casefold() for question in asked[LEARN]}
    rest = [question for question in asked.get(BLIND, ()) if question.text.casefold() not in learnt]
    verdicts = [_verdict(parser, question) for question in rest]
    return agreement(f"{BLIND}, not in {LEARN}", verdicts) if verdicts else None


def _grouped(
    verdicts: Sequence[tuple[Question, Verdict]], group: Grouping
) -> tuple[Agreement, ...]:
    """Agreement by group, the largest first."""
    groups: dict[str, list[Verdict]] = {}
    for question, found in verdicts:
        groups.setdefault(group(question), []).append(found)
    ordered = sorted(groups.items(), key=lambda item: (-len(item[1]), item[0]))
    return tuple(agreement(name, found) for name, found in ordered)


def _time(parser: Parser, question: Question) -> float:
    return parse_time(question.text, parser.question_before(question.context))


def hardest(name: str, family: Family) -> Hardest:
    """The times of a family's texts, and how they grow from half of each.

    All are timed once; the slowest again, to tell texts that are slow from moments that were.
    """
    texts = family(Random(SEED))
    once = [parse_time(text) for text in texts]
    order = sorted(range(len(texts)), key=lambda k: (-once[k], k))[:AGAIN]
    anew = {k: parse_time(texts[k], times=TIMES) for k in order}
    times = [min(taken, anew.get(k, taken)) for k, taken in enumerate(once)]
    worst = max(order, key=lambda k: anew[k])
    ratios = _growth(texts)
    return Hardest(
        name,
        len(texts),
        round(quantile(times, 50), 3),
        round(max(times), 3),
        round(quantile(ratios, 50), 2) if ratios else None,
        round(max(ratios), 2) if ratios else None,
        texts[worst],
    )


def _growth(texts: Sequence[str]) -> list[float]:
    """Time of texts over that of their first halves; of as many as tell."""
    chosen = texts[:: -(-len(texts) // RATIOS)]
    times = [(parse_time(t, times=TIMES), parse_time(half(t), times=TIMES)) for t in chosen]
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
