"""`xavi bench explain`: how long it takes from a recorded decision to its explanation."""

import time
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from statistics import median

import msgspec

from benchmarks.explain import factorisations
from benchmarks.explain.dense_tables import available, done_by_pgmpy
from benchmarks.explain.synthetic_traces import FACT, FOIL, complete, made_up
from benchmarks.figures import (
    Aimed,
    Figure,
    Watch,
    aimed,
    at_most,
    figures_table,
    in_columns,
    targets_table,
)
from planner.record.trace import OUTCOMES, PlanTrace
from xavi_dialogue.causal.effects import effects
from xavi_dialogue.causal.model import CausalModel
from xavi_dialogue.dialogue.standing import reason_of
from xavi_dialogue.domain.answers import NeedRollout
from xavi_dialogue.domain.discourse import GroundedAct
from xavi_dialogue.domain.meaning import Act, Ask, Doing, HowMuch, HowSure, Listing, WhatIf, Why
from xavi_dialogue.domain.terms import Event, Happens, Measured, Not
from xavi_dialogue.explain.answers.engine import explain
from xavi_dialogue.explain.causes.vehicles.involved import contrastive_causes
from xavi_dialogue.explain.history.record import Record
from xavi_dialogue.process.garbage import settled
from xavi_dialogue.storage import ride_file
from xavi_dialogue.storage.ride_file import RecordedRide

STORIES = ("s1", "s2")
REPEATS = 5
VEHICLES = (1, 2, 3, 4, 6, 8, 10, 12)
DEPTHS = (1, 2, 3, 4, 5)
ROLLOUTS = (50, 100, 200, 400, 800, 1600)
USUAL = (3, 4, 150)  # vehicles, depth and rollouts if another size grows
COMPLETE_DEPTH = 2  # depth of complete records
MOST_COMPLETE = 5  # vehicles in complete records: each multiplies the rollouts by 4
MOST_USUAL = 8  # vehicles in comparisons with pgmpy: each multiplies its tables by 4
LIMIT = 10.0  # [s] for pgmpy, beyond which no larger network is tried
ROUNDING = 1e-9
QUESTIONS: Mapping[str, Act] = {
    "why": Ask(Listing("reasons")),
    "why not straight on": Ask(Why(Not(Happens(Event("continue"))))),
    "why not stop": Ask(Why(Not(Happens(Event("stop"))))),
    "what if stopped": Ask(WhatIf(Happens(Event("stop")))),
    "how sure": Ask(HowSure()),
    "what now": Ask(Doing()),
    "what next": Ask(Doing(tense="future")),
    "how fast": Ask(HowMuch(Measured("speed"))),
}
EVERYTHING = "all"  # name of the figure of all questions about all rides
TAIL = 5.0  # [ms] target: greatest p99 of that figure


class Growth(msgspec.Struct, frozen=True):
    """The median times of explaining synthetic decisions of one size."""

    axis: str  # the size that grows: vehicles, depth or rollouts
    vehicles: int
    depth: int
    rollouts: int
    answer: float  # [ms] from the trace to effects and causes


class Beside(msgspec.Struct, frozen=True):
    """A comparison of our p(O | do(plan)) from one record with that of pgmpy."""

    vehicles: int
    depth: int
    rollouts: int
    entries: int  # number of entries in pgmpy's tables
    ours: float  # [ms] from the trace to the answer
    build: float  # [ms] from the trace to pgmpy's network
    query: float  # [ms] from its network to its answer
    ratio: float  # pgmpy's time to ours, from the trace to the answer
    difference: float  # of the coverage, and of p(O) if nothing is unknown


class ExplainReport(Aimed, frozen=True):
    """The results of the benchmark."""

    bench: str
    figures: tuple[Figure, ...]
    growth: tuple[Growth, ...]
    beside: tuple[Beside, ...]  # empty without pgmpy
    paper: tuple[factorisations.Beside, ...]  # the paper's factorisation on the same decisions

    def table(self) -> str:
        """Return the report for people."""
        parts = [figures_table(self.figures)] if self.figures else ["no recorded rides"]
        parts.append(_columns(self.growth, Growth))
        parts.append(_columns(self.beside, Beside) if self.beside else "pgmpy is not installed")
        parts += [factorisations.table(self.paper)] if self.paper else []
        parts.append(targets_table(self.targets))
        return "\n\n".join(parts)


