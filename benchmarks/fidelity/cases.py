"""Cases: foils of decisions, as foreseen and as they happened in SUMO."""

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import msgspec

from benchmarks.drive.runs import warm
from benchmarks.fidelity.foresight import Foreseen, foresee
from benchmarks.fidelity.resimulate import Aim, Happened, drive_foil
from benchmarks.worlds.nets import write_net
from planner.counterfactuals.whatif import decide_again
from planner.driving.driver import Driver
from planner.record.trace import Action, EgoGoal, PlanTrace
from planner.roads.trajectory import Roads
from sim.roads.network import Network
from sim.setup.scenario import Scenario, load
from sim.sumo import Simulation
from xavi_dialogue.dialogue.state.state import EPSILON
from xavi_dialogue.explain.causes.plans.ranges import FoilKind, RoadKind, foil_kind, road_kind
from xavi_dialogue.vehicle.episode import network_of, settings_of

#: Families of random networks: those for learning ranges, and those for tests only.
LEARNING, RANDOM = "learning", "random"


class Task(msgspec.Struct, frozen=True):
    """A ride whose foils are to be compared."""

    world: str  # a scenario by name or folder; or a family of random networks
    seed: int  # of a random network also its number
    every: int = 1  # 2: every other decision that has alternatives
    blind: bool = True  # whether to foresee also with others that do not react


class Case(msgspec.Struct, frozen=True):
    """One foil of one decision."""

    scenario: str
    seed: int
    time: float  # [s] of the decision
    fact: Action
    foil: Action
    foreseen: Foreseen
    happened: Happened
    later: float | None = None  # [s] by which the foil arrived later than the fact, if both did
    blind: Foreseen | None = None  # what is foreseen if the others of a rollout do not react
    road: RoadKind = "road"
    waypoint: bool = False  # whether rollouts aim for a place on the way
    passed: float | None = None  # [s] like `later`, but to the place that the rollouts aim for
    fact_arrived: bool = False  # whether the ride came to the destination

    @property
    def kind(self) -> FoilKind:
        """The kind of the foil."""
        return foil_kind(self.foil)


class Compared(msgspec.Struct, frozen=True):
    """The foils of one ride."""

    scenario: str
    seed: int
    cases: tuple[Case, ...] = ()
    error: str | None = None


class _Pending(msgspec.Struct):
    """A decision whose outcome is not known yet."""

    aim: Aim
    cases: list[Case]
    fact: Happened | None = None
    arrived: float | None = None  # [s] from the decision to the ride's arrival at the destination


def compare(task: Task) -> Compared:
    """Compare all foils of every n-th decision of one ride; errors are part of the result."""
    try:
        warm()
        with _scenario(task) as scenario, Simulation(scenario) as world:
            pending = _ride(task, world, scenario)
        cases = tuple(case for one in pending for case in _settled(one))
        return Compared(task.world, task.seed, cases)
    except Exception as error:
        return Compared(task.world, task.seed, error=f"{type(error).__name__}: {error}")


@contextmanager
def _scenario(task: Task) -> Iterator[Scenario]:
    if task.world not in (LEARNING, RANDOM):
        yield load(task.world, task.seed)
        return
    with tempfile.TemporaryDirectory() as folder:
        yield write_net(task.world, task.seed, Path(folder))


def _ride(task: Task, world: Simulation, scenario: Scenario) -> list[_Pending]:
    network = network_of(scenario)
    roads = Roads(network)
    goal = EgoGoal(scenario.goal.edge, scenario.goal.position, scenario.goal.lane)
    driver = Driver(network, goal, settings_of(scenario), task.seed)
    scene, pending, taken = world.scene(), [], 0
    while not driver.finished and scene.time < scenario.duration - EPSILON:
        driven = driver.step(scene, scenario.step)
        trace = driven.trace
        free = trace is not None and trace.under_way is None
        taken += free
        if trace is not None and free and (taken - 1) % task.every == 0:
            aim = Aim.of(network, trace)
            cases = [
                msgspec.structs.replace(
                    case,
                    happened=drive_foil(
                        world, driver, aim, case.foreseen.plan or (case.foil,), scene, scenario.step
                    ),
                )
                for case in _foils(task, trace, roads)
            ]
            pending.append(_Pending(aim, cases))
        scene = world.step(driven.command)
        touched = world.collisions()
        for one in pending:
            one.fact = one.fact or one.aim.come_to(scene, touched)
            one.arrived = one.arrived or one.aim.arrived(scene)
        if touched:
            break
    return pending


def _foils(task: Task, trace: PlanTrace, roads: Roads) -> Iterator[Case]:
    """Yield the foils of a decision as foreseen."""
    blind = foresee(_blind(trace, roads.network), roads) if task.blind else {}
    for foil, foreseen in foresee(trace, roads).items():
        yield Case(
            task.world,
            task.seed,
            trace.sim_time,
            trace.plan[0].action,
            foil,
            foreseen,
            Happened("termination"),
            blind=blind.get(foil),
            road=road_kind(trace),
            waypoint=trace.waypoint is not None,
        )


def _blind(trace: PlanTrace, network: Network) -> PlanTrace:
    """Return the decision searched again with others that do not react to the ego."""
    settings = msgspec.structs.replace(trace.settings, reacting=False)
    again = decide_again(trace, network, settings)
    return msgspec.structs.replace(again, plan=trace.plan)


def _settled(one: _Pending) -> list[Case]:
    """Return the cases of a decision, with how much later the foils arrived."""
    fact = one.fact.time if one.fact is not None else None
    return [
        msgspec.structs.replace(
            case,
            later=_minus(case.happened.arrived, one.arrived),
            passed=_minus(case.happened.time, fact),
            fact_arrived=one.arrived is not None,
        )
        for case in one.cases
    ]


def _minus(there: float | None, here: float | None) -> float | None:
    return None if there is None or here is None else round(there - here, 3)
