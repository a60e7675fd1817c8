"""`xavi bench sufficiency`: whether stated reasons justify the decision, figure by figure.

An independent reader (see `truth`) checks the text of answers against the record of the decision.
A rival, which gives the reason of another decision of the same ride, is measured for comparison.
"""

from collections import Counter
from collections.abc import Callable, Sequence

import msgspec

from benchmarks.drive.runs import in_processes
from benchmarks.figures import Aimed, aimed, at_least, at_most, in_columns, targets_table
from benchmarks.sufficiency.sufficiency_asking import KINDS
from benchmarks.sufficiency.sufficiency_judging import Judged, Read, read
from benchmarks.truth.sufficient import CHECKS

WORST = 12  # examples that are shown of each check, and sentences that were not understood
READ = 95.0  # target: least [%] of sentences that are understood
EASY = 50.0  # target: greatest [%] of the rival's answers that pass


class Row(msgspec.Struct, frozen=True):
    """The answers of one group, with the numbers that pass and that fail each check."""

    group: str
    asked: int
    declined: int
    answers: int  # the others, which were judged
    passed: float | None  # [%] of the answers
    failed: dict[str, int]  # answers by check
    sentences: int
    understood: float | None  # [%] of the sentences


class Example(msgspec.Struct, frozen=True):
    """An answer that fails, with the figures of the record."""

    check: str
    what: str
    count: int  # answers that fail in the same way
    question: str
    text: str
    figures: str
    reproduce: str


class Unread(msgspec.Struct, frozen=True):
    """A sentence that was not understood, with the parts concerned, and how often it occurs."""

    text: str
    count: int


class SufficiencyReport(Aimed, frozen=True, kw_only=True):
    """The results of the benchmark."""

    bench: str
    scenarios: tuple[Row, ...]
    kinds: tuple[Row, ...]
    all: Row
    rival: Row
    same: int  # answers of the rival in exactly our words, which are not scored
    lone: int  # answers for which the rival finds no other
    worst: tuple[Example, ...]
    uncovered: tuple[Unread, ...]
    failed: tuple[str, ...]
    left_out: tuple[str, ...] = ()  # scenarios that cannot be driven without netconvert

    def table(self) -> str:
        """Return the report for people."""
        rows = (*self.scenarios, *self.kinds, self.all, self.rival)
        note = f"of the rival's, {self.same} in the very same words and {self.lone} without another"
        parts = [_table(rows), note + " are left out", targets_table(self.targets)]
        parts += [_shown(one) for one in self.worst]
        if self.uncovered:
            lines = (f"{one.count:5}  {one.text}" for one in self.uncovered)
            parts.append("\n".join(("not understood:", *lines)))
        if self.failed:
            parts.append("\n".join(("failed:", *self.failed)))
        if self.left_out:
            parts.append(f"left out for want of netconvert: {', '.join(self.left_out)}")
        return "\n\n".join(parts)


def measure(
    scenarios: Sequence[str],
    seeds: Sequence[int],
    every: int,
    jobs: int,
    note: Callable[[str], None],
    left_out: tuple[str, ...] = (),
) -> SufficiencyReport:
    """Ask in scenarios (names or folders), and judge the answers.

    Args:
        scenarios: at least one.
        seeds: of each.
        every: 1 for each decision of a ride, 2 for every other one, ...
        jobs: number of parallel processes.
        note: is called with notes on progress.
        left_out: scenarios that cannot be driven without netconvert.
    """
    tasks = [(name, seed, every) for seed in seeds for name in scenarios]
    found: list[Read] = []
    for one in in_processes(read, tasks, jobs, _died):
        found.append(one)
        note(f"{len(found)} of {len(tasks)}: {one.scenario}, seed {one.seed}")
    return msgspec.structs.replace(report(found), left_out=left_out)


def _died(task: tuple[str, int, int]) -> Read:
    return Read(task[0], task[1], error="its process died")


