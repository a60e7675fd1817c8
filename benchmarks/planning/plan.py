"""`xavi bench plan`: how fast decisions are on this machine.

Times depend on the machine. To compare machines, take ratios to the yardstick, a plain loop that
is timed in the same run.
"""

import math
import time
from collections.abc import Sequence
from statistics import median

import msgspec

from benchmarks.figures import (
    Aimed,
    Figure,
    Target,
    Watch,
    aimed,
    at_most,
    figure,
    figures_table,
    in_columns,
    targets_table,
)
from benchmarks.igp2.beside import BesideIgp2
from benchmarks.igp2.beside import table as beside_table
from benchmarks.planning.dense_scenes import crowd
from benchmarks.planning.process_cost import Memory, memory, start_up
from benchmarks.planning.several_trees import SeveralTrees
from benchmarks.planning.several_trees import table as trees_table
from benchmarks.planning.timed_decision import timed_decision
from benchmarks.service.dialogue import SCENARIOS, SEED, ride
from benchmarks.svg import Line, Panel, chart
from planner.record.trace import EgoGoal, PlanTrace, Settings
from planner.roads.trajectory import Roads
from planner.search.decide import decide
from planner.search.inputs import Frame, Moment, Root, root_at
from planner.search.mcts import Search
from sim.scene import EGO
from sim.setup.scenario import load
from xavi_dialogue.process.garbage import settled
from xavi_dialogue.vehicle.episode import network_of, settings_of
from xavi_dialogue.vehicle.replan_worker import warm_up

ROAD = "motorway"  # scenario whose roads the synthetic moments use
VEHICLES = (1, 2, 3, 4, 6, 8, 10, 12)
DEPTHS = (1, 2, 3, 4, 5)
ROLLOUTS = (25, 50, 100, 200, 400)
USUAL = 3  # number of vehicles if something else grows
REPEATS = 3
BOUNDS = {3: 100.0, 12: 300.0, 40: 500.0}  # [ms] of the p99 of decisions, by others in view
SHIFTS = tuple(-6.0 + 0.5 * k for k in range(25))  # [m]
YARDSTICK = 200_000  # turns of the plain loop
PARTS = ("decision", "recognition", "search", "record")


class Growth(msgspec.Struct, frozen=True):
    """Decisions of one size: medians of some repeats."""

    axis: str  # the size that grows: vehicles, depth or rollouts
    vehicles: int  # others in view
    depth: int
    rollouts: int  # of the search
    decision: float  # [ms]
    recognition: float  # [ms] of the decision
    search: float  # [ms] of the decision
    record: float  # [ms] of the decision
    yardsticks: float  # ratio of the decision's time to the yardstick's
    rollouts_per_s: float  # recorded rollouts per time of the search
    vehicle_steps_per_s: float  # steps of 0.2 s of all vehicles in them, per time of the search


class PlanReport(Aimed, frozen=True, kw_only=True):
    """The results of the benchmark."""

    bench: str
    yardstick: float  # [ms]
    figures: tuple[Figure, ...]
    growth: tuple[Growth, ...]
    memory: tuple[Memory, ...]
    igp2: tuple[BesideIgp2, ...] = ()
    several_trees: tuple[SeveralTrees, ...] = ()

    def table(self) -> str:
        """Return the report for people."""
        names = [name for name in Growth.__struct_fields__ if name != "axis"]
        rows = [[name.replace("_per_", "/").replace("_", " ") for name in names]]
        rows += [[_cell(getattr(row, name)) for name in names] for row in self.growth]
        kept = [["memory", "hours", "decisions", "MB"]]
        kept += [["", f"{m.hours:.3f}", str(m.decisions), f"{m.resident:.1f}"] for m in self.memory]
        parts = [f"yardstick {self.yardstick:.2f} ms", figures_table(self.figures)]
        parts += [in_columns(rows)] + ([in_columns(kept)] if self.memory else [])
        parts += [beside_table(self.igp2)] if self.igp2 else []
        parts += [trees_table(self.several_trees)] if self.several_trees else []
        return "\n\n".join([*parts, targets_table(self.targets)])

    def plot(self) -> str:
        """Return the growth as an SVG document."""
        return chart([self._panel(axis) for axis in ("vehicles", "depth", "rollouts")])

    def _panel(self, axis: str) -> Panel:
        rows = [row for row in self.growth if row.axis == axis]
        lines = (
            Line(part, tuple((float(getattr(row, axis)), getattr(row, part)) for row in rows))
            for part in PARTS
        )
        return Panel(f"Time per decision by {axis}", axis, "ms", tuple(lines))


