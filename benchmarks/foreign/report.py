"""The results of `xavi bench foreign`, as one object or as tables."""

from collections.abc import Sequence

import msgspec

from benchmarks.figures import (
    Aimed,
    Figure,
    Target,
    aimed,
    at_least,
    at_most,
    figure,
    figures_table,
    in_columns,
    targets_table,
)
from benchmarks.foreign.riding import Ridden
from benchmarks.foreign.sites import LeftOut
from benchmarks.foreign.tally import Tally, arrived, tally

ALL = "all"
WORST = 40
CROWDS = ((3, 100.0), (12, 300.0), (40, 500.0))  # greatest number of others, and bound [ms]
ARRIVING = 0.98  # target: share of the rides in which SUMO's driver arrives
RATIO = 1.03  # target: ratio to the time that SUMO's driver takes
SLOW = 1.15


class Bad(msgspec.Struct, frozen=True):
    """A ride that did not go well."""

    site: str
    seed: int
    what: str
    reproduce: str


class ForeignReport(Aimed, frozen=True, kw_only=True):
    """The results of the benchmark."""

    bench: str = "foreign"
    figures: tuple[Figure, ...]
    sites: tuple[Tally, ...]
    all: Tally
    worst: tuple[Bad, ...]
    left_out: tuple[LeftOut, ...] = ()

    def table(self) -> str:
        """Return the report for people."""
        parts = [in_columns([_HEAD, *(_row(one) for one in (*self.sites, self.all))])]
        parts += ["", figures_table(self.figures), "", targets_table(self.targets)]
        parts += ["", "rides that did not go well:"]
        parts += [f"{x.site} {x.seed}: {x.what}\n    {x.reproduce}" for x in self.worst] or ["none"]
        if self.left_out:
            parts += ["", "left out:", *(f"{x.name}: {x.why}" for x in self.left_out)]
        return "\n".join(parts)


_HEAD = (
    *("", "rides", "arrived", "caused", "reds", "crossings", "limits", "off road"),
    *("brakes", "provoked", "comfort", "score", "time", "others", "p50", "p99", "start"),
)


def report(rides: Sequence[Ridden], left_out: Sequence[LeftOut]) -> ForeignReport:
    """Sum up rides, by site in the order of their names."""
    there = [ride for ride in rides if ride.place is not None]
    names = sorted({ride.site for ride in there})
    by_name = {name: [ride for ride in there if ride.site == name] for name in names}
    nowhere = {ride.site: ride.error or "" for ride in rides if ride.site not in by_name}
    gone = (*left_out, *(LeftOut(name, why) for name, why in sorted(nowhere.items())))
    whole = tally(ALL, there)
    found = ForeignReport(
        figures=_figures(there),
        sites=tuple(tally(name, some) for name, some in by_name.items()),
        all=whole,
        worst=worst(there),
        left_out=gone,
    )
    return aimed(found, *_targets(whole, there))


def _targets(whole: Tally, rides: Sequence[Ridden]) -> list[Target]:
    ours, sumo = whole.ours, whole.sumo
    both = (sumo.arrived - whole.missed) / sumo.arrived if sumo.arrived else None
    crowded = _by_crowd(rides)
    times = [
        at_most(f"decision p99, up to {most} others", "ms", _p99(crowded.get(most, ())), bound)
        for most, bound in CROWDS
    ]
    return [
        at_most("rides that failed", "", float(whole.failed), 0.0),
        at_least("arrived where SUMO's driver does", "share", both, ARRIVING),
        at_most("collisions caused", "", float(ours.caused), 0.0),
        at_most("lights passed on red", "", float(ours.reds), 0.0),
        at_most("crossings violated", "", float(ours.violated), 0.0),
        at_most("limits violated", "", float(ours.limits), 0.0),
        at_most("hard brakes provoked", "", float(ours.provoked), float(sumo.provoked)),
        at_most("time ratio", "", whole.time_ratio, RATIO),
        *times,
    ]