def report(found: Sequence[Read]) -> SufficiencyReport:
    """Return the results over the answers that were judged."""
    ours = [one for ride in found for one in ride.ours]
    names = dict.fromkeys(ride.scenario for ride in found)
    rival = row("rival", [one for ride in found for one in ride.rival])
    every = row("all", ours)
    whole = SufficiencyReport(
        bench="sufficiency",
        scenarios=tuple(row(name, [o for o in ours if o.scenario == name]) for name in names),
        kinds=tuple(row(kind, [one for one in ours if one.kind == kind]) for kind in KINDS),
        all=every,
        rival=rival,
        same=sum(ride.same for ride in found),
        lone=sum(ride.lone for ride in found),
        worst=worst(ours),
        uncovered=uncovered(ours),
        failed=tuple(
            f"{ride.error}\n    {_command(ride.scenario, ride.seed)}"
            for ride in found
            if ride.error is not None
        ),
    )
    broken = float(sum(ride.error is not None for ride in found))
    return aimed(
        whole,
        at_least("answers that pass", "%", every.passed, 100.0),
        at_most("answers of the rival that pass", "%", rival.passed, EASY),
        at_least("sentences understood", "%", every.understood, READ),
        at_most("rides that failed", "", broken, 0.0),
    )


def row(group: str, judged: Sequence[Judged]) -> Row:
    """Count the answers of a group."""
    answers = [one for one in judged if not one.declined]
    failed = Counter(check for one in judged for check in {w.check for w in one.wrong})
    sentences = sum(one.sentences for one in answers)
    missed = sum(len(one.uncovered) for one in answers)
    return Row(
        group=group,
        asked=len(judged),
        declined=len(judged) - len(answers),
        answers=len(answers),
        passed=_percent(sum(one.passed for one in answers), len(answers)),
        failed={check: failed[check] for check in CHECKS},
        sentences=sentences,
        understood=_percent(sentences - missed, sentences),
    )


def worst(judged: Sequence[Judged]) -> tuple[Example, ...]:
    """Return one example of each way to fail, the most frequent first in each check."""
    found: dict[tuple[str, str], list[tuple[Judged, str]]] = {}
    for one in judged:
        for wrong in one.wrong:
            found.setdefault((wrong.check, wrong.kind), []).append((one, wrong.detail))
    examples: list[Example] = []
    for check in CHECKS:
        mine = sorted(((k, v) for k, v in found.items() if k[0] == check), key=lambda p: -len(p[1]))
        for (_, kind), cases in mine[:WORST]:
            one, detail = cases[0]
            number = len({id(case) for case, _ in cases})
            where = f"{one.scenario}, seed {one.seed}, {one.time:g} s"
            told = (one.question, f"{where}: {one.text}", detail)
            examples.append(Example(check, kind, number, *told, _command(one.scenario, one.seed)))
    return tuple(examples)


def uncovered(judged: Sequence[Judged]) -> tuple[Unread, ...]:
    """Return the sentences that were not understood, the most frequent first."""
    counted = Counter(text for one in judged for text in one.uncovered)
    ranked = sorted(counted.items(), key=lambda pair: (-pair[1], pair[0]))
    return tuple(Unread(text, number) for text, number in ranked)


def _percent(part: int, whole: int) -> float | None:
    return round(100.0 * part / whole, 1) if whole else None


def _command(scenario: str, seed: int) -> str:
    return f"xavi bench sufficiency --scenario {scenario} --seed {seed}"


def _table(rows: Sequence[Row]) -> str:
    head = ("", "asked", "declined", "answers", "pass", *CHECKS, "sentences", "understood")
    cells = [
        (
            one.group,
            str(one.asked),
            str(one.declined),
            str(one.answers),
            "-" if one.passed is None else f"{one.passed:.1f} %",
            *(str(one.failed[check]) for check in CHECKS),
            str(one.sentences),
            "-" if one.understood is None else f"{one.understood:.1f} %",
        )
        for one in rows
    ]
    return in_columns([head, *cells])


def _shown(one: Example) -> str:
    lines = (
        f"{one.check}: {one.what} ({one.count})",
        f"  {one.question}",
        f"  {one.text}",
        f"  record: {one.figures}",
        f"  {one.reproduce}",
    )
    return "\n".join(lines)