def measure(folder: Path, note: Callable[[str], None]) -> ExplainReport:
    """Time explanations of recorded decisions, their growth with size, and pgmpy's.

    Args:
        folder: folder of recorded rides (*.ride.jsonl.gz).
        note: is called with notes on what is left out.

    Raises:
        RideFileError: a file there is no recorded ride.
    """
    watch = Watch()
    rides = sorted(folder.glob("*.ride.jsonl.gz"))
    if not rides:
        note(f"no recorded rides in {folder}: their explanations are left out")
    known = {path.name.split(".")[0]: ride_file.load(path.read_bytes()) for path in rides}
    with settled():  # as in a warm service
        for name, ride in known.items():
            recorded(name, ride, watch)
    if not available():
        note("pgmpy is not installed (extra `compare`): the comparison is left out")
    figures = watch.figures()
    every = next((one.p99 for one in figures if one.name == EVERYTHING), None)
    report = ExplainReport(
        "explain",
        figures,
        tuple(growth(*size) for size in sizes()),
        tuple(beside()) if available() else (),
        stories({ride.scenario: ride for ride in reversed(known.values())}),  # the first of each
    )
    return aimed(report, at_most("explain, p99 over all rides", "ms", every, TAIL))


def stories(rides: Mapping[str, RecordedRide]) -> tuple[factorisations.Beside, ...]:
    """Compare the paper's factorisation with ours on rides of its stories, S1 and S2."""
    found = (factorisations.beside(name, rides[name]) for name in STORIES if name in rides)
    return tuple(row for rows in found for row in rows)


def recorded(name: str, ride: RecordedRide, watch: Watch) -> None:
    """Ask about every decision of a ride at its time; only answered questions count."""
    for trace in ride.traces:
        extra = tuple(ride.whatifs.values())
        record = Record(trace.sim_time, tuple(ride.traces), tuple(ride.events), False, extra)
        for kind, act in QUESTIONS.items():
            for _ in range(REPEATS):
                began = time.perf_counter()
                found = explain(GroundedAct(act), record)
                taken = time.perf_counter() - began
                if not isinstance(found, NeedRollout) and reason_of(found) is None:
                    watch.taken.setdefault(f"{name} {kind}", []).append(taken)
                    watch.taken.setdefault(EVERYTHING, []).append(taken)


def sizes() -> Iterator[tuple[str, int, int, int]]:
    """Yield the sizes of synthetic decisions: the axis, vehicles, depth, rollouts."""
    vehicles, depth, rollouts = USUAL
    yield from (("vehicles", count, depth, rollouts) for count in VEHICLES)
    yield from (("depth", vehicles, count, rollouts) for count in DEPTHS)
    yield from (("rollouts", vehicles, depth, count) for count in ROLLOUTS)


def growth(axis: str, vehicles: int, depth: int, rollouts: int) -> Growth:
    """Time the explanation of a synthetic decision of one size."""
    trace = made_up(vehicles, depth, rollouts)
    taken = []
    for _ in range(REPEATS):
        began = time.perf_counter()
        answer(CausalModel(trace))
        taken.append(time.perf_counter() - began)
    return Growth(axis, vehicles, depth, rollouts, _ms(median(taken)))


def answer(model: CausalModel) -> None:
    """Find effects and causes of the foil in a synthetic decision."""
    here, there = model.intervene((FACT,)), model.intervene((FOIL,))
    assert here is not None
    assert there is not None
    contrastive_causes(model, there, here, effects(there, here))


def beside() -> Iterator[Beside]:
    """Yield comparisons of complete records, then of usual ones, until pgmpy takes too long."""
    done_by_pgmpy(complete(1, 1), (FOIL,))  # imports it
    for records in (
        (complete(vehicles, COMPLETE_DEPTH) for vehicles in range(1, MOST_COMPLETE + 1)),
        (made_up(vehicles, *USUAL[1:]) for vehicles in range(1, MOST_USUAL + 1)),
    ):
        for trace in records:
            try:
                row = compared(trace)
            except MemoryError:
                break
            yield row
            if row.build + row.query > 1000.0 * LIMIT:
                break


def compared(trace: PlanTrace) -> Beside:
    """Compare p(O | do(plan)) from one record by both."""
    plan = tuple(timed.action for timed in trace.rollouts[0].actions)
    values, build, query, entries = done_by_pgmpy(trace, plan)
    began = time.perf_counter()
    found = CausalModel(trace).intervene(plan)
    ours = time.perf_counter() - began
    assert found is not None
    gaps = [abs(found.coverage - (1.0 - values[-1]))]
    if values[-1] < ROUNDING:  # nothing is unknown
        gaps += [abs(found.outcomes[name] - values[k]) for k, name in enumerate(OUTCOMES)]
    return Beside(
        len(trace.predictions),
        len(plan),
        len(trace.rollouts),
        entries,
        _ms(ours),
        _ms(build),
        _ms(query),
        round((build + query) / ours, 1),
        float(max(gaps)),
    )


def _ms(seconds: float) -> float:
    return round(1000.0 * seconds, 3)


def _columns(rows: tuple[msgspec.Struct, ...], kind: type[msgspec.Struct]) -> str:
    names = kind.__struct_fields__
    cells = [[_cell(getattr(row, name)) for name in names] for row in rows]
    return in_columns([list(names), *cells])


def _cell(value: str | int | float) -> str:
    if isinstance(value, float):
        return f"{value:.1e}" if 0.0 < value < 0.001 else f"{value:.2f}"
    return str(value)