def measure(hours: float) -> PlanReport:
    """Time decisions, and watch the memory over some hours [h] of simulated driving."""
    yardstick = timed_yardstick()
    watch = Watch()
    for name in SCENARIOS:
        _ride_again(watch, name)
    starts = figure("start-up to the first decision", "ms", start_up())
    dense = crowded(tuple(BOUNDS), SHIFTS)
    whole = PlanReport(
        bench="plan",
        yardstick=round(1000.0 * yardstick, 3),
        figures=(*watch.figures(), starts, *dense),
        growth=growth(yardstick, VEHICLES, DEPTHS, ROLLOUTS, REPEATS),
        memory=memory(hours) if hours > 0.0 else (),
    )
    return aimed(whole, *bounded(dense))


def timed_yardstick() -> float:
    """Return the shortest of a few times [s] of a plain loop."""
    taken = []
    for _ in range(5):
        began, total = time.perf_counter(), 0.0
        for k in range(YARDSTICK):
            total += math.sqrt(k)
        taken.append(time.perf_counter() - began)
    return min(taken)


def crowded(sizes: Sequence[int], shifts: Sequence[float]) -> tuple[Figure, ...]:
    """Time decisions by the number of others in view, in processor time of one core.

    Args:
        sizes: numbers of others.
        shifts: [m] by which all of them are farther ahead, with one decision for each.
    """
    scenario = load(ROAD)
    network = network_of(scenario)
    warm_up(network)
    goal = EgoGoal(scenario.goal.edge, scenario.goal.position, scenario.goal.lane)
    watch = Watch(time.process_time)
    for others in sizes:
        for shift in shifts:
            frame, moment = crowd(network, goal, settings_of(scenario), others, shift)
            with settled(), watch.time(f"{others} others, processor time"):
                decide(frame, moment)
    return watch.figures()


def bounded(dense: Sequence[Figure]) -> list[Target]:
    """Return the bounds of decisions in dense scenes, one for each of `BOUNDS`."""
    pairs = zip(dense, BOUNDS.values(), strict=True)
    return [at_most(f"{one.name}, p99", one.unit, one.p99, bound) for one, bound in pairs]


def growth(
    yardstick: float,
    vehicles: Sequence[int],
    depths: Sequence[int],
    rollouts: Sequence[int],
    repeats: int,
) -> tuple[Growth, ...]:
    """Time synthetic decisions, while one size grows and the others stay as usual."""
    scenario = load(ROAD)
    network = network_of(scenario)
    warm_up(network)
    goal = EgoGoal(scenario.goal.edge, scenario.goal.position, scenario.goal.lane)
    usual = settings_of(scenario)
    sizes = [("vehicles", n, usual) for n in vehicles]
    sizes += [("depth", USUAL, msgspec.structs.replace(usual, depth=n)) for n in depths]
    sizes += [("rollouts", USUAL, msgspec.structs.replace(usual, rollouts=n)) for n in rollouts]
    found = []
    for axis, others, settings in sizes:
        watch, search = Watch(), None
        for _ in range(repeats):
            frame, moment = crowd(network, goal, settings, others)
            search = timed_decision(watch, "", frame, moment)
        assert search is not None
        found.append(_grown(axis, others, settings, watch, search, yardstick))
    return tuple(found)


def _grown(
    axis: str, others: int, settings: Settings, watch: Watch, search: Search, yardstick: float
) -> Growth:
    taken = {name: median(times) for name, times in watch.taken.items()}
    steps = sum(len(leg.speed) - 1 for one in search.rollouts for leg in one.legs)
    decision, recognition, searching, recording = (round(1000.0 * taken[part], 3) for part in PARTS)
    return Growth(
        axis=axis,
        vehicles=others,
        depth=settings.depth,
        rollouts=settings.rollouts,
        decision=decision,
        recognition=recognition,
        search=searching,
        record=recording,
        yardsticks=round(taken["decision"] / yardstick, 3),
        rollouts_per_s=round(len(search.rollouts) / taken["search"], 1),
        vehicle_steps_per_s=round(steps * (others + 1) / taken["search"], 1),
    )


def _ride_again(watch: Watch, name: str) -> None:
    """Take every decision of a ride again, and time its parts."""
    conversation, network = ride(name)
    goal = conversation.dialogue.traces[0].goal
    frame = Frame(Roads(network), goal, settings_of(load(name)), SEED, "car")
    for trace in conversation.dialogue.traces:
        moment = _moment(frame, trace)
        if moment is not None:
            timed_decision(watch, f"{name} ", frame, moment)


def _moment(frame: Frame, trace: PlanTrace) -> Moment | None:
    here = root_at(frame.roads, trace.scene[EGO], trace.sim_time)
    if here is None or trace.under_way is not None:
        return None
    return Moment(trace.decision, trace.sim_time, trace.scene, trace.history, Root(here))


def _cell(value: float) -> str:
    if isinstance(value, int):
        return str(value)
    return f"{value:.1f}" if value < 1000.0 else f"{value:.0f}"