def _figures(rides: Sequence[Ridden]) -> tuple[Figure, ...]:
    found = [
        figure(f"decision, up to {most} others", "ms", times)
        for most, times in _by_crowd(rides).items()
        if times
    ]
    started = [ride.start_up for ride in rides if ride.start_up is not None]
    return (*found, figure("start-up", "s", started)) if started else tuple(found)


def _by_crowd(rides: Sequence[Ridden]) -> dict[int, list[float]]:
    """Return the times [ms] of decisions, by the greatest number of others in view."""
    most = [*(most for most, _ in CROWDS), 1000]
    found: dict[int, list[float]] = {bound: [] for bound in most}
    for ride in rides:
        for one in ride.decisions:
            found[next(bound for bound in most if one.others <= bound)].append(one.ms)
    return found


def _p99(times: Sequence[float]) -> float | None:
    return figure("", "", times).p99 if times else None


def worst(rides: Sequence[Ridden]) -> tuple[Bad, ...]:
    """Return the rides that went worst, the worst first."""
    judged = [(judgement, ride) for ride in rides if (judgement := _badness(ride)) is not None]
    judged.sort(key=lambda pair: (pair[0][0], pair[1].site, pair[1].seed))
    return tuple(
        Bad(ride.site, ride.seed, what, ride.reproduce) for (_, what), ride in judged[:WORST]
    )


def _badness(ride: Ridden) -> tuple[int, str] | None:
    """Return a rank (lower is worse) and what happened; None if all went well."""
    ours, sumo = ride.ours, ride.sumo
    if ours is None or sumo is None:
        return 0, ride.error or "failed"
    drive, conduct = ours.drive, ours.conduct
    if drive.hits:
        hit = drive.hits[0]
        what = "ran into" if hit.caused else "was hit by"
        return (1 if hit.caused else 5), f"{what} {hit.vehicle} at {hit.time:.1f} s"
    for name, times in (
        ("passed on red", conduct.reds),
        ("violated a crossing", conduct.violated),
        ("violated a limit", conduct.limits),
        ("left the road", conduct.off_road),
    ):
        if times:
            return 2, f"{name} at {', '.join(f'{time:.1f}' for time in times)} s"
    if arrived(sumo) and not arrived(ours):
        return 3, f"did not arrive by {drive.time:.1f} s; SUMO's driver at {sumo.drive.time:.1f} s"
    if drive.provoked > sumo.drive.provoked:
        return 6, f"provoked {drive.provoked} hard brakes; SUMO's driver {sumo.drive.provoked}"
    if arrived(ours) and arrived(sumo) and drive.time > SLOW * sumo.drive.time:
        return 7, f"took {drive.time:.1f} s; SUMO's driver {sumo.drive.time:.1f} s"
    return None


def _row(one: Tally) -> list[str]:
    """Return the cells of a row: our values, and after a slash those of SUMO's driver."""
    a, b = one.ours, one.sumo
    return [
        one.site,
        str(one.rides),
        f"{a.arrived}/{b.arrived}",
        f"{a.caused}/{b.caused}",
        f"{a.reds}/{b.reds} of {a.lights}",
        f"{a.violated}/{b.violated} of {a.crossings}",
        f"{a.limits}/{b.limits}",
        f"{a.off_road}/{b.off_road}",
        f"{a.hard_brakes}/{b.hard_brakes}",
        f"{a.provoked}/{b.provoked}",
        f"{_cell(a.comfort)}/{_cell(b.comfort)}",
        f"{_cell(a.score)}/{_cell(b.score)}",
        _cell(one.time_ratio),
        _cell(one.company, 1),
        _cell(one.decision_p50, 0),
        _cell(one.decision_p99, 0),
        _cell(one.start_up),
    ]


def _cell(value: float | None, digits: int = 2) -> str:
    return "-" if value is None else f"{value:.{digits}f}"
