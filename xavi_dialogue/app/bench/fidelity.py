"""`xavi bench fidelity`: what we say of foils, beside what SUMO makes of them.

At each decision of each ride, for each foil that applies, SUMO is run on from the very same
state with the ego doing the foil (see `resimulate`), and what an answer would say is compared
with what happened: the outcome, and by how much the ego arrives later than it did. Beside it
stands what would be said if the others of a rollout did not react to the ego.
"""

from collections.abc import Callable, Sequence

import msgspec

from xavi_dialogue.app.bench.agreement import (
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
from xavi_dialogue.app.bench.cases import Case, Compared, compare
from xavi_dialogue.app.bench.runs import in_processes


class Wrong(msgspec.Struct, frozen=True):
    """A foil of which the wrong thing is said."""

    what: str
    reproduce: str


class FidelityReport(msgspec.Struct, frozen=True):
    """What the benchmark found."""

    bench: str
    scenarios: tuple[Agreement, ...]
    all: Agreement
    outcomes: tuple[OutcomeRow, ...]
    calibration: tuple[Bin, ...]
    wrong: tuple[Wrong, ...]
    failed: tuple[str, ...]
    left_out: tuple[str, ...] = ()  # scenarios that cannot be driven for want of netconvert

    def table(self) -> str:
        """The report for people."""
        parts = [tables((*self.scenarios, self.all), self.outcomes, self.calibration)]
        parts.append("\n".join(["wrong:", *(one.what for one in self.wrong)]))
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
) -> FidelityReport:
    """Compare the foils of scenarios (names or folders).

    Args:
        scenarios: at least one.
        seeds: of each.
        every: 1 for each decision of a ride that has alternatives, 2 for every other one, ...
        jobs: processes side by side.
        note: is told the progress.
    """
    tasks = [(name, seed, every) for seed in seeds for name in scenarios]
    found = []
    for one in in_processes(compare, tasks, jobs, _died):
        found.append(one)
        note(f"{len(found)} of {len(tasks)}: {one.scenario}, seed {one.seed}")
    return report(found)


def _died(task: tuple[str, int, int]) -> Compared:
    return Compared(task[0], task[1], error="its process died")


def report(found: Sequence[Compared]) -> FidelityReport:
    """The rides that were compared, in numbers."""
    names = list(dict.fromkeys(one.scenario for one in found))
    cases = [case for one in found for case in one.cases]
    return FidelityReport(
        bench="fidelity",
        scenarios=tuple(agreement(n, [c for c in cases if c.scenario == n]) for n in names),
        all=agreement(ALL, cases),
        outcomes=by_outcome(cases),
        calibration=calibration(cases),
        wrong=tuple(Wrong(_what(case), _command(case)) for case in cases if _is_wrong(case)),
        failed=tuple(
            f"{one.error}\n    xavi bench fidelity --scenario {one.scenario} --seed {one.seed}"
            for one in found
            if one.error is not None
        ),
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
    return f"xavi bench fidelity --scenario {case.scenario} --seed {case.seed}"
