"""`xavi bench drive`: how safely and how fast we drive, compared with SUMO's own driver."""

from collections.abc import Callable, Sequence

import msgspec

from benchmarks.drive.monitor import Drive
from benchmarks.drive.runs import Run, in_processes, run
from benchmarks.figures import (
    Aimed,
    Figure,
    aimed,
    at_least,
    at_most,
    figure,
    in_columns,
    mean,
    quantile,
    targets_table,
)

WORST = 20
ARRIVING = 0.98  # target: share of the runs in which SUMO's driver arrives
TAKING = 1.03  # target: mean ratio to the time of SUMO's driver
SLOW = 1.05  # ratio to the time of SUMO's driver from which on a run is slow
EVERY = 25  # runs between notes on progress
ALL = "all"


class Tally(msgspec.Struct, frozen=True):
    """Counts of the runs of one scenario, or of all of them."""

    scenario: str
    runs: int
    failed: int  # runs that ended with an error
    collisions: int  # runs in which the ego touched another vehicle
    caused: int  # runs in which it caused that
    sumo_collisions: int  # runs in which SUMO's driver touched another vehicle
    sumo_caused: int
    avoidable: int  # runs in which the ego collides and SUMO's driver does not
    hard_brakes: int
    sumo_hard_brakes: int
    provoked: int  # hard brakes of others
    sumo_provoked: int
    reached: int  # runs that reach the goal
    sumo_reached: int
    reached_share: float | None  # relative to the runs in which SUMO's driver does; None: none
    both: int  # runs in which both do
    time_ratio: float | None  # mean ratio of our time to that of SUMO's driver, where both do
    time_ratio_p90: float | None


class Bad(msgspec.Struct, frozen=True):
    """A run that did not go well."""

    scenario: str
    seed: int
    what: str
    reproduce: str


class DriveReport(Aimed, frozen=True, kw_only=True):
    """The results of the benchmark."""

    bench: str
    figures: tuple[Figure, ...]  # decision times
    scenarios: tuple[Tally, ...]
    all: Tally
    worst: tuple[Bad, ...]
    left_out: tuple[str, ...] = ()  # scenarios that cannot be driven without netconvert

    def table(self) -> str:
        """Return the report for people."""
        names = [name for name in Tally.__struct_fields__ if name != "scenario"]
        columns = [*self.scenarios, self.all]
        rows = [["", *(tally.scenario for tally in columns)]]
        rows += [
            [name.replace("_", " "), *(_cell(getattr(tally, name)) for tally in columns)]
            for name in names
        ]
        times = [["decision", "n", "p50", "p99", "most"]]
        times += [
            [f.name, str(f.n), f"{f.p50:.1f} ms", f"{f.p99:.1f} ms", f"{f.most:.1f} ms"]
            for f in self.figures
        ]
        worst = [f"{bad.what}\n    {bad.reproduce}" for bad in self.worst] or ["none"]
        parts = [in_columns(rows), "", in_columns(times), "", "runs that did not go well:", *worst]
        parts += ["", targets_table(self.targets)]
        if self.left_out:
            parts += ["", f"left out for want of netconvert: {', '.join(self.left_out)}"]
        return "\n".join(parts)


def measure(
    scenarios: Sequence[str], runs: int, jobs: int, note: Callable[[str], None]
) -> DriveReport:
    """Drive scenarios (names or folders) with seeds from 0 on, spread evenly.

    Args:
        scenarios: at least one.
        runs: total number.
        jobs: number of parallel processes.
        note: is called with notes on progress.
    """
    tasks = spread(scenarios, runs)
    done: list[Run] = []
    for one in in_processes(run, tasks, jobs, lambda task: Run(*task, error="its process died")):
        done.append(one)
        if len(done) % EVERY == 0:
            note(f"{len(done)} of {len(tasks)} runs")
    return report(done)


def spread(scenarios: Sequence[str], runs: int) -> list[tuple[str, int]]:
    """Return as many pairs of scenario and seed as runs are wanted, spread evenly."""
    each, rest = divmod(runs, len(scenarios))
    return [
        (name, seed)
        for k, name in enumerate(scenarios)
        for seed in range(each + (1 if k < rest else 0))
    ]


