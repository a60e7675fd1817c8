"""`xavi bench fidelity`: statements about foils, compared with what happens in SUMO.

At each decision of each ride, and for each foil that applies, SUMO is run on from exactly this
state while the ego carries out the foil and its expected continuation (see `resimulate`). The
statement of an answer is compared with what happened: the outcome, and how much later the ego
arrives at the destination than it did. For comparison there are statements from rollouts in which
the others do not react to the ego, and guesses from the foil's name alone.
"""

from collections.abc import Callable, Iterator, Sequence

import msgspec

from benchmarks.drive.runs import in_processes
from benchmarks.fidelity.agreement import (
    ALL,
    CLEAR,
    Agreement,
    Bin,
    OutcomeRow,
    agreement,
    by_outcome,
    calibration,
    right,
    same_sign,
    tables,
)
from benchmarks.fidelity.cases import LEARNING, RANDOM, Case, Compared, Task, compare
from benchmarks.fidelity.ranging import (
    Coverage,
    Extension,
    coverage,
    coverage_table,
    extension,
    extension_table,
    learn,
)
from benchmarks.fidelity.rivals import by_name
from benchmarks.figures import Aimed, Target, aimed, at_least, at_most, targets_table
from xavi_dialogue.explain.causes.plans.ranges import Ranges, table

KINDS = ("stop", "exit", "manoeuvre")  # of foils
AHEAD = 10.0  # target: points of agreement above a guess by the name of the foil
NOMINAL, OFF = 90.0, 3.0  # target: [%] of ranges that hold, and greatest deviation


class Wrong(msgspec.Struct, frozen=True):
    """A foil about which the statement is wrong."""

    what: str
    reproduce: str


class FidelityReport(Aimed, frozen=True, kw_only=True):
    """The results of the benchmark."""

    bench: str
    scenarios: tuple[Agreement, ...]
    kinds: tuple[Agreement, ...]  # of foils
    all: Agreement
    coverage: tuple[Coverage, ...]
    extension: tuple[Extension, ...]
    outcomes: tuple[OutcomeRow, ...]
    calibration: dict[str, tuple[Bin, ...]]  # of probabilities among rollouts, and as stated
    wrong: tuple[Wrong, ...]
    failed: tuple[str, ...]
    left_out: tuple[str, ...] = ()  # scenarios that cannot be driven without netconvert

    def table(self) -> str:
        """Return the report for people."""
        rows = (*self.scenarios, *self.kinds, self.all)
        parts = [tables(rows, self.outcomes, self.calibration)]
        parts += [coverage_table(self.coverage), extension_table(self.extension)]
        parts.append("\n".join(["wrong:", *(one.what for one in self.wrong)]))
        if self.failed:
            parts.append("\n".join(("failed:", *self.failed)))
        if self.left_out:
            parts.append(f"left out for want of netconvert: {', '.join(self.left_out)}")
        parts.append(targets_table(self.targets))
        return "\n\n".join(parts)


class Learnt(msgspec.Struct, frozen=True):
    """The table of ranges that was made."""

    bench: str
    ranges: Ranges
    failed: tuple[str, ...]

    def table(self) -> str:
        """Return the table for people."""
        source = self.ranges.source
        lines = [f"{source.cases} foils of {source.rides} rides, {source.missed} never arrived"]
        lines += [
            f"{one.foil}, {one.road or 'all roads'}: {one.reach:.1f} s to either side"
            f" ({one.cases} foils of {one.rides} rides)"
            for one in self.ranges.groups
        ]
        return "\n".join([*lines, *(["failed:", *self.failed] if self.failed else [])])


def tasks(
    scenarios: Sequence[str], seeds: Sequence[int], networks: Sequence[int], every: int
) -> list[Task]:
    """Return the rides whose foils are compared.

    Args:
        scenarios: names or folders.
        seeds: of each.
        networks: numbers of random networks; no range was learnt on them.
        every: 1 for each decision of a ride that has alternatives, 2 for every other one, ...
    """
    found = [Task(name, seed, every) for seed in seeds for name in scenarios]
    return found + [Task(RANDOM, number, every) for number in networks]


def measure(asked: Sequence[Task], jobs: int, note: Callable[[str], None]) -> FidelityReport:
    """Compare the foils of rides.

    Args:
        asked: the rides, at least one.
        jobs: number of parallel processes.
        note: is called with notes on progress.
    """
    return report(_driven(asked, jobs, note), table())


