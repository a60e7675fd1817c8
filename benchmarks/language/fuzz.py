"""`xavi bench fuzz`: random texts, which must all be read and grounded without an error.

One third are forms of questions filled with predicates of the lexicon, one third are annotated
questions with random changes, and one third are arbitrary. Each is grounded in a recorded ride,
after earlier turns or none. Text k of a seed is always the same.

Errors::

    FaultFound   a text cannot be read or grounded; holds the text and the fault
"""

import math
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from pathlib import Path
from random import Random

import msgspec

from benchmarks.drive.runs import in_processes
from benchmarks.errors import FaultFound
from benchmarks.figures import Aimed, aimed, at_most, targets_table
from benchmarks.language.latency import hearing_time, record_of, understood
from benchmarks.language.mutations import anything, mutated
from benchmarks.language.questions import LEARN, read_folder
from benchmarks.language.sentences import sentence
from xavi_dialogue.domain.discourse import Discourse
from xavi_dialogue.domain.meaning import Beyond
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.nlu.grounding.result import Grounding
from xavi_dialogue.nlu.grounding.salience import after

LIMIT = 50.0  # [ms] of processor time: no text may take longer twice in a row
BATCH = 1000  # texts of one task for a process
SOURCES = ("forms", "mutations", "anything")
_FOLLOWS = 0.3  # share of texts with earlier turns
_MOST_TURNS = 4


class Fault(msgspec.Struct, frozen=True):
    """The fault of a text."""

    text: str  # as a Python literal in ASCII
    context: str  # the earlier turns, likewise
    what: str


class Tried(msgspec.Struct, frozen=True):
    """The results of a batch of texts."""

    runs: dict[str, int]  # by source
    understood: dict[str, int]  # those with an act that the car can speak of
    slowest: float  # [ms] of the slowest text, the faster of two times
    worst: str  # the slowest text, as a Python literal
    faults: tuple[Fault, ...] = ()


class FuzzReport(Aimed, frozen=True):
    """The results of all texts."""

    bench: str
    seed: int
    tried: Tried

    def table(self) -> str:
        """Return the report for people."""
        runs, understood = self.tried.runs, self.tried.understood
        shares = ", ".join(
            f"{source} {100 * understood.get(source, 0) / runs[source]:.1f} %"
            for source in SOURCES
            if runs.get(source)
        )
        return (
            f"{sum(runs.values())} texts of seed {self.seed}, none fails; understood: {shares};"
            f" slowest {self.tried.slowest:.1f} ms: {self.tried.worst}\n\n"
            f"{targets_table(self.targets)}"
        )


@dataclass(frozen=True, slots=True)
class Case:
    """A text to try, with the earlier turns."""

    source: str
    text: str
    context: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Batch:
    """Texts `begin` to `end` of a seed."""

    questions: Path
    ride: Path
    seed: int
    begin: int
    end: int
    limit: float | None = LIMIT  # [ms]; None: time does not matter


