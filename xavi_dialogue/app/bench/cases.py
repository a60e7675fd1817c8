"""Cases: foils of decisions, as they were foreseen and as they turned out in SUMO."""

import msgspec

from planner.driver import Driver
from planner.trace import Action, EgoGoal, PlanTrace
from planner.whatif import decide_again
from sim.network import Network
from sim.scenario import Scenario, load
from sim.sumo import Simulation
from xavi_dialogue.app.bench.foresight import Foreseen, foresee
from xavi_dialogue.app.bench.resimulate import Aim, Happened, drive_foil
from xavi_dialogue.app.bench.runs import warm
from xavi_dialogue.app.ride import network_of, settings_of
from xavi_dialogue.dialogue.state import EPSILON


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
    blind: Foreseen | None = None  # what would be said if the others of a rollout did not react


class Compared(msgspec.Struct, frozen=True):
    """The foils of one ride."""

    scenario: str
    seed: int
    cases: tuple[Case, ...] = ()
    error: str | None = None


class _Pending(msgspec.Struct):
    """A decision, until it is known what came of what was decided."""

    aim: Aim
    cases: list[Case]
    fact: Happened | None = None


def compare(task: tuple[str, int, int]) -> Compared:
    """Compare all foils of every so many decisions of one ride; errors are told in the result."""
    name, seed, every = task
    try:
        warm()
        scenario = load(name)
        with Simulation(scenario, seed) as world:
            pending = _ride(name, world, scenario, seed, every)
        return Compared(name, seed, tuple(case for one in pending for case in _settled(one)))
    except Exception as error:
        return Compared(name, seed, error=f"{type(error).__name__}: {error}")


def _ride(
    name: str, world: Simulation, scenario: Scenario, seed: int, every: int
) -> list[_Pending]:
    network = network_of(scenario)
    goal = EgoGoal(scenario.goal.edge, scenario.goal.position, scenario.goal.lane)
    driver = Driver(network, goal, settings_of(scenario), seed)
    scene, pending, taken = world.scene(), [], 0
    while not driver.finished and scene.time < scenario.duration - EPSILON:
        driven = driver.step(scene, scenario.step)
        trace = driven.trace
        free = trace is not None and trace.under_way is None
        taken += free
        if trace is not None and free and (taken - 1) % every == 0:
            aim = Aim.of(network, trace)
            blind = foresee(_blind(trace, network), network)
            cases = [
                Case(
                    name,
                    seed,
                    trace.sim_time,
                    trace.plan[0].action,
                    foil,
                    foreseen,
                    drive_foil(world, driver, aim, foil, scene, scenario.step),
                    blind=blind.get(foil),
                )
                for foil, foreseen in foresee(trace, network).items()
            ]
            pending.append(_Pending(aim, cases))
        scene = world.step(driven.command)
        touched = world.collisions()
        for one in pending:
            one.fact = one.fact or one.aim.come_to(scene, touched)
        if touched:
            break
    return pending


def _blind(trace: PlanTrace, network: Network) -> PlanTrace:
    """The decision as it would have been searched among others that do not react to the ego."""
    settings = msgspec.structs.replace(trace.settings, reacting=False)
    again = decide_again(trace, network, settings)
    return msgspec.structs.replace(again, plan=trace.plan)


def _settled(one: _Pending) -> list[Case]:
    """The cases of a decision, with how much later the foils arrived."""
    fact = one.fact.time if one.fact is not None else None
    return [
        msgspec.structs.replace(case, later=round(case.happened.time - fact, 3))
        if fact is not None and case.happened.time is not None
        else case
        for case in one.cases
    ]
