"""The report of `xavi bench recognise`, with its rows and its tables for people."""

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import msgspec

from benchmarks.figures import (
    Aimed,
    Figure,
    Target,
    aimed,
    at_least,
    at_most,
    figure,
    in_columns,
    targets_table,
)
from benchmarks.prediction.constants import VariedRow, varied_rows
from benchmarks.prediction.displacement import HORIZONS, METHODS, Error
from benchmarks.prediction.foretold import Foretold
from benchmarks.prediction.goal_scores import COMMONEST, OURS, UNIFORM, GoalRow, goal_rows
from benchmarks.prediction.recognise import Watched
from benchmarks.prediction.reliability import Bin, MapRow, fit, map_row
from benchmarks.prediction.stories import Story

SEEN = (0.0, 1.0, 2.0, 4.0, 7.0, 11.0)  # [s] bounds of the time since a vehicle came into view
LEFT = (0.0, 2.0, 4.0, 8.0, 99.0)  # [s] bounds of the time until it enters a road
DEVELOPMENT, HELD_OUT = "development", "held out"

Group = tuple[str, Callable[[Foretold], bool]]


class LineRow(msgspec.Struct, frozen=True):
    """Mean displacement errors of one method at one horizon."""

    group: str
    method: str
    horizon: float  # [s]
    moments: int
    average: float  # [m]
    final: float  # [m]
    lines: float  # number of trajectories, of which the best counts


class Part(msgspec.Struct, frozen=True):
    """The results on one set of networks."""

    name: str
    rides: int
    goals: tuple[GoalRow, ...]
    lines: tuple[LineRow, ...]


class RecogniseReport(Aimed, frozen=True, kw_only=True):
    """The results of the benchmark."""

    bench: str
    figures: tuple[Figure, ...]  # by how much each story is known before the ego is committed
    parts: tuple[Part, ...]
    maps: tuple[MapRow, ...]  # of the map fitted in development, on both sets
    constants: tuple[VariedRow, ...]
    stories: tuple[Story, ...]
    failed: tuple[str, ...]

    def table(self) -> str:
        """Return the report for people."""
        parts = [text for part in self.parts for text in _part(part)]
        parts += [_map(row) for row in self.maps]
        if self.constants:
            parts.append(_constants(self.constants))
        if self.stories:
            told = ["", "seed", "vehicle", "goal", "known", "started", "committed", "before"]
            parts.append(in_columns([told, *map(_story, self.stories)]))
        if self.failed:
            parts.append("\n".join(("failed:", *self.failed)))
        parts.append(targets_table(self.targets))
        return "\n\n".join(parts)


def report(watched: Sequence[Watched]) -> RecogniseReport:
    """Return the results of the rides."""
    stories = [one.story for one in watched if one.story is not None]
    sets = {
        DEVELOPMENT: [one for one in watched if one.task.scenario is not None],
        HELD_OUT: [one for one in watched if one.task.scenario is None],
    }
    whole = RecogniseReport(
        bench="recognise",
        figures=_ahead(stories),
        parts=tuple(_found(name, those) for name, those in sets.items() if those),
        maps=_maps(sets),
        constants=varied_rows([varied for one in watched for varied in one.varied]),
        stories=tuple(stories),
        failed=tuple(
            f"{one.error}\n    {one.task.name}, seed {one.task.seed}"
            for one in watched
            if one.error is not None
        ),
    )
    return aimed(whole, *_targets(whole))


def _targets(found: RecogniseReport) -> Iterator[Target]:
    """Yield the targets, on networks that were never used before."""
    unseen = next((part.goals[-1] for part in found.parts if part.name == HELD_OUT), None)
    sure = None if unseen is None else unseen.ahead - 2.0 * unseen.error
    name = "log score ahead of the better rival, less two standard errors"
    yield at_least(name, "", sure, 0.0)
    yield at_most("rides that failed", "", float(len(found.failed)), 0.0)


def groups(moments: Sequence[Foretold]) -> list[Group]:
    """Return the groups of moments: by network, roads, time seen and time left, and all."""
    families = dict.fromkeys(moment.family for moment in moments)
    kinds = sorted({moment.roads for moment in moments})
    found = [(name, _like("family", name)) for name in families]
    found += [(kind, _like("roads", kind)) for kind in kinds]
    for word, bounds in (("seen", SEEN), ("left", LEFT)):
        for low, high in pairwise(bounds):
            name = f"{word} {low:g} to {high:g} s" if high < LEFT[-1] else f"{word} {low:g} s on"
            found.append((name, _within(word, low, high)))
    return [*found, ("all", lambda _: True)]


def _like(attribute: str, value: str) -> Callable[[Foretold], bool]:
    return lambda moment: bool(getattr(moment, attribute) == value)


def _within(attribute: str, low: float, high: float) -> Callable[[Foretold], bool]:
    return lambda moment: bool(low <= getattr(moment, attribute) + 1e-9 < high)