def measure(
    questions: Path, ride: Path, runs: int, seed: int, jobs: int, note: Callable[[str], None]
) -> FuzzReport:
    """Try a number of texts.

    Args:
        questions: parent of the folder `learn` with annotated questions.
        ride: a recorded ride that the texts are about.
        runs: number of texts.
        seed: of the texts.
        jobs: number of parallel processes.
        note: is called with notes on progress.

    Raises:
        FaultFound: a text cannot be read or grounded, or takes too long.
        QuestionFileError: the questions cannot be read.
        RideFileError: the file is no recorded ride.
    """
    asked(questions)
    record_of(ride)
    begins = range(0, runs, BATCH)
    batches = [Batch(questions, ride, seed, k, min(k + BATCH, runs)) for k in begins]
    found: list[Tried] = []
    for k, tried in enumerate(in_processes(attempt, batches, jobs, _died)):
        if tried.faults:
            raise FaultFound(told(tried.faults[0]))
        found.append(tried)
        if (k + 1) % max(1, len(batches) // 10) == 0:
            note(f"{batches[k].end} texts")
    tried = together(found)
    return aimed(
        FuzzReport("fuzz", seed, tried),
        at_most("faults", "texts", len(tried.faults), 0),
        at_most("slowest text", "ms", tried.slowest, LIMIT),
    )


def told(fault: Fault) -> str:
    """Return a fault on one line."""
    behind = "" if fault.context == "()" else f" after {fault.context}"
    return f"understanding {fault.text}{behind}: {fault.what}"


def together(found: Sequence[Tried]) -> Tried:
    """Combine the results of several batches, at least one."""
    slowest = max(found, key=lambda one: one.slowest)
    return Tried(
        dict(sum((Counter(one.runs) for one in found), Counter())),
        dict(sum((Counter(one.understood) for one in found), Counter())),
        slowest.slowest,
        slowest.worst,
        tuple(fault for one in found for fault in one.faults),
    )


def attempt(batch: Batch) -> Tried:
    """Try a batch of texts; stops at the first fault."""
    known, record = asked(batch.questions), _record(batch.ride)
    runs: Counter[str] = Counter()
    spoken: Counter[str] = Counter()
    slowest, worst = 0.0, ""
    for number in range(batch.begin, batch.end):
        one = case(batch.seed, number, known)
        runs[one.source] += 1
        try:
            found, taken = heard(one, record, slowest)
        except Exception:
            return Tried(dict(runs), dict(spoken), slowest, worst, (_failing(one, record),))
        spoken[one.source] += any(not isinstance(act.act, Beyond) for act in found.acts)
        if taken > slowest:
            slowest, worst = taken, ascii(one.text)
        if batch.limit is not None and taken > batch.limit:
            fault = _fault(one, f"takes {taken:.0f} ms, and no more than {batch.limit:.0f} is fine")
            return Tried(dict(runs), dict(spoken), slowest, worst, (fault,))
    return Tried(dict(runs), dict(spoken), slowest, worst)


def heard(one: Case, record: Record, slowest: float) -> tuple[Grounding, float]:
    """Return the meaning of a text, and the processor time [ms] to find it.

    A text that seems to be the slowest is timed once more, and the faster time counts.

    Raises:
        FaultFound: the result is not a valid one.
    """
    discourse = Discourse()
    for turn in one.context:
        for act in understood(turn, record, discourse).acts:
            discourse = after(discourse, act)
    began = time.process_time()
    found = understood(one.text, record, discourse)
    taken = 1000.0 * (time.process_time() - began)
    if taken > slowest:
        taken = min(taken, hearing_time(one.text, record, discourse))
    if not isinstance(found, Grounding):
        raise FaultFound(f"its meaning is {found!r}")
    if msgspec.json.decode(msgspec.json.encode(found), type=Grounding) != found:
        raise FaultFound(f"{found!r} does not come back from JSON as it was")
    return found, taken


def case(seed: int, number: int, questions: Sequence[str]) -> Case:
    """Return text `number` of a seed."""
    rng = Random(f"{seed} {number}")
    source = SOURCES[number % len(SOURCES)]
    turns = rng.randint(1, _MOST_TURNS) if rng.random() < _FOLLOWS else 0
    context = tuple(_text(rng, rng.choice(SOURCES), questions) for _ in range(turns))
    return Case(source, _text(rng, source, questions), context)


def _text(rng: Random, source: str, questions: Sequence[str]) -> str:
    make = {"forms": sentence, "anything": anything}
    return make.get(source, partial(mutated, questions=questions))(rng)


@cache
def asked(folder: Path) -> tuple[str, ...]:
    """Return the texts of annotated questions.

    Raises:
        QuestionFileError: they cannot be read.
    """
    return tuple(one.text for one in read_folder(folder / LEARN))


@cache
def _record(ride: Path) -> Record:
    return record_of(ride)


def shorter(one: Case, fails: Callable[[Case], bool]) -> Case:
    """Return a shortened case that still fails, without parts that are not needed for that."""
    turns = (Case(one.source, turn, ()) for turn in (*one.context, one.text))
    one = next((turn for turn in turns if fails(turn)), one)
    size = len(one.text)
    while size:
        for begin in range(len(one.text) - size, -1, -size):
            less = replace(one, text=one.text[:begin] + one.text[begin + size :])
            one = less if fails(less) else one
        size //= 2
    return one


def _failing(one: Case, record: Record) -> Fault:
    """Return the fault of a failing text, for a text that is as short as possible."""
    least = shorter(one, lambda case: _error(case, record) is not None)
    return _fault(least, _error(least, record) or "it failed once, and no longer does")


def _error(one: Case, record: Record) -> str | None:
    try:
        heard(one, record, math.inf)
    except Exception as error:
        return f"{type(error).__name__}: {error}"
    return None


def _fault(one: Case, what: str) -> Fault:
    return Fault(ascii(one.text), ascii(one.context), what)


def _died(batch: Batch) -> Tried:
    said = f"one of texts {batch.begin} to {batch.end - 1} of seed {batch.seed}"
    return Tried({}, {}, 0.0, "", (Fault(said, "()", "the process died"),))