def report(runs: Sequence[Run]) -> DriveReport:
    """Return the results by scenario, in the order of their first run."""
    names = list(dict.fromkeys(run.scenario for run in runs))
    by_name = {name: [run for run in runs if run.scenario == name] for name in names}
    taken = {name: [ms for run in by_name[name] for ms in run.decisions] for name in names}
    whole = DriveReport(
        bench="drive",
        figures=tuple(figure(name, "ms", times) for name, times in taken.items() if times),
        scenarios=tuple(tally(name, some) for name, some in by_name.items()),
        all=tally(ALL, runs),
        worst=worst(runs),
    )
    every = whole.all
    return aimed(
        whole,
        at_most("runs that failed", "", float(every.failed), 0.0),
        at_most("collisions caused", "", float(every.caused), 0.0),
        at_least("arrives where SUMO's driver does", "share", every.reached_share, ARRIVING),
        at_most("hard brakes provoked", "", float(every.provoked), float(every.sumo_provoked)),
        at_most("time ratio", "", every.time_ratio, TAKING),
    )


def tally(name: str, runs: Sequence[Run]) -> Tally:
    """Count some runs; those that failed are only counted as failed."""
    pairs = [(r.ours, r.sumo) for r in runs if r.ours is not None and r.sumo is not None]
    ours, sumo = [a for a, _ in pairs], [b for _, b in pairs]
    ratios = [a.time / b.time for a, b in pairs if arrived(a) and arrived(b) and b.time > 0.0]
    sumo_reached = sum(map(arrived, sumo))
    both = sum(arrived(a) and arrived(b) for a, b in pairs)
    ratio = mean(ratios)
    return Tally(
        scenario=name,
        runs=len(runs),
        failed=len(runs) - len(pairs),
        collisions=sum(bool(one.hits) for one in ours),
        caused=sum(one.caused for one in ours),
        sumo_collisions=sum(bool(one.hits) for one in sumo),
        sumo_caused=sum(one.caused for one in sumo),
        avoidable=sum(bool(a.hits) and not b.hits for a, b in pairs),
        hard_brakes=sum(one.hard_brakes for one in ours),
        sumo_hard_brakes=sum(one.hard_brakes for one in sumo),
        provoked=sum(one.provoked for one in ours),
        sumo_provoked=sum(one.provoked for one in sumo),
        reached=sum(map(arrived, ours)),
        sumo_reached=sumo_reached,
        reached_share=round(both / sumo_reached, 4) if sumo_reached else None,
        both=both,
        time_ratio=None if ratio is None else round(ratio, 4),
        time_ratio_p90=round(quantile(ratios, 90), 4) if ratios else None,
    )


def arrived(drive: Drive) -> bool:
    """Check whether a drive reached its goal."""
    return drive.ended == "arrived"


def worst(runs: Sequence[Run]) -> tuple[Bad, ...]:
    """Return the runs that went worst, the worst first."""
    judged = [(_badness(run), run) for run in runs]
    ranked = [(bad, run) for bad, run in judged if bad is not None]
    ranked.sort(key=lambda pair: (*pair[0][:2], pair[1].scenario, pair[1].seed))
    return tuple(
        Bad(run.scenario, run.seed, what, run.reproduce) for (_, _, what), run in ranked[:WORST]
    )


def _badness(run: Run) -> tuple[int, float, str] | None:
    """Return a rank, an order within it (lower is worse), and what happened; None: all well."""
    ours, sumo = run.ours, run.sumo
    if ours is None or sumo is None:
        return 0, 0.0, run.error or "failed"
    if ours.hits:
        hit = ours.hits[0]
        what = f"{'ran into' if hit.caused else 'was hit by'} vehicle {hit.vehicle}"
        known = ", as SUMO's driver collides" if sumo.hits else ""
        return (1 if hit.caused else 2), hit.time, f"{what} at {hit.time:.1f} s{known}"
    if arrived(sumo) and not arrived(ours):
        return 3, 0.0, f"did not arrive by {ours.time:.1f} s; SUMO's driver at {sumo.time:.1f} s"
    if ours.provoked > sumo.provoked or ours.hard_brakes > sumo.hard_brakes:
        what = f"{ours.hard_brakes} hard brakes, {ours.provoked} provoked"
        than = f"SUMO's driver {sumo.hard_brakes} and {sumo.provoked}"
        return 4, float(-ours.hard_brakes - ours.provoked), f"{what}; {than}"
    ratio = ours.time / max(sumo.time, 1e-9)
    if arrived(ours) and arrived(sumo) and ratio > SLOW:
        what = f"took {ours.time:.1f} s, {ratio:.2f} times what SUMO's driver takes"
        return 5, -ratio, what
    return None


def _cell(value: object) -> str:
    if value is None:
        return "-"
    return f"{value:.3f}" if isinstance(value, float) else str(value)