def _found(name: str, watched: Sequence[Watched]) -> Part:
    moments = [moment for one in watched for moment in one.moments]
    chosen = groups(moments)
    lines = [row for group in chosen for row in line_rows(group, moments)]
    return Part(name, len(watched), goal_rows(moments, chosen), tuple(lines))


def line_rows(group: Group, moments: Sequence[Foretold]) -> list[LineRow]:
    """Return the mean displacement errors of each method in a group of moments."""
    name, belongs = group
    errors = [error for moment in moments if belongs(moment) for error in moment.errors]
    return [
        row
        for horizon in HORIZONS
        for method in METHODS
        if (row := _line_row(name, method, horizon, errors)) is not None
    ]


def _line_row(group: str, method: str, horizon: float, errors: Sequence[Error]) -> LineRow | None:
    those = [e for e in errors if e.method == method and e.horizon == horizon]
    if not those:
        return None
    count = len(those)
    means = (sum(e.average for e in those) / count, sum(e.final for e in those) / count)
    return LineRow(group, method, horizon, count, *means, sum(e.lines for e in those) / count)


def _maps(sets: dict[str, list[Watched]]) -> tuple[MapRow, ...]:
    """Fit a power on the development set, if there is one, and apply it to each set."""
    moments = {name: [m for one in those for m in one.moments] for name, those in sets.items()}
    learnt = moments[DEVELOPMENT]
    by = fit(learnt) if learnt else 1.0
    return tuple(map_row(name, by, those) for name, those in moments.items() if those)


def _ahead(stories: Sequence[Story]) -> tuple[Figure, ...]:
    found: dict[str, list[float]] = {}
    for story in stories:
        if story.known is not None and story.committed is not None:
            found.setdefault(story.scenario, []).append(story.committed - story.known)
    return tuple(figure(f"{name} known ahead", "s", ahead) for name, ahead in found.items())


def _part(part: Part) -> list[str]:
    methods = (OURS, UNIFORM, COMMONEST)
    head = [f"{part.name}, {part.rides} rides", "moments", "approaches"]
    head += [f"{what} {method}" for what in ("log", "Brier", "top-1") for method in methods]
    rows = [[*head, "ahead", "+-"]]
    for row in part.goals:
        cells = [row.group, str(row.moments), str(row.approaches)]
        for what in ("log", "brier", "top"):
            cells += [f"{getattr(row.scores[method], what):.3f}" for method in methods]
        rows.append([*cells, f"{row.ahead:.3f}", f"{row.error:.3f}"])
    return [in_columns(rows), _lines(part)]


def _lines(part: Part) -> str:
    rows = [[f"{part.name}: ADE / FDE [m]", "horizon", "moments", *METHODS, "lines"]]
    for group in dict.fromkeys(row.group for row in part.lines):
        for horizon in HORIZONS:
            those = [r for r in part.lines if r.group == group and r.horizon == horizon]
            if those:
                cells = [f"{r.average:.2f} / {r.final:.2f}" for r in those]
                lines = " and ".join(f"{r.lines:.1f}" for r in those[3:])
                rows.append([group, f"{horizon:g} s", str(those[0].moments), *cells, lines])
    return in_columns(rows)


def _map(row: MapRow) -> str:
    told = (
        f"{row.networks}, {row.moments} moments: power {row.power:g};"
        f" ECE {row.ece[0]:.3f} before, {row.ece[1]:.3f} after;"
        f" log score {row.log[0]:.3f} before, {row.log[1]:.3f} after,"
        f" gain {row.gain:.3f} +- {row.error:.3f}"
    )
    head = ["probability", "cases", "said", "true", "cases after", "said", "true"]
    after = {one.low: one for one in row.after}
    rows = [head]
    for one in row.before:
        rows.append([f"{one.low:g} to {one.high:g}", *_bin(one), *_bin(after.get(one.low))])
    return f"{told}\n{in_columns(rows)}"


def _bin(one: Bin | None) -> list[str]:
    return ["0", "", ""] if one is None else [str(one.cases), f"{one.said:.3f}", f"{one.true:.3f}"]


def _constants(rows: Sequence[VariedRow]) -> str:
    factors = list(rows[0].log)
    head = [
        f"change in {rows[0].moments} moments",
        *(f"log x{f}" for f in factors),
        *(f"top-1 x{f}" for f in factors),
    ]
    shown = [
        [row.constant, *(_change(by[f]) for by in (row.log, row.top) for f in factors)]
        for row in rows
    ]
    return in_columns([head, *shown])


def _change(value: float | None) -> str:
    return "same" if value is None else f"{value:+.3f}"


def _story(story: Story) -> list[str]:
    times = (story.known, story.started, story.committed)
    shown = ["never" if time is None else f"{time:.1f} s" for time in times]
    who = [story.scenario, str(story.seed), str(story.vehicle), story.kind]
    return [*who, *shown, "yes" if story.before else "no"]