def learnt(networks: Sequence[int], every: int, jobs: int, note: Callable[[str], None]) -> Learnt:
    """Make the table of ranges on networks that are used for nothing else.

    Args:
        networks: their numbers.
        every: as in `tasks`.
        jobs: number of parallel processes.
        note: is called with notes on progress.

    Raises:
        ValueError: there are too few rides.
    """
    asked = [Task(LEARNING, number, every, blind=False) for number in networks]
    found = _driven(asked, jobs, note)
    first = f"--seed {networks[0]} --networks {len(networks)}" if networks else "--networks 0"
    command = f"xavi bench fidelity --learn FILE {first} --every {every}"
    return Learnt("fidelity-learn", learn(found, command), _failed(found))


def _driven(asked: Sequence[Task], jobs: int, note: Callable[[str], None]) -> list[Compared]:
    found = []
    for one in in_processes(compare, asked, jobs, _died):
        found.append(one)
        note(f"{len(found)} of {len(asked)}: {one.scenario}, seed {one.seed}")
    return found


def _died(task: Task) -> Compared:
    return Compared(task.world, task.seed, error="its process died")


def report(found: Sequence[Compared], ranges: Ranges) -> FidelityReport:
    """Return the results over rides, with ranges that were learnt on other ones."""
    cases = [case for one in found for case in one.cases]
    groups = {
        name: [case for case in cases if case.scenario == name]
        for name in dict.fromkeys(one.scenario for one in found)
    }
    kinds = {kind: [case for case in cases if case.kind == kind] for kind in KINDS}
    named = by_name(cases)
    every = {**groups, **kinds, ALL: cases}
    whole = FidelityReport(
        bench="fidelity",
        scenarios=tuple(agreement(name, own, named) for name, own in groups.items()),
        kinds=tuple(agreement(name, own, named) for name, own in kinds.items()),
        all=agreement(ALL, cases, named),
        coverage=tuple(coverage(name, own, ranges) for name, own in every.items()),
        extension=tuple(extension(name, own) for name, own in every.items()),
        outcomes=by_outcome(cases),
        calibration={
            "rollouts": calibration(cases),
            "told": calibration(cases, ranges.trusted),
        },
        wrong=tuple(Wrong(_what(case), _command(case)) for case in cases if _is_wrong(case)),
        failed=_failed(found),
    )
    return aimed(whole, *_targets(whole))


def _targets(found: FidelityReport) -> Iterator[Target]:
    """Yield the targets over all rides."""
    own, name = found.all.agree, found.all.agree_name
    ahead = None if own is None or name is None else 100.0 * (own - name)
    yield at_least("outcomes named right, ahead of the name", "points", ahead, AHEAD)
    yield at_least("skill in time over the name", "", found.all.skill, 0.0)
    covered = found.coverage[-1].covered
    percent = None if covered is None else 100.0 * covered
    yield at_least("ranges of nine in ten that hold", "%", percent, NOMINAL - OFF)
    yield at_most("ranges of nine in ten that hold", "%", percent, NOMINAL + OFF)
    yield at_most("rides that failed", "", float(len(found.failed)), 0.0)


def _failed(found: Sequence[Compared]) -> tuple[str, ...]:
    return tuple(
        f"{one.error}\n    {_again(one.scenario, one.seed)}"
        for one in found
        if one.error is not None
    )


def _is_wrong(case: Case) -> bool:
    if case.foreseen.declined is not None:
        return False
    known = case.later is not None and case.foreseen.time is not None
    clear = known and case.later is not None and abs(case.later) > CLEAR
    return not right(case) or (clear and not same_sign(case))


def _what(case: Case) -> str:
    foreseen, happened = case.foreseen, case.happened
    said = ", ".join(f"{name} {p:.2f}" for name, p in foreseen.outcomes.items() if p > 0.005)
    time = "" if foreseen.time is None else f", {foreseen.time:+.1f} s"
    later = "" if case.later is None else f", {case.later:+.1f} s"
    struck = "" if happened.collided_with is None else f" with {happened.collided_with}"
    where = f"{case.scenario}, seed {case.seed}, {case.time:g} s"
    return (
        f"{where}: {case.foil} instead of {case.fact}:"
        f" said {said}{time}; came to {happened.outcome}{struck}{later}"
    )


def _command(case: Case) -> str:
    return _again(case.scenario, case.seed)


def _again(scenario: str, seed: int) -> str:
    """Return the command that repeats a ride."""
    if scenario == RANDOM:
        return f"xavi bench fidelity --seeds 0 --networks 1 --seed {seed}"
    return f"xavi bench fidelity --networks 0 --scenario {scenario} --seed {seed}"
