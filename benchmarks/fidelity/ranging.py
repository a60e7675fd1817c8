"""Ranges of differences in time, learnt from some cases and tested on others."""

import math
from collections.abc import Callable, Sequence
from typing import TypeAlias

import msgspec

from benchmarks.fidelity.cases import Case, Compared
from benchmarks.fidelity.model_errors import Known, fitted
from benchmarks.figures import in_columns, mean
from xavi_dialogue.causal.conformal import COVERAGE, reach
from xavi_dialogue.explain.causes.plans.ranges import Error, Ranges, Source, group_errors

Ends: TypeAlias = tuple[float, float]


class Coverage(msgspec.Struct, frozen=True):
    """The share of cases in which ranges held, and the widths [s] of the ranges."""

    cases: str  # a scenario, a family of networks, a kind of foil, or all
    n: int  # foils that are foreseen to arrive, on rides that arrive
    missed: int  # those of them that never came to the destination, so that no range holds
    refused: int  # those of them of a kind with too few cases for a range
    covered: float | None  # share of the others that lie in the stated range
    width: float | None  # [s] mean
    rollouts: float | None  # share of the same cases within the range of the rollouts
    rollouts_width: float | None
    constant: float | None  # share within a range of constant width around what is foreseen
    constant_width: float


class Extension(msgspec.Struct, frozen=True):
    """Errors of times to the destination if rollouts aim for a waypoint."""

    cases: str
    n: int
    error: float | None  # [s] mean absolute error of the stated difference
    bias: float | None  # [s] mean of foreseen minus happened
    error_extended: float | None  # the same with the estimate of the rest of the way
    bias_extended: float | None


def timed(cases: Sequence[Case]) -> list[Case]:
    """Return the cases for which a range may be stated, and whose fact arrived."""
    return [
        case
        for case in cases
        if case.foreseen.time is not None
        and case.foreseen.likeliest == "done"
        and case.fact_arrived
    ]


def learn(found: Sequence[Compared], command: str) -> Ranges:
    """Make the table of ranges from foils that were driven.

    Args:
        found: the rides.
        command: that makes the table again.

    Raises:
        ValueError: there are too few cases even for one range.
    """
    rides = [one for one in found if one.error is None]
    cases = timed([case for one in rides for case in one.cases])
    errors = [Error(c.kind, c.road, f"{c.scenario}-{c.seed}", error_of(c)) for c in cases]
    sizes: dict[str, list[float]] = {}
    for error in errors:
        sizes.setdefault(error.ride, []).append(error.error)
    pooled = reach(list(sizes.values()))
    if pooled is None:
        raise ValueError(f"{len(rides)} rides are too few")
    worlds: dict[str, tuple[int, int]] = {}
    for one in rides:
        low, high = worlds.get(one.scenario, (one.seed, one.seed))
        worlds[one.scenario] = (min(low, one.seed), max(high, one.seed))
    missed = sum(case.later is None for case in cases)
    outcomes = _outcomes(rides)
    wrong = fitted(outcomes)
    return Ranges(
        COVERAGE,
        round(pooled, 3),
        group_errors(errors),
        Source(command, worlds, len(rides), len(cases), missed, len(outcomes), wrong.mean),
        wrong.bound,
        wrong.unforeseen,
    )


def _outcomes(rides: Sequence[Compared]) -> list[Known]:
    """Return the actual outcomes of the foils whose outcomes were foreseen."""
    return [
        Known(
            f"{case.scenario}-{case.seed}",
            case.happened.outcome,
            case.foreseen.outcomes.get(case.happened.outcome, 0.0),
        )
        for one in rides
        for case in one.cases
        if case.foreseen.declined is None
    ]


def error_of(case: Case) -> float:
    """Return how much [s] later than foreseen a foil arrived; infinite if it never did."""
    assert case.foreseen.time is not None
    return math.inf if case.later is None else case.later - case.foreseen.time


def coverage(name: str, cases: Sequence[Case], ranges: Ranges) -> Coverage:
    """Test ranges on cases that they were not learnt from."""
    known = timed(cases)
    told = [case for case in known if ranges.group(case.kind, case.road) is not None]
    ours, raw, one = (_held(told, ends) for ends in (_ours(ranges), _raw, _constant(ranges)))
    return Coverage(
        name,
        len(known),
        sum(case.later is None for case in known),
        len(known) - len(told),
        ours[0],
        ours[1],
        raw[0],
        raw[1],
        one[0],
        round(2.0 * ranges.constant, 3),
    )


def extension(name: str, cases: Sequence[Case]) -> Extension:
    """Test the estimate of the rest of the way beyond a waypoint."""
    pairs = [
        (case.foreseen.time - case.later, case.foreseen.extended - case.later)
        for case in timed(cases)
        if case.waypoint
        and case.later is not None
        and case.foreseen.time is not None
        and case.foreseen.extended is not None
    ]
    figures = [
        _rounded(mean([size(pair[k]) for pair in pairs])) for k in (0, 1) for size in (abs, float)
    ]
    return Extension(name, len(pairs), *figures)


def coverage_table(rows: Sequence[Coverage]) -> str:
    """Return the coverage as a table for people."""
    head = ("", "n", "missed", "refused", "covered", "width", "rollouts", "width", "constant")
    cells = [
        (
            row.cases,
            *(str(n) for n in (row.n, row.missed, row.refused)),
            *(
                _cell(value)
                for value in (
                    *(row.covered, row.width, row.rollouts, row.rollouts_width, row.constant),
                    row.constant_width,
                )
            ),
        )
        for row in rows
    ]
    return in_columns([(*head, "width"), *cells])


def extension_table(rows: Sequence[Extension]) -> str:
    """Return the estimates as a table for people."""
    head = ("beyond waypoints", "n", "error", "bias", "error extended", "bias extended")
    cells = [
        (
            row.cases,
            str(row.n),
            *(_cell(v) for v in (row.error, row.bias, row.error_extended, row.bias_extended)),
        )
        for row in rows
    ]
    return in_columns([head, *cells])


def _held(cases: Sequence[Case], ends: Callable[[Case], Ends]) -> tuple[float | None, float | None]:
    """Return the share of cases that lie within ranges, and the mean width [s] of these."""
    found = [(case, *ends(case)) for case in cases]
    held = [
        float(case.later is not None and low <= case.later <= high) for case, low, high in found
    ]
    return _rounded(mean(held)), _rounded(mean([high - low for _, low, high in found]))


def _ours(ranges: Ranges) -> Callable[[Case], Ends]:
    def ends(case: Case) -> Ends:
        group = ranges.group(case.kind, case.road)
        assert group is not None
        assert case.foreseen.time is not None
        return case.foreseen.time - group.reach, case.foreseen.time + group.reach

    return ends


def _raw(case: Case) -> Ends:
    assert case.foreseen.low is not None
    assert case.foreseen.high is not None
    return case.foreseen.low, case.foreseen.high


def _constant(ranges: Ranges) -> Callable[[Case], Ends]:
    def ends(case: Case) -> Ends:
        assert case.foreseen.time is not None
        return case.foreseen.time - ranges.constant, case.foreseen.time + ranges.constant

    return ends


def _rounded(value: float | None) -> float | None:
    return None if value is None else round(value, 3)


def _cell(value: float | None) -> str:
    return "-" if value is None else f"{value:.3f}"
