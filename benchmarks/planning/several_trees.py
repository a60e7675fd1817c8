"""Decisions with several search trees in as many processes, beside decisions with one tree."""

import time
from collections.abc import Callable, Sequence
from statistics import mean, median

import msgspec

from benchmarks.figures import in_columns
from planner.counterfactuals.whatif import restore
from planner.record.trace import EgoGoal, PlanTrace, WhatIf
from planner.roads.trajectory import Roads
from planner.search.decide import Elsewhere, decide
from planner.search.trees import trees_of
from sim.roads.network import Network
from sim.setup.scenario import Scenario, load
from xavi_dialogue.process.garbage import settled
from xavi_dialogue.vehicle.episode import network_of, settings_of, start
from xavi_dialogue.vehicle.replan_worker import warm_up
from xavi_dialogue.vehicle.search_worker import TreeOfRide
from xavi_dialogue.vehicle.search_workers import search_workers

SCENARIOS = ("motorway", "junction", "city")
ROLLOUTS = (100, 400)
SEED = 0


class SeveralTrees(msgspec.Struct, frozen=True):
    """The decisions of one ride, taken with one tree and with several; times by the clock."""

    scenario: str
    rollouts: int
    trees: int
    decisions: int
    others: float  # mean number in view
    samples: float  # mean number of distinct joint samples in the ride's own decisions
    one: float  # [ms] median with one tree
    several: float  # [ms] median with several
    ratio: float  # median of `several` to `one`, decision by decision


def several_trees(trees: int, note: Callable[[str], None]) -> tuple[SeveralTrees, ...]:
    """Take the decisions of some rides again.

    Args:
        trees: number of search trees, and of processes.
        note: gets a line before each ride.
    """
    found = []
    for name in SCENARIOS:
        note(f"{name}: decisions with {trees} trees beside one")
        found += _beside(name, trees)
    return tuple(found)


def _beside(name: str, trees: int) -> list[SeveralTrees]:
    scenario = load(name, SEED)
    network = network_of(scenario)
    warm_up(network)
    with start(scenario, network) as ride:
        traces = [moment.trace for moment in ride if moment.trace is not None]
    goal = EgoGoal(scenario.goal.edge, scenario.goal.position, scenario.goal.lane)
    usual = settings_of(scenario, trees)
    found = []
    for rollouts in ROLLOUTS:
        settings = msgspec.structs.replace(usual, rollouts=rollouts)
        ride_of_trees = TreeOfRide(goal, settings, SEED, traces[0].vehicle)
        found.append(_ridden(scenario, network, ride_of_trees, traces))
    return found


def _ridden(
    scenario: Scenario, network: Network, ride: TreeOfRide, traces: Sequence[PlanTrace]
) -> SeveralTrees:
    """Take the decisions of a ride again, with its settings and with one tree."""
    alone = msgspec.structs.replace(ride.settings, trees=1)
    roads = Roads(network), Roads(network)  # each with caches of its own
    one, several = [], []
    with search_workers(scenario.network, ride) as elsewhere, settled():
        _await(traces[0], roads[1], elsewhere)
        for trace in traces:
            single = msgspec.structs.replace(trace, settings=alone)
            multiple = msgspec.structs.replace(trace, settings=ride.settings)
            one.append(_timed(single, roads[0], None))
            several.append(_timed(multiple, roads[1], elsewhere))
    return SeveralTrees(
        scenario=scenario.name,
        rollouts=ride.settings.rollouts,
        trees=trees_of(ride.settings),
        decisions=len(traces),
        others=round(mean(len(trace.scene) - 1 for trace in traces), 1),
        samples=round(mean(map(_distinct, traces)), 1),
        one=round(median(one), 1),
        several=round(median(several), 1),
        ratio=round(median(b / a for a, b in zip(one, several, strict=True)), 3),
    )


def _timed(trace: PlanTrace, roads: Roads, elsewhere: Elsewhere | None) -> float:
    """Take a decision again, and return how long [ms] that took."""
    frame, moment = restore(trace, roads, WhatIf())
    began = time.perf_counter()
    decide(frame, moment, elsewhere)
    return 1000.0 * (time.perf_counter() - began)


def _await(trace: PlanTrace, roads: Roads, elsewhere: Elsewhere | None) -> None:
    """Wait until the workers are ready."""
    _, moment = restore(trace, roads, WhatIf())
    while elsewhere is not None and not all(wait() for wait in elsewhere(moment)):
        time.sleep(0.1)


def _distinct(trace: PlanTrace) -> int:
    drawn = (rollout for rollout in trace.rollouts if not rollout.forced)
    return len({(one.samples, one.lights, one.phantoms) for one in drawn})


def table(rows: tuple[SeveralTrees, ...]) -> str:
    """Return the rows for people."""
    names = SeveralTrees.__struct_fields__
    return in_columns([list(names), *([str(getattr(row, n)) for n in names] for row in rows)])
