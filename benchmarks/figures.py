"""Figures: the results of benchmarks, as one JSON object or as a table."""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from statistics import quantiles
from typing import Literal, Protocol, TypeAlias, TypeVar

import msgspec
from msgspec.structs import replace

T = TypeVar("T", bound="Aimed")


class Report(Protocol):
    """The results of a benchmark: a struct that can be written as JSON."""

    def table(self) -> str:
        """Return the report for people."""


Measure: TypeAlias = Callable[[Callable[[str], None]], Report]  # gets a function for notes
Show: TypeAlias = Callable[[Measure, bool], None]  # measures, and prints: as JSON or for people


class Target(msgspec.Struct, frozen=True):
    """A figure with a bound that it is to reach."""

    name: str
    unit: str
    value: float | None  # None: nothing was measured, so the target is not met
    bound: float
    sense: Literal["at most", "at least"]
    met: bool


class Aimed(msgspec.Struct, frozen=True, kw_only=True):
    """The fields of a benchmark's report that has targets besides its figures."""

    targets: tuple[Target, ...] = ()
    met: bool = True  # whether all targets are met


class Figure(msgspec.Struct, frozen=True):
    """One quantity that was measured."""

    name: str
    unit: str
    n: int  # number of cases
    p50: float
    p99: float
    most: float


class Figures(msgspec.Struct, frozen=True):
    """The results of a benchmark."""

    bench: str
    figures: tuple[Figure, ...]

    def table(self) -> str:
        """Return the figures for people."""
        return figures_table(self.figures)


class Watch:
    """A collection of durations [s] by name."""

    def __init__(self, clock: Callable[[], float] = time.perf_counter) -> None:
        self.taken: dict[str, list[float]] = {}
        self._clock = clock  # [s]

    @contextmanager
    def time(self, name: str) -> Iterator[None]:
        """Measure the duration of the context."""
        began = self._clock()
        yield
        self.taken.setdefault(name, []).append(self._clock() - began)

    def figures(self) -> tuple[Figure, ...]:
        """Return the durations [ms], in the order in which they were first taken."""
        return tuple(
            figure(name, "ms", [1000.0 * one for one in taken])
            for name, taken in self.taken.items()
        )


def at_most(name: str, unit: str, value: float | None, bound: float) -> Target:
    """Make the target that a figure is no more than a bound."""
    return Target(name, unit, value, bound, "at most", value is not None and value <= bound)


def at_least(name: str, unit: str, value: float | None, bound: float) -> Target:
    """Make the target that a figure is no less than a bound."""
    return Target(name, unit, value, bound, "at least", value is not None and value >= bound)


def aimed(report: T, *targets: Target) -> T:
    """Return a report with its targets."""
    return replace(report, targets=targets, met=all(target.met for target in targets))


def targets_table(targets: Sequence[Target]) -> str:
    """Return targets as a table for people."""
    rows = [("targets", "unit", "found", "bound", "")]
    rows += [
        (
            one.name,
            one.unit,
            "-" if one.value is None else f"{one.value:.2f}",
            f"{one.sense} {one.bound:g}",
            "met" if one.met else "missed",
        )
        for one in targets
    ]
    return in_columns(rows)


def figures_table(figures: Sequence[Figure]) -> str:
    """Return figures as a table for people."""
    rows = [("", "unit", "n", "p50", "p99", "most")]
    rows += [
        (f.name, f.unit, str(f.n), f"{f.p50:.2f}", f"{f.p99:.2f}", f"{f.most:.2f}") for f in figures
    ]
    return in_columns(rows)


def figure(name: str, unit: str, values: Sequence[float]) -> Figure:
    """Return the median, the 99th percentile and the highest of some values, at least one."""
    p50, p99, most = (
        round(v, 3) for v in (quantile(values, 50), quantile(values, 99), max(values))
    )
    return Figure(name, unit, len(values), p50, p99, most)


def quantile(values: Sequence[float], percent: int) -> float:
    """Return a percentile of some values, at least one, by interpolation."""
    if len(values) == 1:
        return values[0]
    return quantiles(values, n=100, method="inclusive")[percent - 1]


def mean(values: Sequence[float]) -> float | None:
    """Return the mean; None if there are no values."""
    return sum(values) / len(values) if values else None


def in_columns(rows: Sequence[Sequence[str]]) -> str:
    """Return rows of the same length as a table: first column left-aligned, others right."""
    widths = [max(len(cell) for cell in column) for column in zip(*rows, strict=True)]
    lines = (
        "  ".join(
            cell.rjust(width) if k else cell.ljust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        for row in rows
    )
    return "\n".join(line.rstrip() for line in lines)
