"""A decision as text: predictions, the search, and the choice.

Text from the trace is cleaned, so that it cannot control a terminal.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from planner.record.trace import PlanTrace, VehiclePrediction
from planner.search.trees import trees_of
from sim.scene import EGO, VehicleState
from xavi_dialogue.bus.sanitize import one_line
from xavi_dialogue.inspection.comparison import Option, comparison
from xavi_dialogue.inspection.search_tree import Branch, Hindrance, grow

KMH = 3.6
PLAIN = 1e6  # numbers from here on are written with an exponent
FOREMOST = 3  # number of road users shown as hold-ups
LIKELY = 0.005  # probability below which a goal is shown only on request

Row: TypeAlias = tuple[str, ...]

HEADINGS: Row = ("", "visits", "forced", "value", "alike", "time", "outcomes", "held up by")
COMPARED: Row = ("", "reward", "time", "outcomes", "told", "collision")
OF_COMPARED = """\
reward   mean, as outcomes and time are, by the weights of the samples: what the decision went by
told     mean reward by all rollouts of a plan, and collision: its probability, as answers tell it
"""
LEGEND = """\
visits   rollouts of the search; forced: rollouts added for comparison and evidence
value    of the action in the search; alike: mean reward over samples tried with every first action
time     [s] mean time to the goal of the rollouts that reach it
held up  vehicle, how, share of the rollouts, mean seconds of those
◀        the chosen plan; ✗ could not be done"""


@dataclass(frozen=True, slots=True)
class Extent:
    """The extent of the tree that is shown."""

    depth: int = 2  # macro actions in a row, besides the chosen plan
    all: bool = False  # every branch, every goal, every refusal


def show(trace: PlanTrace, extent: Extent) -> str:
    """Return the decision as text.

    Raises:
        TreeError: the rollouts are no search.
    """
    root = grow(trace)
    compared = comparison(trace)
    parts = [_head(trace), _expectations(trace, extent), _search(root, extent), _plan(trace)]
    if compared:
        parts.insert(3, _compared(compared))
    legend = (OF_COMPARED if compared else "") + LEGEND
    return "\n\n".join("\n".join(part) for part in parts) + "\n\n" + legend


def listing(traces: Sequence[PlanTrace]) -> str:
    """Return one line for each decision of a ride."""
    rows: list[Row] = [("decision", "time", "speed", "plan")]
    for trace in traces:
        ego = trace.scene.get(EGO)
        under_way = "" if trace.under_way is None else f"  ({trace.under_way.action} is under way)"
        rows.append(
            (
                str(trace.decision),
                f"{_number(trace.sim_time)} s",
                "" if ego is None else _speed(ego),
                _chain(planned.action for planned in trace.plan) + under_way,
            )
        )
    return "\n".join(_columns(rows, right=(0, 1, 2)))


def _head(trace: PlanTrace) -> Iterator[str]:
    goal, settings = trace.goal, trace.settings
    lane = "any lane" if goal.lane is None else f"lane {goal.lane}"
    ego = trace.scene.get(EGO)
    speed = "" if ego is None else f", at {_speed(ego)}"
    now = f"decision {trace.decision} at {_number(trace.sim_time)} s{speed}"
    place = f"{one_line(goal.edge)} ({_number(goal.position)} m, {lane})"
    yield f"{one_line(trace.vehicle)}: {now}, to {place}"
    grown = "" if trees_of(settings) == 1 else f" in {trees_of(settings)} trees"
    yield (
        f"trace {trace.trace_id}; seed {trace.seed}; {settings.rollouts} rollouts{grown},"
        f" {settings.depth} actions deep, {_number(settings.horizon)} s ahead"
    )
    if trace.under_way is not None:
        yield f"{trace.under_way.action} is under way and must be finished first"
    if trace.what_if is not None:
        yield f"planned again: {_supposed(trace)}"


def _supposed(trace: PlanTrace) -> str:
    request, said = trace.what_if, []
    assert request is not None
    if request.gone:
        said.append(f"without vehicle {' and '.join(map(str, sorted(request.gone)))}")
    if request.vehicle is not None:
        does = _chain(request.vehicle_actions) or one_line(request.goal or "")
        if isinstance(request.faster, float):
            does = f"drive {_number(request.faster)} m/s faster"
        said.append(f"supposing that vehicle {request.vehicle} does: {does}")
    if request.actions:
        said.append(f"{request.rollouts} rollouts forced to begin: {_chain(request.actions)}")
    return "; ".join(said) or "with nothing changed"


def _expectations(trace: PlanTrace, extent: Extent) -> Iterator[str]:
    yield "What the others were believed to do"
    if not trace.predictions:
        yield "  nobody was in view"
    for known in trace.predictions:
        yield f"  vehicle {known.vehicle}{_looks(trace.scene.get(known.vehicle))}"
        yield from (f"    {line}" for line in _columns(_goals(known, extent), right=(0,)))


def _goals(known: VehiclePrediction, extent: Extent) -> list[Row]:
    goals = sorted(known.goals, key=lambda goal: -goal.probability)
    return [
        (
            f"{goal.probability:.2f}",
            goal.kind,
            one_line(goal.place) + (f" ({one_line(goal.edge)})" if goal.edge else ""),
            " · ".join(f"{_chain(way.actions)} {way.probability:.2f}" for way in goal.trajectories)
            if len(goal.trajectories) > 1
            else "",
        )
        for goal in goals
        if extent.all or goal.probability >= LIKELY
    ]


def _looks(state: VehicleState | None) -> str:
    if state is None:
        return ""
    words = [one_line(word) for word in (state.colour, state.kind) if word]
    return f", {' '.join(words)}, {_speed(state)}"


def _search(root: Branch, extent: Extent) -> Iterator[str]:
    total = f"{root.visits} of the search, {root.forced} forced"
    yield f"What was tried: {root.visits + root.forced} rollouts ({total})"
    rows = [HEADINGS, _row("now", root), *_below(root, "", extent)]
    yield from _columns(rows, right=(1, 2, 3, 4, 5))


def _below(branch: Branch, indent: str, extent: Extent) -> Iterator[Row]:
    """Format the rows below a branch: options that were tried, and inapplicable ones."""
    children = branch.children if _opens(branch, extent) else ()
    children = tuple(c for c in children if _shown(c, extent))
    barred = branch.refused if _explains(branch, extent) else ()
    last = len(children) + len(barred) - 1
    for k, child in enumerate(children):
        twig, deeper = ("└─ ", "   ") if k == last else ("├─ ", "│  ")
        mark = " ◀" if child.chosen else ""
        yield _row(f"{indent}{twig}{child.actions[-1]}{mark}", child)
        yield from _below(child, indent + deeper, extent)
    for k, (reason, actions) in enumerate(barred, len(children)):
        twig = "└─ " if k == last else "├─ "
        yield (f"{indent}{twig}✗ {', '.join(actions)}: {one_line(reason)}",)


def _opens(branch: Branch, extent: Extent) -> bool:
    return extent.all or branch.chosen or len(branch.actions) < extent.depth


def _shown(branch: Branch, extent: Extent) -> bool:
    return extent.all or branch.chosen or len(branch.actions) <= extent.depth


def _explains(branch: Branch, extent: Extent) -> bool:
    """Format why other options were inapplicable: at the root, or everywhere on request."""
    return extent.all or not branch.actions


def _row(label: str, branch: Branch) -> Row:
    return (
        label,
        str(branch.visits),
        str(branch.forced),
        _number(branch.value),
        _number(branch.alike),
        _number(branch.time),
        ", ".join(f"{outcome} {count}" for outcome, count in branch.outcomes.items()),
        _hindrances(branch.held_up),
    )


def _hindrances(held_up: Sequence[Hindrance]) -> str:
    told = [
        f"{one.vehicle} {one.how} {one.share:.0%} {_number(one.seconds)} s"
        for one in held_up[:FOREMOST]
    ]
    return " · ".join(told) + (" · …" if len(held_up) > FOREMOST else "")


def _compared(rows: Sequence[Option]) -> Iterator[str]:
    """Yield rows of the first actions, by the weights of the samples tried with all of them."""
    yield f"What was compared: {rows[0].samples} joint samples by their weights"
    table = [
        (
            f"{one.action}{' ◀' if one.chosen else ''}",
            _number(one.value),
            _number(one.time),
            ", ".join(f"{outcome} {share:.1%}" for outcome, share in one.chances.items()),
            _number(one.told),
            "" if one.collision is None else f"{one.collision:.1%}",
        )
        for one in rows
    ]
    yield from _columns([COMPARED, *table], right=(1, 2, 4, 5))


def _plan(trace: PlanTrace) -> Iterator[str]:
    if not trace.plan:
        yield "What was chosen: nothing; the car stops"
        return
    steps = (f"{step.action} ({_number(step.value)}, {step.visits} visits)" for step in trace.plan)
    yield "What was chosen: " + " → ".join(steps)


def _columns(rows: Sequence[Row], right: Sequence[int]) -> Iterator[str]:
    """Return rows in aligned columns; rows of a single cell do not widen a column."""
    full = [row for row in rows if len(row) > 1]
    widths = [max(len(cell) for cell in column) for column in zip(*full, strict=True)]
    for row in rows:
        if len(row) == 1:
            yield row[0]
            continue
        cells = (
            cell.rjust(width) if k in right else cell.ljust(width)
            for k, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        yield "  ".join(cells).rstrip()


def _chain(actions: Iterator[str] | Sequence[str]) -> str:
    return " → ".join(actions)


def _speed(state: VehicleState) -> str:
    return f"{_number(state.speed * KMH, 0)} km/h"


def _number(value: float | None, digits: int = 1) -> str:
    """Format a number, short even if it is extreme; empty for None."""
    if value is None:
        return ""
    return f"{value:.{digits}f}" if abs(value) < PLAIN else f"{value:.1e}"
