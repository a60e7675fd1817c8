"""Runs: a scenario with a seed, driven by our planner and by SUMO's own driver."""

import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from functools import cache
from multiprocessing import active_children, get_context
from typing import TypeAlias, TypeVar

import msgspec

from benchmarks.drive.monitor import Drive, Observer
from planner.driving.driver import Driver
from planner.record.trace import EgoGoal
from sim.roads.network import Network
from sim.scene import Command, Scene
from sim.setup.scenario import Scenario, load
from sim.sumo import EgoGone, Simulation
from xavi_dialogue.dialogue.state.state import EPSILON
from xavi_dialogue.process.garbage import settled
from xavi_dialogue.vehicle.episode import network_of, settings_of
from xavi_dialogue.vehicle.replan_worker import warm_up

WARMING = "s2"  # scenario of the decision that warms a process up

See: TypeAlias = Callable[[Scene], None]

Task = TypeVar("Task")
Result = TypeVar("Result")


class Decided(msgspec.Struct, frozen=True):
    """The time of one decision, and the number of others."""

    ms: float  # [ms] of processor time: of one core, whatever else runs
    others: int  # in view


class Run(msgspec.Struct, frozen=True):
    """One scenario with one seed."""

    scenario: str  # name or folder, as given
    seed: int
    ours: Drive | None = None
    sumo: Drive | None = None
    error: str | None = None  # of a run that failed
    decisions: tuple[float, ...] = ()  # [ms] processor time of each decision

    @property
    def reproduce(self) -> str:
        """The command that repeats the run."""
        return f"xavi drive --scenario {self.scenario} --seed {self.seed}"


def run(task: tuple[str, int]) -> Run:
    """Drive a scenario (name or folder) with a seed; errors are part of the result."""
    name, seed = task
    try:
        warm()
        scenario = load(name, seed)
        network = network_of(scenario)
        with Simulation(scenario) as world:
            sumo = by_sumo(world, scenario, network)
        with Simulation(scenario) as world:
            ours, decisions = by_planner(world, scenario, network)
    except Exception as error:
        return Run(name, seed, error=f"{type(error).__name__}: {error}")
    return Run(name, seed, ours, sumo, None, tuple(one.ms for one in decisions))


def _overlook(_: Scene) -> None:
    """Ignore a scene."""


@cache
def warm() -> None:
    """Decide once per process, so that compiling is not part of the time of a decision."""
    warm_up(network_of(load(WARMING)))


def by_sumo(world: Simulation, scenario: Scenario, network: Network, see: See = _overlook) -> Drive:
    """Drive a scenario with SUMO as driver of the ego; call `see` with each scene."""
    return _driven(world, scenario, network, lambda _: None, see)


def by_planner(
    world: Simulation, scenario: Scenario, network: Network, see: See = _overlook
) -> tuple[Drive, tuple[Decided, ...]]:
    """Drive a scenario with our planner; call `see` with each scene.

    Returns:
        The drive, and the time of each decision.
    """
    goal = EgoGoal(scenario.goal.edge, scenario.goal.position, scenario.goal.lane)
    driver = Driver(network, goal, settings_of(scenario), scenario.seed)
    decisions: list[Decided] = []

    def command(scene: Scene) -> Command:
        began = time.process_time()
        driven = driver.step(scene, scenario.step)
        if driven.trace is not None:
            taken = round(1000.0 * (time.process_time() - began), 2)
            decisions.append(Decided(taken, len(scene.vehicles) + len(scene.people) - 1))
        return driven.command

    with settled():
        return _driven(world, scenario, network, command, see), tuple(decisions)


def _driven(
    world: Simulation,
    scenario: Scenario,
    network: Network,
    command: Callable[[Scene], Command | None],
    see: See,
) -> Drive:
    """Drive until the goal, a collision, the end of the ego's route, or the end of the time."""
    observer = Observer(network, scenario.goal)
    scene = world.scene()
    with suppress(EgoGone):
        while True:
            observer.see(scene)
            see(scene)
            if observer.hits:
                return observer.drive("collided")
            if observer.arrived:
                return observer.drive("arrived")
            if scene.time >= scenario.duration - EPSILON:
                return observer.drive("duration")
            scene = world.step(command(scene))
    return observer.drive("left")


def in_processes(
    function: Callable[[Task], Result],
    tasks: Sequence[Task],
    jobs: int,
    died: Callable[[Task], Result],
) -> Iterator[Result]:
    """Yield the results in the order of the tasks, from processes of their own.

    Args:
        function: works on one task; must be a function of a module.
        tasks: the tasks.
        jobs: number of parallel processes.
        died: the result of a task whose process dies.
    """
    rest = list(tasks)
    while rest:
        done = 0
        with suppress(BrokenProcessPool):
            for result in _pooled(function, rest, jobs):
                yield result
                done += 1
        rest = rest[done:]
        if rest:  # one of the next few killed its process: the first is tried alone
            try:
                yield from _pooled(function, rest[:1], 1)
            except BrokenProcessPool:
                yield died(rest[0])
            rest = rest[1:]


def _pooled(
    function: Callable[[Task], Result], tasks: Sequence[Task], jobs: int
) -> Iterator[Result]:
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        futures: list[Future[Result]] = []
        try:
            futures += [pool.submit(function, task) for task in tasks]
            for future in futures:
                yield future.result()
        except (KeyboardInterrupt, GeneratorExit):
            for child in active_children():  # they would go on with their tasks
                child.terminate()
            raise
        finally:
            for future in futures:
                future.cancel()
